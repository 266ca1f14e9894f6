"""Where the robot came into a room: the wall above that stretch cannot hide another part of the room."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.polygon import points_inside
from perception.ports import RobotShape
from perception.rooms.outline.portals import Portal

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class EntranceSettings:
    """Which stretch of a wall the robot came in through."""

    beside_m: float = 0.02
    """Beside the robot's body that is free as well. Chosen: it does not touch the posts."""
    through_the_wall_m: float = 0.7
    """Farthest from where the measuring began, in the doorway: a thick wall, and the way until the first view."""


def entrance(
    polygon: Array, path: Array, settings: EntranceSettings = EntranceSettings(), shape: RobotShape = RobotShape()
) -> Portal | None:
    """The stretch of a wall, as wide as the robot, through which it came in; ``None`` when it did not.

    The lintel above is seen badly: from right below not at all. ``polygon``: (N, 2) rectilinear, along the axes;
    ``path``: (M, 2) from where the measuring began, in the doorway. What the robot enters only later may be an arm
    of the room.
    """
    within = points_inside(polygon, path).tolist()
    if within[0] or not any(within):
        return None
    after = within.index(True)
    outside, entered = path[after - 1], path[after]
    half_m = shape.footprint_radius_m + settings.beside_m
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        axis = 0 if abs(start[0] - end[0]) < abs(start[1] - end[1]) else 1
        across_m = entered[axis] - outside[axis]
        share = (start[axis] - outside[axis]) / across_m if across_m != 0.0 else -1.0
        crossing = outside + share * (entered - outside)
        low_m, high_m = sorted((float(start[1 - axis]), float(end[1 - axis])))
        near = float(np.linalg.norm(crossing - path[0])) < settings.through_the_wall_m
        if 0.0 <= share <= 1.0 and low_m < crossing[1 - axis] < high_m and near:
            station_m = float(crossing[1 - axis])
            return Portal(axis=axis, offset_m=float(start[axis]), low_m=station_m - half_m, high_m=station_m + half_m)
    return None
