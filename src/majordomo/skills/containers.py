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


def is_container(label: str) -> bool:
    """Whether things are put *in* rather than *on* something of this label."""
    return label.replace("_", " ") in CONTAINER_LABELS
