"""A server that says what a script tells it, byte by byte if need be, and the three ways in which providers talk."""

from __future__ import annotations

import asyncio
import contextlib
import json
from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class Line:
    """One answer: ``cut`` closes the connection amid it, ``pause_s`` passes before each of its bytes."""

    body: object = ""
    status: int = 200
    headers: dict = field(default_factory=dict)
    cut: bool = False
    pause_s: float = 0.0

    @property
    def content(self):
        return self.body.encode() if isinstance(self.body, str) else json.dumps(self.body).encode()


class ModelServer:
    """Answers with the lines in turn, the last one for ever; a function of the request's body may be a line."""

    def __init__(self, *lines):
        self.lines, self.paths, self.headers, self.requests, self.url = list(lines), [], [], [], ""
        self._visits = set()

    @contextlib.asynccontextmanager
    async def running(self):
        server = await asyncio.start_server(self._answer, "127.0.0.1", 0)
        self.url = f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}"
        try:
            yield self
        finally:
            server.close()
            for visit in self._visits:
                visit.cancel()
            await asyncio.gather(*self._visits, return_exceptions=True)

    async def _answer(self, reader, writer):
        self._visits.add(asyncio.current_task())
        try:
            head = (await reader.readuntil(b"\r\n\r\n")).decode().split("\r\n")
            headers = {name.lower(): value.strip() for name, _, value in (line.partition(":") for line in head[1:])}
            self.paths.append(head[0].split()[1])
            self.headers.append(headers)
            self.requests.append(json.loads(await reader.readexactly(int(headers["content-length"]))))
            line = self.lines.pop(0) if len(self.lines) > 1 else self.lines[0]
            await self._say(line(self.requests[-1]) if callable(line) else line, writer)
        except (ConnectionError, asyncio.IncompleteReadError):
            pass
        finally:
            writer.close()
            with contextlib.suppress(ConnectionError):
                await writer.wait_closed()

    async def _say(self, line, writer):
        headers = {"Content-Type": "application/json", "Connection": "close", **line.headers}
        headers["Content-Length"] = str(len(line.content))
        head = f"HTTP/1.1 {line.status} Said\r\n" + "".join(f"{name}: {value}\r\n" for name, value in headers.items())
        writer.write(head.encode() + b"\r\n")
        if line.cut:
            writer.write(line.content[: len(line.content) // 2])
        elif line.pause_s:
            for byte in line.content:
                await asyncio.sleep(line.pause_s)
                writer.write(bytes([byte]))
                await writer.drain()
        else:
            writer.write(line.content)
        await writer.drain()


class OpenAI:
    """Chat completions."""

    provider, path = "openai", "/v1/chat/completions"
    refusal_is_told = True

    @staticmethod
    def text(content, *, stop="stop"):
        choice = {"message": {"role": "assistant", "content": content}, "finish_reason": stop}
        return {"choices": [choice], "usage": {"prompt_tokens": 10, "completion_tokens": 5}}

    def cut_off(self, content):
        return self.text(content, stop="length")

    def refusal(self):
        answer = self.text(None)
        answer["choices"][0]["message"]["refusal"] = "I cannot help with that."
        return answer

    @staticmethod
    def rung(request):
        return {"json_schema": "schema", "json_object": "middle", None: "asking"}[
            request.get("response_format", {}).get("type")
        ]

    @staticmethod
    def schema(request):
        return request["response_format"]["json_schema"]["schema"]

    unknown_format = ({"error": {"message": "response_format is not supported"}}, 400)
    too_long = (
        {
            "error": {
                "message": "maximum context length is 9 tokens, shorten messages or schema",
                "code": "context_length_exceeded",
            }
        },
        400,
    )
    wrong_types = (
        {"choices": "none"},
        {"choices": []},
        {"choices": [{"message": {"content": [1, 2]}}]},
        {"choices": [{"message": "hi"}]},
    )


class Ollama:
    """Ollama's chats."""

    provider, path = "ollama", "/api/chat"
    refusal_is_told = False

    @staticmethod
    def text(content, *, stop="stop"):
        message = {"role": "assistant", "content": content}
        return {"message": message, "done": True, "done_reason": stop, "prompt_eval_count": 10, "eval_count": 5}

    def cut_off(self, content):
        return self.text(content, stop="length")

    def refusal(self):
        return self.text("I cannot help with that.")

    @staticmethod
    def rung(request):
        asked = request.get("format")
        return "schema" if isinstance(asked, dict) else {"json": "middle", None: "asking"}[asked]

    @staticmethod
    def schema(request):
        return request["format"]

    unknown_format = ({"error": "invalid format"}, 400)
    too_long = ({"error": "the input length, format included, exceeds the context length"}, 400)
    wrong_types = ({"message": "hi"}, {"message": {"content": None}}, {"message": {"content": {}}}, {"message": [1]})


class Anthropic:
    """Anthropic's messages."""

    provider, path = "anthropic", "/v1/messages"
    refusal_is_told = True

    @staticmethod
    def text(content, *, stop="end_turn"):
        blocks = [] if content is None else [{"type": "text", "text": content}]
        usage = {"input_tokens": 10, "output_tokens": 5}
        return {"type": "message", "role": "assistant", "content": blocks, "stop_reason": stop, "usage": usage}

    def cut_off(self, content):
        return self.text(content, stop="max_tokens")

    def refusal(self):
        return self.text(None, stop="refusal")

    @staticmethod
    def rung(request):
        if "output_config" in request:
            return "schema"
        return "middle" if "tools" in request else "asking"

    @staticmethod
    def schema(request):
        return request["output_config"]["format"]["schema"]

    unknown_format = (
        {"type": "error", "error": {"type": "invalid_request_error", "message": "output_config: not permitted"}},
        400,
    )
    too_long = (
        {"type": "error", "error": {"message": "prompt is too long: 300000 tokens > 200000 maximum, tools included"}},
        400,
    )
    wrong_types = (
        {"content": "hi"},
        {"content": [{"type": "text", "text": 7}]},
        {"content": [{"type": "tool_use", "input": "{}"}]},
        {"type": "message"},
    )


DIALECTS = (OpenAI(), Ollama(), Anthropic())
