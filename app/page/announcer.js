// Says things to people who listen instead of looking: few, whole sentences, one after the other.

const GATHER_MS = 400;

export class Announcer {
  #region; #waiting = [];

  constructor(region) { this.#region = region; }

  // What comes at almost the same time is said together; what is said already is not said twice.
  say(text) {
    if (!text || this.#waiting.includes(text)) return;
    this.#waiting.push(text);
    if (this.#waiting.length === 1) setTimeout(() => { this.#region.textContent = this.#waiting.splice(0).join(". "); }, GATHER_MS);
  }
}
