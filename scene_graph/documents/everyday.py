"""What a hand-written graph need not say of everyday things: that a table bears things, that a cup can be carried."""

from __future__ import annotations

BEARING = frozenset(
    {
        "table", "desk", "counter", "shelf", "bookshelf", "bench", "stand", "nightstand", "sideboard", "dresser",
        "bed", "couch", "sofa", "chair", "stool", "armchair", "windowsill", "workbench", "rack", "dining table",
        "coffee table", "cabinet", "cupboard", "drawer", "refrigerator", "fridge", "microwave", "oven",
        "sink", "basket", "bin", "trash can", "box", "trolley", "cart",
    }
)  # fmt: skip
CARRIED = frozenset(
    {
        "cup", "mug", "glass", "bottle", "can", "bowl", "plate", "fork", "knife", "spoon", "apple", "banana", "orange",
        "pear", "lemon", "book", "remote", "remote control", "phone", "cell phone", "mouse", "pen", "pencil",
        "scissors", "toothbrush", "key", "keys", "toy", "ball", "teddy bear", "towel", "jar",
        "pill bottle", "snack", "newspaper",
    }
)  # fmt: skip


def bears(label: str) -> bool:
    """Whether things are put on or in something of this label."""
    return label.replace("_", " ") in BEARING


def is_carried(label: str) -> bool:
    """Whether a hand takes up something of this label."""
    return label.replace("_", " ") in CARRIED
