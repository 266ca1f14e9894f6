"""What there is to know of one moment: the measurements that are new in it, and the graph now and then."""

from __future__ import annotations

from dataclasses import dataclass

from perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from scene_graph.geometry.se3 import SE3
from scene_graph.snapshot import Snapshot
from skills.ports import BodyState


@dataclass(frozen=True, kw_only=True, eq=False)
class Moment:
    """``now_s``: robot time. Of sensors only what has not been told before. ``T_map_base`` as believed."""

    now_s: float
    body: BodyState
    odometry: Odometry | None = None
    scan: LidarScan | None = None
    joints: JointState | None = None
    frame: RgbdFrame | None = None
    T_map_base: SE3 | None = None
    building: Snapshot | None = None
