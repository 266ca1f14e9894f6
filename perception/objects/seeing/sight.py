"""One frame, measured and placed, as the tracker takes it in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.objects.seeing.detection import Detection
from perception.objects.seeing.membership import Surroundings
from perception.objects.seeing.projection import View


@dataclass(frozen=True, kw_only=True, eq=False)
class Sight:
    """One frame as the tracker sees it.

    ``turning_radps``: how fast the robot turns. ``looked_before``: when each room and support
    was first inspected. ``hand``: (3,) where the fingers are, in the room frame of the view, if that is known;
    ``reaching``: whether the arm is stretched out, so that it hides and cuts what it reaches for; ``persons``: (P, 2)
    where people stand, in the same frame.
    """

    view: View
    detections: Sequence[Detection]
    surroundings: Surroundings
    turning_radps: float = 0.0
    looked_before: Mapping[str, float] = field(default_factory=dict)
    hand: NDArray[np.float64] | None = None
    reaching: bool = False
    persons: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 2)))
