// Outlines and labels over a picture, in the picture's own pixels.

import { shape } from "./shapes.js";

const HUE_STEP = 137.508;

// A color that stays with a thing: from its identifier, or from its label while it has none.
function hue(text) {
  let sum = 7;
  for (const character of text) sum = (sum * 31 + character.codePointAt(0)) % 9973;
  return Math.round(sum * HUE_STEP) % 360;
}

const color = ({ node, label }) => `hsl(${hue(node ?? label)} 85% 68%)`;

export function outline(seen, name) {
  const parts = seen.outline_px.map((part) => `M${part.map((spot) => spot.join(" ")).join("L")}Z`);
  const drawn = shape("path", { d: parts.join(""), class: seen.node ? "seen known" : "seen" });
  drawn.style.setProperty("--hue", color(seen));
  if (seen.node) drawn.dataset.id = seen.node;
  drawn.append(shape("title", {}, seen.node ? name : `${name}, not in the graph yet`));
  return drawn;
}

// Names above their things, or, where another name is already, below it; those that find no place are left out.
// `size`: height of the letters in pixels of the picture, which is `width` of them wide.
export function labels(instances, width, size) {
  const taken = [];
  return instances.toReversed().flatMap((seen) => {
    const [left, top, right] = seen.box_px, w = seen.name.length * size * 0.58 + 0.6 * size, h = 1.35 * size;
    const x = Math.min(Math.max((left + right - w) / 2, 1), Math.max(width - w - 1, 1));
    const y = [top - h - 1, top + 1, top + h + 2].map((at) => Math.max(at, 1)).find((at) => taken.every(([a, b, c]) => x + w < a || a + c < x || at + h < b || b + h < at));
    if (y === undefined) return [];
    taken.push([x, y, w]);
    const group = shape("g", { class: "seen-label", transform: `translate(${x} ${y})` });
    group.style.setProperty("--hue", color(seen));
    group.append(shape("rect", { width: w, height: h, rx: 2 }), shape("text", { x: w / 2, y: h / 2, "font-size": size }, seen.name));
    if (seen.node) group.dataset.id = seen.node;
    return [group];
  });
}
