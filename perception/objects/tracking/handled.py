"""What the hand did last to a thing, and when."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray


class HandDid(StrEnum):
    """The hand closed where it was, took it, has put it down, or lost it."""

    TOUCHED = "touched"
    TAKEN = "taken"
    PUT = "put"
    DROPPED = "dropped"


@dataclass(frozen=True, kw_only=True, eq=False)
class Handled:
    """``room``, ``position``: where the thing was just before, (3,) in the frame of its room."""

    did: HandDid
    stamp_s: float
    room: str
    position: NDArray[np.float64]
