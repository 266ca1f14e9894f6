// Ties stream, views, requests and log together.

import { Announcer } from "./announcer.js";
import { RequestBox } from "./asking.js";
import { Connection } from "./connection.js";
import { Journal } from "./journal.js";
import { call, Stream } from "./service.js";
import { TaskList } from "./tasks.js";
import { Views } from "./views.js";
import { definite } from "./words.js";

const STOP_TRIES = 20, STOP_AGAIN_MS = 500;
const $ = (id) => document.getElementById(id);
const scene = { nodes: new Map(), edges: new Map(), robot: null, selected: null };
let status = {};

const announcer = new Announcer($("announcement"));
const journal = new Journal($("log"), (text) => announcer.say(text));
const views = new Views(scene, { call, attempt });
const tasks = new TaskList($("tasks"), scene, {
  act: (id, name, body) => attempt(() => call("POST", `/v1/tasks/${id}/${name}`, body)),
  trace: async (id) => (await call("GET", `/v1/tasks/${id}/trace?limit=1000`).catch(() => null))?.entries,
});
const box = new RequestBox($("request-form"), $("suggestions"), scene, (request, mode, key) => attempt(() =>
  call("POST", "/v1/tasks", { request, approval: mode === "ask" ? "ask" : "auto", dry_run: mode === "dry" }, { "Idempotency-Key": key })));

function setText(id, text) { if ($(id).textContent !== text) $(id).textContent = text; }

function showProblem(text, ...buttons) {
  $("problem").hidden = !text;
  $("problem").replaceChildren(text ?? "", " ", ...buttons);
}

const counted = (count, word) => (count ? `${count} ${word}${count === 1 ? "" : "s"}` : "");

function activity() {
  const { robot } = scene;
  if (robot?.stopped) return "stopped";
  if (status.task) return "working on a request";
  if (status.simulator === "none") return "a stored map: requests are planned, nothing moves";
  return status.exploring ? "exploring" : status.explored ? "ready" : "idle";
}

function showStatus() {
  const { nodes, robot } = scene, known = [...nodes.values()];
  const parts = [
    activity(),
    nodes.has(robot?.room) ? `in ${definite(robot.room, nodes)}` : "",
    nodes.has(robot?.holding) ? `holding ${definite(robot.holding, nodes)}` : "",
    [counted(known.filter((node) => node.type === "room").length, "room"), counted(known.filter((node) => node.type === "object").length, "thing")].filter(Boolean).join(", "),
    status.language_model ?? "",
    status.perception ?? "",
  ];
  const waits = { lost: "no connection, trying again …", refused: "no access", quiet: "no news from the robot …" };
  setText("status", waits[connection.state] ?? parts.filter(Boolean).join(" · "));
  views.status(status, connection.state === "live");
  $("stopped").hidden = !robot?.stopped;
}

const edgeKey = (edge) => [edge.type, edge.source, edge.target, edge.label].join("|");
const handlers = {
  snapshot(data) {
    scene.nodes = new Map(data.scene.nodes.map((node) => [node.id, node]));
    scene.edges = new Map(data.scene.edges.map((edge) => [edgeKey(edge), edge]));
    status = data.status;
    tasks.replace(data.tasks);
    for (const task of data.tasks) journal.remember(task);
    $("no-tasks").hidden = data.tasks.length > 0;
    handlers.robot(data.robot);
    box.offer();
    views.show();
  },
  scene(delta, stamp_s) {
    journal.discovered(delta.put_nodes, scene.nodes, stamp_s);
    for (const node of delta.put_nodes) scene.nodes.set(node.id, node);
    for (const id of delta.removed_nodes) scene.nodes.delete(id);
    for (const edge of delta.put_edges) scene.edges.set(edgeKey(edge), edge);
    for (const edge of delta.removed_edges) scene.edges.delete(edgeKey(edge));
    box.offer();
    views.show();
  },
  task(task, stamp_s) { tasks.show(task); views.task(task); journal.follow(task, scene, stamp_s); $("no-tasks").hidden = true; },
  robot(robot) {
    const moved = robot.room !== scene.robot?.room;
    scene.robot = robot;
    views.robot(robot);
    if (moved) views.show();
  },
  perception(news) { status = news; },
  log(entry, stamp_s) { journal.say(entry.message, stamp_s); },
  problem({ detail }) { showProblem(detail); },
};

// Without a body there is no news, whoever answers.
const isGone = () => Boolean(status.simulator) && !["running", "none"].includes(status.simulator);

const connection = new Connection($("connection"), { changed: (state) => { if (state === "live") showProblem(null); showStatus(); }, renew: () => stream.renew(), restart: offerRestart });
const stream = new Stream(
  (event) => {
    handlers[event.type]?.(event.data ?? event, event.stamp_s);
    connection.heard();
    if (isGone()) connection.set("quiet");
    showStatus();
  },
  (state) => connection.set(state === "live" && isGone() ? "quiet" : state),
);

function offerRestart(reason) {
  const restart = Object.assign(document.createElement("button"), { type: "button", textContent: "Restart", onclick: () => attempt(() => call("POST", "/v1/simulation/restart")) });
  showProblem(reason, restart);
}

// Whether it came off; if not, why not is shown.
async function attempt(action) {
  try { await action(); showProblem(null); return true; } catch (error) { showProblem(error.message); return false; }
}

// By both ways, and again until the service has confirmed it.
async function stop() {
  stream.stop();
  for (let left = STOP_TRIES; left > 0; left -= 1) {
    try {
      await call("POST", "/v1/stop");
      if (scene.robot) scene.robot.stopped = true;
      showProblem(null);
      return showStatus();
    } catch (error) {
      showProblem(`STOP is not confirmed, the robot may still move: ${error.message}.${left > 1 ? " Trying again …" : ""}`);
    }
    await new Promise((resolve) => { setTimeout(resolve, STOP_AGAIN_MS); });
  }
}

$("stop").addEventListener("click", stop);
$("release").addEventListener("click", () => attempt(() => call("POST", "/v1/resume")));
addEventListener("keydown", ({ key }) => { if (key === "Escape") stop(); }, { capture: true });
