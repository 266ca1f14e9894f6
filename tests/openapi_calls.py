"""Generated calls to a running service, checked against its OpenAPI document by schemathesis."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from service_process import ServiceProcess

CHECKS = (
    "not_a_server_error",
    "status_code_conformance",
    "content_type_conformance",
    "response_headers_conformance",
    "response_schema_conformance",
    "negative_data_rejection",
    "missing_required_header",
    "unsupported_method",
    "ignored_auth",
    "use_after_free",
    "ensure_resource_availability",
)
CONFIGURATION = """
[checks.negative_data_rejection]
# What schemathesis takes for a rejection, and 413: a text that is over its length may be over that of a body as well.
expected-statuses = [400, 401, 403, 404, 405, 406, 409, 413, 415, 422, 428, 429]
"""


def call(service: ServiceProcess, folder: Path, *options: str, timeout_s: float) -> subprocess.CompletedProcess:
    """Make up calls and sequences of calls, and check every answer. ``folder``: empty, for the configuration."""
    address, _, token = service.page.partition("/?token=")
    (folder / "schemathesis.toml").write_text(CONFIGURATION, encoding="utf-8")
    return subprocess.run(
        [
            *(sys.executable, "-m", "schemathesis.cli", "run", f"{address}/openapi.json"),
            *("--header", f"Authorization: Bearer {token}"),
            *("--checks", ",".join(CHECKS)),
            *("--phases", "examples,coverage,fuzzing,stateful"),
            *("--continue-on-failure", "--no-color", *options),
        ],
        capture_output=True,
        text=True,
        timeout=timeout_s,
        cwd=folder,
        check=False,
    )
