// The log: what the service says, what is discovered, and how requests go on, in robot time.

import { clock, definite, step, title } from "./words.js";

const KEPT = 200;
const DISCOVERED = new Set(["room", "door", "object", "person"]);
const TOLD = new Set(["awaiting_answer", "awaiting_approval", "paused", "succeeded", "failed", "cancelled", "refused"]);

export class Journal {
  #list; #announce; #tasks = new Map();

  // `announce(text)` says aloud what a person waits for: questions, outcomes, what went wrong.
  constructor(list, announce) { [this.#list, this.#announce] = [list, announce]; }

  say(message, stamp_s) {
    const [item, time] = [document.createElement("li"), document.createElement("time")];
    time.textContent = clock(stamp_s);
    item.append(time, message);
    this.#list.prepend(item);
    while (this.#list.children.length > KEPT) this.#list.lastChild.remove();
  }

  // Tells of nodes that are not among `known` yet.
  discovered(nodes, known, stamp_s) {
    for (const node of nodes) {
      if (known.has(node.id) || !DISCOVERED.has(node.type) || node.provisional || node.status === "temporary") continue;
      const where = node.type !== "room" && known.has(node.room) ? ` in ${definite(node.room, known)}` : "";
      this.say(`found ${title(node)}${where}`, stamp_s);
    }
  }

  // Remembers a task without telling of it.
  remember(task) { this.#tasks.set(task.id, task); }

  // Tells what has changed of a task.
  follow(task, { nodes }, stamp_s) {
    const before = this.#tasks.get(task.id);
    const done = (plan) => plan?.steps.filter((part) => part.status === "succeeded").length ?? 0;
    if (!before) this.say(`asked: ${task.request}`, stamp_s);
    for (const failure of task.failures.slice(before?.failures.length ?? 0)) this.#tell(failure.message, stamp_s);
    if (task.plan && done(task.plan) > done(before?.plan)) this.say(`done: ${step(task.plan.steps[done(task.plan) - 1], nodes)}`, stamp_s);
    if (before && before.status !== task.status && (TOLD.has(task.status) || before.status === "paused")) {
      this.#tell(`${task.status.replaceAll("_", " ")}: ${task.request}`, stamp_s);
      if (TOLD.has(task.status)) this.#announce([...new Set([task.reply, task.explanation])].filter(Boolean).join(" "));
    }
    this.remember(task);
  }

  #tell(message, stamp_s) { this.say(message, stamp_s); this.#announce(message); }
}
