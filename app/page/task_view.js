// How one request looks: the words, what the robot says, its plan as a timeline, what went wrong, and what a person may do next.

import { el } from "./dom.js";
import { taskLinks } from "./links.js";
import { action, choices, goal, parsedStep, roughly, step } from "./words.js";

const MARKS = { running: "▸", succeeded: "✓", failed: "✕", skipped: "–", interrupted: "–" };
const SPOKEN = { running: "now", succeeded: "done", failed: "failed", skipped: "left out", interrupted: "broken off" };
const OPERATIONS = { awaiting_approval: ["approve", "reject"], running: ["pause", "cancel"], paused: ["resume", "cancel"] };
const ENDED = new Set(["succeeded", "failed", "cancelled", "refused"]);
export const hasEnded = ({ status }) => ENDED.has(status);

// The item of a task. `past`: plans that were given up on the way, or null while they are not known. `isOpen`: whether the plan is unfolded at first.
export function taskItem(task, { nodes, edges }, { past = null, isOpen = true } = {}) {
  const ended = hasEnded(task);
  return el("li", { class: `task ${task.status}`, "data-key": task.id, "data-task": task.id, "data-revision": task.plan?.revision },
    el("div", { class: "heading", "data-key": "heading" }, el("h3", { class: "words" }, task.request), el("span", { class: "badge" }, statusWords(task))),
    task.dialogue.filter(({ answer }) => answer).map(({ question, answer }, i) => [speech(question, `asked ${i}`), el("p", { class: "answered", "data-key": `answered ${i}` }, answer)]).flat(),
    said(task),
    ended && task.verified.length ? el("ul", { class: "verified", "data-key": "verified" }, task.verified.map((part) => verifiedItem(part, nodes))) : "",
    task.status === "awaiting_answer" ? question(task, nodes, edges) : "",
    ended ? "" : controls(task),
    task.failures.length ? el("ol", { class: "failures", "data-key": "failures", "aria-label": "What went wrong" }, task.failures.map(failureItem)) : "",
    task.replans ? earlierPlans(task, past, nodes) : "",
    task.plan ? planFold(task, nodes, isOpen || !ended) : "",
    showsForecast(task) ? forecast(task.plan, nodes) : "",
    taskLinks(task, nodes),
  );
}

const speech = (text, key) => (text ? el("p", { class: "reply", "data-key": key }, text) : "");

// While a task runs its steps say more than its explanation.
const said = ({ reply, explanation, status }) => [...new Set([reply, status === "running" ? "" : explanation])].map((text, i) => speech(text, `said ${i}`));

function statusWords({ status, plan, times }) {
  if (status === "succeeded" && plan && times.started_s === null) return "planned only";
  return { awaiting_answer: "question", awaiting_approval: "may I?" }[status] ?? status;
}

function planFold(task, nodes, isOpen) {
  const { steps } = task.plan, done = steps.filter(({ status }) => status === "succeeded").length;
  const spent = Math.round(steps.reduce((sum, { seconds }) => sum + seconds, 0));
  const counted = `${steps.length} step${steps.length === 1 ? "" : "s"}`;
  const told = task.times.started_s === null ? counted : `${done} of ${counted} done${spent ? `, ${spent} s` : ""}`;
  const broken = (part) => (hasEnded(task) && part.status === "running" ? { ...part, status: "interrupted" } : part);
  return el("details", { class: "plan", "data-key": "plan", open: isOpen },
    el("summary", {}, task.replans ? "Plan now: " : "Plan: ", told),
    el("ol", { class: "steps" }, steps.map((part) => stepItem(broken(part), nodes))));
}

function stepItem(part, nodes) {
  const active = part.status === "running" && part.actions.find(({ status }) => status === "running");
  return el("li", { class: part.status, title: `${part.skill}(${part.args.join(", ")})`, "aria-current": part.status === "running" ? "step" : null },
    el("span", { class: "mark", role: MARKS[part.status] ? "img" : null, "aria-label": SPOKEN[part.status] }, MARKS[part.status] ?? ""),
    el("span", { class: "what" }, step(part, nodes)),
    el("span", { class: "seconds" }, part.seconds ? `${Math.round(part.seconds)} s` : ""),
    active ? el("span", { class: "action" }, action(active.name, nodes)) : "");
}

function earlierPlans(task, past, nodes) {
  const count = `${task.replans} earlier plan${task.replans === 1 ? "" : "s"}`;
  return el("details", { class: "earlier", "data-key": "earlier" }, el("summary", {}, count),
    past === null ? el("p", { class: "soft" }, "…") : past.map((plan) => el("ol", { class: "steps given-up" }, plan.map((part) => stepItem(part, nodes)))));
}

// The plans that a trace tells of, but for the last one, with how far their steps came.
export function plansInTrace(entries) {
  const plans = [];
  for (const { kind, data } of entries) {
    if (kind === "planned") plans.push(data.steps.map((text) => ({ ...parsedStep(text), status: "pending", actions: [], seconds: 0 })));
    const told = kind === "step" ? plans.at(-1)?.[data.index] : undefined;
    if (told) Object.assign(told, { status: data.status, seconds: data.seconds });
  }
  return plans.slice(0, -1).map((plan) => plan.map((part) => (part.status === "running" ? { ...part, status: "interrupted" } : part)));
}

const showsForecast = ({ status, plan, times }) => plan?.steps.length > 0 && (status === "awaiting_approval" || (status === "succeeded" && times.started_s === null));

// What a plan is expected to take, and how things will be afterwards.
function forecast({ expected_s, expected_m, changes }, nodes) {
  const way = expected_m >= 0.05 ? `, ${expected_m.toFixed(1)} m to drive` : "";
  return el("div", { class: "forecast", "data-key": "forecast" },
    el("p", {}, expected_s > 0 ? `It takes ${roughly(expected_s)}${way}.` : "", changes.added.length ? " Afterwards:" : ""),
    el("ul", {}, changes.added.map((fact) => el("li", {}, goal(fact, nodes)))));
}

function failureItem({ message, suggestion, code, evidence }) {
  return el("li", { title: code.replaceAll("_", " ") }, el("span", {}, message), " ", el("span", { class: "suggestion" }, suggestion),
    evidence.observation && evidence.observation !== message ? el("p", { class: "evidence" }, `Evidence: ${evidence.observation}`) : "");
}

function verifiedItem(part, nodes) {
  return el("li", { class: part.confirmed ? "confirmed" : "" }, part.confirmed ? "seen: " : "not seen: ", goal(part, nodes));
}

function question(task, nodes, edges) {
  const candidates = choices(task.candidates, nodes, edges);
  return el("div", { class: "question", "data-key": `question ${task.dialogue.length}` },
    candidates.length ? el("div", { class: "candidates", role: "group", "aria-label": "Answers" }, candidates.map(({ id, text }) => el("button", { type: "button", "data-answer": id }, text))) : "",
    el("form", { class: "row" },
      el("input", { "aria-label": "Answer", maxlength: 2000, placeholder: candidates.length ? "or in your own words" : "your answer" }),
      el("button", {}, "Answer")));
}

function controls(task) {
  const names = OPERATIONS[task.status] ?? ["cancel"];
  return el("div", { class: "controls", "data-key": "controls", role: "group", "aria-label": "What you may do" },
    names.map((name) => el("button", { type: "button", class: name, "data-key": name, "data-act": name }, name[0].toUpperCase() + name.slice(1))));
}
