"""The thing in the gripper: how it got there, where it is, and where it went."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.objects.holding.grip import Grip, GripChange, GripEvent, GripSettings
from perception.objects.tracker import Tracker
from perception.objects.tracking.handled import HandDid
from perception.objects.tracking.track import Track
from perception.ports import JointState
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ROBOT_ID, ObjectState
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Held:
    """A track in the gripper and ``T_gripper_object``, fixed since it was taken."""

    track: Track
    T_gripper_object: SE3


class Hand:
    """Follows one thing from its place into the hand and back out.

    Attributes:
        held: what is in the hand, if anything.
        T_base_gripper: newest pose of the finger pads.
    """

    def __init__(self, tracker: Tracker, settings: GripSettings, held_before: str | None = None) -> None:
        """``held_before``: what was in the hand when the robot was switched off."""
        self._tracker = tracker
        self._settings = settings
        self._grip = Grip(settings, held_before)
        self.held: Held | None = None
        self.T_base_gripper = SE3.identity()

    def update(self, snapshot: Snapshot, joints: JointState | None) -> frozenset[int]:
        """React to what the fingers feel; numbers of tracks that were put somewhere just now."""
        room, robot = snapshot.current_room, snapshot.robot
        if room is None or robot is None or joints is None:
            return frozenset()
        before, self.T_base_gripper = self.T_base_gripper, joints.T_base_gripper
        self._agree_with_graph(snapshot, robot.holding)
        self._note_touch(self._grip.closing_on(robot.status), joints.stamp_s)
        holding = self.held.track.node_id if self.held is not None else None
        event = self._grip.update(joints, robot.status, holding)
        if event is None:
            return frozenset()
        if event.change is GripChange.TAKEN:
            self._take(snapshot, room, event.object_id, joints.stamp_s)
            return frozenset()
        held, self.held = self.held, None
        if held is None:
            return frozenset()
        return self._let_go(snapshot, room, held, event, before, joints.stamp_s)

    def T_robot_object(self, held: Held) -> SE3:
        """Pose of the held thing in the robot's base."""
        return self.T_base_gripper @ held.T_gripper_object

    def _note_touch(self, object_id: str | None, stamp_s: float) -> None:
        """What the hand closes on may be gone from there afterwards, be it held or not."""
        track = self._tracker.of_node(object_id) if object_id is not None else None
        if track is not None and track.state is not ObjectState.HELD:
            track.note_hand(HandDid.TOUCHED, stamp_s)

    def _agree_with_graph(self, snapshot: Snapshot, holding: str | None) -> None:
        """Sight may have shown that the hand is empty, and a restart may find it full."""
        if self.held is not None and self.held.track.state is not ObjectState.HELD:
            self.held = None
        if self.held is None and holding is not None:
            track = self._tracker.of_node(holding)
            if track is not None and track.state is ObjectState.HELD:
                T_robot_object = snapshot.transform(ROBOT_ID, holding)
                self.held = Held(track=track, T_gripper_object=self.T_base_gripper.inverse() @ T_robot_object)

    def _take(self, snapshot: Snapshot, room: str, object_id: str, stamp_s: float) -> None:
        track = self._tracker.of_node(object_id)
        if track is None or object_id not in snapshot:
            return
        T_base_object = snapshot.transform(ROBOT_ID, object_id)
        track.note_hand(HandDid.TAKEN, stamp_s)
        T_gripper_object = self.T_base_gripper.inverse() @ T_base_object
        most_m = self._settings.off_center_m
        offset = np.clip(T_gripper_object.translation_m, -most_m, most_m)
        offset[1] = 0.0  # the fingers have centered it
        self.held = Held(track=track, T_gripper_object=SE3(T_gripper_object.quat_wxyz, offset))
        track.state = ObjectState.HELD
        track.room = room
        track.log_odds = max(track.log_odds, 2.0)

    def _let_go(
        self, snapshot: Snapshot, room: str, held: Held, event: GripEvent, T_base_gripper: SE3, stamp_s: float
    ) -> frozenset[int]:
        """Place the thing where the hand was when it still felt it."""
        track = held.track
        T_room_object = snapshot.transform(room, ROBOT_ID) @ T_base_gripper @ held.T_gripper_object
        position = np.array(T_room_object.translation_m)
        if event.change is GripChange.RELEASED:
            track.state, track.log_odds = ObjectState.PRESENT, 2.0
            position[2] = self._resting_height(position[2], track, event.place)
            track.put_at(room, position, self._settings.released_sigma_m, T_room_object.yaw_rad)
            track.note_hand(HandDid.PUT, stamp_s)
            return frozenset({track.number})
        track.state, track.log_odds = ObjectState.MISSING, -2.0
        position[2] = track.box.size_m[2] / 2.0
        track.put_at(room, position, self._settings.lost_sigma_m)
        track.note_hand(HandDid.DROPPED, stamp_s)
        return frozenset()

    def _resting_height(self, z_m: float, track: Track, place: str | None) -> float:
        """Height of the center of a thing put down: on the top of its support, if that is near; as it was let go
        otherwise.
        """
        support = self._tracker.of_node(place) if place is not None else None
        half_m = track.box.size_m[2] / 2.0
        if support is None:
            return z_m
        top_m = float(support.position[2]) + support.box.size_m[2] / 2.0
        on_top_m = top_m + half_m
        return on_top_m if abs(on_top_m - z_m) < self._settings.support_m and not support.category.levels else z_m
