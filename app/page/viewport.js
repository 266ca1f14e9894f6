// Pan, zoom and fit of a group inside an SVG whose user units are meters, by mouse, touch and keyboard.
// Only the group's transform changes, so moving costs the same however much is drawn.

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const DRAG_PIXELS = 5;
const NEAREST_M = 0.5, FARTHEST_M = 500;
const SETTLED_MS = 120;

export class Viewport {
  #svg; #world; #center = [0, 0]; #scale = 0.02; #size = [0, 0]; #box = null; #fitted = true;
  #pointers = new Map(); #moved = 0; #onScale; #onTap; #drawnAt = 0; #settling = 0;

  // `onScale` hears when a new scale has settled, `onTap` the data-id that was tapped, or null.
  constructor(svg, world, { onScale, onTap }) {
    [this.#svg, this.#world, this.#onScale, this.#onTap] = [svg, world, onScale, onTap];
    svg.addEventListener("wheel", (event) => { event.preventDefault(); this.zoom(event.deltaY > 0 ? 1.15 : 0.87, this.#toMeters(event)); }, { passive: false });
    svg.addEventListener("pointerdown", (event) => { if (!this.#pointers.size) this.#moved = 0; this.#pointers.set(event.pointerId, event); });
    svg.addEventListener("pointermove", (event) => this.#drag(event));
    for (const name of ["pointerup", "pointercancel", "pointerleave"]) svg.addEventListener(name, (event) => this.#release(event));
    svg.addEventListener("keydown", (event) => this.#press(event));
    new ResizeObserver(() => this.#resize()).observe(svg);
    this.#resize();
  }

  // Meters per CSS pixel.
  get scale() { return this.#scale; }

  // Shows `box` ([left, top, right, bottom], y down) unless a person has moved the view; `again` makes that so no more.
  fit(box = this.#box, again = false) {
    this.#box = box;
    if (again) this.#fitted = true;
    const [width, height] = this.#size;
    if (!this.#fitted || !box || !width || !height) return;
    const [left, top, right, bottom] = box;
    this.#show([(left + right) / 2, (top + bottom) / 2], Math.max(Math.max(right - left, 1) / width, Math.max(bottom - top, 1) / height));
  }

  zoom(factor, [x, y] = this.#center) {
    const width = this.#scale * (this.#size[0] || 1);
    const bounded = Math.min(Math.max(width * factor, NEAREST_M), FARTHEST_M) / width;
    this.#fitted = false;
    this.#show([x - (x - this.#center[0]) * bounded, y - (y - this.#center[1]) * bounded], this.#scale * bounded);
  }

  // Moves the point into view if it is not.
  reveal([x, y]) {
    const margin = 40 * this.#scale;
    const isOut = [x, y].some((value, i) => Math.abs(value - this.#center[i]) > (this.#size[i] * this.#scale) / 2 - margin);
    if (isOut) { this.#fitted = false; this.#show([x, y], this.#scale); }
  }

  #pan(dx, dy) {
    this.#fitted = false;
    this.#show([this.#center[0] + dx, this.#center[1] + dy], this.#scale);
  }

  #resize() {
    const [before, after] = [this.#size[0], [this.#svg.clientWidth, this.#svg.clientHeight]];
    if (!after[0] || !after[1]) return;
    this.#size = after;
    if (this.#fitted && this.#box) this.fit();
    else this.#show(this.#center, before ? this.#scale : 8 / after[0]);
  }

  #show(center, scale) {
    [this.#center, this.#scale] = [center, scale];
    const k = 1 / scale, [x, y] = center, [width, height] = this.#size;
    this.#world.setAttribute("transform", `matrix(${k} 0 0 ${k} ${width / 2 - x * k} ${height / 2 - y * k})`);
    if (Math.abs(scale / this.#drawnAt - 1) < 1e-3) return;
    clearTimeout(this.#settling);
    if (this.#drawnAt) this.#settling = setTimeout(() => this.#settle(), SETTLED_MS);
    else this.#settle();
  }

  #settle() { this.#drawnAt = this.#scale; this.#onScale(); }

  #toMeters({ clientX, clientY }) {
    const { left, top } = this.#svg.getBoundingClientRect(), [width, height] = this.#size;
    return [this.#center[0] + (clientX - left - width / 2) * this.#scale, this.#center[1] + (clientY - top - height / 2) * this.#scale];
  }

  #drag(event) {
    const before = this.#pointers.get(event.pointerId);
    if (!before) return;
    const other = [...this.#pointers.values()].find((pointer) => pointer.pointerId !== event.pointerId);
    const [x0, y0] = this.#toMeters(before), [x1, y1] = this.#toMeters(event);
    this.#moved += Math.hypot(event.clientX - before.clientX, event.clientY - before.clientY);
    this.#pointers.set(event.pointerId, event);
    if (other) {
      const [ox, oy] = this.#toMeters(other);
      this.zoom(Math.hypot(x0 - ox, y0 - oy) / Math.max(0.01, Math.hypot(x1 - ox, y1 - oy)), [ox, oy]);
    } else if (this.#moved > DRAG_PIXELS) {
      this.#pan(x0 - x1, y0 - y1);
    }
  }

  #release(event) {
    if (!this.#pointers.delete(event.pointerId) || event.type !== "pointerup" || this.#moved > DRAG_PIXELS) return;
    this.#onTap(event.target.closest("[data-id]")?.dataset.id ?? null);
  }

  #press(event) {
    const [dx, dy] = ARROWS[event.key] ?? [0, 0];
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (dx || dy) this.#pan(dx * 60 * this.#scale, dy * 60 * this.#scale);
    else if (event.key === "+" || event.key === "=") this.zoom(0.8);
    else if (event.key === "-") this.zoom(1.25);
    else if (event.key === "0") this.fit(undefined, true);
    else return;
    event.preventDefault();
  }
}
