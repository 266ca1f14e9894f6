"""Guides as programs: what stands in their fenced blocks is done as a reader would do it, in an empty home.

A comment before a block says what is special about it:

``<!-- not run: WHY -->``   nobody types it in a test; commands of ours among it are still parsed
``<!-- file: NAME -->``     the block is a file of that name
``<!-- printed -->``        the block before printed these lines, in this order; ``…`` stands for anything
"""

from __future__ import annotations

import contextlib
import os
import re
import shlex
import shutil
import signal
import socket
import stat
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import httpx
from markdown_it import MarkdownIt

from paths import HELPERS, ROOT

DATA_LANGUAGES = frozenset({"json", "toml", "text"})
RUN_LANGUAGES = frozenset({"sh", "python"})
PORTS = ("8642", "9090", "8000")
"""Ports that guides name; each reading of a guide gets free ones in their place."""
CTRL_C = "# Ctrl-C"
START_LIMIT_S, COMMAND_LIMIT_S, GLANCE_S = 120.0, 180.0, 8.0
_MARKER = re.compile(r"<!--\s*(not run|file|printed)(?::\s*(.*?))?\s*-->")
_STAYS = re.compile(r"^majordomo serve\b|^python examples/\S+")


@dataclass(frozen=True, kw_only=True)
class Block:
    """One fenced block: where it stands, its language, its text, and what the comment before it says."""

    line: int
    language: str
    text: str
    marker: str = ""
    about: str = ""

    @property
    def is_run(self) -> bool:
        return self.language in RUN_LANGUAGES and not self.marker

    @property
    def commands(self) -> list[str]:
        """The lines of a shell block, continued ones joined, comments left out but ``# Ctrl-C``, which ends things."""
        lines = [line.strip() for line in self.text.replace("\\\n", " ").splitlines()]
        return [line for line in lines if line == CTRL_C or (line and not line.startswith("#"))]


def blocks(guide: Path) -> list[Block]:
    """All fenced blocks, in order.

    Raises:
        ValueError: a block says neither what language it is in nor why it is not run.
    """
    found, marker, about = [], "", ""
    for token in MarkdownIt("commonmark").parse(guide.read_text(encoding="utf-8")):
        if token.type == "html_block" and (match := _MARKER.search(token.content)):
            marker, about = match[1], match[2] or ""
        elif token.type == "fence":
            line = token.map[0] + 1
            if token.info not in DATA_LANGUAGES | RUN_LANGUAGES:
                raise ValueError(f"{guide.name}:{line}: the block says no language that is known: {token.info!r}")
            if marker in {"not run", "file"} and not about:
                raise ValueError(f"{guide.name}:{line}: '{marker}' says nothing more")
            found.append(Block(line=line, language=token.info, text=token.content, marker=marker, about=about))
            marker = about = ""
    return found


def own_commands(block: Block) -> list[tuple[str, list[str]]]:
    """Program and arguments of each ``majordomo …`` and ``python -m training …`` in a shell block."""
    if block.language != "sh":
        return []
    found = []
    for command in block.commands:
        words = shlex.split(re.split(r" (?:>|\|\|?|&&) ", command)[0], comments=True)
        if words[:1] == ["majordomo"]:
            found.append(("majordomo", words[1:]))
        elif words[:3] == ["python", "-m", "training"]:
            found.append(("training", words[3:]))
    return found


def _look_at_the_map(address: str, token: str) -> None:
    """Nobody types on before the robot knows what to call the room that it is in, if it ever does."""
    deadline = time.monotonic() + GLANCE_S
    while time.monotonic() < deadline:
        with contextlib.suppress(httpx.HTTPError, ValueError):
            scene = httpx.get(f"{address}/v1/scene?frame=map", headers={"Authorization": f"Bearer {token}"}).json()
            if any(node["type"] == "room" and node["label"] for node in scene.get("nodes", ())):
                return
        time.sleep(0.1)


@dataclass(kw_only=True)
class Reader:
    """Somebody who reads a guide and does what it says, in ``folder``."""

    folder: Path
    environment: dict[str, str] = field(default_factory=dict)
    printed: str = ""
    _ports: dict[str, str] = field(default_factory=dict)
    _running: dict[str, subprocess.Popen] = field(default_factory=dict)

    def __enter__(self):
        programs = self.folder / "programs"
        programs.mkdir()
        self._ports = dict(zip(PORTS, free_ports(len(PORTS)), strict=True))
        serve = f'if [ "$1" = serve ]; then shift; set -- serve --port {self._ports["8642"]} "$@"; fi\n'
        _program(programs / "majordomo", f'{serve}exec {shlex.quote(sys.executable)} -m app "$@"\n')
        _program(programs / "python", f'exec {shlex.quote(sys.executable)} "$@"\n')
        packages = self.folder / "packages"
        installing = "-m pip install --quiet --no-deps --no-build-isolation --disable-pip-version-check --target"
        refused = 'if [ "$1" != install ]; then exit 1; fi; shift\n'
        install = f'{refused}exec {shlex.quote(sys.executable)} {installing} {shlex.quote(str(packages))} "$@"\n'
        _program(programs / "pip", install)
        if shutil.which("curl") is None:
            _program(programs / "curl", f'exec {shlex.quote(sys.executable)} {HELPERS / "curl.py"} "$@"\n')
        lay_out(self.folder)
        python_path = os.pathsep.join(map(str, (packages, ROOT, os.environ.get("PYTHONPATH", ""))))
        self.environment = os.environ | self.environment | {
            "HOME": str(self.folder), "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": python_path,
            "COLUMNS": "160", "NO_COLOR": "1",
        }  # fmt: skip
        return self

    def __exit__(self, *_):
        self._end_all(signal.SIGKILL)

    def follow(self, block: Block) -> None:
        """Do what a block says."""
        text = self._with_free_ports(block.text)
        if block.marker == "file":
            path = self.folder / block.about
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        elif block.marker == "printed":
            assert_printed(block.text, self.printed)
        elif block.is_run and block.language == "python":
            self.printed = self._run(["python", "-c", text])
        elif block.is_run:
            self.printed = "".join(self._type(self._with_free_ports(command)) for command in block.commands)

    def _type(self, command: str) -> str:
        if command == CTRL_C:
            self._end_all(signal.SIGINT)
            return ""
        if _STAYS.match(command):
            return self._start(command)
        state = self.folder / "exported"
        state.touch()
        return self._run(["bash", "-euo", "pipefail", "-c", f'. "{state}"\n{command}\nexport -p > "{state}"'])

    def _run(self, command: list[str]) -> str:
        outcome = subprocess.run(
            command,
            cwd=self.folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=COMMAND_LIMIT_S,
            check=False,
        )
        assert outcome.returncode == 0, f"{command[-1]}\nended with {outcome.returncode}:\n{outcome.stdout}"
        return outcome.stdout

    def _start(self, command: str) -> str:
        """What does not end by itself goes on until something of the same name is started, or the guide ends."""
        name = command.split()[1]
        self._end(name)
        state, log = self.folder / "exported", self.folder / f"{Path(name).name}.log"
        state.touch()
        with log.open("w") as errors:
            process = subprocess.Popen(
                ["bash", "-c", f'. "{state}"\nexec {command}'], cwd=self.folder, env=self.environment,
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=errors, text=True,
            )  # fmt: skip
        self._running[name] = process
        told = process.stdout.readline()
        assert told.strip(), f"{command}\nsaid nothing:\n{log.read_text()}"
        if name == "serve":
            self._wait_until_ready(told, log)
        return told

    def _wait_until_ready(self, told: str, log: Path) -> None:
        address, _, token = told.strip().partition("/?token=")
        deadline = time.monotonic() + START_LIMIT_S
        while True:
            with contextlib.suppress(httpx.HTTPError):
                if httpx.get(f"{address}/readyz", headers={"Authorization": f"Bearer {token}"}).status_code == 200:
                    break
            assert time.monotonic() < deadline, f"not ready: {log.read_text()}"
            time.sleep(0.1)
        _look_at_the_map(address, token)

    def _end_all(self, how: signal.Signals) -> None:
        for name in list(self._running):
            self._end(name, how)

    def _end(self, name: str, how: signal.Signals = signal.SIGKILL) -> None:
        process = self._running.pop(name, None)
        if process is None:
            return
        with process:
            process.send_signal(how)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()

    def _with_free_ports(self, text: str) -> str:
        for port, free in self._ports.items():
            text = text.replace(port, free)
        return text


def lay_out(folder: Path) -> None:
    """Put what guides take from a checkout into a folder."""
    for name in ("examples", "perception", "scripts", "tests"):
        (folder / name).symlink_to(ROOT / name)


def assert_printed(expected: str, printed: str) -> None:
    """Check that the lines were printed in this order, whatever stands between them."""
    words = " ".join(printed.split())
    at = 0
    for line in filter(None, map(str.strip, expected.splitlines())):
        pattern = ".*?".join(re.escape(" ".join(part.split())) for part in line.split("…"))
        match = re.compile(pattern).search(words, at)
        assert match, f"not printed: {line}\nprinted was:\n{printed}"
        at = match.end()


def free_ports(number: int) -> list[str]:
    """Ports of this machine that nothing listens on."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(number)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [str(one.getsockname()[1]) for one in sockets]


def _program(path: Path, script: str) -> None:
    path.write_text(f"#!/bin/sh\n{script}", encoding="utf-8")
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
