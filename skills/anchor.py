"""A point tied to a node: it stays where it is meant when the graph refines the node's pose or the robot's frame
changes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.geometry import Points
from skills.navigation.pose import in_base

Point3 = tuple[float, float, float]


@dataclass(frozen=True)
class Anchor:
    """``point_m`` in the frame of ``node_id``; by default the node's own origin."""

    node_id: str
    point_m: Point3 = (0.0, 0.0, 0.0)

    @classmethod
    def fix(cls, snapshot: Snapshot, node_id: str, holder: str) -> Anchor:
        """Where ``node_id`` is now, tied to ``holder`` (its support or room) instead of to itself."""
        x_m, y_m, z_m = snapshot.position(node_id, holder)
        return cls(holder, (float(x_m), float(y_m), float(z_m)))

    def position(self, snapshot: Snapshot, frame: str) -> Points:
        """The point (3,) in ``frame``."""
        return snapshot.transform(frame, self.node_id).apply(np.array(self.point_m))

    def in_base(self, context: RobotContext) -> Points:
        """The point (3,) in the base frame now."""
        return in_base(context, self.node_id).apply(np.array(self.point_m))


AnchorSource = Anchor | Callable[[], Anchor]
"""An anchor, or a function that gives it once it is known (a spot that an earlier action chooses)."""


def resolved(source: AnchorSource) -> Anchor:
    """The anchor."""
    return source if isinstance(source, Anchor) else source()
