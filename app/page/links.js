// What belongs to a request elsewhere on the page: the nodes it is about, and the decisions about it.

import { el } from "./dom.js";
import { title } from "./words.js";

const MOST = 8;

// Identifiers of the graph that a task speaks of, the goals' first.
export function mentioned(task, nodes) {
  const told = [...(task.plan?.goals ?? []), ...(task.plan?.steps ?? [])].flatMap(({ args }) => args);
  return [...new Set([...told, ...task.failures.flatMap(({ evidence }) => evidence.nodes)])].filter((id) => nodes.has(id)).slice(0, MOST);
}

export function taskLinks(task, nodes) {
  return el("div", { class: "links", "data-key": "links" },
    mentioned(task, nodes).map((id) => el("button", { type: "button", class: "link", "data-key": id, "data-node": id }, title(nodes.get(id)))),
    el("button", { type: "button", class: "link why", "data-key": "why", "data-trace": true, "aria-label": `Decisions about: ${task.request}` }, "Decisions"));
}
