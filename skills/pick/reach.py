"""Taking hold: reach to the object."""

from __future__ import annotations

from dataclasses import replace
from math import hypot

from py_trees.common import Status

from scene_graph.nodes import ObjectState
from skills.action import RobotContext
from skills.arm.arm import ArmAction, ArmProgress, avoid_side
from skills.arm.arm_way import clear_over_m
from skills.arm.finger_room import fingers_met
from skills.arm.grasping import Grasp, choose_grasp
from skills.arm.level_hand import meets_support_level, prefers_level
from skills.arm.roof import roof_over_m
from skills.arm.way_in import palm_room_m
from skills.errors import Unreachable
from skills.failures import FailureCode
from skills.navigation.pose import in_base


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
        self.context.commands.grip = (self._grasp.opening_m, self.settings.close_effort_n)
        progress = self.move_arm()
        if progress is ArmProgress.STALLED:
            if self._hand_error_m(self._grasp) < self.settings.hand_tolerance_m:
                return Status.SUCCESS
            avoid_side(self.context, self.object_id)
            return self.stalled(self.object_id)
        if progress is ArmProgress.MOVING:
            return Status.RUNNING
        if self._hand_error_m(self._grasp) > self.settings.hand_tolerance_m:
            seen = f"hand is {100 * self._hand_error_m(self._grasp):.1f} cm from where it should be"
            return self.fail(FailureCode.UNREACHABLE, f"the hand did not get to {self.object_id}.", (), seen)
        return Status.SUCCESS

    def _plan(self) -> None:
        context, snapshot, hand = self.context, self.context.snapshot, self.context.hand
        T_base_object, roof_m = in_base(context, self.object_id), roof_over_m(snapshot, self.object_id, hand)
        self._grasp = choose_grasp(
            snapshot.object(self.object_id).size_m,
            T_base_object,
            hand,
            level_first=prefers_level(snapshot, self.object_id, T_base_object, hand),
            met=fingers_met(context, self.object_id),
            roof_m=roof_m,
            level_too=not meets_support_level(snapshot, self.object_id, T_base_object, hand),
        )
        self._x_m = hypot(T_base_object.x_m, T_base_object.y_m)
        wider_m = self._grasp.opening_m - self.settings.side_from_m
        if abs(T_base_object.y_m) > self.settings.side_tolerance_m + wider_m / 4:
            where = f"{100 * T_base_object.y_m:.1f} cm beside the arm's plane"
            raise Unreachable(T_base_object.x_m, T_base_object.z_m, self._grasp.pitch_rad, where)
        room_m = palm_room_m(snapshot, self.object_id, hand)
        if room_m is not None and sum(room_m) < 2 * hand.geometry.hand_half_width_m:
            where = f"{100 * sum(room_m):.1f} cm wide gap, too narrow for the hand"
            raise Unreachable(T_base_object.x_m, T_base_object.z_m, self._grasp.pitch_rad, where)
        over_m = min(clear_over_m(context, self._x_m, self.object_id), T_base_object.z_m + roof_m - hand.tip_m)
        targets = self._grasp.approach(self._x_m, hand, clear_over_m=over_m)
        arm = context.body.arm
        if arm.extension_m > self.settings.extended_m:  # taken up again: straight up before drawing back
            targets = (replace(arm, lift_m=max(arm.lift_m, targets[0].lift_m)), *targets)
        self.follow(targets)

    def _hand_error_m(self, grasp: Grasp) -> float:
        """Distance between where the pads are and where they should be."""
        hand = self.context.body.T_base_gripper
        return hypot(hand.x_m - self._x_m, hand.y_m, hand.z_m - grasp.pads_z_m)
