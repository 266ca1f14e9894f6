// Calls to the service and the event stream; the only module that knows addresses and the token.

const KEY = "majordomo-token";
const QUIET_MS = 4000, SHORT_MS = 500, LONG_MS = 4000, ANSWER_MS = 8000;
const REFUSED = 4401;
const token = new URLSearchParams(location.search).get("token") ?? sessionStorage.getItem(KEY) ?? "";
sessionStorage.setItem(KEY, token);
if (location.search) history.replaceState(null, "", location.pathname);

export async function call(method, path, body, headers = {}) {
  let response;
  try {
    response = await fetch(path, {
      method,
      headers: { ...headers, Authorization: `Bearer ${token}`, ...(body ? { "Content-Type": "application/json" } : {}) },
      body: body ? JSON.stringify(body) : undefined,
      signal: AbortSignal.timeout(ANSWER_MS),
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
  #socket; #pause = SHORT_MS; #onEvent; #onState; #last = 0; #waiting = null;

  constructor(onEvent, onState) {
    this.#onEvent = onEvent;
    this.#onState = onState;
    this.#open();
    setInterval(() => this.#watch(), 500);
    addEventListener("online", () => this.#hurry());
    document.addEventListener("visibilitychange", () => { if (!document.hidden) this.#hurry(); });
  }

  stop() { if (this.#socket.readyState === WebSocket.OPEN) this.#socket.send('{"type":"stop"}'); }

  // Gives a connection up that may be dead, and makes a new one.
  renew() {
    this.#socket.onmessage = this.#socket.onclose = null;
    this.#socket.close();
    this.#lose();
  }

  #open() {
    const socket = new WebSocket(`${location.origin.replace("http", "ws")}/v1/stream?${new URLSearchParams({ token })}`);
    this.#waiting = null;
    this.#socket = socket;
    socket.onmessage = ({ data }) => {
      this.#pause = SHORT_MS;
      this.#last = Date.now();
      this.#onState("live");
      this.#onEvent(JSON.parse(data));
    };
    socket.onclose = ({ code }) => (code === REFUSED ? this.#onState("refused") : this.#lose());
  }

  #lose() {
    this.#last = 0;
    this.#onState("lost");
    this.#waiting = setTimeout(() => this.#open(), this.#pause);
    this.#pause = Math.min(this.#pause * 2, LONG_MS);
  }

  #hurry() {
    if (this.#waiting === null) return;
    clearTimeout(this.#waiting);
    this.#open();
  }

  #watch() { if (this.#last && Date.now() - this.#last > QUIET_MS) this.#onState("quiet"); }
}
