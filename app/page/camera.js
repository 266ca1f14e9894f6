// What the robot sees: the newest picture with outlines over it that can be picked, and how old it is.
// Nothing is fetched while nobody can see it, and a picture that is no longer new says so.

import { button, el, replaceIfNew } from "./dom.js";
import { labels, outline } from "./outlines.js";
import { title } from "./words.js";

const PERIOD_MS = 700;
const OLD_S = 2;
const LABEL_PX = 12;

export class CameraView {
  #fetch; #select; #frames = []; #visible = new Set(); #seen = null; #stamped = 0; #live = false; #available = false; #scene = null;

  // `fetch(path)` gives a document or a blob, `select(id)` hears what was picked.
  constructor(fetch, select) {
    [this.#fetch, this.#select] = [fetch, select];
    this.#loop();
  }

  // Shows in a figure of an image, an overlay and a caption; `list`: where what is seen is listed by name, too.
  show(figure, list = null) {
    const [image, overlay, caption] = ["img", "svg", "figcaption"].map((name) => figure.querySelector(name));
    this.#frames.push({ figure, image, overlay, caption, list });
    overlay.addEventListener("click", ({ target }) => { const id = target.closest("[data-id]")?.dataset.id; if (id) this.#select(id); });
    const watched = new IntersectionObserver((entries) => {
      const { isIntersecting } = entries.at(-1);
      this.#visible[isIntersecting ? "add" : "delete"](figure);
      if (!isIntersecting) return;
      this.#showAge();
      if (this.#seen) this.#draw(this.#seen);  // labels go by the size on the screen, which is known only now
    });
    watched.observe(figure);
  }

  // `live`: whether the service is heard at the moment; `available`: whether it has a camera that has shown something.
  status({ live, available }) {
    [this.#live, this.#available] = [live, available];
    for (const { figure } of this.#frames) figure.classList.toggle("without", !available);
    this.#showAge();
  }

  scene(scene) { this.#scene = scene; this.#mark(); }

  async #loop() {
    if (this.#live && this.#available && !document.hidden && this.#visible.size) await this.#refresh().catch(() => {});
    this.#showAge();
    setTimeout(() => this.#loop(), PERIOD_MS);
  }

  async #refresh() {
    const seen = await this.#fetch("/v1/camera");
    if (seen.stamp_s === this.#seen?.stamp_s) return;
    const picture = await this.#fetch(`/v1/camera.jpg?${new URLSearchParams({ stamp_s: seen.stamp_s, outlines: false })}`);
    const address = URL.createObjectURL(picture), before = this.#frames[0]?.image.src;
    const loaded = new Image();
    loaded.src = address;
    await loaded.decode();
    this.#stamped = performance.now() - 1000 * seen.age_s;
    this.#seen = seen;
    for (const { image } of this.#frames) image.src = address;
    if (before?.startsWith("blob:")) URL.revokeObjectURL(before);
    this.#draw(seen);
  }

  #draw({ width, height, instances: all }) {
    const instances = all.filter(({ background }) => !background);
    for (const { overlay, list, figure } of this.#frames) {
      overlay.setAttribute("viewBox", `0 0 ${width} ${height}`);
      overlay.replaceChildren(...instances.flatMap((seen) => outline(seen, this.#name(seen))), ...(list ? labels(instances.map((seen) => ({ ...seen, name: this.#name(seen) })), width, (LABEL_PX * width) / (overlay.clientWidth || width)) : []));
      figure.style.setProperty("--aspect", `${width} / ${height}`);
      if (list) this.#listSeen(list, instances);
    }
    this.#mark();
  }

  #listSeen(list, instances) {
    const known = instances.filter(({ node }) => node);
    replaceIfNew(list, known.map((seen) => seen.node + this.#name(seen)).sort().join(), () =>
      [...new Map(known.map((seen) => [seen.node, seen])).values()].map((seen) => el("li", {}, button(this.#name(seen), () => this.#select(seen.node), { "data-id": seen.node, "data-focus": seen.node }))));
  }

  #name({ node, label }) {
    const known = this.#scene?.nodes.get(node);
    return known ? title(known) : label.replaceAll("_", " ");
  }

  #mark() {
    for (const { overlay, list } of this.#frames) {
      for (const part of overlay.querySelectorAll("[data-id]")) part.classList.toggle("selected", part.dataset.id === this.#scene?.selected);
      for (const one of list?.querySelectorAll("button") ?? []) one.setAttribute("aria-pressed", one.dataset.id === this.#scene?.selected);
    }
  }

  #showAge() {
    const age_s = (performance.now() - this.#stamped) / 1000, isOld = !this.#live || age_s > OLD_S;
    for (const { figure, caption } of this.#frames) {
      if (!this.#visible.has(figure) && !isOld) continue;
      figure.classList.toggle("old", Boolean(this.#seen) && isOld);
      const text = !this.#available ? "The camera is off, or has not shown anything yet." : !this.#seen ? "waiting for a picture …" : isOld ? `not live: ${ago(age_s)} old` : `live, ${age_s.toFixed(1)} s old`;
      if (caption.textContent !== text) caption.textContent = text;
    }
  }
}

const ago = (age_s) => (age_s < 90 ? `${Math.round(age_s)} s` : `${Math.round(age_s / 60)} min`);
