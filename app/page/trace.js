// What was decided about a request, when, and why.

import { button, el, replaceIfNew } from "./dom.js";
import { clock, title } from "./words.js";

const PAGE = 200;
const AGAIN_MS = 700;
const IDENTIFIER = /([a-z]+(?:_[a-z]+)*(?:_\d+)+)/;

export class TraceView {
  #panel; #fetch; #scene; #select; #task = null; #due = 0;
  #heading = el("h2", { tabindex: "-1" }, "Decisions"); #note = el("p", "soft"); #list = el("ol", "trace");

  // `fetch(path)` gives a document, `select(id)` hears which node of `scene` was picked.
  constructor(panel, fetch, scene, select) {
    [this.#panel, this.#fetch, this.#scene, this.#select] = [panel, fetch, scene, select];
    panel.append(this.#heading, this.#note, this.#list);
  }

  // Shows the decisions about a task and goes on with it.
  async show(taskId) {
    if (taskId !== this.#task) { this.#list.replaceChildren(); delete this.#list.dataset.key; }
    this.#task = taskId;
    this.#heading.textContent = `Decisions about ${taskId.replace("_", " ")}`;
    this.#heading.focus({ preventScroll: true });
    await this.#load();
  }

  // Hears that a task has changed.
  follow(taskId) {
    if (taskId !== this.#task || this.#due || this.#panel.hidden) return;
    this.#due = setTimeout(() => { this.#due = 0; this.#load(); }, AGAIN_MS);
  }

  async #load() {
    const task = this.#task;
    try {
      const { entries, dropped } = await this.#read(task);
      if (task !== this.#task) return;
      this.#note.textContent = [entries.length ? "" : "Nothing was written down.", dropped ? `${dropped} older entries were dropped, because the journal is full.` : ""].filter(Boolean).join(" ");
      replaceIfNew(this.#list, `${task} ${entries.at(-1)?.seq}`, () => entries.map((entry) => this.#item(entry)));
    } catch (error) {
      this.#note.textContent = error.message;
    }
  }

  #item({ stamp_s, at_s, kind, what, why, data }) {
    const at = new Date(1000 * at_s);
    return el("li", `entry ${kind}`,
      el("time", { datetime: at.toISOString(), title: at.toLocaleString() }, clock(stamp_s)),
      el("div", {}, el("b", {}, kind.replaceAll("_", " ")), " ", this.#linked(what), why ? el("p", "why", this.#linked(why)) : null, Object.keys(data).length ? dataOf(data) : null));
  }

  // A text in which the names of nodes can be picked.
  #linked(text) {
    return text.split(IDENTIFIER).map((part) => (this.#scene.nodes.has(part) ? button(part, () => this.#select(part), { class: "link inline", title: title(this.#scene.nodes.get(part)) }) : part));
  }

  async #read(task) {
    const entries = [];
    let after = 0, page;
    do {
      page = await this.#fetch(`/v1/tasks/${encodeURIComponent(task)}/trace?after=${after}&limit=${PAGE}`);
      entries.push(...page.entries);
      after = page.next;
    } while (after !== null);
    return { entries, dropped: page.dropped };
  }
}

const dataOf = (data) => el("details", {}, el("summary", {}, "details"), el("pre", { tabindex: "0" }, JSON.stringify(data, null, 1)));
