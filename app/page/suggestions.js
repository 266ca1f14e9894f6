// What can be asked in this building, with things and places that are really there.

import { place, title } from "./words.js";

const MOST = 5, SHORTEST = 2;

const labelOf = (node) => node.label.replaceAll("_", " ");
const presentIn = (nodes) => [...nodes.values()].filter((node) => node.type === "object" && node.state === "present" && isNamed(node));
const isOnly = (node, present, name) => present.filter((other) => name(other) === name(node)).length === 1;

// Whole requests, as { text, isGood(nodes) }: whether it still makes sense, with everything in it there and nothing else of that name.
export function ideas(nodes, edges) {
  const present = presentIn(nodes), single = present.filter((node) => isOnly(node, present, title));
  const things = single.filter((node) => node.graspable && place(node, nodes, edges));
  const tops = single.filter((node) => node.support && !node.graspable && isOnly(node, present, labelOf));
  const person = [...nodes.values()].find((node) => node.type === "person" && node.name);
  const found = [];
  // `named`: pairs of a node and how it is called in the text.
  const add = (text, ...named) => found.push({ text, isGood: (now) => named.every(([{ id }, name]) => now.has(id) && (name === null || isOnly(now.get(id), presentIn(now), name))) });
  for (const thing of things) {
    const top = tops.find((node) => node.room !== thing.room);
    if (top) { add(`bring the ${title(thing)} to the ${labelOf(top)}`, [thing, title], [top, labelOf]); break; }
  }
  if (things.length > 1) add(`where is the ${title(things[1])}?`, [things[1], title]);
  if (person && things.length) add(`give ${person.name} the ${title(things.at(-1))}`, [person, null], [things.at(-1), title]);
  const laden = tops.find((node) => [...edges.values()].some((edge) => edge.target === node.id && edge.label === "on"));
  if (laden) add(`what is on the ${labelOf(laden)}?`, [laden, labelOf]);
  return found;
}

// Requests that go on from what has been typed with a name that the graph knows: "bring the bl" → "bring the blue bottle".
export function completions(typed, nodes) {
  const names = [...new Set([...nodes.values()].filter(isNamed).map(title))];
  const words = typed.split(/(?<=\s)/);
  for (let first = Math.max(0, words.length - 4); first < words.length; first += 1) {
    const begun = words.slice(first).join("");
    const fitting = begun.length < SHORTEST ? [] : names.filter((name) => name.length > begun.length && name.toLowerCase().startsWith(begun.toLowerCase()));
    if (fitting.length) return fitting.slice(0, MOST).map((name) => ({ text: words.slice(0, first).join("") + name }));
  }
  return [];
}

function isNamed(node) {
  if (node.type === "object") return ![undefined, "", "unknown"].includes(node.label) && node.state !== "missing";
  return (node.type === "room" && Boolean(node.label)) || (node.type === "person" && Boolean(node.name));
}
