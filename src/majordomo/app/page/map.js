// The live floor plan: an SVG in meters, y up in the world and down on the screen, drawn from scene nodes in the map frame.

import { LabelPlaces } from "./labels.js";
import { tiltOf, Turn } from "./upright.js";
import { Viewport } from "./viewport.js";
import { title } from "./words.js";

const SVG = "http://www.w3.org/2000/svg";
const LAYERS = ["walls", "floors", "doors", "furniture", "path", "names", "things", "people", "marks"];
const WALL_M = 0.12;
const TURN_AGAIN_RAD = 0.05;

function shape(name, attributes = {}, text) {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

const points = (polygon) => polygon.map(([x, y]) => `${x},${-y}`).join(" ");
const degrees = (radians) => (-radians * 180) / Math.PI;

// What the robot calls a color, as far as the screen knows it.
export function paint(color) {
  const names = [color, color.replaceAll(" ", ""), color.split(" ").at(-1)];
  return names.find((name) => /^[a-z]+$/.test(name) && CSS.supports("color", name)) ?? "gray";
}

function boundingBox(corners) {
  const xs = corners.map(([x]) => x), ys = corners.map(([, y]) => -y);
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

function corners({ position_m: [x, y], yaw_rad = 0, size_m: [width, depth] }) {
  const [c, s] = [Math.cos(yaw_rad), Math.sin(yaw_rad)];
  return [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([a, b]) => [x + (a * width * c - b * depth * s) / 2, y + (a * width * s + b * depth * c) / 2]);
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

export class BuildingMap {
  #svg; #view; #layers = {}; #robot; #turn = 0; #labels = new LabelPlaces(); #scene = null; #upright = new Turn(0); #pending = false;

  constructor(svg, onSelect) {
    this.#svg = svg;
    for (const name of LAYERS) this.#layers[name] = svg.appendChild(shape("g"));
    this.#robot = svg.appendChild(shape("g", { class: "robot", visibility: "hidden" }));
    this.#robot.append(shape("circle", { r: 0.25 }), shape("path", { d: "M.19 0L-.08 .13L-.02 0L-.08 -.13z" }), shape("title", {}, "robot"));
    this.#layers.held = svg.appendChild(shape("g"));
    this.#view = new Viewport(svg, { onScale: () => this.#redraw(), onTap: onSelect });
  }

  zoom(factor) { this.#view.zoom(factor); }
  fit() { this.#view.fit(undefined, true); }

  // `scene`: { nodes, edges, robot, selected }.
  draw(scene) { this.#scene = scene; this.#redraw(); }

  // The part that changes all the time.
  drawRobot(robot) {
    const { pose_map: { x, y, yaw_rad }, path_map } = this.#upright.robot(robot);
    const turn = degrees(yaw_rad);
    this.#turn += ((turn - this.#turn + 540) % 360 + 360) % 360 - 180;
    this.#robot.style.transform = `translate(${x}px, ${-y}px) rotate(${this.#turn}deg)`;
    this.#robot.classList.toggle("smooth", this.#robot.getAttribute("visibility") === "visible");
    this.#robot.setAttribute("visibility", "visible");
    this.#layers.path.replaceChildren(...(path_map?.length ? [shape("polyline", { points: points([[x, y], ...path_map]), class: "path" })] : []));
  }

  #redraw() {
    if (this.#pending || !this.#scene) return;
    this.#pending = true;
    requestAnimationFrame(() => { this.#pending = false; this.#drawAll(); });
  }

  #drawAll() {
    this.#stand(this.#scene);
    const robot = this.#scene.robot && this.#upright.robot(this.#scene.robot);
    const all = [...this.#scene.nodes.values()].filter((node) => node.position_m).map((node) => this.#upright.node(node));
    const nodes = new Map(all.map((node) => [node.id, node]));
    for (const [name, layer] of Object.entries(this.#layers)) if (name !== "path") layer.replaceChildren();
    const of = (type) => all.filter((node) => node.type === type);
    const rooms = of("room").filter((node) => node.polygon_m?.length), things = of("object");
    rooms.forEach((node) => this.#drawRoom(node, robot));
    of("door").forEach((node) => this.#drawDoor(node, nodes));
    things.forEach((node) => (isFurniture(node) ? this.#drawFurniture(node) : this.#drawThing(node)));
    of("person").forEach((node) => this.#drawPerson(node));
    this.#drawGoal(nodes, this.#scene.edges);
    this.#drawNames(rooms, things, of("person"), robot);
    this.#fitAll(all, robot);
  }

  // Turns the building upright, once and when it turns out to be turned otherwise.
  #stand({ nodes, robot }) {
    const rooms = [...nodes.values()].filter((node) => node.type === "room" && node.status === "permanent" && node.polygon_m?.length);
    const tilt = rooms.length ? tiltOf(rooms) : 0;
    if (Math.abs(tilt - this.#upright.angle) < TURN_AGAIN_RAD && tilt) return;
    this.#upright = new Turn(tilt);
    if (robot) this.drawRobot(robot);
  }

  #drawRoom(node, robot) {
    const state = `${node.status ?? ""} ${node.id === robot?.room ? "here" : ""}`;
    this.#layers.walls.append(shape("polygon", { points: points(node.polygon_m), class: `wall ${state}` }));
    this.#add("floors", shape("polygon", { points: points(node.polygon_m), class: `room ${state}` }), node);
  }

  #drawDoor(node, nodes) {
    const [low, high] = wallAt(node, nodes), half = node.width_m / 2;
    const kind = node.provisional ? "provisional" : node.state === "closed" ? "closed" : node.crossing === "uncrossed" ? "uncrossed" : "";
    const door = shape("g", { class: `door ${kind}`, transform: `translate(${node.position_m[0]} ${-node.position_m[1]}) rotate(${degrees(node.yaw_rad ?? 0)})` });
    door.append(
      shape("rect", { x: -half, y: -high - 0.02, width: 2 * half, height: high - low + 0.04, class: "gap" }),
      shape("line", { x1: -half, y1: -(low + high) / 2, x2: half, y2: -(low + high) / 2, class: "leaf" }),
    );
    this.#add("doors", door, node);
  }

  #drawFurniture(node) {
    this.#add("furniture", shape("polygon", { points: points(corners(node)), class: `furniture ${node.state}` }), node);
  }

  #drawThing(node) {
    const [x, y] = node.position_m, r = radius(node, this.#view.scale), isLong = longest(node) > 0.2;
    const spread = 2 * Math.max(...(node.position_std_m ?? [0]).slice(0, 2));
    if (spread > Math.max(r, 0.08)) this.#layers.things.append(shape("circle", { cx: x, cy: -y, r: spread, class: "spread" }));
    const look = { class: `thing ${node.state}`, fill: paint(node.attributes?.color ?? "") };
    const outline = isLong ? shape("polygon", { ...look, points: points(corners(node)) }) : shape("circle", { ...look, cx: x, cy: -y, r });
    this.#add(node.state === "held" ? "held" : "things", outline, node);
  }

  #drawPerson(node) {
    const [x, y] = node.position_m;
    const person = shape("g", { class: "person", transform: `translate(${x} ${-y})` });
    person.append(shape("circle", { cy: -0.13, r: 0.11 }), shape("path", { d: "M-.2 .22V.18A.2 .2 0 0 1 .2 .18V.22Z" }));
    this.#add("people", person, node);
  }

  // Where the robot is wanted: the target of the intention that has been granted.
  #drawGoal(nodes, edges) {
    const granted = [...edges.values()].find((edge) => edge.type === "has_intention" && edge.status === "granted");
    const target = nodes.get(granted?.target);
    if (!target?.position_m || target.type === "robot") return;
    this.#layers.marks.append(shape("circle", { cx: target.position_m[0], cy: -target.position_m[1], r: 0.32, class: "goal" }));
  }

  #drawNames(rooms, things, people, robot) {
    const around = ([x, y], r) => [x - r, -y - r, x + r, -y + r];
    const pixel = this.#view.scale;
    const furniture = things.filter(isFurniture), small = things.filter((node) => !isFurniture(node));
    const bodies = [...people.map((node) => around(node.position_m, 0.3)), ...(robot ? [around([robot.pose_map.x, robot.pose_map.y], 0.3)] : [])];
    const dots = small.map((node) => around(node.position_m, radius(node, pixel) + 2 * pixel));
    this.#labels.start([...dots, ...bodies]);
    for (const node of furniture) this.#name(node, "thing-name", boundingBox(corners(node)), 11.5 * pixel);
    this.#labels.start([...dots, ...bodies, ...furniture.map((node) => boundingBox(corners(node)))]);
    for (const node of people) {
      const [x, y] = node.position_m;
      this.#name(node, "person-name", [x - 1.2, -y - 0.3 - 18 * pixel, x + 1.2, -y - 0.3], 12 * pixel);
    }
    for (const node of rooms) this.#name(node, "room-name", boundingBox(node.polygon_m), 15 * pixel);
  }

  #name(node, className, area, size) {
    const text = node.type === "object" ? (node.attributes?.name || node.label).replaceAll("_", " ") : title(node);
    const [w, h] = [text.length * 0.6 * size, 1.2 * size];
    const tall = area[3] - area[1] > 1.2 * (area[2] - area[0]) && w > area[2] - area[0];
    const spot = this.#labels.place(`${node.id} ${tall}`, area, tall ? h : w, tall ? w : h);
    if (!spot) return;
    const transform = `translate(${spot.join(" ")}) scale(${this.#view.scale})${tall ? " rotate(-90)" : ""}`;
    this.#layers.names.append(shape("text", { class: className, transform }, text));
  }

  #add(layer, drawn, node) {
    drawn.dataset.id = node.id;
    drawn.classList.toggle("selected", node.id === this.#scene.selected);
    drawn.append(shape("title", {}, `${title(node)} (${node.id})`));
    this.#layers[layer].append(drawn);
  }

  #fitAll(all, robot) {
    const spots = all.flatMap((node) => (node.type === "room" ? node.polygon_m ?? [] : ["object", "door", "person"].includes(node.type) ? [node.position_m] : []));
    if (robot) spots.push([robot.pose_map.x, robot.pose_map.y]);
    if (!spots.length) return;
    const [left, top, right, bottom] = boundingBox(spots), margin = Math.max(0.4, 0.04 * (right - left));
    this.#view.fit([left - margin, top - margin, right + margin, bottom + margin]);
  }
}

const longest = (node) => Math.max(...node.size_m.slice(0, 2));
const isFurniture = (node) => !node.graspable && longest(node) >= 0.3 && node.size_m[2] >= 0.1;

// True to scale, but never too small to see or to hit.
const radius = (node, pixel) => Math.max(longest(node) / 2, 5 * pixel);
