"""What rooms a building has, before it is known where they are: their uses, in homes and in offices."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Use:
    """What a room is for.

    ``area_m2``: usual range. ``width_m``: the least, between inner faces. ``privacy``: how little people
    like to walk through it on their way elsewhere, from 0 (a corridor) to 9 (a bathroom).
    """

    label: str
    area_m2: tuple[float, float]
    width_m: float
    privacy: int


_ALL = (
    Use(label="corridor", area_m2=(4.0, 60.0), width_m=1.2, privacy=0),
    Use(label="hall", area_m2=(9.0, 50.0), width_m=2.6, privacy=0),
    Use(label="living room", area_m2=(18.0, 34.0), width_m=3.2, privacy=1),
    Use(label="lounge", area_m2=(14.0, 28.0), width_m=3.0, privacy=1),
    Use(label="reception", area_m2=(12.0, 28.0), width_m=3.0, privacy=1),
    Use(label="dining room", area_m2=(11.0, 20.0), width_m=2.8, privacy=2),
    Use(label="kitchen", area_m2=(8.0, 16.0), width_m=2.3, privacy=3),
    Use(label="meeting room", area_m2=(13.0, 30.0), width_m=3.0, privacy=6),
    Use(label="office", area_m2=(9.0, 20.0), width_m=2.5, privacy=6),
    Use(label="bedroom", area_m2=(9.5, 19.0), width_m=2.6, privacy=6),
    Use(label="laundry room", area_m2=(4.0, 8.0), width_m=1.7, privacy=8),
    Use(label="storage", area_m2=(3.2, 8.0), width_m=1.6, privacy=8),
    Use(label="bathroom", area_m2=(3.6, 8.0), width_m=1.6, privacy=9),
)

USES: Mapping[str, Use] = MappingProxyType({use.label: use for use in _ALL})
"""Every use by its label."""

CORRIDOR, HALL = USES["corridor"], USES["hall"]
SERVICE = frozenset({"bathroom", "storage", "laundry room"})
"""Small rooms that are cut out of a larger one as a matter of course."""

_HOME = (
    "living room", "bathroom", "bedroom", "kitchen", "bedroom", "office", "dining room", "bathroom", "bedroom",
    "storage", "bedroom", "laundry room", "hall", "bathroom", "bedroom", "office",
)  # fmt: skip
_HOME_MORE = ("bedroom", "bedroom", "bathroom", "storage", "office", "lounge")
_OFFICE = (
    "office", "office", "kitchen", "bathroom", "meeting room", "office", "storage", "office", "reception", "office",
    "lounge", "office", "bathroom", "office", "meeting room", "office",
)  # fmt: skip
_OFFICE_MORE = ("office", "office", "office", "meeting room", "storage", "bathroom")
_SINGLE = ("living room", "office", "hall", "meeting room", "bedroom")


@dataclass(frozen=True, kw_only=True)
class Wish:
    """A room that is to be built: its use, and the area to be aimed at."""

    use: Use
    area_m2: float


def draw_program(generator: np.random.Generator, rooms: int, *, office: bool) -> list[Wish]:
    """A plausible mix of ``rooms`` rooms in random order; corridors and such are for the layout to add."""
    if rooms == 1:
        labels = [_SINGLE[generator.integers(len(_SINGLE))]]
    else:
        first, more = (_OFFICE, _OFFICE_MORE) if office else (_HOME, _HOME_MORE)
        labels = list(first[:rooms])
        labels += [more[generator.integers(len(more))] for _ in range(rooms - len(labels))]
        if rooms > 4 and generator.random() < 0.4:
            labels[-1] = more[generator.integers(len(more))]
    uses = [USES[labels[index]] for index in generator.permutation(rooms)]
    return [Wish(use=use, area_m2=float(generator.uniform(*use.area_m2))) for use in uses]
