// Pan, zoom and fit of an SVG whose user units are meters, by mouse, touch and keyboard.

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const DRAG_PIXELS = 5;

export class Viewport {
  #svg; #view = { x: -4, y: -4, w: 8, h: 8 }; #box = null; #fitted = true; #pointers = new Map(); #moved = 0; #onScale; #onTap; #scale = 0;

  constructor(svg, { onScale, onTap }) {
    this.#svg = svg;
    this.#onScale = onScale;
    this.#onTap = onTap;
    svg.addEventListener("wheel", (event) => { event.preventDefault(); this.zoom(event.deltaY > 0 ? 1.15 : 0.87, this.#toMeters(event)); }, { passive: false });
    svg.addEventListener("pointerdown", (event) => { if (!this.#pointers.size) this.#moved = 0; this.#pointers.set(event.pointerId, event); });
    svg.addEventListener("pointermove", (event) => this.#drag(event));
    for (const name of ["pointerup", "pointercancel", "pointerleave"]) svg.addEventListener(name, (event) => this.#release(event));
    svg.addEventListener("keydown", (event) => this.#press(event));
    new ResizeObserver(() => this.#apply()).observe(svg);
    this.#apply();
  }

  // Meters per CSS pixel.
  get scale() { return this.#scale; }

  // Shows `box` ([left, top, right, bottom], y down) unless a person has moved the view; `again` makes that so no more.
  fit(box = this.#box, again = false) {
    this.#box = box;
    if (again) this.#fitted = true;
    if (!this.#fitted || !box) return;
    const [left, top, right, bottom] = box;
    this.#show({ x: left, y: top, w: Math.max(right - left, 1), h: Math.max(bottom - top, 1) });
  }

  zoom(factor, [cx, cy] = [this.#view.x + this.#view.w / 2, this.#view.y + this.#view.h / 2]) {
    const { x, y, w, h } = this.#view;
    const bounded = Math.min(Math.max(w * factor, 0.5), 500) / w;
    this.#fitted = false;
    this.#show({ x: cx - (cx - x) * bounded, y: cy - (cy - y) * bounded, w: w * bounded, h: h * bounded });
  }

  #pan(dx, dy) {
    this.#fitted = false;
    this.#show({ ...this.#view, x: this.#view.x + dx, y: this.#view.y + dy });
  }

  #show(view) { this.#view = view; this.#apply(); }

  #apply() {
    const { x, y, w, h } = this.#view;
    const { clientWidth, clientHeight } = this.#svg;
    this.#svg.setAttribute("viewBox", `${x} ${y} ${w} ${h}`);
    if (!clientWidth || !clientHeight) return;
    const scale = Math.max(w / clientWidth, h / clientHeight);
    if (Math.abs(scale / this.#scale - 1) < 1e-3) return;
    this.#scale = scale;
    this.#svg.style.setProperty("--pixel", scale);
    this.#onScale();
  }

  #toMeters(event) {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.#svg.getScreenCTM().inverse());
    return [point.x, point.y];
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
    if (dx || dy) this.#pan(dx * this.#view.w * 0.08, dy * this.#view.h * 0.08);
    else if (event.key === "+" || event.key === "=") this.zoom(0.8);
    else if (event.key === "-") this.zoom(1.25);
    else if (event.key === "0") this.fit(undefined, true);
    else return;
    event.preventDefault();
  }
}
