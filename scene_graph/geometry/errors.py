"""What can go wrong with transforms."""

from __future__ import annotations


class InvalidTransform(ValueError):
    """Numbers that are no rigid transform."""
