"""From where a frame was taken: the robot's pose in its room, carried to the time of the frame by odometry."""

from __future__ import annotations

import math

from perception.crossing import in_doubt
from perception.errors import OdometryUnavailable
from perception.objects.seeing.projection import View
from perception.ports import RgbdFrame
from perception.sensing import SensorBuffer
from scene_graph.errors import FramesNotConnected
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ROBOT_ID, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

_YAW = 5
"""Index of the heading in a pose's covariance."""


def view_of(frame: RgbdFrame, snapshot: Snapshot, buffer: SensorBuffer, *, sure_rad: float = math.inf) -> View | None:
    """The frame in the robot's room, ``None`` while there is no room to see it in, or its place is in doubt.

    ``sure_rad``: standard deviation of the robot's heading from which on it is: behind a door, until the new room is
    known, it rests on odometry alone.
    """
    room_id = snapshot.current_room
    room = snapshot.get(room_id) if room_id is not None else None
    parent = snapshot.parent(ROBOT_ID)
    if not isinstance(room, RoomNode) or room.status is RoomStatus.TEMPORARY or parent is None or in_doubt(snapshot):
        return None
    try:
        T_room_robot, covariance = snapshot.transform_with_covariance(room.id, ROBOT_ID)
    except FramesNotConnected:
        return None
    if covariance[_YAW, _YAW] > sure_rad**2:
        return None
    T_room_base = T_room_robot @ _motion(buffer, parent.stamp_s, frame.stamp_s)
    return View.of(frame, room=room.id, T_room_base=T_room_base, pose_covariance=covariance)


def turning_radps(buffer: SensorBuffer) -> float:
    """How fast the robot turns, without sign."""
    return abs(buffer.odometry[-1].angular_radps) if buffer.odometry else 0.0


def _motion(buffer: SensorBuffer, from_s: float, to_s: float) -> SE3:
    """How the base moved between the time of its pose in the graph and the time of the frame."""
    try:
        return buffer.odometry_at(from_s).inverse() @ buffer.odometry_at(to_s)
    except OdometryUnavailable:
        return SE3.identity()
