"""Taking hold: reach to the object, close the fingers on it, open them again."""

from __future__ import annotations

from dataclasses import replace
from math import hypot

import numpy as np
from py_trees.common import Status

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState
from skills.action import Action, Grip, RobotContext
from skills.arm.arm import EMPTY_OPENING_M, ArmAction, ArmProgress, avoid_side, is_firm
from skills.arm.arm_way import clear_over_m
from skills.arm.finger_room import fingers_met
from skills.arm.grasping import TIP_M, Grasp, choose_grasp, meets_seat_level, prefers_level, roof_over_m
from skills.errors import Unreachable
from skills.failures import FailureCode
from skills.furniture.boards import HAND_HALF_WIDTH_M, palm_room_m
from skills.furniture.containers import is_open_container
from skills.navigation.pose import in_base
from skills.place.place_spot import surface_m

HAND_TOLERANCE_M = 0.02
SIDE_TOLERANCE_M = 0.015
CLOSE_EFFORT_N, SHIFT_EFFORT_N = 15.0, 40.0
SETTLE_S = 0.35
FOLLOW_MPS, FOLLOW_M = 0.01, 0.03
"""How fast, and how far at most, the hand follows a finger that touches alone."""
CLOSE_LIMIT_S = 8.0
GIVE_UP_S = CLOSE_LIMIT_S - 1.0
"""Fingers that have come to no rest by then hold nothing; short of the time limit, which would leave them closing."""
EXTENDED_M = 0.05
STAND_S = 0.6
STUCK_S, RELIEF_M = 2.0, 0.015
MISJUDGED_M = 0.1
"""A height that is farther off than this is not that of a thing standing there."""
LET_GO_S = 2.0
"""A thing may lean on a finger after it was let go; after this long it is left so."""


class Reach(ArmAction):
    """Opens the fingers and brings the pads to the object ahead: over or before it first, then straight in.

    The base must already face the object, as the arm moves in the plane y = 0. Fails with UNREACHABLE and the numbers.
    """

    def __init__(self, context: RobotContext, object_id: str) -> None:
        super().__init__(f"reach for {object_id}", context)
        self.object_id = object_id
        self._grasp: Grasp | None = None
        self._why = ""

    def begin(self) -> None:
        """Choose the grasp from where the object is now."""
        self.context.announce(f"grasping {self.object_id}")
        self._grasp, self._why = None, ""
        self.follow([])
        if self.object_id not in self.context.snapshot:
            return
        try:
            self._plan()
        except Unreachable as error:
            self._why = str(error)

    def step(self) -> Status:
        """Move through the targets and check that the hand is where it should be."""
        if self.object_id not in self.context.snapshot:
            return self.fail(FailureCode.OBJECT_GONE, f"{self.object_id} is no longer on my map.")
        if self.context.snapshot.object(self.object_id).state is ObjectState.MISSING:
            self.context.commands.arm = self.context.body.arm
            message = f"{self.object_id} went while I reached for it."
            return self.fail(FailureCode.OBJECT_GONE, message, (self.object_id,))
        if self._grasp is None or self._why:
            return self.fail(FailureCode.UNREACHABLE, f"{self.object_id}: {self._why}.", (self.object_id,))
        if (person := self.meets_person()) is not None:
            return self.wait_for(person, self.object_id)
        self.context.commands.grip = (self._grasp.opening_m, CLOSE_EFFORT_N)
        progress = self.move_arm()
        if progress is ArmProgress.STALLED:
            if self._hand_error_m(self._grasp) < HAND_TOLERANCE_M:
                return Status.SUCCESS
            avoid_side(self.context, self.object_id)
            return self.stalled(self.object_id)
        if progress is ArmProgress.MOVING:
            return Status.RUNNING
        if self._hand_error_m(self._grasp) > HAND_TOLERANCE_M:
            seen = f"hand is {100 * self._hand_error_m(self._grasp):.1f} cm from where it should be"
            return self.fail(FailureCode.UNREACHABLE, f"the hand did not get to {self.object_id}.", (), seen)
        return Status.SUCCESS

    def _plan(self) -> None:
        context, snapshot = self.context, self.context.snapshot
        T_base_object, roof_m = in_base(context, self.object_id), roof_over_m(snapshot, self.object_id)
        self._grasp = choose_grasp(
            snapshot.object(self.object_id).size_m,
            T_base_object,
            level_first=prefers_level(snapshot, self.object_id, T_base_object),
            geometry=context.geometry,
            limits=context.limits,
            met=fingers_met(context, self.object_id),
            roof_m=roof_m,
            level_too=not meets_seat_level(snapshot, self.object_id, T_base_object),
        )
        self._x_m = hypot(T_base_object.x_m, T_base_object.y_m)
        if abs(T_base_object.y_m) > SIDE_TOLERANCE_M + (self._grasp.opening_m - 0.06) / 4:
            where = f"{100 * T_base_object.y_m:.1f} cm beside the arm's plane"
            raise Unreachable(T_base_object.x_m, T_base_object.z_m, self._grasp.pitch_rad, where)
        room_m = palm_room_m(snapshot, self.object_id)
        if room_m is not None and sum(room_m) < 2 * HAND_HALF_WIDTH_M:
            where = f"{100 * sum(room_m):.1f} cm wide gap, too narrow for the hand"
            raise Unreachable(T_base_object.x_m, T_base_object.z_m, self._grasp.pitch_rad, where)
        over_m = min(clear_over_m(context, self._x_m, self.object_id), T_base_object.z_m + roof_m - TIP_M)
        targets = self._grasp.approach(self._x_m, context.geometry, context.limits, clear_over_m=over_m)
        arm = context.body.arm
        if arm.extension_m > EXTENDED_M:  # taken up again: straight up before drawing back
            targets = (replace(arm, lift_m=max(arm.lift_m, targets[0].lift_m)), *targets)
        self.follow(targets)

    def _hand_error_m(self, grasp: Grasp) -> float:
        """Distance between where the pads are and where they should be."""
        hand = self.context.body.T_base_gripper
        return hypot(hand.x_m - self._x_m, hand.y_m, hand.z_m - grasp.pads_z_m)


class CloseGripper(Action):
    """Closes the fingers until they hold something; fails with GRASP_EMPTY when they meet."""

    timeout_s = CLOSE_LIMIT_S

    def __init__(self, context: RobotContext, object_id: str) -> None:
        super().__init__(f"close on {object_id}", context)
        self.object_id = object_id
        self._last_m, self._still_s = 0.0, 0.0
        self._open_m = self._moved_m = self._along_m = self._stamp_s = 0.0
        self._follows, self._arm = True, context.body.arm
        self._standing: tuple[SE3, tuple[float, float, float]] | None = None

    def begin(self) -> None:
        """Remember the opening, to see when it stops changing, and pose and size while the object still stands."""
        self.context.grip, self._standing, self._arm = None, None, self.context.body.arm
        self._moved_m = self._along_m = 0.0
        room_m = palm_room_m(self.context.snapshot, self.object_id)
        self._follows = room_m is None or min(room_m) >= HAND_HALF_WIDTH_M + FOLLOW_M
        if self.object_id in self.context.snapshot:
            self._standing = in_base(self.context, self.object_id), self._standing_size_m()
        self._last_m = self._open_m = self.context.body.gripper_opening_m
        self._still_s = self._stamp_s = self.context.stamp_s

    def step(self) -> Status:
        """Close, wait until the fingers stand still, and judge; what is not held firmly is let go, or it would come
        along when the arm is drawn back.
        """
        body = self.context.body
        self.context.commands.grip, self.context.commands.drive = (0.0, CLOSE_EFFORT_N), (0.0, 0.0)
        if abs(body.gripper_opening_m - self._last_m) > 0.001:
            self._last_m, self._still_s = body.gripper_opening_m, self.context.stamp_s
        late = self.elapsed_s > GIVE_UP_S
        if not late and (self.context.stamp_s - self._still_s < SETTLE_S or self.elapsed_s < 2 * SETTLE_S):
            return self._go_on()
        if is_firm(body):
            self._hold()
            return Status.SUCCESS
        waited_s = self.context.stamp_s - self._still_s
        if not late and body.gripper_opening_m > EMPTY_OPENING_M and waited_s < 3 * SETTLE_S:
            return self._go_on()
        self.context.commands.grip = (self._open_m, CLOSE_EFFORT_N)
        seen = f"opening {1000 * body.gripper_opening_m:.0f} mm, contacts {body.finger_contacts}"
        message = f"the fingers closed without holding {self.object_id}."
        return self.fail(FailureCode.GRASP_EMPTY, message, (self.object_id,), seen)

    def _go_on(self) -> Status:
        """Close further. Towards a finger that alone touches, the hand is moved until the other one does too: pushed at
        from one side, what is high and narrow tilts under the finger and is stuck. Across the arm's plane the base
        turns, along it the arm is stretched or drawn in. Where there is no room for that, it is pushed with more force.
        """
        body, commands = self.context.body, self.context.commands
        left, right = body.finger_contacts
        step_m, self._stamp_s = FOLLOW_MPS * (self.context.stamp_s - self._stamp_s), self.context.stamp_s
        if left == right:
            return Status.RUNNING
        if not self._follows or self._moved_m >= FOLLOW_M:
            commands.grip = (0.0, SHIFT_EFFORT_N)
            return Status.RUNNING
        x, y, _ = body.T_base_gripper.rotation()[:, 1] * (1.0 if left else -1.0)
        self._moved_m, self._along_m = self._moved_m + step_m, self._along_m + step_m * float(x)
        commands.drive = (0.0, FOLLOW_MPS * float(y) / max(body.T_base_gripper.x_m, FOLLOW_M))
        commands.arm = replace(self._arm, extension_m=self._arm.extension_m + self._along_m)
        return Status.RUNNING

    def _hold(self) -> None:
        """Remember where the object sits in the hand; the fingers have centered it along their closing direction."""
        if self._standing is None:
            return
        T_base_object, size_m = self._standing
        T_gripper_object = self.context.body.T_base_gripper.inverse() @ T_base_object
        x_m, _, z_m = T_gripper_object.translation_m
        centered = SE3(T_gripper_object.quat_wxyz, np.array([x_m, 0.0, z_m]))
        self.context.grip = Grip(object_id=self.object_id, T_gripper_object=centered, size_m=size_m)

    def _standing_size_m(self) -> tuple[float, float, float]:
        """Its size, as high as it must be to stand on what carries it: of a thing that is half hidden, the bottom is
        known from its place better than from its picture, and it is the bottom that is put down again.
        """
        snapshot = self.context.snapshot
        x_m, y_m, z_m = snapshot.object(self.object_id).size_m
        support = snapshot.support_of(self.object_id)
        if support is not None and is_open_container(snapshot.object(support).label):
            return x_m, y_m, z_m
        top_m = surface_m(snapshot, support, self.object_id) if support is not None else 0.0
        surface_z_m = in_base(self.context, support).z_m + top_m if support is not None else 0.0
        standing_m = 2 * (in_base(self.context, self.object_id).z_m - surface_z_m)
        return x_m, y_m, standing_m if standing_m > 0.0 and abs(standing_m - z_m) < MISJUDGED_M else z_m


class OpenGripper(Action):
    """Opens the fingers wide enough to leave what they held."""

    timeout_s = 8.0

    def __init__(self, context: RobotContext, object_id: str, opening_m: float = 0.03) -> None:
        super().__init__(f"let go of {object_id}", context)
        self.object_id, self._more_m = object_id, opening_m
        self._opening_m = self._opened_s = 0.0
        self._arm = context.body.arm

    def begin(self) -> None:
        """A little wider than now: neighbors may stand close."""
        widest_m = self.context.limits.gripper_opening_m[1]
        self._arm = self.context.body.arm
        self._opening_m = min(self.context.body.gripper_opening_m + 2 * self._more_m, widest_m)

    def step(self) -> Status:
        """Open, and wait until nothing is touched."""
        body = self.context.body
        self.context.commands.grip = (self._opening_m, CLOSE_EFFORT_N)
        self.context.commands.drive = (0.0, 0.0)
        if body.gripper_opening_m < self._opening_m - 0.01:
            self._opened_s = self.context.stamp_s
            if self.elapsed_s > STUCK_S:  # the finger tips press on the surface: relieve them
                self.context.commands.arm = replace(self._arm, lift_m=self._arm.lift_m + RELIEF_M)
            return Status.RUNNING
        touching = any(body.finger_contacts) and self.elapsed_s < LET_GO_S
        if touching or self.context.stamp_s - self._opened_s < STAND_S:
            return Status.RUNNING
        self.context.grip = None
        return Status.SUCCESS
