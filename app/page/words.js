// People's words for nodes of the scene graph and for steps of a plan.

const spaced = (text) => text.replaceAll("_", " ");

export function title(node) {
  const name = node.name || node.attributes?.name;
  if (name) return name;
  if (node.type === "object") return spaced([node.attributes?.color, node.label].filter(Boolean).join(" "));
  return spaced(node.type === "door" ? "door" : node.label || node.id);
}

export function definite(id, nodes) {
  const node = nodes.get(id);
  if (!node) return spaced(id);
  if (node.name || node.attributes?.name || (node.type === "room" && !node.label)) return title(node);
  const namesake = node.type === "object" && [...nodes.values()].some((other) => other.id !== id && other.type === "object" && title(other) === title(node));
  const room = namesake && nodes.has(node.room) ? ` in ${definite(node.room, nodes)}` : "";
  return `the ${title(node)}${room}`;
}

export function place(node, nodes, edges) {
  const holds = (edge) => edge.type === "relation" && edge.source === node.id && ["on", "in"].includes(edge.label);
  const support = [...edges.values()].filter(holds).sort((a, b) => b.probability - a.probability)[0];
  const room = nodes.get(node.room) ? `in ${definite(node.room, nodes)}` : "";
  if (node.state === "held") return "in my hand";
  const spot = support ? `${support.label} ${definite(support.target, nodes)}` : "";
  return [spot, spot.endsWith(room) ? "" : room].filter(Boolean).join(" ");
}

export function step({ skill, args }, nodes) {
  const [first, second] = args.map((id) => definite(id, nodes));
  const kind = nodes.get(args[1])?.type;
  switch (skill) {
    case "GOTO": return `Go to ${first}`;
    case "PICK": return `Pick up ${first}`;
    case "PLACE": return kind === "person" ? `Hand ${first} to ${second}` : `Put ${first} ${kind === "room" ? "down in" : "on"} ${second}`;
    default: return `${skill.charAt(0)}${spaced(skill.slice(1).toLowerCase())} ${args.map((id) => definite(id, nodes)).join(", ")}`;
  }
}

// "approach door_1_3_0" with people's words for the identifiers in it.
export function action(name, nodes) {
  return name.replace(/[a-z]+(_[a-z]+)*(_\d+)+/g, (id) => (id.startsWith("door_") ? "the door" : definite(id, nodes)));
}

export function goal({ predicate, args }, nodes) {
  const [first, second] = args.map((id) => definite(id, nodes));
  switch (predicate) {
    case "robot_at": return `I am at ${first}`;
    case "holding": return `I hold ${first}`;
    case "given": return `${second} has ${first}`;
    case "open": return `${first} is open`;
    default: return `${first} is ${spaced(predicate)} ${second}`;
  }
}

// Descriptions of the nodes an answer may name; two that read alike are told apart by their identifiers.
export function choices(ids, nodes, edges) {
  const texts = ids.map((id) => (nodes.has(id) ? `${title(nodes.get(id))} ${place(nodes.get(id), nodes, edges)}`.trim() : spaced(id)));
  return ids.map((id, i) => ({ id, text: texts.filter((text) => text === texts[i]).length > 1 ? `${texts[i]} (${id})` : texts[i] }));
}

// "bottle_1" out of "PICK(bottle_1)", as the trace writes steps.
export function parsedStep(text) {
  const [, skill, args] = text.match(/^(\w+)\((.*)\)$/) ?? [null, text, ""];
  return { skill, args: args ? args.split(", ") : [] };
}

// "about 40 s", "about 2 min" of an expected time.
export const roughly = (seconds) => (seconds < 90 ? `about ${Math.max(5, 5 * Math.round(seconds / 5))} s` : `about ${Math.round(seconds / 60)} min`);

// "1:05" of a robot time in seconds; "−1:05" was before the service started.
export function clock(stamp_s) {
  const seconds = Math.floor(Math.abs(stamp_s));
  return `${stamp_s < 0 ? "−" : ""}${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}
