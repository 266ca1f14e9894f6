"""Things that others are put *in* rather than *on*."""

from __future__ import annotations

CONTAINER_LABELS = frozenset(
    {
        "bowl",
        "box",
        "basket",
        "sink",
        "drawer",
        "cabinet",
        "bin",
        "trash can",
        "refrigerator",
        "microwave",
        "oven",
        "bag",
    }
)


CLOSED_LABELS = frozenset({"drawer", "cabinet", "refrigerator", "microwave", "oven"})
"""Containers with a top and a door. The hand opens no door: what is brought there is put on the top, side by side."""


def is_container(label: str) -> bool:
    """Whether things are put *in* rather than *on* something of this label."""
    return label.replace("_", " ") in CONTAINER_LABELS


def is_open_container(label: str) -> bool:
    """Whether things are dropped into it from above, one onto the other."""
    return is_container(label) and label.replace("_", " ") not in CLOSED_LABELS
