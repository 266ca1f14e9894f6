// Says whether what is shown is what is: while news fail to come the page is dimmed and tells how old it is.

import { call } from "./service.js";

const PROBE_S = 6;
const WORDS = {
  lost: "No connection to the service. Trying again …",
  quiet: "No news from the robot.",
  refused: "The token is not valid. Open the address that the service printed when it started.",
};

export class Connection {
  #banner; #words; #age; #changed; #news = null; #patient = true; #probed = 0; #state = "lost";

  // `changed(state)` hears of every change. `renew()` makes a new connection. `restart(reason)`: the robot is gone, and why.
  constructor(banner, { changed, renew, restart }) {
    this.#banner = banner;
    this.#words = banner.querySelector(".words");
    this.#age = banner.querySelector(".age");
    this.#changed = { changed, renew, restart };
    setInterval(() => this.#tick(), 1000);
  }

  get state() { return this.#state; }

  // An event came; the time of the newest one is what the age is counted from.
  heard() { this.#news = Date.now(); }

  // `state`: as the stream tells it.
  set(state) {
    if (state === this.#state) return;
    this.#state = state;
    this.#probed = 0;
    this.#show();
    this.#changed.changed(state);
  }

  // The first second of all, when nothing can have come yet, is no reason to complain.
  #show() {
    const live = this.#state === "live";
    document.body.classList.toggle("stale", !live);
    this.#banner.hidden = live || (this.#patient && this.#state === "lost" && this.#news === null);
    if (this.#banner.hidden) return;
    if (this.#words.textContent !== WORDS[this.#state]) this.#words.textContent = WORDS[this.#state];
    this.#age.textContent = this.#news === null ? "" : `What you see is ${ago(Date.now() - this.#news)} old.`;
  }

  #tick() {
    this.#patient = false;
    if (this.#state === "live") return;
    this.#show();
    if (this.#state === "quiet" && (this.#probed += 1) % PROBE_S === 1) this.#probe();
  }

  // Connected, and yet nothing comes: either the robot is gone, or the connection is and nobody said so.
  async #probe() {
    try {
      const { simulator } = await call("GET", "/v1/status");
      if (!["running", "none"].includes(simulator)) this.#changed.restart(simulator);
    } catch {
      if (this.#state === "quiet") this.#changed.renew();
    }
  }
}

function ago(ms) {
  const seconds = Math.round(ms / 1000);
  return seconds < 90 ? `${seconds} s` : seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${Math.round(seconds / 3600)} h`;
}
