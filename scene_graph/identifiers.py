"""Identifiers: well-formed, in natural order, and the next free one of a label."""

from __future__ import annotations

import re
from collections.abc import Container
from functools import lru_cache
from typing import Protocol, runtime_checkable

_WELL_FORMED = re.compile(r"\w[\w.:\-]{0,127}")
_DIGITS = re.compile(r"([0-9]+)")
_NOT_WORD = re.compile(r"[^a-z0-9]+")

NaturalKey = tuple[str | int, ...]


def is_well_formed(identifier: str) -> bool:
    """Whether ``identifier`` is 1 to 128 letters, digits, ``_ . : -`` and starts with a letter, digit or ``_``."""
    return _WELL_FORMED.fullmatch(identifier) is not None


@lru_cache(maxsize=65536)
def natural_key(identifier: str) -> NaturalKey:
    """Sorting key under which ``bottle_2`` comes before ``bottle_10``. Texts and numbers alternate, text first."""
    return tuple(int(part) if i % 2 else part for i, part in enumerate(_DIGITS.split(identifier)))


def slug(label: str) -> str:
    """A label as the first part of an identifier: ``Potted plant`` becomes ``potted_plant``."""
    return _NOT_WORD.sub("_", label.lower()).strip("_") or "object"


def room_number(room_id: str) -> str:
    """What the identifiers of a room's walls, corners and doors begin with after their kind: ``2`` of ``room_2``."""
    return room_id.rsplit("_", 1)[-1]


def wall_id_of(room_id: str, wall: int) -> str:
    """Identifier of a room's wall: ``wall_2_0`` is the first of ``room_2``."""
    return f"wall_{room_number(room_id)}_{wall}"


def corner_id_of(room_id: str, wall: int) -> str:
    """Identifier of the corner where a room's wall begins."""
    return f"corner_{room_number(room_id)}_{wall}"


@runtime_checkable
class PartOfAll(Protocol):
    """A part of what is known, such as a snapshot of working memory; ``elsewhere`` holds the other identifiers."""

    @property
    def elsewhere(self) -> Container[str]: ...


def next_id(taken: Container[str], label: str) -> str:
    """The first of ``<label>_1``, ``<label>_2``, … that is not taken.

    ``taken`` may be a snapshot; identifiers that long-term memory keeps are taken too.
    """
    elsewhere: Container[str] = taken.elsewhere if isinstance(taken, PartOfAll) else ()
    stem = slug(label)
    number = 1
    while f"{stem}_{number}" in taken or f"{stem}_{number}" in elsewhere:
        number += 1
    return f"{stem}_{number}"
