"""How figures are written in tables."""

from __future__ import annotations


def shown(value: float | None, digits: int = 3) -> str:
    """A figure, a dash where nothing could be measured."""
    return "–" if value is None else f"{value:.{digits}f}"
