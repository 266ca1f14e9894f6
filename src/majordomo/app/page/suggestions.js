// A few things that can be asked in this building, with things and places that are really there.

import { place, title } from "./words.js";

export function suggestions(nodes, edges) {
  const present = [...nodes.values()].filter((node) => node.type === "object" && node.state === "present");
  const counts = new Map();
  for (const node of present) counts.set(title(node), (counts.get(title(node)) ?? 0) + 1);
  const single = present.filter((node) => counts.get(title(node)) === 1 && node.label);
  const things = single.filter((node) => node.graspable && place(node, nodes, edges));
  const tops = single.filter((node) => node.support && !node.graspable && present.filter((other) => other.label === node.label).length === 1);
  const person = [...nodes.values()].find((node) => node.type === "person" && node.name);
  const ideas = [];
  for (const thing of things) {
    const top = tops.find((node) => node.room !== thing.room);
    if (top) { ideas.push(`bring the ${title(thing)} to the ${top.label.replaceAll("_", " ")}`); break; }
  }
  if (things.length > 1) ideas.push(`where is the ${title(things[1])}?`);
  if (person && things.length) ideas.push(`give ${person.name} the ${title(things.at(-1))}`);
  const laden = tops.find((node) => [...edges.values()].some((edge) => edge.target === node.id && edge.label === "on"));
  if (laden) ideas.push(`what is on the ${laden.label.replaceAll("_", " ")}?`);
  return ideas;
}
