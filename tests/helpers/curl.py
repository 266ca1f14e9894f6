"""As much of curl as the guides use, for machines that have none: ``python tests/helpers/curl.py OPTIONS URL``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import httpx

FAILED = 22
"""How curl ends when a server refuses and ``--fail`` is given."""


def main(arguments: list[str]) -> int:
    """Ask, and print or keep the answer; curl's exit code."""
    parser = argparse.ArgumentParser(prog="curl", allow_abbrev=False)
    for flag in ("--fail", "--silent"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("--header", action="append", default=[])
    parser.add_argument("--request")
    parser.add_argument("--data")
    parser.add_argument("--output", type=Path)
    parser.add_argument("url")
    asked = parser.parse_args(arguments)
    headers = dict(header.split(": ", 1) for header in asked.header)
    method = asked.request or ("GET" if asked.data is None else "POST")
    answer = httpx.request(method, asked.url, headers=headers, content=asked.data)
    if asked.fail and answer.is_error:
        return FAILED
    if asked.output is not None:
        asked.output.write_bytes(answer.content)
    else:
        sys.stdout.buffer.write(answer.content)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
