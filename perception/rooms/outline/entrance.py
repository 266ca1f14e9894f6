"""Where the robot came into a room: the wall above that stretch cannot hide another part of the room."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from perception.geometry.polygon import points_inside
from perception.rooms.outline.portals import Portal

Array = NDArray[np.float64]

_BODY_M = 0.3
_THROUGH_THE_WALL_M = 0.7


def entrance(polygon: Array, path: Array) -> Portal | None:
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
    for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        axis = 0 if abs(start[0] - end[0]) < abs(start[1] - end[1]) else 1
        across_m = entered[axis] - outside[axis]
        share = (start[axis] - outside[axis]) / across_m if across_m != 0.0 else -1.0
        crossing = outside + share * (entered - outside)
        low_m, high_m = sorted((float(start[1 - axis]), float(end[1 - axis])))
        near = float(np.linalg.norm(crossing - path[0])) < _THROUGH_THE_WALL_M
        if 0.0 <= share <= 1.0 and low_m < crossing[1 - axis] < high_m and near:
            station_m = float(crossing[1 - axis])
            return Portal(axis=axis, offset_m=float(start[axis]), low_m=station_m - _BODY_M, high_m=station_m + _BODY_M)
    return None
