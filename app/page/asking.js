// The request box: what was asked before comes back with the arrow keys, and the graph's names complete the words.

import { completions, ideas } from "./suggestions.js";

const KEY = "majordomo-requests", KEPT = 50;

function recalled() {
  try { return JSON.parse(sessionStorage.getItem(KEY)) ?? []; } catch { return []; }
}

const random = () => crypto.getRandomValues(new Uint32Array(4)).join("-");

export class RequestBox {
  #form; #input; #offers; #scene; #ask; #asked = recalled(); #at = null; #draft = ""; #ideas = []; #key = {};

  // `ask(request, mode, key)`: hands a request in, and gives whether it was taken. `mode`: "auto", "ask", or "dry". `key`: stays the
  // same until it was taken, so that nothing is done twice when an answer was lost on the way or somebody was impatient.
  constructor(form, offers, scene, ask) {
    [this.#form, this.#input, this.#offers, this.#scene, this.#ask] = [form, form.elements.request, offers, scene, ask];
    form.addEventListener("submit", (event) => { event.preventDefault(); this.#send(); });
    this.#input.addEventListener("input", () => { this.#at = null; this.offer(); });
    this.#input.addEventListener("keydown", (event) => this.#press(event));
    offers.addEventListener("click", ({ target }) => { if (target.matches("button")) this.#fill(target.textContent, true); });
  }

  // Offers what fits the words and the graph as it is now. Ideas stay as they are while they make sense and there are no more of them.
  offer() {
    const { nodes, edges } = this.#scene, typed = this.#input.value;
    const next = ideas(nodes, edges);
    if (next.length > this.#ideas.length || !this.#ideas.every(({ isGood }) => isGood(nodes))) this.#ideas = next;
    const texts = (typed.trim() ? completions(typed, nodes) : this.#ideas).map(({ text }) => text);
    const shown = [...this.#offers.children].map((button) => button.textContent);
    if (texts.join("\n") === shown.join("\n")) return;
    this.#offers.replaceChildren(...texts.map((text) => Object.assign(document.createElement("button"), { type: "button", textContent: text })));
  }

  async #send() {
    const request = this.#input.value.trim();
    if (!request) return this.#input.focus();
    const mode = this.#form.elements.mode.value, meant = `${mode} ${request}`;
    if (this.#key.meant !== meant) this.#key = { meant, value: random() };
    const key = this.#key;
    if (!(await this.#ask(request, mode, key.value)) || key.taken) return;
    key.taken = true;
    if (this.#key === key) this.#key = {};
    this.#asked = [...this.#asked.filter((text) => text !== request), request].slice(-KEPT);
    try { sessionStorage.setItem(KEY, JSON.stringify(this.#asked)); } catch { /* kept until the page is closed */ }
    if (this.#input.value.trim() !== request) return; // the next one is being typed already
    this.#at = null;
    this.#fill("");
  }

  #press(event) {
    if (event.isComposing || event.shiftKey || event.ctrlKey || event.altKey || event.metaKey) return;
    const step = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (event.key === "Enter") this.#send();
    else if (!step || !this.#walk(step)) return;
    event.preventDefault();
  }

  // To the request before or after the one that is shown; false when the key shall move the cursor instead.
  #walk(step) {
    const isFirst = this.#at === null;
    if (isFirst && (step > 0 || this.#input.selectionEnd > 0 || !this.#asked.length)) return false;
    if (isFirst) this.#draft = this.#input.value;
    const at = Math.max(0, (this.#at ?? this.#asked.length) + step);
    this.#at = at < this.#asked.length ? at : null;
    const wanted = this.#asked[at] ?? this.#draft;
    this.#fill(wanted);
    if (this.#at === null) this.#input.setSelectionRange(0, 0);
    return true;
  }

  #fill(text, focus = false) {
    this.#input.value = text;
    this.#input.setSelectionRange(text.length, text.length);
    if (focus) this.#input.focus();
    this.offer();
  }
}
