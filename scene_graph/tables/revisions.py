"""Which revision last wrote each element: a small table of recent writes over a large one that is shared."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Generic, TypeVar

K = TypeVar("K")
_RECENT = 256
"""Size of a full small table; larger ones make commits slow, smaller ones fold too often; answers are the same."""


class Revisions(Generic[K]):
    """Revision of the last write by key; immutable.

    Copying a table of all elements at every commit would cost more than the commit itself, so writes gather in a
    small table that is folded into the large one when it is full.
    """

    __slots__ = ("_recent", "_settled")

    def __init__(self, settled: Mapping[K, int] | None = None, recent: Mapping[K, int] | None = None) -> None:
        self._settled = settled or {}
        self._recent = recent or {}

    def of(self, key: K) -> int:
        """Revision that last wrote the key. Only keys that still exist may be asked for."""
        revision = self._recent.get(key)
        return self._settled[key] if revision is None else revision

    def updated(self, written: Iterable[K], removed: Iterable[K], revision: int) -> Revisions[K]:
        """After writing some keys at ``revision`` and removing others."""
        recent = {**self._recent, **dict.fromkeys(written, revision)}
        removed = tuple(removed)
        if not removed and len(recent) <= _RECENT:
            return Revisions(self._settled, recent)
        settled = {**self._settled, **recent}
        for key in removed:
            settled.pop(key, None)
        return Revisions(settled)
