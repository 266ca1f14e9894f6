"""Moving the arm through a few targets, and the poses it is carried in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum, auto
from math import cos, hypot, sin

from py_trees.common import Status

from skills.action import Action, RobotContext
from skills.arm.arm_way import clear_over_m, people_here
from skills.arm.hand import DOWN_RAD
from skills.arm.held import above_bottom_m, held_radius_m, is_holding
from skills.arm.settings import ArmSettings
from skills.arm.way_in import is_among_boards
from skills.failures import FailureCode
from skills.navigation.pose import base_pose, bearing_rad, in_base, robot_frame
from skills.ports import ArmTarget


class ArmProgress(Enum):
    """How the arm's motion goes."""

    MOVING = auto()
    THERE = auto()
    STALLED = auto()


class ArmAction(Action):
    """An action that moves the arm through targets in order; the base stands still."""

    timeout_s = 40.0
    holds_arm = True

    def __init__(self, name: str, context: RobotContext) -> None:
        super().__init__(name, context)
        self.settings = context.settings.arm
        self._targets: list[ArmTarget] = []
        self._last: ArmTarget | None = None
        self._moved_s = 0.0
        self._moves = False
        self._lost_s: float | None = None

    def follow(self, targets: Sequence[ArmTarget]) -> None:
        """Start through ``targets``, each as high as the lift goes: one above that would never be reached, and what is
        held be let go in the air, the arm being taken to have met the surface.
        """
        low_m, high_m = self.context.limits.lift_m
        self._targets = [replace(target, lift_m=min(max(target.lift_m, low_m), high_m)) for target in targets]
        self._last, self._moved_s = None, self.context.stamp_s
        self._moves = False

    def move_arm(self) -> ArmProgress:
        """Command the next target; THERE once the last is reached, STALLED when the arm stopped short of one."""
        self.context.commands.drive = (0.0, 0.0)
        if not self._targets:
            return ArmProgress.THERE
        self.context.commands.arm = self._targets[0]
        arm = self.context.body.arm
        if _reached(arm, self._targets[0], self.settings):
            self._targets.pop(0)
            self._moved_s, self._moves = self.context.stamp_s, True
            return ArmProgress.MOVING if self._targets else ArmProgress.THERE
        if self._last is None or _moved(arm, self._last, self.settings):
            self._moves = self._last is not None
            self._last, self._moved_s = arm, self.context.stamp_s
        stalled = self.context.stamp_s - self._moved_s > self.settings.stall_s
        return ArmProgress.STALLED if stalled else ArmProgress.MOVING

    def meets_person(self) -> str | None:
        """A person, seen a while ago at most, whom the arm would come too near to on its way out."""
        context, arm = self.context, self.context.body.arm
        out = [
            target
            for target in self._targets
            if target.extension_m > arm.extension_m + self.settings.length_tolerance_m
        ]
        if not out:
            return None
        farthest_m = max(_hand_x_m(context, target) for target in out)
        clear_m = context.settings.reach.person_clearance_m - context.settings.approach.position_m
        for person in people_here(context, self.settings.person_away_s):
            T_base_person = in_base(context, person)
            beyond_m = max(T_base_person.x_m - farthest_m, 0.0)
            if T_base_person.x_m > 0.0 and hypot(beyond_m, T_base_person.y_m) < clear_m:
                return person
        return None

    def wait_for(self, person: str, what: str) -> Status:
        """Fail because of a person in the arm's way, who may move on; the arm stays where it is."""
        self.context.commands.arm = self.context.body.arm
        purpose = "" if person == what else f" to reach {what}"
        message = f"{person} is where my arm would go{purpose}."
        return self.fail(FailureCode.PERSON_IN_WAY, message, (person,))

    def slipped(self) -> bool:
        """Whether the fingers have been without contact for a moment."""
        if is_firm(self.context):
            self._lost_s = None
        elif self._lost_s is None:
            self._lost_s = self.context.stamp_s
        return self._lost_s is not None and self.context.stamp_s - self._lost_s > self.settings.slip_s

    def stalled(self, what: str) -> Status:
        """Fail because the arm stopped short; with TIMEOUT when it has not moved at all."""
        arm = self.context.body.arm
        wanted = self._targets[0] if self._targets else arm
        lift, extension = (
            f"{arm.lift_m:.3f} of {wanted.lift_m:.3f}",
            f"{arm.extension_m:.3f} of {wanted.extension_m:.3f}",
        )
        seen = f"lift {lift} m, extension {extension} m"
        if not self._moves:
            return self.fail(FailureCode.TIMEOUT, "the arm does not do what it is told.", (), seen)
        return self.fail(FailureCode.UNREACHABLE, f"the arm was stopped on its way to {what}.", (), seen)


class Stow(ArmAction):
    """Brings the arm into the pose it travels in: stowed when empty, upright over the base when it holds something."""

    def __init__(self, context: RobotContext) -> None:
        super().__init__("stow the arm", context)

    def begin(self) -> None:
        """Off the table first, so that nothing is swept over it, then back, then to height."""
        self.follow(
            way_back(self.context, carry_pose(self.context) if is_holding(self.context) else self.settings.stowed)
        )

    def step(self) -> Status:
        """Move on; a stall is no reason not to drive when the arm is within the base's outline."""
        progress = self.move_arm()
        if progress is ArmProgress.STALLED:
            return (
                Status.SUCCESS
                if self.context.body.arm.extension_m < self.settings.driveable_m
                else self.stalled("its travel pose")
            )
        return Status.SUCCESS if progress is ArmProgress.THERE else Status.RUNNING


class Lift(ArmAction):
    """Raises what the fingers hold straight up; fails with SLIPPED when they lose it."""

    def __init__(self, context: RobotContext, object_id: str) -> None:
        super().__init__(f"lift {object_id}", context)
        self.object_id = object_id

    def begin(self) -> None:
        """As high as the carry pose, at least 12 cm, and over what stands on the way back; a little only below a
        board.
        """
        context, arm, (_, top_m) = self.context, self.context.body.arm, self.context.limits.lift_m
        if is_below_board(context):
            self.follow([replace(arm, lift_m=arm.lift_m + self.settings.off_board_m)])
            return
        hand_x_m, radius_m = float(context.body.T_base_gripper.x_m), held_radius_m(context)
        over_m = clear_over_m(context, hand_x_m, self.object_id, held_radius_m=radius_m)
        clear_m = over_m + above_bottom_m(context) - context.geometry.hand_length_m * sin(arm.wrist_pitch_rad)
        highest_m = max(arm.lift_m + self.settings.lift_m, self.settings.carry_lift_m, clear_m if over_m > 0.0 else 0.0)
        self.follow([replace(arm, lift_m=min(highest_m, top_m))])

    def step(self) -> Status:
        """Raise, watching the fingers."""
        progress = self.move_arm()
        if self.slipped():
            self.context.grip = None
            return self.fail(FailureCode.SLIPPED, f"{self.object_id} slipped out of the fingers.", (self.object_id,))
        return Status.RUNNING if progress is ArmProgress.MOVING else Status.SUCCESS


class Retract(ArmAction):
    """Draws the arm back over the base; with something held, ``watch`` it and fail with SLIPPED when it is lost."""

    def __init__(self, context: RobotContext, *, watch: str | None = None) -> None:
        super().__init__("retract the arm", context)
        self._watch = watch

    def begin(self) -> None:
        """What is held was lifted already; an empty hand first leaves what it let go."""
        arm = self.context.body.arm
        if self._watch is None:
            self.follow(way_back(self.context, self.settings.stowed))
        else:
            travel = carry_pose(self.context)
            self.follow([replace(arm, extension_m=travel.extension_m), travel])

    def step(self) -> Status:
        """Draw back."""
        progress = self.move_arm()
        if self._watch is not None and self.slipped():
            self.context.grip = None
            return self.fail(FailureCode.SLIPPED, f"{self._watch} slipped out of the fingers.", (self._watch,))
        if progress is ArmProgress.STALLED:
            return self.stalled("its travel pose")
        return Status.SUCCESS if progress is ArmProgress.THERE else Status.RUNNING


def way_back(context: RobotContext, travel: ArmTarget) -> list[ArmTarget]:
    """Targets from wherever the arm is to a travel pose: a hand that points down rises first, as high as it came, so
    that it clears the arm of a sofa; a level one, or one below a board, just draws back.
    """
    arm, (_, top_m), settings = context.body.arm, context.limits.lift_m, context.settings.arm
    back = replace(arm, extension_m=travel.extension_m)
    drawn_in = arm.extension_m < settings.carry_extension_m + settings.length_tolerance_m
    if drawn_in or arm.wrist_pitch_rad > DOWN_RAD / 2:
        return [back, travel]
    if is_below_board(context):
        off = replace(arm, lift_m=arm.lift_m + settings.off_board_m / 2)
        return [off, replace(back, lift_m=off.lift_m), travel]
    up_m = min(max(arm.lift_m + settings.lift_m, settings.carry_lift_m), top_m)
    return [replace(arm, lift_m=up_m), replace(back, lift_m=up_m), travel]


def carry_pose(context: RobotContext) -> ArmTarget:
    """The travel pose for something held: retracted, high, the wrist as it is."""
    arm, settings = context.body.arm, context.settings.arm
    extension_m = settings.carry_extension_m if arm.wrist_pitch_rad < DOWN_RAD / 2 else 0.0
    lift_m = max(settings.carry_lift_m, min(arm.lift_m, settings.highest_carry_m))
    return replace(arm, extension_m=extension_m, lift_m=lift_m)


def is_below_board(context: RobotContext) -> bool:
    """Whether the hand is between the boards of a shelf: it must leave as it came, level-wise."""
    hand = base_pose(context, robot_frame(context.snapshot)) @ context.body.T_base_gripper
    return is_among_boards(context.snapshot, robot_frame(context.snapshot), hand.translation_m, context.hand)


def avoid_side(context: RobotContext, node_id: str) -> None:
    """Remember that a thing was not got hold of from the side on which the base stands: others are tried first."""
    context.blocked_reaches[node_id, bearing_rad(context, node_id)] = context.stamp_s


def is_firm(context: RobotContext) -> bool:
    """Whether both fingers touch something that keeps them apart."""
    body = context.body
    return all(body.finger_contacts) and body.gripper_opening_m > context.settings.arm.empty_opening_m


def _reached(arm: ArmTarget, target: ArmTarget, settings: ArmSettings) -> bool:
    lengths_m, angles_rad = _off(arm, target)
    return max(lengths_m) < settings.length_tolerance_m and max(angles_rad) < settings.angle_tolerance_rad


def _moved(arm: ArmTarget, last: ArmTarget, settings: ArmSettings) -> bool:
    lengths_m, angles_rad = _off(arm, last)
    return sum(lengths_m) > settings.moving_m or sum(angles_rad) > settings.turning_rad


def _off(arm: ArmTarget, other: ArmTarget) -> tuple[tuple[float, float], tuple[float, float]]:
    """How far lift and extension, and both angles of the wrist, are from those of another."""
    lengths_m = abs(arm.lift_m - other.lift_m), abs(arm.extension_m - other.extension_m)
    pitch_rad, roll_rad = arm.wrist_pitch_rad - other.wrist_pitch_rad, arm.wrist_roll_rad - other.wrist_roll_rad
    return lengths_m, (abs(pitch_rad), abs(roll_rad))


def _hand_x_m(context: RobotContext, target: ArmTarget) -> float:
    geometry = context.geometry
    return geometry.wrist_x_m + target.extension_m + geometry.hand_length_m * cos(target.wrist_pitch_rad)
