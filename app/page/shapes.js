// How each kind of node is drawn on the floor plan: SVG in meters, y up in the world and down on the screen.
// Every function gives pairs of a layer and a shape.

const SVG = "http://www.w3.org/2000/svg";
const WALL_M = 0.12;
const SMALLEST_PX = 5, SMALLEST_SPREAD_PX = 6;

export function shape(name, attributes = {}, text) {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

export const points = (polygon) => polygon.map(([x, y]) => `${x},${-y}`).join(" ");
export const degrees = (radians) => (-radians * 180) / Math.PI;

// What the robot calls a color, as far as the screen knows it.
export function paint(color) {
  const names = [color, color.replaceAll(" ", ""), color.split(" ").at(-1)];
  return names.find((name) => /^[a-z]+$/.test(name) && CSS.supports("color", name)) ?? "gray";
}

export function boundingBox(corners) {
  const xs = corners.map(([x]) => x), ys = corners.map(([, y]) => -y);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

export function corners({ position_m: [x, y], yaw_rad = 0, size_m: [width, depth] }) {
  const [c, s] = [Math.cos(yaw_rad), Math.sin(yaw_rad)];
  return [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => [x + (a * width * c - b * depth * s) / 2, y + (a * width * s + b * depth * c) / 2]);
}

const longest = (node) => Math.max(...(node.size_m ?? [0, 0]).slice(0, 2));
export const isFurniture = (node) => !node.graspable && longest(node) >= 0.3 && node.size_m[2] >= 0.1;

// True to scale, but never too small to see or to hit.
export const radius = (node, pixel) => Math.max(longest(node) / 2, SMALLEST_PX * pixel);

export function drawRoom(node) {
  const outline = points(node.polygon_m), kind = node.status ?? "";
  const hatch = shape("polygon", { points: outline, class: "hatch", fill: "url(#hatch)", visibility: "hidden" });
  return [["walls", shape("polygon", { points: outline, class: `wall ${kind}` })], ["hatches", hatch], ["floors", shape("polygon", { points: outline, class: `room ${kind}` })]];
}

// How far the wall reaches from a door to either side, so that the gap goes right through it: where the normal meets the rooms.
function wallAt({ position_m: [x, y], yaw_rad = 0, rooms }, nodes) {
  const [nx, ny] = [-Math.sin(yaw_rad), Math.cos(yaw_rad)];
  const hits = rooms.flatMap((id) => {
    const polygon = nodes.get(id)?.polygon_m ?? [];
    const found = polygon.flatMap(([ax, ay], i) => {
      const [bx, by] = polygon[(i + 1) % polygon.length];
      const side = (px, py) => (px - x) * ny - (py - y) * nx;
      const along = (px, py) => (px - x) * nx + (py - y) * ny;
      const [a, b] = [side(ax, ay), side(bx, by)];
      return a * b < 0 ? [along(ax, ay) + (a / (a - b)) * (along(bx, by) - along(ax, ay))] : [];
    });
    return found.sort((a, b) => Math.abs(a) - Math.abs(b)).slice(0, 1).filter((hit) => Math.abs(hit) < 1);
  });
  const [low, high] = [Math.min(0, ...hits), Math.max(0, ...hits)];
  return high - low > 0.02 ? [low, high] : [low - WALL_M, high];
}

// `rooms`: the rooms by identifier, as they stand on the screen.
export function drawDoor(node, rooms) {
  const [low, high] = wallAt(node, rooms), half = node.width_m / 2, middle = -(low + high) / 2;
  const kind = node.provisional ? "provisional" : node.state === "closed" ? "closed" : node.crossing === "uncrossed" ? "uncrossed" : node.state ?? "";
  const door = shape("g", { class: `door ${kind}`, transform: `translate(${node.position_m[0]} ${-node.position_m[1]}) rotate(${degrees(node.yaw_rad ?? 0)})` });
  door.append(
    shape("rect", { x: -half, y: -high - 0.02, width: 2 * half, height: high - low + 0.04, class: "gap" }),
    shape("line", { x1: -half, y1: middle, x2: half, y2: middle, class: "leaf" }),
  );
  return [["doors", door]];
}

export function drawObject(node, pixel, tilt, isSelected) {
  const spread = drawSpread(node, pixel, tilt, isSelected);
  if (isFurniture(node)) return [...spread, ["furniture", shape("polygon", { points: points(corners(node)), class: `furniture ${node.state}` })]];
  const [x, y] = node.position_m;
  const look = { class: `thing ${node.state}`, fill: paint(node.attributes?.color ?? "") };
  const outline = longest(node) > 0.2 ? shape("polygon", { ...look, points: points(corners(node)) }) : shape("circle", { ...look, cx: x, cy: -y, r: radius(node, pixel) });
  return [...spread, [node.state === "held" ? "held" : "things", outline]];
}

// One standard deviation of the place, along the axes of the room; `tilt`: by how much those are turned on the screen.
// What would be lost in its own dot is drawn for the selected node only.
function drawSpread({ position_m: [x, y], position_std_m: std, state }, pixel, tilt, isSelected) {
  const widest = Math.max(...(std ?? [0]).slice(0, 2));
  if (!widest || state === "held" || (!isSelected && widest < SMALLEST_SPREAD_PX * pixel)) return [];
  const ellipse = { rx: Math.max(std[0], pixel), ry: Math.max(std[1], pixel), transform: `translate(${x} ${-y}) rotate(${degrees(tilt)})`, class: "spread" };
  return [["spreads", shape("ellipse", ellipse)]];
}

export function drawPerson({ position_m: [x, y] }) {
  const person = shape("g", { class: "person", transform: `translate(${x} ${-y})` });
  person.append(shape("circle", { cy: -0.13, r: 0.11 }), shape("path", { d: "M-.2 .22V.18A.2 .2 0 0 1 .2 .18V.22Z" }));
  return [["people", person]];
}

// The robot at the origin, looking along x.
export function drawRobot() {
  const robot = shape("g", { class: "robot", visibility: "hidden" });
  robot.append(
    shape("circle", { r: 0.25, class: "body" }),
    shape("path", { d: "M.19 0L-.08 .13L-.02 0L-.08 -.13z", class: "nose" }),
    shape("title", {}, "robot"),
  );
  robot.dataset.id = "robot";
  return robot;
}

// Stripes for what has not been looked at.
export function hatchPattern() {
  const pattern = shape("pattern", { id: "hatch", width: 0.16, height: 0.16, patternUnits: "userSpaceOnUse", patternTransform: "rotate(45)" });
  pattern.append(shape("rect", { width: 0.05, height: 0.16, class: "stripe" }));
  const definitions = shape("defs");
  definitions.append(pattern);
  return definitions;
}
