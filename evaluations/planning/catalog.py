"""What kinds of things stand in the buildings: how large they are, and what can be done with them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

Size = tuple[float, float, float]


class Nature(Enum):
    """What can be done with a thing: carry it, put things on it, put things in it, or nothing."""

    CARRIED = auto()
    SUPPORT = auto()
    FIXED = auto()


@dataclass(frozen=True, kw_only=True)
class Sort:
    """One kind of thing. ``categories`` are those that the graph knows of it."""

    size_m: Size
    nature: Nature = Nature.CARRIED
    categories: tuple[str, ...] = ()


SMALL: Size = (0.07, 0.07, 0.1)
FLAT: Size = (0.1, 0.15, 0.03)
LONG: Size = (0.03, 0.16, 0.03)
WIDE: Size = (0.3, 0.3, 0.25)
"""Too wide for the fingers."""
TABLE: Size = (1.2, 0.8, 0.75)
CASE: Size = (1.0, 0.35, 1.0)
BIN: Size = (0.4, 0.4, 0.4)
SIZES = {"small": SMALL, "flat": FLAT, "long": LONG, "wide": WIDE, "table": TABLE, "case": CASE, "bin": BIN}
"""Sizes by name, for floor plans."""

_CARRIED: dict[tuple[str, Size], str] = {
    ("", SMALL): "candle soap vase sponge badge ball glue",
    ("", LONG): "key hairbrush comb ruler toothbrush remote flashlight umbrella whistle bandage charger towel sock",
    ("", FLAT): "phone glasses envelope photo",
    ("dish", SMALL): "cup wine_glass",
    ("dish", LONG): "fork knife spoon",
    ("drink", (0.07, 0.07, 0.24)): "bottle milk juice",
    ("drink", SMALL): "can",
    ("food snack", SMALL): "yogurt cookie chips muffin sandwich",
    ("fruit food snack", SMALL): "apple banana orange pear",
    ("food", SMALL): "jar",
    ("reading", (0.06, 0.2, 0.2)): "book magazine newspaper",
    ("office", LONG): "pen pencil marker stapler scissors",
    ("office", FLAT): "folder notebook clipboard",
    ("tool", LONG): "hammer screwdriver wrench pliers tape",
    ("toy", SMALL): "teddy_bear toy_car doll puzzle",
    ("medical", SMALL): "medicine thermometer syringe stethoscope",
    ("", WIDE): "kettle pillow backpack pan plate helmet drill",
}
_SUPPORT: dict[Size, str] = {
    TABLE: "table desk workbench bed couch",
    (2.0, 0.6, 0.9): "counter stove",
    (0.5, 0.5, 0.55): "nightstand coffee_table side_table stool trolley",
    (1.2, 0.4, 0.45): "bench",
    CASE: "shelf dresser refrigerator cabinet windowsill",
    BIN: "box basket trash_can sink drawer",
    (0.18, 0.18, 0.08): "bowl tray",
}
_FIXED: dict[Size, str] = {
    (0.5, 0.5, 0.9): "chair potted_plant armchair printer washing_machine bathtub toilet",
    (0.5, 0.4, 0.4): "tv monitor microwave laptop lamp aquarium",
    (1.6, 0.6, 1.1): "bicycle piano wheelchair treadmill statue",
}
SORTS: dict[str, Sort] = {
    **{n: Sort(size_m=s, categories=tuple(c.split())) for (c, s), ns in _CARRIED.items() for n in ns.split()},
    **{n: Sort(size_m=size, nature=Nature.SUPPORT) for size, names in _SUPPORT.items() for n in names.split()},
    **{n: Sort(size_m=size, nature=Nature.FIXED) for size, names in _FIXED.items() for n in names.split()},
}
