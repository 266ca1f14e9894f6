"""A server that talks like OpenAI's and knows one answer: for trying how a language model is attached.

It takes whatever is asked for a wish to have cup_1 on desk_1, as a language model would have to find out. The first
line that it prints is its address.
"""

from __future__ import annotations

import argparse
import json
from http.server import BaseHTTPRequestHandler, HTTPServer
from typing import Any

MODEL = "scripted"
PLAN = {"kind": "plan", "goals": [{"predicate": "on", "args": ["cup_1", "desk_1"]}], "question": "", "reply": ""}


class Handler(BaseHTTPRequestHandler):
    """Lists its one model, and completes any chat with ``PLAN``."""

    def do_GET(self) -> None:
        """``/v1/models``."""
        self._say({"object": "list", "data": [{"id": MODEL, "object": "model"}]})

    def do_POST(self) -> None:
        """``/v1/chat/completions``."""
        self.rfile.read(int(self.headers["Content-Length"]))
        message = {"role": "assistant", "content": json.dumps(PLAN)}
        self._say({"model": MODEL, "choices": [{"index": 0, "message": message, "finish_reason": "stop"}]})

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 - the name that the library gives it
        """Keep quiet."""

    def _say(self, document: dict[str, Any]) -> None:
        body = json.dumps(document).encode()
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)


def main() -> None:
    """Answer until interrupted."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--port", type=int, default=8000)
    with HTTPServer(("127.0.0.1", parser.parse_args().port), Handler) as server:
        print(f"http://127.0.0.1:{server.server_port}/v1", flush=True)
        server.serve_forever()


if __name__ == "__main__":
    main()
