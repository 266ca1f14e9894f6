"""Moving the arm through a few targets, and the poses it is carried in."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from enum import Enum, auto
from math import cos, hypot, sin

from py_trees.common import Status

from skills.action import Action, RobotContext
from skills.arm.arm_way import DRIFT_M, PERSON_CLEARANCE_M, clear_over_m, people_here
from skills.arm.grasping import DOWN_RAD
from skills.arm.spot_reach import above_bottom_m, held_radius_m
from skills.failures import FailureCode
from skills.furniture.boards import is_among_boards
from skills.navigation.pose import base_pose, bearing_rad, in_base, robot_frame
from skills.ports import ArmTarget, BodyState

STOWED = ArmTarget(lift_m=0.75, extension_m=0.0, wrist_pitch_rad=DOWN_RAD, wrist_roll_rad=0.0)
CARRY_LIFT_M = 0.95
CARRY_EXTENSION_M = 0.05
LIFT_M = 0.12
OFF_BOARD_M = 0.02
"""What is taken from below a board is raised by this before it is drawn out."""
LENGTH_TOLERANCE_M = 0.008
ANGLE_TOLERANCE_RAD = 0.05
STALL_S = 0.8
EMPTY_OPENING_M = 0.004
SLIP_S = 0.3
PERSON_AWAY_S = 20.0
"""Who was not seen for so long where the robot looks to reach is there no more."""


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
        if _reached(arm, self._targets[0]):
            self._targets.pop(0)
            self._moved_s, self._moves = self.context.stamp_s, True
            return ArmProgress.MOVING if self._targets else ArmProgress.THERE
        if self._last is None or _moved(arm, self._last):
            self._moves = self._last is not None
            self._last, self._moved_s = arm, self.context.stamp_s
        stalled = self.context.stamp_s - self._moved_s > STALL_S
        return ArmProgress.STALLED if stalled else ArmProgress.MOVING

    def meets_person(self) -> str | None:
        """A person, seen a while ago at most, whom the arm would come too near to on its way out."""
        context, arm = self.context, self.context.body.arm
        out = [target for target in self._targets if target.extension_m > arm.extension_m + LENGTH_TOLERANCE_M]
        if not out:
            return None
        farthest_m = max(_hand_x_m(context, target) for target in out)
        for person in people_here(context, PERSON_AWAY_S):
            T_base_person = in_base(context, person)
            beyond_m = max(T_base_person.x_m - farthest_m, 0.0)
            if T_base_person.x_m > 0.0 and hypot(beyond_m, T_base_person.y_m) < PERSON_CLEARANCE_M - DRIFT_M:
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
        if is_firm(self.context.body):
            self._lost_s = None
        elif self._lost_s is None:
            self._lost_s = self.context.stamp_s
        return self._lost_s is not None and self.context.stamp_s - self._lost_s > SLIP_S

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
        arm = self.context.body.arm
        self.follow(way_back(self.context, carry_pose(arm) if is_holding(self.context) else STOWED))

    def step(self) -> Status:
        """Move on; a stall is no reason not to drive when the arm is within the base's outline."""
        progress = self.move_arm()
        if progress is ArmProgress.STALLED:
            return Status.SUCCESS if self.context.body.arm.extension_m < 0.1 else self.stalled("its travel pose")
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
            self.follow([replace(arm, lift_m=arm.lift_m + OFF_BOARD_M)])
            return
        hand_x_m, radius_m = float(context.body.T_base_gripper.x_m), held_radius_m(context)
        over_m = clear_over_m(context, hand_x_m, self.object_id, held_radius_m=radius_m)
        clear_m = over_m + above_bottom_m(context) - context.geometry.hand_length_m * sin(arm.wrist_pitch_rad)
        highest_m = max(arm.lift_m + LIFT_M, CARRY_LIFT_M, clear_m if over_m > 0.0 else 0.0)
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
            self.follow(way_back(self.context, STOWED))
        else:
            travel = carry_pose(arm)
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
    arm, (_, top_m) = context.body.arm, context.limits.lift_m
    back = replace(arm, extension_m=travel.extension_m)
    if arm.extension_m < CARRY_EXTENSION_M + LENGTH_TOLERANCE_M or arm.wrist_pitch_rad > DOWN_RAD / 2:
        return [back, travel]
    if is_below_board(context):
        off = replace(arm, lift_m=arm.lift_m + OFF_BOARD_M / 2)
        return [off, replace(back, lift_m=off.lift_m), travel]
    up_m = min(max(arm.lift_m + LIFT_M, CARRY_LIFT_M), top_m)
    return [replace(arm, lift_m=up_m), replace(back, lift_m=up_m), travel]


def carry_pose(arm: ArmTarget) -> ArmTarget:
    """The travel pose for something held: retracted, high, the wrist as it is."""
    extension_m = CARRY_EXTENSION_M if arm.wrist_pitch_rad < DOWN_RAD / 2 else 0.0
    return replace(arm, extension_m=extension_m, lift_m=max(CARRY_LIFT_M, min(arm.lift_m, 1.1)))


def is_below_board(context: RobotContext) -> bool:
    """Whether the hand is between the boards of a shelf: it must leave as it came, level-wise."""
    hand = base_pose(context, robot_frame(context.snapshot)) @ context.body.T_base_gripper
    return is_among_boards(context.snapshot, robot_frame(context.snapshot), hand.translation_m)


def is_holding(context: RobotContext) -> bool:
    """Whether the hand holds something, by the grip just made or by the graph."""
    robot = context.snapshot.robot
    return context.grip is not None or (robot is not None and robot.holding is not None)


def avoid_side(context: RobotContext, node_id: str) -> None:
    """Remember that a thing was not got hold of from the side on which the base stands: others are tried first."""
    context.blocked_reaches[node_id, bearing_rad(context, node_id)] = context.stamp_s


def is_firm(body: BodyState) -> bool:
    """Whether both fingers touch something that keeps them apart."""
    return all(body.finger_contacts) and body.gripper_opening_m > EMPTY_OPENING_M


def _reached(arm: ArmTarget, target: ArmTarget) -> bool:
    return (
        abs(arm.lift_m - target.lift_m) < LENGTH_TOLERANCE_M
        and abs(arm.extension_m - target.extension_m) < LENGTH_TOLERANCE_M
        and abs(arm.wrist_pitch_rad - target.wrist_pitch_rad) < ANGLE_TOLERANCE_RAD
        and abs(arm.wrist_roll_rad - target.wrist_roll_rad) < ANGLE_TOLERANCE_RAD
    )


def _hand_x_m(context: RobotContext, target: ArmTarget) -> float:
    geometry = context.geometry
    return geometry.wrist_x_m + target.extension_m + geometry.hand_length_m * cos(target.wrist_pitch_rad)


def _moved(arm: ArmTarget, last: ArmTarget) -> bool:
    lengths = abs(arm.lift_m - last.lift_m) + abs(arm.extension_m - last.extension_m)
    angles = abs(arm.wrist_pitch_rad - last.wrist_pitch_rad) + abs(arm.wrist_roll_rad - last.wrist_roll_rad)
    return lengths > 0.004 or angles > 0.02
