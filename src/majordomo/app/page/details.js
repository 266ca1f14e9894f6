// What is known of the selected node, and a place to teach its name.

import { clock, place, title } from "./words.js";

const TAUGHT = { room: "label", object: "name", person: "name" };
const numbers = (values, joint) => values?.map((value) => value.toFixed(2)).join(joint);

function rows(node, { nodes, edges, robot }) {
  const seen = node.last_seen_s === undefined || !robot ? undefined : Math.max(0, robot.stamp_s - node.last_seen_s);
  const room = (id) => (nodes.has(id) ? title(nodes.get(id)) : "not known yet");
  return {
    is: node.type === "object" ? node.label.replaceAll("_", " ") : node.type,
    where: node.type === "object" || node.type === "person" ? place(node, nodes, edges) : undefined,
    joins: node.rooms && [node.rooms[0], node.rooms[1]].map(room).join(" – "),
    color: node.attributes?.color,
    kind: node.attributes?.categories?.join(", "),
    state: [node.state, { uncrossed: "not crossed yet", given_up: "given up" }[node.crossing]].filter(Boolean).join(", "),
    "position (m)": numbers(node.position_m, ", "),
    "size (m)": numbers(node.size_m, " × "),
    "width (m)": node.width_m?.toFixed(2),
    "last seen": seen === undefined ? undefined : seen < 2 ? "now" : `${clock(seen)} ago`,
    certainty: node.confidence === undefined ? undefined : `${Math.round(100 * node.confidence)} %`,
  };
}

export function fillDetails(panel, node, scene, { teach, close }) {
  panel.hidden = !node;
  if (!node) return panel.replaceChildren();
  const make = (name, text) => Object.assign(document.createElement(name), text === undefined ? {} : { textContent: text });
  const list = make("dl");
  for (const [key, value] of Object.entries(rows(node, scene))) if (value) list.append(make("dt", key), make("dd", value));
  const heading = make("h2", `${title(node)} `);
  heading.append(make("small", node.id));
  const shut = Object.assign(make("button", "×"), { type: "button", className: "close", ariaLabel: "Close", onclick: close });
  panel.replaceChildren(heading, shut, list);
  if (TAUGHT[node.type]) panel.append(teachingForm(node, teach));
}

function teachingForm(node, teach) {
  const form = Object.assign(document.createElement("form"), { className: "row" });
  const input = Object.assign(document.createElement("input"), { maxLength: 80, placeholder: node.type === "room" ? "this is the …" : "call it …", ariaLabel: "Name to teach" });
  form.append(input, Object.assign(document.createElement("button"), { textContent: "Teach" }));
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    if (input.value.trim()) teach(node.id, { [TAUGHT[node.type]]: input.value.trim() });
  });
  return form;
}
