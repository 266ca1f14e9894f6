// The selected node: what is known of it and how surely, its edges to go along, what became of it, and a place to teach.

import { button, el, replaceIfNew } from "./dom.js";
import { clock, place, title } from "./words.js";

const TAUGHT = { room: "label", object: "name", person: "name" };
const MOST_EDGES = 60;
const AGAIN_MS = 1000;
const EDGE_ORDER = ["relation", "in", "connects", "has_intention", "match", "has", "rt"];
const HISTORY = {
  known: () => "known when this record began",
  found: () => "found",
  gone: () => "no longer in the graph",
  moved: ({ before, after }) => `moved by ${Math.hypot(...after.map((value, i) => value - before[i])).toFixed(2)} m`,
  room: ({ after }, name) => (after ? `now in ${name(after)}` : "in no room"),
  place: ({ before, after }, name) => (after ? `now ${inWords(after, name)}` : `no longer ${inWords(before, name)}`),
  state: ({ before, after }) => `${after ?? "unknown"}, was ${before ?? "unknown"}`,
  label: ({ before, after }) => `taken for ${after ?? "nothing"}, before for ${before ?? "nothing"}`,
  name: ({ before, after }) => (after ? `called ${after}` : `no longer called ${before}`),
  seen_again: () => "seen again",
};
const spaced = (text) => text.replaceAll("_", " ");
const inWords = (text, name) => text.replace(/^(\w+) (.+)$/, (_, predicate, id) => `${predicate} ${name(id)}`);
const numbers = (values, joint) => values?.map((value) => value.toFixed(2)).join(joint);
// Coarse, so that it does not change all the time.
function ago(age_s) {
  if (age_s < 2) return "now";
  if (age_s < 60) return `${Math.floor(age_s / 5) * 5 || "a few"} s ago`;
  if (age_s < 5400) return `${Math.floor(age_s / 60)} min ago`;
  return age_s < 172800 ? `${Math.round(age_s / 3600)} h ago` : `${Math.round(age_s / 86400)} days ago`;
}

const percent = (value) => `${Math.round(100 * value)} %`;

export class NodePanel {
  #panel; #acts; #id = null; #loaded = { id: null, entries: [] }; #due = 0; #shown = {};
  #heading = el("h2"); #facts = el("dl"); #edges = el("details", { open: true }); #history = el("details", { open: true }); #teaching = el("div");

  // `acts`: { select(id), teach(id, body), close(), fetch(path) }.
  constructor(panel, acts) {
    [this.#panel, this.#acts] = [panel, acts];
    panel.append(this.#heading, button("×", () => acts.close(), { class: "close", "aria-label": "Close" }), this.#facts, this.#teaching, this.#edges, this.#history);
  }

  // `scene`: { nodes, edges, robot, selected }.
  show(scene) {
    const id = scene.selected, node = nodeOf(id, scene);
    this.#panel.hidden = !id;
    if (!id) { this.#id = null; return; }
    if (id !== this.#id) this.#begin(id);
    if (node !== this.#shown.node) this.#loadSoon();
    this.#shown = { ...scene, node };
    replaceIfNew(this.#heading, `${id} ${node && title(node)}`, () => [`${node ? title(node) : spaced(id)} `, el("small", {}, id)]);
    const facts = node ? factsOf(node, scene) : [["is", "no longer in the graph"]];
    replaceIfNew(this.#facts, JSON.stringify(facts), () => facts.flatMap(([key, value]) => [el("dt", {}, key), el("dd", {}, value)]));
    this.#showEdges(id, scene);
    this.#showHistory();
    replaceIfNew(this.#teaching, node && TAUGHT[node.type] ? id : "", () => (node && TAUGHT[node.type] ? teachingForm(node, this.#acts.teach) : []));
  }

  #begin(id) {
    this.#id = id;
    this.#loaded = { id, entries: [] };
    this.#shown = {};
    this.#panel.scrollTop = 0;
  }

  #showEdges(id, scene) {
    const edges = edgesOf(id, scene);
    this.#edges.hidden = !edges.length;
    replaceIfNew(this.#edges, JSON.stringify(edges), () => [
      el("summary", {}, `${edges.length} edge${edges.length === 1 ? "" : "s"}`),
      el("ul", "edges", edges.slice(0, MOST_EDGES).map(({ words, other, text, kind, sure }) => el("li", {}, el("span", `kind ${kind}`, words), " ",
        scene.nodes.has(other) || other === "robot" ? button(text, () => this.#acts.select(other), { class: "link", "data-focus": `${kind} ${words} ${other}` }) : text, sure ? el("small", {}, ` ${sure}`) : null))),
      edges.length > MOST_EDGES ? el("p", "soft", `and ${edges.length - MOST_EDGES} more`) : null,
    ].filter(Boolean));
  }

  #showHistory() {
    const { entries, dropped } = this.#loaded, { nodes } = this.#shown, name = (id) => (nodes.has(id) ? title(nodes.get(id)) : spaced(id));
    this.#history.hidden = !entries.length;
    const now_s = this.#shown.robot?.stamp_s ?? 0;
    const when = (stamp_s) => (stamp_s < 0 ? ago(now_s - stamp_s) : clock(stamp_s));
    const lines = entries.toReversed().map((entry) => [when(entry.stamp_s), HISTORY[entry.kind]?.(entry, name) ?? spaced(entry.kind)]);
    replaceIfNew(this.#history, JSON.stringify(lines), () => [el("summary", {}, "History"), el("ol", "happenings", lines.map(([time, text]) => el("li", {}, el("time", {}, time), text))), dropped ? el("p", "soft", `and ${dropped} older`) : null].filter(Boolean));
  }

  #loadSoon() {
    if (this.#due) return;
    this.#due = setTimeout(() => { this.#due = 0; this.#load(); }, this.#loaded.entries.length ? AGAIN_MS : 0);
  }

  async #load() {
    const id = this.#id;
    if (!id) return;
    const past = await this.#acts.fetch(`/v1/scene/nodes/${encodeURIComponent(id)}/history`).catch(() => null);
    if (id !== this.#id || !past) return;
    this.#loaded = { id, ...past };
    this.#showHistory();
  }
}

// The robot's own node is as its last event told.
function nodeOf(id, { nodes, robot }) {
  const node = nodes.get(id);
  if (id !== "robot" || !robot) return node;
  const { x, y, yaw_rad } = robot.pose_map;
  return { ...node, id, type: "robot", label: "robot", room: robot.room, position_m: [x, y, 0], yaw_rad, state: [robot.status, robot.localized ? "" : "lost"].filter(Boolean).join(", "), holding: robot.holding };
}

function factsOf(node, { nodes, edges, robot }) {
  const since = (stamp_s) => (typeof stamp_s === "number" && robot ? ago(Math.max(0, robot.stamp_s - stamp_s)) : undefined);
  const room = (id) => (nodes.has(id) ? title(nodes.get(id)) : "not known yet");
  const others = node.label_distribution?.slice(0, 3).filter(([, probability]) => probability >= 0.01);
  const rows = {
    is: node.type === "object" ? spaced(node.label) : node.type,
    where: ["object", "person"].includes(node.type) ? place(node, nodes, edges) : node.type === "robot" ? room(node.room) : undefined,
    joins: node.rooms && node.type === "door" ? [node.rooms[0], node.rooms[1]].map(room).join(" – ") : undefined,
    holds: node.holding ? room(node.holding) : undefined,
    region: node.region ? room(node.region) : undefined,
    color: [node.attributes?.color, ...(node.attributes?.accents ?? [])].filter(Boolean).join(", ") || undefined,
    kind: node.attributes?.categories?.join(", "),
    state: [node.state, node.status !== "permanent" ? node.status : "", node.provisional ? "not sure yet" : "", { uncrossed: "not crossed yet", given_up: `given up: ${node.crossing_reason}` }[node.crossing]].filter(Boolean).join(", "),
    "position (m)": numbers(node.position_m, ", "),
    "± 1 σ (cm)": node.position_std_m?.some(Boolean) ? node.position_std_m.map((value) => (100 * value).toFixed(1)).join(", ") : undefined,
    "size (m)": numbers(node.size_m, " × "),
    "width (m)": node.width_m?.toFixed(2),
    "height (m)": node.height_m?.toFixed(2),
    "first seen": node.first_seen_s ? since(node.first_seen_s) : undefined,
    "last seen": since(node.last_seen_s),
    "looked at": since(node.inspected_s),
    sightings: node.observations || undefined,
    certainty: node.confidence === undefined ? undefined : percent(node.confidence),
    "still there": node.existence === undefined || node.state === "held" ? undefined : percent(node.existence),
    "looks like": others?.length > 1 ? others.map(([label, probability]) => `${spaced(label)} ${percent(probability)}`).join(", ") : undefined,
  };
  return Object.entries(rows).filter(([, value]) => value !== undefined && value !== null && value !== "").map(([key, value]) => [key, String(value)]);
}

// Every edge of a node in words, with the node at its other end.
function edgesOf(id, { nodes, edges }) {
  const words = {
    relation: ({ label }, out) => (out ? spaced(label) : `${spaced(label)} it`),
    in: (_, out) => (out ? "belongs to" : "contains"),
    connects: (_, out) => (out ? "leads to" : "has"),
    has_intention: ({ action, status, label }, out) => (out ? `shall ${action}` : `${action} wanted by ${label} (${status})`),
    match: () => "same door as",
    has: (_, out) => (out ? "offers" : "offered by"),
    rt: (_, out) => (out ? "frame of" : "in the frame of"),
  };
  const found = [];
  for (const edge of edges.values()) {
    if (edge.source !== id && edge.target !== id) continue;
    const out = edge.source === id, other = out ? edge.target : edge.source, node = nodes.get(other);
    const sure = edge.type === "relation" ? percent(edge.probability) : "";
    found.push({ kind: edge.type, other, text: node && !["wall", "corner", "root"].includes(node.type) ? title(node) : spaced(other), words: words[edge.type]?.(edge, out) ?? spaced(edge.type), sure });
  }
  return found.sort((a, b) => EDGE_ORDER.indexOf(a.kind) - EDGE_ORDER.indexOf(b.kind));
}

function teachingForm(node, teach) {
  const input = el("input", { maxlength: 80, placeholder: node.type === "room" ? "this is the …" : "call it …", "aria-label": "Name to teach" });
  const submit = async (event) => {
    event.preventDefault();
    if (input.value.trim() && await teach(node.id, { [TAUGHT[node.type]]: input.value.trim() })) input.value = "";
  };
  return el("form", { class: "row", onsubmit: submit }, input, el("button", {}, "Teach"));
}
