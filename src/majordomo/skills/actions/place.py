"""Putting down: choose a free spot, check it from near, lower onto it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import hypot, sin

import numpy as np
from py_trees.common import Status

from majordomo.scene_graph.nodes import ObjectNode
from majordomo.skills.action import Action, RobotContext
from majordomo.skills.actions.approach import reaches_m, ring
from majordomo.skills.actions.arm import ArmAction, ArmProgress
from majordomo.skills.anchor import Anchor
from majordomo.skills.errors import Unreachable
from majordomo.skills.failures import FailureCode
from majordomo.skills.geometry import Points
from majordomo.skills.grasping import TIP_M
from majordomo.skills.kinematics import arm_target
from majordomo.skills.navigation.local_map import draw_map
from majordomo.skills.navigation.pose import footprint_radius_m, look_around, planar_pose, robot_frame
from majordomo.skills.navigation.route import find_routes
from majordomo.skills.navigation.walls import Walls
from majordomo.skills.place_spot import GAP_M, Spot
from majordomo.skills.ports import ArmTarget

RELEASE_M = -0.004
"""The arm goes this far below the height at which the object should stand, so that it does stand when let go."""
ABOVE_RIM_M = 0.04
HOVER_M = 0.10
TOUCH_M = 0.04
SLOW_M, STEP_M = 0.04, 0.01
"""The last centimeters are lowered step by step, which is slow."""
SPARE_LIFT_M = 0.02
"""A surface may turn out to be a little higher when it is seen from near."""
MOST_SPOTS = 40
TIGHT_M = 0.10
TIGHT_WEIGHT = 3.0
DEFAULT_GRIP_SHARE = 0.6

SpotSource = Callable[[], Sequence[Spot]]
"""Gives the free spots as the graph is now."""


@dataclass(kw_only=True)
class Placement:
    """What the actions of one PLACE share: the object, where it may go, and the spot chosen."""

    object_id: str
    target: str
    spots: SpotSource
    spot: Spot | None = None

    def anchor(self) -> Anchor:
        """The chosen spot; the target itself until one is chosen."""
        return self.spot.anchor if self.spot is not None else Anchor(self.target)


class ChooseSpot(Action):
    """Chooses, among the free spots, the one that is cheapest to reach from here; fails with SUPPORT_FULL."""

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"choose a spot at {placement.target}", context)
        self._placement = placement

    def step(self) -> Status:
        """Work it out at once."""
        if self._placement.target not in self.context.snapshot:
            return self.fail(FailureCode.SUPPORT_GONE, f"{self._placement.target} is no longer in the scene graph.")
        look_around(self.context)
        spots = list(self._placement.spots())
        if not spots:
            return _full(self, self._placement)
        if len(spots) > MOST_SPOTS:
            spots = [spots[int(i)] for i in np.linspace(0, len(spots) - 1, MOST_SPOTS)]
        costs = self._costs(spots)
        best = int(np.argmin(costs))
        if not np.isfinite(costs[best]):
            message = f"there is no free place from which the arm reaches {self._placement.target}."
            return self.fail(FailureCode.UNREACHABLE, message, (self._placement.target,), f"{len(spots)} spots tried")
        self._placement.spot = spots[best]
        return Status.SUCCESS

    def _costs(self, spots: Sequence[Spot]) -> Points:
        """Way to the best place to stand for each spot, plus a little for tight ones, (N,)."""
        snapshot = self.context.snapshot
        frame = robot_frame(snapshot)
        pose = planar_pose(self.context, frame)
        centers = np.array([spot.anchor.position(snapshot, frame)[:2] for spot in spots])
        points = [pose.point, *((float(x), float(y)) for x, y in centers)]
        around = self.context.surroundings.points()
        grid = draw_map(snapshot, frame, around, points, walls=Walls.of(snapshot, frame), stamp_s=self.context.stamp_s)
        routes = find_routes(grid, pose.point, footprint_radius_m(self.context))
        radii_m = reaches_m(self.context, self.context.body.arm.wrist_pitch_rad)[:-1]
        best = np.array([routes.cost_at(ring(center, radii_m)[0]).min() for center in centers])
        best = np.where([self._is_low_enough(spot) for spot in spots], best, np.inf)
        tight = np.array([0.0 if spot.inside else max(TIGHT_M - spot.room_m, 0.0) for spot in spots])
        return np.asarray(best + TIGHT_WEIGHT * tight)

    def _is_low_enough(self, spot: Spot) -> bool:
        """Whether the lift gets the hand with what it holds over the spot."""
        snapshot, arm = self.context.snapshot, self.context.body.arm
        z_m = float(spot.anchor.position(snapshot, robot_frame(snapshot))[2]) + above_bottom_m(self.context)
        lift_m = (
            z_m + (ABOVE_RIM_M if spot.inside else 0.0) - self.context.geometry.hand_length_m * sin(arm.wrist_pitch_rad)
        )
        low_m, high_m = self.context.limits.lift_m
        return low_m <= lift_m <= high_m - SPARE_LIFT_M


class CheckSpot(Action):
    """Looks the chosen spot over once perception has seen it from near; takes another within reach when it is taken."""

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"check the spot at {placement.target}", context)
        self._placement = placement

    def step(self) -> Status:
        """Compare with the free spots of now."""
        chosen = self._placement.spot
        if chosen is None or chosen.anchor.node_id not in self.context.snapshot:
            return self.fail(FailureCode.SUPPORT_GONE, f"{self._placement.target} is no longer in the scene graph.")
        if chosen.inside:
            return Status.SUCCESS
        here = [spot for spot in self._placement.spots() if spot.anchor.node_id == chosen.anchor.node_id]
        reachable = [(self._offset_m(spot, chosen), i) for i, spot in enumerate(here) if self._within_reach(spot)]
        if not reachable:
            return _full(self, self._placement)
        self._placement.spot = here[min(reachable)[1]]
        return Status.SUCCESS

    def _within_reach(self, spot: Spot) -> bool:
        x_m, y_m, _ = spot.anchor.in_base(self.context)
        nearest_m, *_, farthest_m = reaches_m(self.context, self.context.body.arm.wrist_pitch_rad)
        return nearest_m - 0.06 < hypot(x_m, y_m) < farthest_m + 0.06 and spot.room_m >= GAP_M

    @staticmethod
    def _offset_m(spot: Spot, chosen: Spot) -> float:
        (ax, ay, _), (bx, by, _) = spot.anchor.point_m, chosen.anchor.point_m
        return hypot(ax - bx, ay - by) + TIGHT_WEIGHT * max(TIGHT_M - spot.room_m, 0.0)


class LowerToPlace(ArmAction):
    """Brings what the hand holds over the spot ahead and lowers it until it stands; the base already faces the spot."""

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"lower {placement.object_id}", context)
        self._placement = placement
        self._why = ""
        self._standing_lift_m = 0.0

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
        progress = self.move_arm()
        if self.slipped():
            self.context.grip = None
            message = f"{self._placement.object_id} was lost before it stood."
            return self.fail(FailureCode.DROPPED, message, (self._placement.object_id,))
        if progress is ArmProgress.STALLED:
            lowering = self.context.body.arm.lift_m - self._standing_lift_m < TOUCH_M
            return Status.SUCCESS if lowering else self._stopped()
        return Status.SUCCESS if progress is ArmProgress.THERE else Status.RUNNING

    def _stopped(self) -> Status:
        """Fail, and remember where, so that another spot is tried next."""
        spot = self._placement.anchor()
        if not (self._placement.spot is None or self._placement.spot.inside):
            self.context.blocked_spots[spot.node_id, spot.point_m] = self.context.stamp_s
        return self.stalled(self._placement.target)

    def _plan(self) -> tuple[ArmTarget, ...]:
        """Up, out, and down, with the wrist as it is; down only when it is out: drawn in, the hand is over the base."""
        context, arm = self.context, self.context.body.arm
        x_m, y_m, z_m = self._placement.anchor().in_base(context)
        inside = self._placement.spot is not None and self._placement.spot.inside
        pads_z_m = z_m + above_bottom_m(context) + (ABOVE_RIM_M if inside else RELEASE_M)
        pads_z_m = max(pads_z_m, z_m + TIP_M)
        wrist = (arm.wrist_pitch_rad, arm.wrist_roll_rad)
        final = arm_target(hypot(x_m, y_m), pads_z_m, *wrist, context.geometry, context.limits)
        self._standing_lift_m = final.lift_m
        above_m = min(final.lift_m + HOVER_M, context.limits.lift_m[1])
        steps = [replace(final, lift_m=final.lift_m + k * STEP_M) for k in range(int(SLOW_M / STEP_M), -1, -1)]
        highest_m = max(above_m, arm.lift_m)
        way = replace(arm, lift_m=highest_m), replace(final, lift_m=highest_m), replace(final, lift_m=above_m)
        return *way, *steps


def above_bottom_m(context: RobotContext) -> float:
    """Height of the pads over the bottom of what the hand holds."""
    grip, hand = context.grip, context.body.T_base_gripper
    if grip is not None:
        return float(hand.z_m - (hand @ grip.T_gripper_object).z_m + grip.size_m[2] / 2)
    robot = context.snapshot.robot
    node = context.snapshot.get(robot.holding) if robot is not None and robot.holding is not None else None
    return DEFAULT_GRIP_SHARE * node.size_m[2] if isinstance(node, ObjectNode) else 0.1


def _full(action: Action, placement: Placement) -> Status:
    message = f"{placement.target} has no free spot for {placement.object_id}."
    return action.fail(FailureCode.SUPPORT_FULL, message, (placement.target, placement.object_id))
