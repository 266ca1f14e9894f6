"""The faces of walls as line segments."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Walls:
    """Wall faces as line segments.

    ``normal`` (N, 2) into the room, ``offset_m`` (N,), ``start`` (N, 2), ``along`` (N, 2) unit direction, ``length_m``
    (N,).
    """

    normal: Array
    offset_m: Array
    start: Array
    along: Array
    length_m: Array

    @classmethod
    def of_polygon(cls, polygon: Array, kept: NDArray[np.bool_] | None = None) -> Walls:
        """The walls of a counter-clockwise polygon, or the ``kept`` (N,) ones of them."""
        edges = np.roll(polygon, -1, axis=0) - polygon
        length = np.linalg.norm(edges, axis=1)
        along = edges / length[:, None]
        normal = np.stack([-along[:, 1], along[:, 0]], axis=1)
        offset = (normal * polygon).sum(axis=1)
        chosen = slice(None) if kept is None else kept
        return cls(
            normal=normal[chosen],
            offset_m=offset[chosen],
            start=polygon[chosen],
            along=along[chosen],
            length_m=length[chosen],
        )

    def facing(self, point: Array, least_m: float) -> Walls:
        """The walls whose inner side the point is on, by at least ``least_m``."""
        kept = self.normal @ point - self.offset_m > least_m
        return Walls(
            normal=self.normal[kept],
            offset_m=self.offset_m[kept],
            start=self.start[kept],
            along=self.along[kept],
            length_m=self.length_m[kept],
        )
