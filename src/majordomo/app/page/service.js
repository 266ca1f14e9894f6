// Calls to the service and the event stream; the only module that knows addresses and the token.

const KEY = "majordomo-token";
const QUIET_MS = 5000;
const token = new URLSearchParams(location.search).get("token") ?? sessionStorage.getItem(KEY) ?? "";
sessionStorage.setItem(KEY, token);
if (location.search) history.replaceState(null, "", location.pathname);

export async function call(method, path, body) {
  let response;
  try {
    response = await fetch(path, {
      method,
      headers: { Authorization: `Bearer ${token}`, ...(body ? { "Content-Type": "application/json" } : {}) },
      body: body ? JSON.stringify(body) : undefined,
    });
  } catch {
    throw new Error("the service does not answer");
  }
  const isJson = (response.headers.get("content-type") ?? "").includes("json");
  const content = isJson ? await response.json() : await response.blob();
  if (!response.ok) throw new Error(content.detail ?? response.statusText);
  return content;
}

// Keeps a stream open for ever. Every connection begins with a snapshot, so nothing old outlives a restart of the service.
// `onState` hears "live", "quiet" (connected, but no event for a while), "lost" or "refused".
export class Stream {
  #socket; #pause = 500; #onEvent; #onState; #last = 0;

  constructor(onEvent, onState) {
    this.#onEvent = onEvent;
    this.#onState = onState;
    this.#open();
    setInterval(() => this.#watch(), 1000);
  }

  stop() { if (this.#socket.readyState === WebSocket.OPEN) this.#socket.send('{"type":"stop"}'); }

  #open() {
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/v1/stream?${new URLSearchParams({ token })}`);
    this.#socket = socket;
    socket.onmessage = ({ data }) => {
      this.#pause = 500;
      this.#last = Date.now();
      this.#onState("live");
      this.#onEvent(JSON.parse(data));
    };
    socket.onclose = ({ code }) => {
      this.#last = 0;
      this.#onState(code === 4401 ? "refused" : "lost");
      if (code === 4401) return;
      setTimeout(() => this.#open(), this.#pause);
      this.#pause = Math.min(this.#pause * 2, 5000);
    };
  }

  #watch() { if (this.#last && Date.now() - this.#last > QUIET_MS) this.#onState("quiet"); }
}
