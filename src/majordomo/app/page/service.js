// Calls to the service and the event stream; the only module that knows addresses and the token.

const token = new URLSearchParams(location.search).get("token") ?? sessionStorage.getItem("majordomo-token") ?? "";
sessionStorage.setItem("majordomo-token", token);
if (location.search) history.replaceState(null, "", location.pathname);

export async function call(method, path, body) {
  const response = await fetch(path, {
    method,
    headers: { Authorization: `Bearer ${token}`, ...(body ? { "Content-Type": "application/json" } : {}) },
    body: body ? JSON.stringify(body) : undefined,
  });
  const type = response.headers.get("content-type") ?? "";
  const document_ = type.includes("json") ? await response.json() : await response.blob();
  if (!response.ok) throw new Error(document_.detail ?? response.statusText);
  return document_;
}

// Keeps a stream open for ever: reconnects with growing pauses and resumes after the last event seen.
export class Stream {
  #seq = null; #pause = 500; #onEvent; #onState; #last = 0;

  constructor(onEvent, onState) {
    this.#onEvent = onEvent;
    this.#onState = onState;
    this.#open();
    setInterval(() => { if (this.#last && Date.now() - this.#last > 5000) this.#onState(false); }, 1000);
  }

  #open() {
    const query = new URLSearchParams({ token, ...(this.#seq === null ? {} : { since: this.#seq }) });
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/v1/stream?${query}`);
    socket.onopen = () => { this.#pause = 500; };
    socket.onmessage = ({ data }) => {
      const event = JSON.parse(data);
      this.#last = Date.now();
      if (event.seq !== undefined) this.#seq = event.seq;
      this.#onState(true);
      this.#onEvent(event);
    };
    socket.onclose = ({ code }) => {
      this.#onState(false, code === 4401 ? "the token is not valid: open the address that the service printed" : undefined);
      if (code === 4401) return;
      if (code === 4410) this.#seq = null;
      setTimeout(() => this.#open(), this.#pause);
      this.#pause = Math.min(this.#pause * 2, 8000);
    };
  }
}
