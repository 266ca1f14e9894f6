// The scene graph by layers: the building, a card for each room, in it its doors, people, furniture and what lies on it.
// What is contained or carried is told by nesting; other edges are drawn between the nodes as curves.

import { button, el, replaceIfNew } from "./dom.js";
import { isFurniture, paint, shape } from "./shapes.js";
import { title } from "./words.js";

const LAYERS = [["door", "doors"], ["person", "people and robot"], ["furniture", "furniture"], ["thing", "things"], ["names", "their names"], ["wall", "walls"]];
const EDGES = [["connects", "doors between rooms"], ["relation", "other relations"], ["has_intention", "intentions"]];
const AT_FIRST = new Set(["door", "person", "furniture", "thing", "connects", "names"]);
const CROWD = 150;
const DRAW_MS = 400;
const ROOMY = "(min-width: 821px)";

export class GraphView {
  #panel; #scene = null; #due = 0; #on = new Set(AT_FIRST); #select;
  #cards = el("ul", { class: "cards", "aria-label": "Nodes by room" });
  #under = shape("svg", { class: "curves", "aria-hidden": "true" });
  #over = shape("svg", { class: "curves over", "aria-hidden": "true" });
  #canvas = el("div", { class: "canvas" });

  // `select(id)` hears which node was picked.
  constructor(panel, select) {
    [this.#panel, this.#select] = [panel, select];
    this.#canvas.append(this.#under, this.#cards, this.#over);
    panel.append(this.#switches(), this.#canvas);
    this.#cards.addEventListener("click", ({ target }) => { const id = target.closest("[data-id]")?.dataset.id; if (id) this.#select(id); });
    this.#cards.addEventListener("keydown", (event) => this.#press(event));
    new ResizeObserver(() => this.#draw()).observe(this.#cards);
  }

  // Shows a scene soon; nothing is done while the view is hidden.
  show(scene) {
    this.#scene = scene;
    if (!this.#due && !this.#panel.hidden) this.#due = setTimeout(() => { this.#due = 0; this.#fill(); }, this.#cards.childElementCount ? DRAW_MS : 0);
  }

  select(id) {
    if (this.#panel.hidden || !this.#scene) return;
    this.#mark();
    this.#draw();
    this.#cards.querySelector(`[data-id="${CSS.escape(id ?? "")}"]`)?.scrollIntoView({ block: "nearest" });
  }

  #switches() {
    const box = ([name, text]) => el("label", `switch ${name}`, el("input", { type: "checkbox", checked: this.#on.has(name), onchange: ({ target }) => this.#switch(name, target.checked) }), el("i"), text);
    const group = (legend, all) => el("fieldset", {}, el("legend", {}, legend), all.map(box));
    return el("details", { class: "switches", open: matchMedia(ROOMY).matches }, el("summary", {}, "Layers and edges"), group("Layers", LAYERS), group("Edges", EDGES));
  }

  #switch(name, isOn) {
    this.#on[isOn ? "add" : "delete"](name);
    this.#fill();
  }

  // Of very many things the names are shown on demand.
  #abbreviate() {
    this.#on.delete("names");
    this.#panel.querySelector(".switch.names input").checked = false;
  }

  #fill() {
    if (!this.#scene || this.#panel.hidden) return;
    if (!this.#cards.childElementCount && this.#scene.nodes.size > CROWD) this.#abbreviate();
    this.#cards.classList.toggle("dots", !this.#on.has("names"));
    const cards = cardsOf(this.#scene, this.#on);
    const before = new Map([...this.#cards.children].map((card) => [card.dataset.room, card]));
    const shown = cards.map((card) => {
      const item = before.get(card.id) ?? el("li", { class: "card", "data-room": card.id });
      replaceIfNew(item, JSON.stringify(card), () => branch(card));
      return item;
    });
    if (shown.length !== this.#cards.childElementCount || shown.some((item, i) => item !== this.#cards.children[i])) this.#cards.replaceChildren(...shown);
    this.#mark();
    this.#draw();
  }

  #buttons() { return [...this.#cards.querySelectorAll("[data-id]")]; }

  #mark() {
    const { selected, edges } = this.#scene, near = new Set();
    for (const { source, target, type } of edges.values()) if (type !== "rt") { if (source === selected) near.add(target); if (target === selected) near.add(source); }
    const buttons = this.#buttons(), current = buttons.find((one) => one === document.activeElement) ?? buttons.find((one) => one.dataset.id === selected) ?? buttons[0];
    for (const one of buttons) {
      one.setAttribute("aria-pressed", one.dataset.id === selected);
      one.classList.toggle("near", near.has(one.dataset.id));
      one.tabIndex = one === current ? 0 : -1;
    }
  }

  // Curves between nodes that are shown, behind the cards unless they are the selected node's. A door has an end in each of its rooms.
  #draw() {
    if (!this.#scene || this.#panel.hidden) return;
    const origin = this.#cards.getBoundingClientRect(), spots = new Map();
    for (const one of this.#buttons()) {
      const { left, top, width, height } = one.getBoundingClientRect(), spot = { x: left - origin.left, y: top - origin.top + height / 2, w: width };
      spots.set(one.dataset.id, [...(spots.get(one.dataset.id) ?? []), spot]);
    }
    const curves = curvesOf(this.#scene, this.#on, spots), isOver = (curve) => curve.classList.contains("selected");
    for (const svg of [this.#under, this.#over]) { svg.setAttribute("width", origin.width); svg.setAttribute("height", origin.height); }
    this.#under.replaceChildren(...curves.filter((curve) => !isOver(curve)));
    this.#over.replaceChildren(...curves.filter(isOver));
  }

  #press(event) {
    const buttons = this.#buttons(), at = buttons.indexOf(document.activeElement);
    const next = { ArrowDown: at + 1, ArrowRight: at + 1, ArrowUp: at - 1, ArrowLeft: at - 1, Home: 0, End: buttons.length - 1 }[event.key];
    if (next === undefined || !buttons[next]) return;
    event.preventDefault();
    buttons[at].tabIndex = -1;
    buttons[next].tabIndex = 0;
    buttons[next].focus();
  }
}

// What each card holds, as nested plain documents: { id, kind, text, note, inside }.
export function cardsOf({ nodes, edges, robot }, on) {
  const all = [...nodes.values()], carried = carriers(edges);
  const leaf = (node, kind) => ({ id: node.id, kind, text: title(node), note: noteOf(node), color: kind === "thing" ? paint(node.attributes?.color ?? "") : undefined, inside: [] });
  const kindOf = (node) => (node.type === "object" ? (isFurniture(node) ? "furniture" : "thing") : node.type);
  const inRoom = (room) => {
    const here = all.filter((node) => node.type === "object" && (node.room ?? "") === room), byId = new Map(here.map((node) => [node.id, leaf(node, kindOf(node))]));
    const top = [];
    for (const [id, item] of byId) (byId.get(carried.get(id))?.inside ?? top).push(item);
    return top.sort((a, b) => (a.kind === b.kind ? b.inside.length - a.inside.length : a.kind === "furniture" ? -1 : 1));
  };
  const doorsOf = (room) => all.filter((node) => node.type === "door" && node.rooms.includes(room.id)).map((node) => {
    const beyond = node.rooms.find((id) => id !== room.id);
    return { ...leaf(node, "door"), text: beyond && nodes.has(beyond) ? `door to ${title(nodes.get(beyond))}` : "door, beyond not known" };
  });
  const peopleIn = (room) => [...all.filter((node) => node.type === "person" && node.room === room.id).map((node) => leaf(node, "person")), ...(robot?.room === room.id ? [{ id: "robot", kind: "person robot", text: "robot", note: "", inside: [] }] : [])];
  const wallsOf = (room) => all.filter((node) => node.type === "wall" && node.room === room.id).map((node) => ({ ...leaf(node, "wall"), text: node.id.replaceAll("_", " ") }));
  const rooms = neighborly(all);
  const card = (room) => ({ ...leaf(room, "room"), inside: [...doorsOf(room), ...peopleIn(room), ...inRoom(room.id), ...wallsOf(room)] });
  const elsewhere = inRoom(""), regions = all.filter((node) => node.type === "region");
  const building = { id: "building", kind: "building", text: "Building", note: `${counted(rooms.length, "room")}, ${counted(all.filter(({ type }) => type === "object").length, "thing")}`, inside: regions.map((node) => ({ ...leaf(node, "region"), note: counted(node.rooms.length, "room") })) };
  const cards = [building, ...rooms.map(card), ...(elsewhere.length ? [{ id: "elsewhere", kind: "building", text: "In no room", note: "", inside: elsewhere }] : [])];
  return cards.map((one) => ({ ...one, inside: pruned(one.inside, on) }));
}

const counted = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;

// Rooms by region, and each followed by those behind its doors, so that curves are short.
function neighborly(all) {
  const rooms = all.filter((node) => node.type === "room").sort((a, b) => (a.region ?? "").localeCompare(b.region ?? "") || a.id.localeCompare(b.id, "en", { numeric: true }));
  const doors = all.filter((node) => node.type === "door"), order = new Set();
  const visit = (room) => {
    if (order.has(room)) return;
    order.add(room);
    for (const other of rooms) if (other.region === room.region && doors.some((door) => door.rooms.includes(room.id) && door.rooms.includes(other.id))) visit(other);
  };
  rooms.forEach(visit);
  return [...order];
}

// Layers that are switched off are left out, and what they hold moves up.
function pruned(items, on) {
  return items.flatMap((item) => {
    const inside = pruned(item.inside, on), layer = item.kind.split(" ")[0];
    return layer === "region" || on.has(layer) ? [{ ...item, inside }] : inside;
  });
}

// What each thing lies on or in, the likeliest; never in a circle.
function carriers(edges) {
  const best = new Map();
  for (const { type, label, source, target, probability } of edges.values()) {
    if (type === "relation" && ["on", "in"].includes(label) && probability > (best.get(source)?.probability ?? 0)) best.set(source, { target, probability });
  }
  const leadsTo = (id, goal, steps = 0) => id !== undefined && steps < 20 && (id === goal || leadsTo(best.get(id)?.target, goal, steps + 1));
  return new Map([...best].filter(([source, { target }]) => !leadsTo(target, source)).map(([source, { target }]) => [source, target]));
}

function noteOf(node) {
  if (node.type === "door") return node.provisional ? "unsure" : node.crossing === "uncrossed" && node.state !== "closed" ? "not crossed" : node.state === "open" ? "" : node.state ?? "";
  if (node.type === "object") return node.state === "present" ? "" : node.state;
  return node.status === "permanent" ? "" : node.status ?? "";
}

function branch(item) {
  const isNode = item.kind !== "building";
  const dot = el("i", "dot");
  if (item.color) dot.style.background = item.color;
  const content = [dot, el("span", "text", item.text), item.note ? el("small", {}, item.note) : null];
  const head = isNode ? button("", undefined, { class: ["gnode", ...item.kind.split(" ").map((kind) => `is-${kind}`), item.note.replaceAll(" ", "-")].filter(Boolean).join(" "), "data-id": item.id, "data-focus": item.id, title: item.text }) : el("span", "gnode is-building");
  head.append(...content.filter(Boolean));
  return item.inside.length ? [head, el("ul", {}, item.inside.map((one) => el("li", {}, branch(one))))] : [head];
}

function curvesOf({ edges, nodes, selected }, on, spots) {
  const curves = [], carried = carriers(edges);
  const draw = (a, b, kind, ids) => curves.push(shape("path", { d: curve(a, b), class: `curve ${kind} ${ids.includes(selected) ? "selected" : ""}` }));
  for (const [id, [a, b]] of spots) if (b && on.has("connects") && nodes.get(id)?.type === "door") draw(a, b, `connects ${nodes.get(id).state}`, [id, ...nodes.get(id).rooms]);
  for (const { type, source, target, status } of edges.values()) {
    const [[a], [b]] = [spots.get(source) ?? [], spots.get(target) ?? []];
    const isNested = carried.get(source) === target, isWanted = type !== "has_intention" || ["proposed", "granted"].includes(status);
    if (a && b && isWanted && !isNested && on.has(type) && type !== "connects") draw(a, b, `${type} ${status ?? ""}`, type === "has_intention" ? [target] : [source, target]);
  }
  return curves;
}

// From the sides that face each other; within a column, round the right.
function curve(a, b) {
  const isColumn = Math.abs(a.x - b.x) < 60;
  const [from, to] = isColumn ? [a.x + a.w, b.x + b.w] : a.x < b.x ? [a.x + a.w, b.x] : [a.x, b.x + b.w];
  const bend = isColumn ? 14 + Math.min(30, Math.abs(a.y - b.y) / 6) : Math.max(20, Math.abs(to - from) / 2);
  const [c, d] = isColumn ? [from + bend, to + bend] : a.x < b.x ? [from + bend, to - bend] : [from - bend, to + bend];
  return `M${from} ${a.y}C${c} ${a.y} ${d} ${b.y} ${to} ${b.y}`;
}
