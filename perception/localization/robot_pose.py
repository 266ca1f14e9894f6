"""The robot's pose at the time of a measurement: the graph's belief carried over by odometry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, planar_covariance
from perception.sensing import SensorBuffer
from scene_graph.nodes import ROBOT_ID
from scene_graph.snapshot import Snapshot


@dataclass(frozen=True, kw_only=True, eq=False)
class RobotPose:
    """Where the robot was at some time: in its ``parent`` frame (room or root) and by odometry alone.

    ``covariance``: (3, 3) of (x, y, yaw) in the base frame.
    """

    parent: str
    T_parent_base: Pose2
    T_odom_base: Pose2
    covariance: NDArray[np.float64]


def robot_pose_at(snapshot: Snapshot, buffer: SensorBuffer, stamp_s: float) -> RobotPose | None:
    """The pose at ``stamp_s``, or ``None`` before the first odometry."""
    edge = snapshot.parent(ROBOT_ID)
    if edge is None or not buffer.odometry:
        return None
    T_odom_base = Pose2.from_se3(buffer.odometry_near(stamp_s))
    moved = Pose2.from_se3(buffer.odometry_near(edge.stamp_s)).inverse() @ T_odom_base
    return RobotPose(
        parent=edge.source,
        T_parent_base=Pose2.from_se3(edge.T_source_target) @ moved,
        T_odom_base=T_odom_base,
        covariance=planar_covariance(edge.covariance),
    )
