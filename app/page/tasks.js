// The list of requests, newest first. Whatever happens to a task, focus, typing and what was unfolded stay.

import { morph } from "./morph.js";
import { plansInTrace, taskItem } from "./task_view.js";

const SHOWN = 30;

export class TaskList {
  #list; #scene; #do; #items = new Map(); #tasks = new Map(); #past = new Map();

  // `scene`: { nodes, edges }. `act(task id, operation, body)` carries out what a person chose, `trace(task id)` promises the
  // entries of its trace. The events "select-node" and "show-trace" ask those who can to show a node or the decisions about a task.
  constructor(list, scene, { act, trace }) {
    [this.#list, this.#scene, this.#do] = [list, scene, { act, trace }];
    list.addEventListener("click", (event) => this.#click(event.target.closest("button")));
    list.addEventListener("submit", (event) => { event.preventDefault(); this.#submit(event.target); });
    list.addEventListener("toggle", ({ target }) => { if (target.matches(".earlier") && target.open) this.#remember(target.closest(".task").dataset.task); }, { capture: true });
  }

  // All tasks there are, oldest first; what is shown of others goes.
  replace(tasks) {
    const ids = new Set(tasks.map(({ id }) => id));
    for (const id of [...this.#items.keys()]) if (!ids.has(id)) this.#forget(id);
    for (const task of tasks.slice(-SHOWN)) this.show(task, task === tasks.at(-1));
  }

  show(task, isOpen = true) {
    const isNew = !this.#tasks.has(task.id);
    const hasOtherPast = (this.#tasks.get(task.id)?.replans ?? 0) !== task.replans && this.#past.has(task.id);
    this.#tasks.set(task.id, task);
    const item = taskItem(task, this.#scene, { past: this.#past.get(task.id) ?? null, isOpen });
    if (isNew) {
      this.#items.set(task.id, item);
      this.#list.prepend(item);
      if (this.#list.children.length > SHOWN) this.#forget(this.#list.lastElementChild.dataset.task);
    } else {
      morph(this.#items.get(task.id), item);
      if (hasOtherPast) this.#remember(task.id);
    }
  }

  #forget(id) {
    this.#items.get(id).remove();
    for (const kept of [this.#items, this.#tasks, this.#past]) kept.delete(id);
  }

  // Asks for the plans that were given up, and shows them.
  async #remember(id) {
    const entries = await this.#do.trace(id);
    if (!entries || !this.#tasks.has(id)) return;
    this.#past.set(id, plansInTrace(entries));
    this.show(this.#tasks.get(id));
  }

  #click(button) {
    if (!button) return;
    const { task, revision } = button.closest(".task").dataset, { act, answer, node } = button.dataset;
    const say = (name, detail) => button.dispatchEvent(new CustomEvent(name, { bubbles: true, detail }));
    if (node) say("select-node", node);
    if ("trace" in button.dataset) say("show-trace", task);
    if (answer) this.#do.act(task, "answer", { answer });
    if (act) this.#do.act(task, act, act === "approve" ? { revision: Number(revision) } : undefined);
  }

  #submit(form) {
    const answer = form.querySelector("input").value.trim();
    if (answer) this.#do.act(form.closest(".task").dataset.task, "answer", { answer });
  }
}
