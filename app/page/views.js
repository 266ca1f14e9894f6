// Map, graph, camera, agents and decisions: one is shown at a time, all show the same selected node.

import { AgentsView } from "./agents.js";
import { CameraView } from "./camera.js";
import { NodePanel } from "./details.js";
import { GraphView } from "./graph.js";
import { BuildingMap } from "./map.js";
import { Tabs } from "./tabs.js";
import { TraceView } from "./trace.js";
import { place, title } from "./words.js";

const $ = (id) => document.getElementById(id);
const NEXT = new Set(["room", "door", "object", "person"]);

export class Views {
  #scene; #status = {}; #live = false; #map; #graph; #camera; #agents; #trace; #panel; #tabs;

  // `scene`: { nodes, edges, robot, selected }, kept up to date by the owner; `call(method, path, body)` asks the service,
  // `attempt(action)` carries out what may fail, tells if it does, and gives whether it went well.
  constructor(scene, { call, attempt }) {
    this.#scene = scene;
    const fetch = (path) => call("GET", path), select = (id) => this.select(id);
    this.#map = new BuildingMap($("map"), select);
    this.#graph = new GraphView($("view-graph"), select);
    this.#camera = new CameraView(fetch, select);
    this.#agents = new AgentsView($("view-agents"));
    this.#trace = new TraceView($("view-trace"), fetch, scene, select);
    this.#panel = new NodePanel($("details"), {
      select, fetch, close: () => this.#close(),
      teach: (id, body) => attempt(() => call("PATCH", `/v1/scene/nodes/${encodeURIComponent(id)}`, body)),
    });
    this.#tabs = new Tabs($("view-tabs"), (name) => this.#shown(name));
    this.#camera.show($("camera-view"), $("camera-seen"));
    this.#camera.show($("camera-panel"));
    this.#listen();
  }

  // The scene has changed.
  show() {
    this.#map.draw(this.#scene);
    this.#graph.show(this.#scene);
    this.#camera.scene(this.#scene);
    this.#panel.show(this.#scene);
    $("map-empty").hidden = [...this.#scene.nodes.values()].some((node) => node.type === "room");
  }

  // The robot has moved, or done something.
  robot(robot) {
    this.#map.drawRobot(robot);
    if (this.#scene.selected === "robot") this.#panel.show(this.#scene);
  }

  // `live`: whether the service is heard at the moment.
  status(status, live) {
    [this.#status, this.#live] = [status, live];
    $("map-panel").classList.toggle("stale", !live);
    $("camera-panel").hidden = !status.camera;
    this.#camera.status({ live, available: Boolean(status.camera) });
    this.#agents.show(status, live);
  }

  // A task has changed.
  task({ id }) { this.#trace.follow(id); }

  // Selects a node in every view, or none.
  select(id) {
    const isNew = id !== this.#scene.selected, node = this.#scene.nodes.get(id);
    this.#scene.selected = id;
    this.show();
    if (!isNew) return;
    this.#map.reveal(id);
    this.#graph.select(id);
    $("selected").textContent = node ? `selected: ${title(node)} ${place(node, this.#scene.nodes, this.#scene.edges)}` : "";
  }

  // Shows what was decided about a task.
  showTrace(taskId) {
    this.#tabs.show("trace");
    $("map-panel").scrollIntoView({ block: "nearest" });
    this.#trace.show(taskId);
  }

  #shown(name) {
    $("map-panel").dataset.view = name;
    if (name === "graph") this.#graph.show(this.#scene);
    if (name === "agents") this.#agents.show(this.#status, this.#live);
  }

  #close() {
    this.select(null);
    ($("map").checkVisibility() ? $("map") : $("view-tabs").querySelector("[aria-selected=true]")).focus();
  }

  #selectNext(step) {
    const ids = [...this.#scene.nodes.values()].filter((node) => NEXT.has(node.type)).map((node) => node.id), at = ids.indexOf(this.#scene.selected);
    this.select(ids.at(at < 0 && step < 0 ? -1 : (at + step) % ids.length) ?? null);
  }

  #listen() {
    $("map").addEventListener("keydown", ({ key }) => { if (key === "n" || key === "p") this.#selectNext(key === "n" ? 1 : -1); });
    $("zoom-in").onclick = () => this.#map.zoom(0.8);
    $("zoom-out").onclick = () => this.#map.zoom(1.25);
    $("zoom-fit").onclick = () => this.#map.fit();
    $("camera-large").onclick = () => this.#tabs.show("camera");
    document.addEventListener("select-node", ({ detail }) => this.select(detail));
    document.addEventListener("show-trace", ({ detail }) => this.showTrace(detail));
  }
}
