"""Identifiers that must not be given to anything new."""

from __future__ import annotations

from collections.abc import Container


class TakenNames(set[str]):
    """Every identifier ever seen, and those of ``elsewhere``: what long-term memory keeps without anyone seeing it."""

    elsewhere: Container[str] = ()
