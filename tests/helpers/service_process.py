"""Starts ``majordomo serve`` as a user does, for tests from outside."""

from __future__ import annotations

import contextlib
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import httpx

START_TIMEOUT_S = 60.0


@dataclass(frozen=True, kw_only=True)
class ServiceProcess:
    """A running service: its process, and a client that holds the token."""

    process: subprocess.Popen
    client: httpx.Client
    page: str


def majordomo(*arguments, **options):
    """Run the command line to its end."""
    command = [sys.executable, "-m", "app", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=600, check=False, **options)


@contextlib.contextmanager
def serving(data: Path, *arguments):
    """A service on a free port that is ready to take requests."""
    command = [sys.executable, "-m", "app", "serve", "--port", "0", "--data", str(data), *arguments]
    with (
        (data / "stderr.log").open("w") as log,
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=log, text=True) as process,
    ):
        try:
            page = process.stdout.readline().strip()
            if not page:
                raise AssertionError(f"no address printed: {(data / 'stderr.log').read_text()}")
            address, _, token = page.partition("/?token=")
            headers = {"Authorization": f"Bearer {token}"}
            with httpx.Client(base_url=address, headers=headers, timeout=30.0) as client:
                wait_until(lambda: client.get("/readyz").status_code == 200, START_TIMEOUT_S)
                yield ServiceProcess(process=process, client=client, page=page)
        finally:
            process.terminate()
            try:
                process.wait(15)
            except subprocess.TimeoutExpired:
                process.kill()


def wait_until(condition, timeout_s, pause_s=0.1):
    """Poll a process from outside until ``condition`` holds."""
    deadline = time.monotonic() + timeout_s
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"did not happen within {timeout_s} s")
        time.sleep(pause_s)
