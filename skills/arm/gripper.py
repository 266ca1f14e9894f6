"""The gripper: close the fingers on a thing, open them again."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from py_trees.common import Status

from scene_graph.geometry.se3 import SE3
from skills.action import Action, Grip, RobotContext
from skills.arm.arm import is_firm
from skills.arm.way_in import palm_room_m
from skills.failures import FailureCode
from skills.furniture.furniture import nearest
from skills.furniture.standing import stand_of, surfaces_of
from skills.navigation.pose import in_base


class CloseGripper(Action):
    """Closes the fingers until they hold something; fails with GRASP_EMPTY when they meet."""

    def __init__(self, context: RobotContext, object_id: str) -> None:
        super().__init__(f"close on {object_id}", context)
        self.object_id, self._settings = object_id, context.settings.arm
        self.timeout_s = self._settings.give_up_s + 1.0  # what ends it leaves the fingers closing
        self._last_m, self._still_s = 0.0, 0.0
        self._open_m = self._moved_m = self._along_m = self._stamp_s = 0.0
        self._follows, self._arm = True, context.body.arm
        self._standing: tuple[SE3, tuple[float, float, float]] | None = None

    def begin(self) -> None:
        """Remember the opening, to see when it stops changing, and pose and size while the object still stands."""
        self.context.grip, self._standing, self._arm = None, None, self.context.body.arm
        self._moved_m = self._along_m = 0.0
        hand = self.context.hand
        room_m = palm_room_m(self.context.snapshot, self.object_id, hand)
        needed_m = hand.geometry.hand_half_width_m + self._settings.follow_m
        self._follows = room_m is None or min(room_m) >= needed_m
        if self.object_id in self.context.snapshot:
            self._standing = in_base(self.context, self.object_id), self._standing_size_m()
        self._last_m = self._open_m = self.context.body.gripper_opening_m
        self._still_s = self._stamp_s = self.context.stamp_s

    def step(self) -> Status:
        """Close, wait until the fingers stand still, and judge; what is not held firmly is let go, or it would come
        along when the arm is drawn back.
        """
        body, settings = self.context.body, self._settings
        self.context.commands.grip, self.context.commands.drive = (0.0, settings.close_effort_n), (0.0, 0.0)
        if abs(body.gripper_opening_m - self._last_m) > settings.still_m:
            self._last_m, self._still_s = body.gripper_opening_m, self.context.stamp_s
        late, waited_s = self.elapsed_s > settings.give_up_s, self.context.stamp_s - self._still_s
        if not late and (waited_s < settings.settle_s or self.elapsed_s < 2 * settings.settle_s):
            return self._go_on()
        if is_firm(self.context):
            self._hold()
            return Status.SUCCESS
        if not late and body.gripper_opening_m > settings.empty_opening_m and waited_s < 3 * settings.settle_s:
            return self._go_on()
        self.context.commands.grip = (self._open_m, settings.close_effort_n)
        seen = f"opening {1000 * body.gripper_opening_m:.0f} mm, contacts {body.finger_contacts}"
        message = f"the fingers closed without holding {self.object_id}."
        return self.fail(FailureCode.GRASP_EMPTY, message, (self.object_id,), seen)

    def _go_on(self) -> Status:
        """Close further. Towards a finger that alone touches, the hand is moved until the other one does too: pushed at
        from one side, what is high and narrow tilts under the finger and is stuck. Across the arm's plane the base
        turns, along it the arm is stretched or drawn in. Where there is no room for that, it is pushed with more force.
        """
        body, commands, settings = self.context.body, self.context.commands, self._settings
        left, right = body.finger_contacts
        step_m, self._stamp_s = settings.follow_mps * (self.context.stamp_s - self._stamp_s), self.context.stamp_s
        if left == right:
            return Status.RUNNING
        if not self._follows or self._moved_m >= settings.follow_m:
            commands.grip = (0.0, settings.shift_effort_n)
            return Status.RUNNING
        x, y, _ = body.T_base_gripper.rotation()[:, 1] * (1.0 if left else -1.0)
        self._moved_m, self._along_m = self._moved_m + step_m, self._along_m + step_m * float(x)
        commands.drive = (0.0, settings.follow_mps * float(y) / max(body.T_base_gripper.x_m, settings.follow_m))
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
        stand, surface_z_m = stand_of(snapshot, self.object_id), 0.0
        if stand is not None and stand.furniture.is_dropped_into:
            return x_m, y_m, z_m
        middle_m = in_base(self.context, self.object_id).z_m
        if stand is not None:
            surface = nearest(surfaces_of(snapshot, stand.on, self.object_id), stand.point_m[2] - z_m / 2)
            surface_z_m = in_base(self.context, stand.on).z_m + surface.height_m
        standing_m = 2 * (middle_m - surface_z_m)
        return x_m, y_m, standing_m if standing_m > 0.0 and abs(standing_m - z_m) < self._settings.misjudged_m else z_m


class OpenGripper(Action):
    """Opens the fingers wide enough to leave what they held."""

    timeout_s = 8.0

    def __init__(self, context: RobotContext, object_id: str) -> None:
        super().__init__(f"let go of {object_id}", context)
        self.object_id, self._settings = object_id, context.settings.arm
        self._opening_m = self._opened_s = 0.0
        self._arm = context.body.arm

    def begin(self) -> None:
        """A little wider than now: neighbors may stand close."""
        widest_m = self.context.limits.gripper_opening_m[1]
        self._arm = self.context.body.arm
        self._opening_m = min(self.context.body.gripper_opening_m + self._settings.let_go_m, widest_m)

    def step(self) -> Status:
        """Open, and wait until nothing is touched."""
        body, settings = self.context.body, self._settings
        self.context.commands.grip = (self._opening_m, settings.close_effort_n)
        self.context.commands.drive = (0.0, 0.0)
        if body.gripper_opening_m < self._opening_m - settings.open_tolerance_m:
            self._opened_s = self.context.stamp_s
            if self.elapsed_s > settings.stuck_s:  # the finger tips press on the surface: relieve them
                self.context.commands.arm = replace(self._arm, lift_m=self._arm.lift_m + settings.relief_m)
            return Status.RUNNING
        touching = any(body.finger_contacts) and self.elapsed_s < settings.touch_s
        if touching or self.context.stamp_s - self._opened_s < settings.stand_s:
            return Status.RUNNING
        self.context.grip = None
        return Status.SUCCESS
