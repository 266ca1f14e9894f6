// Requests and what became of them: reply, plan with each step's state, failures with explanation, buttons.

const MARKS = { pending: "○", running: "▶", succeeded: "✓", failed: "✗", skipped: "–" };
const ENDED = new Set(["succeeded", "failed", "cancelled", "refused"]);

function el(name, className, text) {
  const node = document.createElement(name);
  if (className) node.className = className;
  if (text !== undefined) node.textContent = text;
  return node;
}

function stepItem(step) {
  const item = el("li", step.status);
  item.append(el("span", "mark", MARKS[step.status] ?? "○"), el("span", "", `${step.skill} ${step.args.join(", ")}`),
    el("span", "seconds", step.seconds ? `${Math.round(step.seconds)} s` : ""));
  const active = (step.actions ?? []).find((action) => action.status === "running");
  if (active) item.append(el("span", "actions", active.name));
  return item;
}

function failureItem(failure) {
  const item = el("li");
  item.append(el("div", "", failure.message));
  if (failure.suggestion) item.append(el("div", "suggestion", failure.suggestion));
  return item;
}

export function taskItem(task, act) {
  const item = el("li", "task");
  item.append(el("span", `badge ${task.status}`, task.status.replaceAll("_", " ")), el("div", "words", task.request));
  if (task.reply) item.append(el("p", "reply", task.reply));
  if (task.plan) {
    const steps = el("ol", "steps");
    steps.append(...task.plan.steps.map(stepItem));
    item.append(steps);
  }
  if (task.failures?.length) {
    const failures = el("ol", "failures");
    failures.append(...task.failures.map(failureItem));
    item.append(failures);
  }
  if (task.explanation && task.explanation !== task.reply) item.append(el("p", "reply", task.explanation));
  if (task.status === "awaiting_answer") item.append(candidates(task, act));
  if (!ENDED.has(task.status)) item.append(controls(task, act));
  return item;
}

function candidates(task, act) {
  const row = el("div", "candidates controls");
  for (const candidate of task.candidates ?? []) {
    const button = el("button", "", candidate.description ?? candidate.id ?? candidate);
    button.onclick = () => act(task.id, "answer", { answer: candidate.id ?? candidate });
    row.append(button);
  }
  return row;
}

function controls(task, act) {
  const row = el("div", "controls");
  const names = { awaiting_approval: ["approve", "reject"], running: ["pause", "cancel"], paused: ["resume", "cancel"] }[task.status] ?? ["cancel"];
  for (const name of names) {
    const button = el("button", "", name[0].toUpperCase() + name.slice(1));
    button.type = "button";
    button.onclick = () => act(task.id, name);
    row.append(button);
  }
  return row;
}
