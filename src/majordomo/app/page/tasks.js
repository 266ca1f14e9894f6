// Requests and what became of them: reply, plan as a timeline, failures with explanation, and what a person may do next.

import { action, choices, goal, step } from "./words.js";

const MARKS = { running: "▸", succeeded: "✓", failed: "✕", skipped: "–", interrupted: "–" };
const ENDED = new Set(["succeeded", "failed", "cancelled", "refused"]);
const OPERATIONS = { awaiting_approval: ["approve", "reject"], running: ["pause", "cancel"], paused: ["resume", "cancel"] };

function el(name, className, ...content) {
  const node = document.createElement(name);
  if (className) node.className = className;
  node.append(...content.filter((part) => part !== null && part !== ""));
  return node;
}

// Shows tasks in a list, newest first, and touches only the items that changed, so that focus and typing stay.
export class TaskList {
  #list; #act; #items = new Map();

  // `act(task id, operation, body)` carries out what a person chose.
  constructor(list, act) { this.#list = list; this.#act = act; }

  clear() { this.#items.clear(); this.#list.replaceChildren(); }

  show(task, { nodes, edges }) {
    const item = this.#item(task, nodes, edges);
    const old = this.#items.get(task.id);
    if (old) old.replaceWith(item);
    else this.#list.prepend(item);
    this.#items.set(task.id, item);
    while (this.#list.children.length > 30) this.#forgetOldest();
  }

  #forgetOldest() {
    const oldest = this.#list.lastChild;
    oldest.remove();
    this.#items.delete(oldest.dataset.task);
  }

  #item(task, nodes, edges) {
    const item = el("li", `task ${task.status}`,
      el("div", "heading", el("span", "words", task.request), el("span", "badge", statusWords(task))));
    item.dataset.task = task.id;
    for (const { question, answer } of task.dialogue) {
      if (answer) item.append(el("p", "said", question, " ", el("b", "", answer)));
    }
    if (task.reply && task.reply !== task.explanation) item.append(el("p", "reply", task.reply));
    if (task.failures.length) item.append(el("ol", "failures", ...task.failures.map(failureItem)));
    if (task.plan) item.append(el("ol", "steps", ...task.plan.steps.map((part) => stepItem(ENDED.has(task.status) && part.status === "running" ? { ...part, status: "interrupted" } : part, nodes))));
    if (task.explanation && task.status !== "running") item.append(el("p", "reply", task.explanation));
    if (ENDED.has(task.status) && task.verified.length) item.append(el("ul", "verified", ...task.verified.map((part) => verifiedItem(part, nodes))));
    if (task.status === "awaiting_answer") item.append(this.#question(task, nodes, edges));
    if (!ENDED.has(task.status)) item.append(this.#controls(task));
    return item;
  }

  #question(task, nodes, edges) {
    const box = el("div", "question");
    const answer = (text) => this.#act(task.id, "answer", { answer: text });
    const buttons = choices(task.candidates, nodes, edges).map(({ id, text }) => button(text, () => answer(id)));
    const input = el("input");
    input.setAttribute("aria-label", "Answer");
    input.placeholder = buttons.length ? "or in your own words" : "your answer";
    const form = el("form", "row", input, button("Answer"));
    form.addEventListener("submit", (event) => { event.preventDefault(); if (input.value.trim()) answer(input.value.trim()); });
    box.append(...(buttons.length ? [el("div", "candidates", ...buttons)] : []), form);
    return box;
  }

  #controls(task) {
    const names = OPERATIONS[task.status] ?? ["cancel"];
    return el("div", "controls", ...names.map((name) => button(name[0].toUpperCase() + name.slice(1), () => this.#act(task.id, name), name)));
  }
}

function statusWords({ status, plan, times }) {
  if (status === "succeeded" && plan && times.started_s === null) return "planned only";
  return { awaiting_answer: "question", awaiting_approval: "may I?" }[status] ?? status;
}

function button(text, onClick, className = "") {
  const node = el("button", className, text);
  if (onClick) { node.type = "button"; node.onclick = onClick; }
  return node;
}

function stepItem(part, nodes) {
  const active = part.status === "running" && part.actions.find(({ status }) => status === "running");
  const item = el("li", part.status, el("span", "mark", MARKS[part.status] ?? ""), el("span", "what", step(part, nodes)),
    el("span", "seconds", part.seconds ? `${Math.round(part.seconds)} s` : ""));
  if (active) item.append(el("span", "action", action(active.name, nodes)));
  item.title = `${part.skill}(${part.args.join(", ")})`;
  return item;
}

function failureItem(failure) {
  const item = el("li", "", el("span", "", failure.message), " ", el("span", "suggestion", failure.suggestion));
  item.title = failure.code.replaceAll("_", " ");
  return item;
}

function verifiedItem(part, nodes) {
  return el("li", part.confirmed ? "confirmed" : "", part.confirmed ? "seen: " : "not seen: ", goal(part, nodes));
}
