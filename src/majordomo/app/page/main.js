// Ties stream, map, requests, camera and log together.

import { fillDetails } from "./details.js";
import { Journal } from "./journal.js";
import { BuildingMap } from "./map.js";
import { call, Stream } from "./service.js";
import { suggestions } from "./suggestions.js";
import { TaskList } from "./tasks.js";
import { definite } from "./words.js";

const CAMERA_MS = 700;
const $ = (id) => document.getElementById(id);
const scene = { nodes: new Map(), edges: new Map(), robot: null, selected: null };
let status = {}, state = "lost", ideas = [];

const journal = new Journal($("log"));
const map = new BuildingMap($("map"), select);
const tasks = new TaskList($("tasks"), (id, name, body) => attempt(() => call("POST", `/v1/tasks/${id}/${name}`, body)));

function select(id) { scene.selected = id; showScene(); showDetails(); }

function showScene() {
  map.draw(scene);
  $("map-empty").hidden = [...scene.nodes.values()].some((node) => node.type === "room");
}

function showDetails() {
  const teach = (id, body) => attempt(() => call("PATCH", `/v1/scene/nodes/${encodeURIComponent(id)}`, body));
  if ($("details").contains(document.activeElement) && document.activeElement.value) return;
  fillDetails($("details"), scene.nodes.get(scene.selected), scene, { teach, close: () => { select(null); $("map").focus(); } });
}

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
  setText("status", { lost: "no connection, trying again …", refused: "no access", quiet: "no news from the robot …" }[state] ?? parts.filter(Boolean).join(" · "));
  $("map-panel").classList.toggle("stale", state !== "live");
  $("stopped").hidden = !robot?.stopped;
}

function suggest() {
  const next = suggestions(scene.nodes, scene.edges);
  if (next.length <= ideas.length) return;
  ideas = next;
  $("suggestions").replaceChildren(...ideas.map((idea) => Object.assign(document.createElement("button"), {
    type: "button", textContent: idea, onclick: () => { $("request").value = idea; $("request").focus(); },
  })));
}

const edgeKey = (edge) => [edge.type, edge.source, edge.target, edge.label].join("|");
const handlers = {
  snapshot(data) {
    scene.nodes = new Map(data.scene.nodes.map((node) => [node.id, node]));
    scene.edges = new Map(data.scene.edges.map((edge) => [edgeKey(edge), edge]));
    status = data.status;
    tasks.clear();
    for (const task of data.tasks) { tasks.show(task, scene); journal.remember(task); }
    $("no-tasks").hidden = data.tasks.length > 0;
    handlers.robot(data.robot);
    suggest();
    showScene();
    showDetails();
  },
  scene(delta, stamp_s) {
    journal.discovered(delta.put_nodes, scene.nodes, stamp_s);
    for (const node of delta.put_nodes) scene.nodes.set(node.id, node);
    for (const id of delta.removed_nodes) scene.nodes.delete(id);
    for (const edge of delta.put_edges) scene.edges.set(edgeKey(edge), edge);
    for (const edge of delta.removed_edges) scene.edges.delete(edgeKey(edge));
    suggest();
    showScene();
    showDetails();
  },
  task(task, stamp_s) { tasks.show(task, scene); journal.follow(task, scene, stamp_s); $("no-tasks").hidden = true; },
  robot(robot) {
    const moved = robot.room !== scene.robot?.room;
    scene.robot = robot;
    map.drawRobot(robot);
    if (moved) showScene();
  },
  perception(news) { status = news; },
  log(entry, stamp_s) { journal.say(entry.message, stamp_s); },
  problem({ detail }) { showProblem(detail); },
};

const stream = new Stream(
  (event) => { handlers[event.type]?.(event.data ?? event, event.stamp_s); showStatus(); },
  (next) => {
    if (next === state) return;
    if (next === "live") showProblem(null);
    if (next === "refused") showProblem("The token is not valid. Open the address that the service printed when it started.");
    if (next === "quiet") askWhy();
    state = next;
    showStatus();
  },
);

async function askWhy() {
  const { simulator } = await call("GET", "/v1/status").catch(() => ({ simulator: "running" }));
  if (["running", "none"].includes(simulator)) return;
  const restart = Object.assign(document.createElement("button"), { type: "button", textContent: "Restart", onclick: () => attempt(() => call("POST", "/v1/simulation/restart")) });
  showProblem(simulator, restart);
}

async function attempt(action) { try { await action(); showProblem(null); } catch (error) { showProblem(error.message); } }

function stop() {
  stream.stop();
  call("POST", "/v1/stop").then(() => { if (scene.robot) scene.robot.stopped = true; showStatus(); }).catch((error) => showProblem(`STOP may not have reached the robot: ${error.message}`));
}

function ask() {
  const request = $("request").value.trim();
  if (!request) return $("request").focus();
  attempt(async () => {
    await call("POST", "/v1/tasks", { request, approval: $("approval").checked ? "ask" : "auto" });
    $("request").value = "";
  });
}

function selectNext() {
  const ids = [...scene.nodes.values()].filter((node) => ["room", "object", "person"].includes(node.type)).map((node) => node.id);
  select(ids[(ids.indexOf(scene.selected) + 1) % ids.length] ?? null);
}

$("request-form").addEventListener("submit", (event) => { event.preventDefault(); ask(); });
$("request").addEventListener("keydown", (event) => {
  if (event.key === "Enter" && !event.shiftKey && !event.isComposing) { event.preventDefault(); ask(); }
});
$("stop").addEventListener("click", stop);
$("release").addEventListener("click", () => attempt(() => call("POST", "/v1/resume")));
addEventListener("keydown", ({ key }) => { if (key === "Escape") stop(); });
$("map").addEventListener("keydown", ({ key }) => { if (key === "n") selectNext(); });
$("zoom-in").onclick = () => map.zoom(0.8);
$("zoom-out").onclick = () => map.zoom(1.25);
$("zoom-fit").onclick = () => map.fit();

async function refreshCamera() {
  if (state === "live" && status.camera && !document.hidden) {
    const picture = await call("GET", "/v1/camera.jpg").catch(() => null);
    if (picture) {
      URL.revokeObjectURL($("camera").src);
      $("camera").src = URL.createObjectURL(picture);
    }
    $("camera-panel").hidden = !picture;
  }
  setTimeout(refreshCamera, CAMERA_MS);
}
refreshCamera();
