// Ties stream, map, requests, camera and log together.

import { BuildingMap } from "./map.js";
import { call, Stream } from "./service.js";
import { taskItem } from "./tasks.js";

const $ = (id) => document.getElementById(id);
const nodes = new Map();
const edges = new Map();
const tasks = new Map();
let robot = null, status = {}, live = false, selected = null, drawing = false;

const map = new BuildingMap($("map"), (id) => { selected = id; map.select(id); redraw(); });

function redraw() {
  if (drawing) return;
  drawing = true;
  requestAnimationFrame(() => { drawing = false; map.draw(nodes, robot); showDetails(); });
}

function say(problem) { $("banner").hidden = !problem; $("banner").textContent = problem ?? ""; }

function showStatus() {
  const room = nodes.get(robot?.room);
  const parts = [
    robot?.stopped ? "stopped" : status.task ? "working on a request" : status.exploring ? "exploring" : status.explored ? "ready" : "idle",
    room ? `in ${room.name || room.label || room.id.replace("_", " ")}` : "",
    robot?.holding ? `holding ${nodes.get(robot.holding)?.label ?? robot.holding}` : "",
    status.language_model ? `model ${status.language_model}` : "",
  ];
  $("status").textContent = live ? parts.filter(Boolean).join(" · ") : "not connected: what you see is old";
  $("map-panel").classList.toggle("stale", !live);
  $("stop").textContent = robot?.stopped ? "RELEASE STOP" : "STOP";
  $("stop").classList.toggle("latched", Boolean(robot?.stopped));
}

function showTasks() {
  const newest = [...tasks.values()].reverse().slice(0, 20);
  $("tasks").replaceChildren(...newest.map((task) => taskItem(task, act)));
}

function showDetails() {
  const node = nodes.get(selected);
  $("details").hidden = !node;
  if (!node) return;
  const list = document.createElement("dl");
  const rows = { id: node.id, what: node.label || node.type, room: node.room, color: node.attributes?.color, state: node.state,
    position: node.position_m?.map((v) => v.toFixed(2)).join(", "), size: node.size_m?.map((v) => v.toFixed(2)).join(" × "),
    rooms: node.rooms?.map((room) => room ?? "unknown").join(" – "), width: node.width_m?.toFixed(2),
    seen: node.last_seen_s === undefined ? undefined : `${Math.max(0, Math.round((robot?.stamp_s ?? 0) - node.last_seen_s))} s ago`,
    relations: [...edges.values()].filter((edge) => edge.type === "relation" && edge.source === node.id).map((edge) => `${edge.label} ${edge.target}`).join(", ") };
  for (const [key, value] of Object.entries(rows)) {
    if (value === undefined || value === null || value === "") continue;
    const [term, text] = [document.createElement("dt"), document.createElement("dd")];
    term.textContent = key; text.textContent = value;
    list.append(term, text);
  }
  $("details").replaceChildren(list);
}

function suggest() {
  const things = [...nodes.values()].filter((node) => node.type === "object" && node.graspable && node.state === "present");
  const supports = [...nodes.values()].filter((node) => node.type === "object" && node.support && !node.graspable);
  const words = (node) => ["the", node.attributes?.color, node.label].filter(Boolean).join(" ");
  const ideas = things.slice(0, 2).map((thing, index) => supports.length ? `bring ${words(thing)} to the ${supports[(index * 3 + 1) % supports.length].label}` : `where is ${words(thing)}?`);
  if (things.length) ideas.push(`where is ${words(things[0])}?`, "what do you see?");
  const key = ideas.join("|");
  if ($("suggestions").dataset.key === key) return;
  $("suggestions").dataset.key = key;
  $("suggestions").replaceChildren(...ideas.map((idea) => {
    const button = document.createElement("button");
    button.type = "button"; button.textContent = idea;
    button.onclick = () => { $("request").value = idea; $("request").focus(); };
    return button;
  }));
}

function log(entry, stamp_s) {
  const [item, time] = [document.createElement("li"), document.createElement("time")];
  time.textContent = `${stamp_s.toFixed(1)} s`;
  item.append(time, entry.message);
  $("log").prepend(item);
  while ($("log").children.length > 100) $("log").lastChild.remove();
}

const edgeKey = (edge) => [edge.type, edge.source, edge.target, edge.label].join("|");
const handlers = {
  snapshot({ scene, tasks: list, robot: pose, status: state }) {
    nodes.clear(); edges.clear(); tasks.clear();
    for (const node of scene.nodes) nodes.set(node.id, node);
    for (const edge of scene.edges) edges.set(edgeKey(edge), edge);
    for (const task of list) tasks.set(task.id, task);
    robot = pose; status = state;
    showTasks();
  },
  scene(delta) {
    for (const node of delta.put_nodes) nodes.set(node.id, node);
    for (const id of delta.removed_nodes) nodes.delete(id);
    for (const edge of delta.put_edges) edges.set(edgeKey(edge), edge);
    for (const edge of delta.removed_edges) edges.delete(edgeKey(edge));
    suggest();
  },
  task(task) { tasks.set(task.id, task); showTasks(); },
  robot(pose) { robot = pose; },
  perception(state) { status = { ...status, ...state }; },
  log,
};

new Stream(
  (event) => { handlers[event.type]?.(event.data, event.stamp_s); showStatus(); redraw(); },
  (connected, problem) => { if (connected !== live || problem) { live = connected; say(problem); showStatus(); } },
);

async function attempt(action) { try { await action(); say(null); } catch (error) { say(error.message); } }
const act = (id, name, body) => attempt(() => call("POST", `/v1/tasks/${id}/${name}`, body));
const toggleStop = () => attempt(() => call("POST", robot?.stopped ? "/v1/resume" : "/v1/stop"));

$("request-form").addEventListener("submit", (event) => {
  event.preventDefault();
  const request = $("request").value.trim();
  if (request) attempt(async () => { await call("POST", "/v1/tasks", { request }); $("request").value = ""; });
});
$("stop").addEventListener("click", toggleStop);
addEventListener("keydown", ({ key }) => { if (key === "Escape" && !robot?.stopped) attempt(() => call("POST", "/v1/stop")); });
$("zoom-in").onclick = () => map.zoom(0.8);
$("zoom-out").onclick = () => map.zoom(1.25);
$("zoom-fit").onclick = () => map.fit(nodes);

async function refreshCamera() {
  if (live && !document.hidden) {
    try {
      const picture = await call("GET", "/v1/camera.jpg");
      const old = $("camera").src;
      $("camera").src = URL.createObjectURL(picture);
      if (old.startsWith("blob:")) URL.revokeObjectURL(old);
      $("camera-panel").hidden = false;
    } catch { $("camera-panel").hidden = true; }
  }
  setTimeout(refreshCamera, 1000);
}
refreshCamera();
showStatus();
