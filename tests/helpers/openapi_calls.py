"""Generated calls to a running service, checked against its OpenAPI document by schemathesis."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from service_process import ServiceProcess


def call(service: ServiceProcess, folder: Path, *options: str, timeout_s: float) -> subprocess.CompletedProcess:
    """Make up calls and sequences of calls, and make every check of every answer. ``folder``: where it may write."""
    address, _, token = service.page.partition("/?token=")
    return subprocess.run(
        [
            *(sys.executable, "-m", "schemathesis.cli", "run", f"{address}/openapi.json"),
            *("--header", f"Authorization: Bearer {token}"),
            *("--checks", "all"),
            *("--phases", "examples,coverage,fuzzing,stateful"),
            *("--continue-on-failure", "--no-color", *options),
        ],
        capture_output=True,
        text=True,
        timeout=timeout_s,
        cwd=folder,
        check=False,
    )
