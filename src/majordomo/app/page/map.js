// The live top-down map: an SVG in meters, y up, drawn from scene nodes in the map frame.

const SVG = "http://www.w3.org/2000/svg";

function element(name, attributes = {}, text) {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

const points = (polygon) => polygon.map(([x, y]) => `${x},${-y}`).join(" ");
const degrees = (radians) => (-radians * 180) / Math.PI;

export class BuildingMap {
  #svg; #layers = {}; #view = { x: -5, y: -5, w: 10, h: 10 }; #fitted = true; #onSelect; #selected = null; #pointers = new Map();

  constructor(svg, onSelect) {
    this.#svg = svg;
    this.#onSelect = onSelect;
    for (const name of ["rooms", "doors", "furniture", "path", "things", "people", "robot", "names"]) {
      this.#layers[name] = svg.appendChild(element("g", { class: `layer-${name}` }));
    }
    this.#listen();
    new ResizeObserver(() => this.#apply()).observe(svg);
  }

  draw(nodes, robot) {
    for (const layer of Object.values(this.#layers)) layer.replaceChildren();
    for (const node of nodes.values()) this.#drawNode(node, robot);
    this.#drawRobot(robot);
    if (this.#fitted) this.fit(nodes);
  }

  #drawNode(node, robot) {
    if (!node.position_m) return;
    const [x, y] = node.position_m;
    const classes = (...names) => [...names, node.id === this.#selected ? "selected" : ""].filter(Boolean).join(" ");
    if (node.type === "room" && node.polygon_m?.length) {
      const here = node.id === robot?.room ? "here" : "";
      this.#add("rooms", "polygon", { points: points(node.polygon_m), class: classes("room", here, node.status) }, node);
      this.#layers.names.append(element("text", { x, y: -y, class: "room-name" }, node.name || node.label || node.id.replace("_", " ")));
    } else if (node.type === "door") {
      const [dx, dy] = [Math.cos(node.yaw_rad ?? 0) * node.width_m / 2, Math.sin(node.yaw_rad ?? 0) * node.width_m / 2];
      const kind = node.provisional ? "provisional" : node.state === "closed" ? "closed" : node.crossing === "crossed" ? "" : "uncrossed";
      this.#add("doors", "line", { x1: x - dx, y1: -(y - dy), x2: x + dx, y2: -(y + dy), class: classes("door", kind) }, node);
    } else if (node.type === "object") {
      this.#drawObject(node, x, y, classes);
    } else if (node.type === "person") {
      this.#add("people", "circle", { cx: x, cy: -y, r: 0.22, class: classes("person") }, node);
      this.#layers.names.append(element("text", { x, y: -y - 0.3, class: "thing-name" }, node.name || node.label));
    }
  }

  #drawObject(node, x, y, classes) {
    const [width, depth] = node.size_m ?? [0.1, 0.1];
    const missing = node.state === "missing" ? "missing" : "";
    if (node.graspable || Math.max(width, depth) < 0.3) {
      const r = Math.max(0.06, Math.min(width, depth) / 2);
      this.#add("things", "circle", { cx: x, cy: -y, r, class: classes("thing", missing), fill: node.attributes?.color || "gray" }, node);
      const spread = Math.max(...(node.position_std_m ?? [0]));
      if (spread > 0.02) this.#layers.things.append(element("circle", { cx: x, cy: -y, r: r + 2 * spread, class: "spread" }));
    } else {
      const transform = `translate(${x} ${-y}) rotate(${degrees(node.yaw_rad ?? 0)})`;
      this.#add("furniture", "rect", { x: -width / 2, y: -depth / 2, width, height: depth, transform, class: classes("furniture", missing) }, node);
      if (Math.max(width, depth) > 0.35) this.#layers.names.append(element("text", { x, y: -y + 0.05, class: "thing-name" }, node.label));
    }
  }

  #drawRobot(robot) {
    if (!robot?.pose_map) return;
    const { x, y, yaw_rad } = robot.pose_map;
    if (robot.path_map?.length) this.#layers.path.append(element("polyline", { points: points(robot.path_map), class: "path" }));
    const group = element("g", { class: "robot", transform: `translate(${x} ${-y}) rotate(${degrees(yaw_rad)})` });
    group.append(element("circle", { r: 0.25 }), element("path", { d: "M.2 0 L-.06 .11 L-.06 -.11z" }), element("title", {}, "robot"));
    this.#layers.robot.append(group);
  }

  #add(layer, name, attributes, node) {
    const shape = element(name, { ...attributes, "data-id": node.id });
    shape.append(element("title", {}, `${node.label || node.type} (${node.id})`));
    this.#layers[layer].append(shape);
  }

  fit(nodes) {
    const all = [...nodes.values()].flatMap((node) => node.polygon_m ?? []);
    if (!all.length) return this.#apply();
    const xs = all.map(([x]) => x), ys = all.map(([, y]) => -y);
    const [left, top] = [Math.min(...xs) - 0.5, Math.min(...ys) - 0.5];
    this.#view = { x: left, y: top, w: Math.max(...xs) - left + 0.5, h: Math.max(...ys) - top + 0.5 };
    this.#fitted = true;
    this.#apply();
  }

  zoom(factor, cx = this.#view.x + this.#view.w / 2, cy = this.#view.y + this.#view.h / 2) {
    const { x, y, w, h } = this.#view;
    this.#view = { x: cx - (cx - x) * factor, y: cy - (cy - y) * factor, w: w * factor, h: h * factor };
    this.#fitted = false;
    this.#apply();
  }

  select(id) { this.#selected = id; }

  #apply() {
    const { x, y, w, h } = this.#view;
    this.#svg.setAttribute("viewBox", `${x} ${y} ${w} ${h}`);
  }

  #toMeters(event) {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.#svg.getScreenCTM().inverse());
    return [point.x, point.y];
  }

  #listen() {
    const svg = this.#svg;
    let moved = 0;
    svg.addEventListener("wheel", (event) => { event.preventDefault(); this.zoom(event.deltaY > 0 ? 1.15 : 0.87, ...this.#toMeters(event)); }, { passive: false });
    svg.addEventListener("pointerdown", (event) => { moved = 0; this.#pointers.set(event.pointerId, event); });
    svg.addEventListener("pointermove", (event) => {
      const before = this.#pointers.get(event.pointerId);
      if (!before) return;
      const others = [...this.#pointers.values()].filter((pointer) => pointer.pointerId !== event.pointerId);
      const [x0, y0] = this.#toMeters(before), [x1, y1] = this.#toMeters(event);
      moved += Math.hypot(event.clientX - before.clientX, event.clientY - before.clientY);
      if (others.length) {
        const [ox, oy] = this.#toMeters(others[0]);
        this.zoom(Math.hypot(x0 - ox, y0 - oy) / Math.max(0.01, Math.hypot(x1 - ox, y1 - oy)), ox, oy);
      } else if (moved > 4) {
        this.#view.x -= x1 - x0; this.#view.y -= y1 - y0; this.#fitted = false; this.#apply();
      }
      this.#pointers.set(event.pointerId, event);
    });
    const up = (event) => {
      this.#pointers.delete(event.pointerId);
      if (event.type === "pointerup" && moved <= 4) this.#onSelect(event.target.closest("[data-id]")?.dataset.id ?? null);
    };
    svg.addEventListener("pointerup", up);
    svg.addEventListener("pointercancel", up);
    svg.addEventListener("pointerleave", up);
    svg.addEventListener("keydown", ({ key }) => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
      if (step) { this.#view.x += step[0] * this.#view.w * 0.08; this.#view.y += step[1] * this.#view.h * 0.08; this.#fitted = false; this.#apply(); }
      if (key === "+") this.zoom(0.8);
      if (key === "-") this.zoom(1.25);
    });
  }
}
