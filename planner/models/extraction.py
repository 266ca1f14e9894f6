"""Gets the one JSON object out of what a model wrote: plain, fenced, after its reasoning, or amid prose."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any

_REASONING = re.compile(r"<(think|thinking|reasoning)>.*?(</\1>|\Z)", re.DOTALL | re.IGNORECASE)
_REASONING_END = re.compile(r"</(think|thinking|reasoning)>", re.IGNORECASE)
_DECODER = json.JSONDecoder(parse_constant=lambda name: name)
_MAX_TRIES = 200
"""Opening braces that are tried: a bound on the time that a hostile text takes."""


def json_object(text: str) -> Mapping[str, Any] | None:
    """The largest JSON object in ``text`` outside reasoning tags, None when there is none that is whole.

    Some servers leave out the tag that opens the reasoning: what follows the last one that closes it is searched first.
    """
    text = _REASONING.sub(" ", text)
    *_, last = re.split(_REASONING_END, text)
    found = _largest_object(last)
    return found if found is not None else _largest_object(text)


def _largest_object(text: str) -> Mapping[str, Any] | None:
    best: tuple[int, Mapping[str, Any]] | None = None
    position, tries = text.find("{"), 0
    while position != -1 and tries < _MAX_TRIES:
        tries += 1
        found, end = _object_at(text, position)
        if found is not None and (best is None or end - position > best[0]):
            best = (end - position, found)
        position = text.find("{", end if found is not None else position + 1)
    return best[1] if best is not None else None


def _object_at(text: str, position: int) -> tuple[Mapping[str, Any] | None, int]:
    try:
        value, end = _DECODER.raw_decode(text, position)
    except (ValueError, RecursionError):
        return None, position
    return (value, end) if isinstance(value, dict) else (None, position)
