// How the service is: language model, network, sensors, and how each agent keeps its rate.

import { el, replaceIfNew } from "./dom.js";
import { clock } from "./words.js";

const COLUMNS = ["agent", "turns per second", "time a turn, median", "99th percentile", "restarts"];

export class AgentsView {
  #panel; #facts = el("dl", "facts"); #rows = el("tbody");

  constructor(panel) {
    this.#panel = panel;
    const head = el("thead", {}, el("tr", {}, COLUMNS.map((name, i) => el("th", { scope: "col", class: i ? "number" : "" }, name))));
    panel.append(this.#facts, el("div", { class: "wide", tabindex: "0", role: "region", "aria-label": "Agents" }, el("table", {}, el("caption", {}, "Agents"), head, this.#rows)));
  }

  // `live`: whether the service is heard at the moment.
  show(status, live) {
    if (this.#panel.hidden || !status.agents) return;
    const facts = factsOf(status, live);
    replaceIfNew(this.#facts, JSON.stringify(facts), () => facts.flatMap(([name, value, look]) => [el("dt", {}, name), el("dd", look ?? "", value)]));
    replaceIfNew(this.#rows, JSON.stringify(status.agents), () => Object.entries(status.agents).map(([name, agent]) => row(name, agent)));
  }
}

function factsOf(status, live) {
  return [
    ["connection", live ? "live" : "lost: what follows is old", live ? "good" : "bad"],
    ["language model", status.language_model ?? "none attached: the grammar answers alone"],
    ["network of the camera", status.network ?? "none"],
    ["camera", status.camera ? "on" : "off, or nothing shown yet"],
    ["perception", status.perception ?? "all well", status.perception ? "bad" : ""],
    ["robot", { none: "none: a stored graph", running: `running, ${status.robot.localized ? "knows where it is" : "does not know where it is"}` }[status.simulator] ?? status.simulator, ["none", "running"].includes(status.simulator) ? "" : "bad"],
    ["clock", `${status.clock}, ${clock(status.stamp_s)}`],
    ["graph", `revision ${status.revision}`],
  ];
}

function row(name, { rate_hz, busy_ms_p50, busy_ms_p99, restarts }) {
  const numbers = [rate_hz.toFixed(1), `${busy_ms_p50.toFixed(1)} ms`, `${busy_ms_p99.toFixed(1)} ms`];
  return el("tr", {}, el("th", { scope: "row" }, name.replaceAll("_", " ")), numbers.map((text) => el("td", "number", text)), el("td", restarts ? "number bad" : "number", String(restarts)));
}
