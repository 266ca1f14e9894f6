// The live floor plan. Each node is drawn once and drawn anew only when it has changed; names follow a little later.

import { LabelPlaces } from "./labels.js";
import { boundingBox, corners, degrees, drawDoor, drawObject, drawPerson, drawRobot, drawRoom, hatchPattern, isFurniture, points, radius, shape } from "./shapes.js";
import { covered } from "./sight.js";
import { tiltOf, Turn } from "./upright.js";
import { Viewport } from "./viewport.js";
import { title } from "./words.js";

const LAYERS = ["walls", "floors", "hatches", "gaze", "doors", "furniture", "path", "names", "spreads", "things", "people", "marks", "rings"];
const SHOWN = new Set(["room", "door", "object", "person"]);
const TURN_AGAIN_RAD = 0.05;
const NAMES_MS = 300;
const LOOKED = new Set(["done", "failed"]);

// All that decides how a node is drawn, to half a centimeter; when it was last seen, for one, does not.
function lookOf({ type, label, room, position_m, yaw_rad, size_m, polygon_m, position_std_m, state, status, attributes, name, graspable, width_m, rooms, provisional, crossing }) {
  const rounded = [position_m, size_m, position_std_m, polygon_m?.flat(), [width_m, yaw_rad]].map((values) => values?.map((value) => Math.round(200 * value)));
  return JSON.stringify([type, label, room, rounded, state, status, attributes?.color, attributes?.name, name, graspable, rooms, provisional, crossing]);
}

export class BuildingMap {
  #view; #layers = {}; #robot; #turn = 0; #labels = new LabelPlaces(); #scene = null; #upright = new Turn(0); #pending = false;
  #drawn = new Map(); #selected = null; #naming = 0;

  constructor(svg, onSelect) {
    svg.append(hatchPattern());
    const world = svg.appendChild(shape("g", { class: "world" }));
    for (const name of LAYERS) this.#layers[name] = world.appendChild(shape("g", { "data-layer": name }));
    this.#robot = world.appendChild(drawRobot());
    this.#layers.held = world.appendChild(shape("g"));
    this.#view = new Viewport(svg, world, { onScale: () => this.#rescale(), onTap: onSelect });
  }

  zoom(factor) { this.#view.zoom(factor); }
  fit() { this.#view.fit(undefined, true); }

  // `scene`: { nodes, edges, robot, selected }. Nodes that look as before are left as they are drawn.
  draw(scene) {
    this.#scene = scene;
    if (this.#pending) return;
    this.#pending = true;
    requestAnimationFrame(() => { this.#pending = false; this.#update(); });
  }

  // The part that changes all the time.
  drawRobot(robot) {
    const { pose_map, path_map } = this.#upright.robot(robot), { x, y, yaw_rad } = pose_map;
    const turn = degrees(yaw_rad);
    this.#turn += ((turn - this.#turn + 540) % 360 + 360) % 360 - 180;
    this.#robot.style.transform = `translate(${x}px, ${-y}px) rotate(${this.#turn}deg)`;
    this.#robot.classList.toggle("smooth", this.#robot.getAttribute("visibility") === "visible");
    this.#robot.setAttribute("visibility", "visible");
    this.#layers.gaze.replaceChildren(...(robot.camera ? [shape("polygon", { points: points(this.#covered(pose_map, robot.camera)), class: "gaze" })] : []));
    this.#layers.path.replaceChildren(...(path_map?.length ? [shape("polyline", { points: points([[x, y], ...path_map]), class: "path" })] : []));
  }

  #covered(pose, camera) {
    const all = [...this.#drawn.values()].map(({ turned }) => turned);
    return covered(pose, camera, all.filter((node) => node.type === "room" && node.polygon_m?.length), all.filter((node) => node.type === "door"));
  }

  // Moves the view so that a node that was selected elsewhere can be seen.
  reveal(id) {
    const node = this.#scene?.nodes.get(id);
    if (!node?.position_m || node.type === "room") return;
    const [x, y] = this.#upright.point(node.position_m);
    this.#view.reveal([x, -y]);
  }

  #update() {
    const { nodes, edges, robot } = this.#scene;
    this.#stand();
    const changed = this.#removeGone(nodes) + this.#drawChanged(nodes);
    this.#markRooms(nodes, edges, robot?.room ?? null);
    this.#markSelected();
    this.#markGoal(nodes, edges);
    if (!changed) return;
    this.#fitAll(robot);
    this.#nameSoon();
  }

  // Turns the building upright, once and when it turns out to be turned otherwise.
  #stand() {
    const { nodes, robot } = this.#scene;
    const rooms = [...nodes.values()].filter((node) => node.type === "room" && node.status === "permanent" && node.polygon_m?.length);
    const tilt = rooms.length ? tiltOf(rooms) : 0;
    if (Math.abs(tilt - this.#upright.angle) < TURN_AGAIN_RAD && tilt) return;
    if (tilt !== this.#upright.angle) for (const drawing of this.#drawn.values()) drawing.look = null;
    this.#upright = new Turn(tilt);
    if (robot) this.drawRobot(robot);
  }

  #removeGone(nodes) {
    let count = 0;
    for (const [id, drawing] of this.#drawn) {
      if (nodes.has(id)) continue;
      for (const [, part] of drawing.parts) part.remove();
      this.#drawn.delete(id);
      count += 1;
    }
    return count;
  }

  #drawChanged(nodes) {
    const changed = [...nodes.values()].filter((node) => SHOWN.has(node.type) && node.position_m && !this.#looksTheSame(node));
    const rooms = new Map([...this.#drawn].filter(([, { node }]) => node?.type === "room").map(([id, { turned }]) => [id, turned]));
    for (const node of changed) if (node.type === "room") rooms.set(node.id, this.#upright.node(node));
    const moved = new Set(changed.filter((node) => node.type === "room").map((node) => node.id));
    const doors = [...nodes.values()].filter((node) => node.type === "door" && !changed.includes(node) && node.rooms.some((id) => moved.has(id)));
    for (const node of [...changed, ...doors]) this.#drawNode(node, rooms);
    return changed.length;
  }

  #looksTheSame(node) {
    const drawing = this.#drawn.get(node.id);
    if (!drawing?.look) return false;
    if (drawing.node !== node && drawing.look === lookOf(node)) drawing.node = node;
    return drawing.node === node;
  }

  #drawNode(node, rooms) {
    const turned = this.#upright.node(node), before = this.#drawn.get(node.id), pixel = this.#view.scale;
    const draw = {
      room: () => (node.polygon_m?.length ? drawRoom(turned) : []),
      door: () => drawDoor(turned, rooms),
      object: () => drawObject(turned, pixel, (this.#scene.nodes.get(node.room)?.yaw_rad ?? 0) - this.#upright.angle, node.id === this.#scene.selected),
      person: () => drawPerson(turned),
    };
    const parts = draw[node.type]();
    for (const [, part] of before?.parts ?? []) part.remove();
    for (const [layer, part] of parts) this.#layers[layer].append(part);
    const body = parts.at(-1)?.[1];
    if (body) {
      body.dataset.id = node.id;
      body.append(shape("title", {}, `${title(node)} (${node.id})`));
    }
    this.#drawn.set(node.id, { node, look: lookOf(node), turned, parts, body });
  }

  // Which room the robot is in, and which it has not looked around in yet.
  #markRooms(nodes, edges, here) {
    const asked = new Set(), looked = new Set();
    for (const edge of edges.values()) {
      if (edge.type !== "has_intention" || edge.action !== "look") continue;
      asked.add(edge.target);
      if (LOOKED.has(edge.status)) looked.add(edge.target);
    }
    for (const [id, { node, body, parts }] of this.#drawn) {
      if (node?.type !== "room" || !body) continue;
      body.classList.toggle("here", id === here);
      const [, hatch] = parts.find(([layer]) => layer === "hatches");
      hatch.setAttribute("visibility", asked.has(id) && !looked.has(id) ? "visible" : "hidden");
    }
  }

  #markSelected() {
    const { selected } = this.#scene;
    if (selected !== this.#selected) for (const id of [this.#selected, selected]) {
      const node = this.#drawn.get(id)?.node;
      if (node?.type === "object") this.#drawNode(node);
      this.#drawn.get(id)?.body?.classList.remove("selected");
    }
    this.#drawn.get(selected)?.body?.classList.add("selected");
    this.#robot.classList.toggle("selected", selected === "robot");
    this.#layers.rings.replaceChildren(...this.#ring(this.#drawn.get(selected)?.turned));
    this.#selected = selected;
  }

  // What is small is hard to find by its own outline alone.
  #ring(node) {
    if (!node || !["object", "person"].includes(node.type) || isFurniture(node)) return [];
    const pixel = this.#view.scale, [x, y] = node.position_m, place = { cx: x, cy: -y, r: (node.type === "person" ? 0.3 : radius(node, pixel)) + 5 * pixel };
    return [shape("circle", { ...place, class: "ring halo" }), shape("circle", { ...place, class: "ring" })];
  }

  // Where the robot is wanted: the target of the intention that has been granted.
  #markGoal(nodes, edges) {
    const granted = [...edges.values()].find((edge) => edge.type === "has_intention" && edge.status === "granted");
    const target = this.#drawn.get(granted?.target)?.turned;
    const [x, y] = target?.position_m ?? [];
    this.#layers.marks.replaceChildren(...(target ? [shape("circle", { cx: x, cy: -y, r: 0.32, class: "goal" })] : []));
  }

  // Sizes in pixels follow the scale: dots, and names.
  #rescale() {
    for (const [id, drawing] of this.#drawn) if (drawing.node?.type === "object" && !isFurniture(drawing.node)) this.#drawNode(this.#scene.nodes.get(id) ?? drawing.node);
    if (this.#scene) { this.#markSelected(); this.#name(); }
  }

  #nameSoon() {
    if (!this.#naming) this.#naming = setTimeout(() => { this.#naming = 0; this.#name(); }, this.#layers.names.childElementCount ? NAMES_MS : 0);
  }

  #name() {
    const around = ([x, y], r) => [x - r, -y - r, x + r, -y + r];
    const pixel = this.#view.scale, all = [...this.#drawn.values()].map(({ turned }) => turned), robot = this.#scene.robot && this.#upright.robot(this.#scene.robot);
    const of = (type) => all.filter((node) => node.type === type);
    const furniture = of("object").filter(isFurniture), small = of("object").filter((node) => !isFurniture(node));
    const bodies = [...of("person").map((node) => around(node.position_m, 0.3)), ...(robot ? [around([robot.pose_map.x, robot.pose_map.y], 0.3)] : [])];
    const dots = small.map((node) => around(node.position_m, radius(node, pixel) + 2 * pixel));
    const written = [];
    this.#labels.start([...dots, ...bodies]);
    for (const node of furniture) written.push(this.#written(node, "thing-name", boundingBox(corners(node)), 11.5 * pixel));
    this.#labels.start([...dots, ...bodies, ...furniture.map((node) => boundingBox(corners(node)))]);
    for (const node of of("person")) {
      const [x, y] = node.position_m;
      written.push(this.#written(node, "person-name", [x - 1.2, -y - 0.3 - 18 * pixel, x + 1.2, -y - 0.3], 12 * pixel));
    }
    for (const node of of("room")) if (node.polygon_m?.length) written.push(this.#written(node, "room-name", boundingBox(node.polygon_m), 15 * pixel));
    this.#layers.names.replaceChildren(...written.filter(Boolean));
  }

  #written(node, className, area, size) {
    const text = node.type === "object" ? (node.attributes?.name || node.label).replaceAll("_", " ") : title(node);
    const [w, h] = [text.length * 0.6 * size, 1.2 * size];
    const tall = area[3] - area[1] > 1.2 * (area[2] - area[0]) && w > area[2] - area[0];
    const spot = this.#labels.place(`${node.id} ${tall}`, area, tall ? h : w, tall ? w : h);
    if (!spot) return null;
    const transform = `translate(${spot.join(" ")}) scale(${this.#view.scale})${tall ? " rotate(-90)" : ""}`;
    return shape("text", { class: className, transform }, text);
  }

  #fitAll(robot) {
    const spots = [...this.#drawn.values()].flatMap(({ turned }) => (turned.type === "room" ? turned.polygon_m ?? [] : [turned.position_m]));
    if (robot) { const { x, y } = this.#upright.robot(robot).pose_map; spots.push([x, y]); }
    if (!spots.length) return;
    const [left, top, right, bottom] = boundingBox(spots), margin = Math.max(0.4, 0.04 * (right - left));
    this.#view.fit([left - margin, top - margin, right + margin, bottom + margin]);
  }
}
