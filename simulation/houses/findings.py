"""What validation finds wrong in a document, as a path that its writer knows and one sentence."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from pydantic import ValidationError


def field_path(location: Sequence[int | str], document: Any) -> str:
    """``("doors", 1, "center")`` as ``doors[1].center``, without tags of variants, which no document has written."""
    path, at = "", document
    for number, part in enumerate(location, start=1):
        written = part in at if isinstance(at, Mapping) else isinstance(at, list) and part in range(len(at))
        if written or number == len(location):
            path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
        if written:
            at = at[part]
    return path


def first_problem(error: ValidationError, document: Any) -> tuple[str, str]:
    """Path and problem of the first finding; how many more there are is told too."""
    findings = error.errors(include_url=False, include_context=False)
    more = f" (and {len(findings) - 1} more)" if len(findings) > 1 else ""
    message = findings[0]["msg"]
    return field_path(findings[0]["loc"], document), f"{message[:1].lower()}{message[1:]}{more}"
