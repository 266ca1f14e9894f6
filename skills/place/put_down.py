"""Putting down: lower what the hand holds onto the spot that was chosen."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, sin

from py_trees.common import Status

from skills.action import RobotContext
from skills.arm.arm import ArmAction, ArmProgress
from skills.arm.arm_way import clear_over_m
from skills.arm.held import above_bottom_m, held_radius_m
from skills.arm.kinematics import arm_target
from skills.errors import Unreachable
from skills.failures import FailureCode
from skills.place.spot_reach import Placement, roll_at
from skills.ports import ArmTarget


class LowerToPlace(ArmAction):
    """Brings what the hand holds over the spot ahead and lowers it until it stands; the base already faces the spot."""

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"lower {placement.object_id}", context)
        self._placement, self._lowering = placement, context.settings.place.put_down
        self._why = ""
        self._standing = self.settings.stowed

    def begin(self) -> None:
        """Work out the arm's targets."""
        self._why = ""
        place = self._placement.anchor().node_id
        self.context.announce(f"releasing {self._placement.object_id} {place}")
        self.follow([])
        try:
            self.follow(self._plan())
        except Unreachable as error:
            self._why = str(error)

    def step(self) -> Status:
        """Move; standing on the surface a little early is fine, losing the object is not."""
        if self._why:
            return self.fail(
                FailureCode.UNREACHABLE, f"{self._placement.target}: {self._why}.", (self._placement.target,)
            )
        if (person := self.meets_person()) is not None:
            return self.wait_for(person, self._placement.target)
        progress = self.move_arm()
        if self.slipped():
            self.context.grip = None
            message = f"{self._placement.object_id} was lost before it stood."
            return self.fail(FailureCode.DROPPED, message, (self._placement.object_id,))
        if progress is ArmProgress.STALLED:
            return Status.SUCCESS if self._stands() else self._stopped()
        return Status.SUCCESS if progress is ArmProgress.THERE else Status.RUNNING

    def _stands(self) -> bool:
        """Whether what stopped the arm is the surface: it is out over the spot, and nearly down."""
        arm = self.context.body.arm
        out = self._standing.extension_m - arm.extension_m < self._lowering.out_m
        return out and arm.lift_m - self._standing.lift_m < self._lowering.touch_m

    def _stopped(self) -> Status:
        """Fail, and remember where, so that another spot is tried next."""
        spot = self._placement.anchor()
        if not (self._placement.spot is None or self._placement.spot.inside):
            self.context.blocked_spots[spot.node_id, spot.point_m] = self.context.stamp_s
        return self.stalled(self._placement.target)

    def _plan(self) -> tuple[ArmTarget, ...]:
        """Up, out, and down, with the wrist as it is unless what is held must be turned to fit, which is done out
        there; down only when it is out: drawn in, the hand is over the base.
        """
        context, arm, settings = self.context, self.context.body.arm, self._lowering
        x_m, y_m, z_m = self._placement.anchor().in_base(context)
        spot = self._placement.spot
        over_m = settings.above_rim_m if spot is not None and spot.inside else settings.release_m
        pads_z_m = max(z_m + above_bottom_m(context) + over_m, z_m + context.hand.tip_m)
        covered = spot is not None and spot.is_covered
        roll_rad = arm.wrist_roll_rad if spot is None else roll_at(context, spot)
        # to the sides, the fingers neither push what they leave nor touch the board above
        wrist = (arm.wrist_pitch_rad, 0.0 if covered else roll_rad)
        final = arm_target(hypot(x_m, y_m), pads_z_m, *wrist, context.geometry, context.limits)
        self._standing = final
        if covered:
            return self._level_way(final)
        above_m = min(final.lift_m + settings.hover_m, context.limits.lift_m[1])
        count = int(settings.slow_m / settings.step_m)
        steps = [replace(final, lift_m=final.lift_m + k * settings.step_m) for k in range(count, -1, -1)]
        radius_m = held_radius_m(context)
        over_m = clear_over_m(context, hypot(x_m, y_m), self._placement.target, held_radius_m=radius_m)
        over_m += above_bottom_m(context)
        clear_m = over_m - context.geometry.hand_length_m * sin(arm.wrist_pitch_rad)
        highest_m = max(above_m, arm.lift_m, min(clear_m, context.limits.lift_m[1]))
        out = replace(final, lift_m=highest_m)
        way = replace(arm, lift_m=highest_m), replace(out, wrist_roll_rad=arm.wrist_roll_rad), out
        return *way, replace(final, lift_m=above_m), *steps

    def _level_way(self, final: ArmTarget) -> tuple[ArmTarget, ...]:
        """To the height at which it comes in, with the arm drawn in, straight in, and down."""
        settings = self._lowering
        over_m = settings.in_m - settings.release_m
        over = replace(final, lift_m=final.lift_m + over_m)
        steps = range(1, int(over_m / settings.step_m) + 1)
        down = [replace(over, lift_m=over.lift_m - k * settings.step_m) for k in steps]
        return replace(over, extension_m=self.context.body.arm.extension_m), over, *down, final
