"""Putting down: choose a free spot, check it from near, lower onto it."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from math import dist, hypot, inf

import numpy as np
from py_trees.common import Status

from majordomo.scene_graph.nodes import ObjectNode
from majordomo.skills.action import Action, RobotContext
from majordomo.skills.actions.approach import reaches_m, ring
from majordomo.skills.actions.arm import STOWED, ArmAction, ArmProgress
from majordomo.skills.actions.arm_way import (
    nearest_to,
    passing_over,
    people_here,
    routes_around,
    spared_nodes,
    underside_of_held_m,
)
from majordomo.skills.actions.spot_reach import ABOVE_RIM_M, Placement, above_bottom_m, admitted, is_within_lift
from majordomo.skills.boards import TURN_RAD
from majordomo.skills.errors import Unreachable
from majordomo.skills.failures import FailureCode
from majordomo.skills.geometry import Points
from majordomo.skills.grasping import TIP_M
from majordomo.skills.kinematics import arm_target
from majordomo.skills.navigation.pose import look_around, planar_pose, robot_frame
from majordomo.skills.navigation.route import Routes
from majordomo.skills.place_spot import GAP_M, Spot, stands_on
from majordomo.skills.ports import ArmTarget

RELEASE_M = -0.004
"""The arm goes this far below the height at which the object should stand, so that it does stand when let go."""
HOVER_M = 0.10
TOUCH_M, OUT_M = 0.04, 0.02
"""What stops the arm so near above the spot, and so near to it, is the surface."""
SLOW_M, STEP_M = 0.04, 0.01
"""The last centimeters are lowered step by step, which is slow."""
SLACK_RAD = 0.15
"""What the drive to a place may be off, seen from the spot."""
IN_M = 0.03
"""So high over a board, at most, what is held comes in."""
MOST_SPOTS = 40
TIGHT_M = 0.10
TIGHT_WEIGHT = 3.0


class ChooseSpot(Action):
    """Chooses, among the free spots, the one that is cheapest to reach from here.

    Fails with SUPPORT_FULL where there is none, or where other things leave only such as cannot be reached, and with
    PERSON_IN_WAY where one could be reached were it not for somebody who is there.
    """

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"choose a spot at {placement.target}", context)
        self._placement = placement

    def step(self) -> Status:
        """Work it out at once."""
        if self._placement.target not in self.context.snapshot:
            return self.fail(FailureCode.SUPPORT_GONE, f"{self._placement.target} is no longer on my map.")
        look_around(self.context)
        spots = list(self._placement.spots())
        if not spots:
            return _full(self, self._placement)
        spot = self._cheapest(spots)
        if spot is None:
            further = (self._cheapest(others) for others in self._placement.further())
            spot = next((found for found in further if found is not None), None)
        if spot is None:
            return self._out_of_reach(spots)
        self._placement.spot = spot
        return Status.SUCCESS

    def _out_of_reach(self, spots: Sequence[Spot]) -> Status:
        """Fail because of what keeps the robot from all of them: things on the support, people, or the building."""
        target, if_empty, people = self._placement.target, self._placement.spots_if_empty(), people_here(self.context)
        snapshot, frame = self.context.snapshot, robot_frame(self.context.snapshot)
        furniture = isinstance(snapshot.get(target), ObjectNode)
        things = [node.id for node in stands_on(snapshot, target, None)] if furniture else []
        if self._cheapest(if_empty, things=things) is not None:
            return _full(self, self._placement)
        if people and self._cheapest(spots, people=people) is not None:
            person = nearest_to(snapshot, people, spots[0].anchor.position(snapshot, frame), frame)
            message = f"{person} stands where I would have to be, or to reach, to put something down at {target}."
            return self.fail(FailureCode.PERSON_IN_WAY, message, (person, target))
        if people and self._cheapest(if_empty, people=people, things=things) is not None:
            return _full(self, self._placement)
        message = f"there is no free place from which the arm reaches {target}."
        return self.fail(FailureCode.UNREACHABLE, message, (target,), f"{len(spots)} spots tried")

    def _cheapest(
        self, spots: Sequence[Spot], *, people: Sequence[str] = (), things: Sequence[str] = ()
    ) -> Spot | None:
        """The one that is cheapest to reach from here, with as little as may be in the arm's way; ``None`` where none
        can be reached. ``people`` and ``things`` are thought away.
        """
        within = [spot for spot in spots if is_within_lift(self.context, spot)]
        if len(within) > MOST_SPOTS:
            within = [within[int(i)] for i in np.linspace(0, len(within) - 1, MOST_SPOTS)]
        if not within:
            return None
        routes = self._routes(within, people)
        least_m, best = inf, None
        for cost_m, i in sorted((self._cost_m(routes, spot), i) for i, spot in enumerate(within)):
            if cost_m >= least_m:
                break
            if (total_m := self._total_m(routes, within[i], {*people, *things})) < least_m:
                least_m, best = total_m, within[i]
        return best

    def _routes(self, spots: Sequence[Spot], people: Sequence[str]) -> Routes:
        """The ways from here on a map that shows all the spots."""
        snapshot = self.context.snapshot
        frame = robot_frame(snapshot)
        centers = [spot.anchor.position(snapshot, frame) for spot in spots]
        points = [(float(x), float(y)) for x, y, _ in centers]
        return routes_around(self.context, planar_pose(self.context, frame).point, points, spared=people)

    def _cost_m(self, routes: Routes, spot: Spot) -> float:
        """Way to the best place to stand for a spot, plus a little for a tight one."""
        return float(self._ways_m(routes, spot)[1].min()) + self._price_m(spot)

    def _price_m(self, spot: Spot) -> float:
        """What a spot costs wherever one stands: a tight or hidden one is as good as one that is so much farther."""
        tight_m = 0.0 if spot.inside else max(TIGHT_M - spot.room_m, 0.0)
        return TIGHT_WEIGHT * tight_m + self._hidden_m(spot)

    def _ways_m(self, routes: Routes, spot: Spot) -> tuple[Points, Points]:
        """Places (N, 2) from which the hand gets to a spot, and the cost (N,) of the way to each."""
        snapshot = self.context.snapshot
        center = spot.anchor.position(snapshot, robot_frame(snapshot))[:2]
        places = ring(center, reaches_m(self.context, self.context.body.arm.wrist_pitch_rad)[:-1])[0]
        return places, np.where(admitted(self.context, spot, places), routes.cost_at(places), np.inf)

    def _total_m(self, routes: Routes, spot: Spot, spared: Collection[str]) -> float:
        """Cost with what the arm would have to pass over, from the best place to stand."""
        snapshot = self.context.snapshot
        frame = robot_frame(snapshot)
        places, ways_m = self._ways_m(routes, spot)
        reached = np.isfinite(ways_m)
        target = spot.anchor.position(snapshot, frame)
        no_obstacle = spared_nodes(snapshot, self._placement.target, spot.anchor.node_id) | set(spared)
        low_m, stamp_s = underside_of_held_m(float(target[2])), self.context.stamp_s
        over_m = passing_over(snapshot, frame, target, low_m, places[reached], no_obstacle, stamp_s=stamp_s)
        return float((ways_m[reached] + over_m).min()) + self._price_m(spot)

    def _hidden_m(self, spot: Spot) -> float:
        """The lower a board, the more of it the one above hides from the camera: a price, in meters of way."""
        if not spot.is_covered:
            return 0.0
        snapshot = self.context.snapshot
        z_m = float(spot.anchor.position(snapshot, robot_frame(snapshot))[2])
        return max(self.context.geometry.camera_height_m - z_m, 0.0)


class CheckSpot(Action):
    """Looks the chosen spot over once perception has seen it from near; takes another within reach when it is taken."""

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"check the spot at {placement.target}", context)
        self._placement = placement

    def step(self) -> Status:
        """Compare with the free spots of now."""
        chosen = self._placement.spot
        if chosen is None or chosen.anchor.node_id not in self.context.snapshot:
            return self.fail(FailureCode.SUPPORT_GONE, f"{self._placement.target} is no longer on my map.")
        if chosen.inside:
            return Status.SUCCESS
        here = self._placement.spots_at(chosen.anchor.node_id)
        reachable = [(self._offset_m(spot, chosen), i) for i, spot in enumerate(here) if self._within_reach(spot)]
        if not reachable:
            return _full(self, self._placement)
        self._placement.spot = here[min(reachable)[1]]
        return Status.SUCCESS

    def _within_reach(self, spot: Spot) -> bool:
        x_m, y_m, _ = spot.anchor.in_base(self.context)
        nearest_m, *_, farthest_m = reaches_m(self.context, self.context.body.arm.wrist_pitch_rad)
        near = nearest_m - 0.06 < hypot(x_m, y_m) < farthest_m + 0.06 and spot.room_m >= GAP_M
        return near and is_within_lift(self.context, spot) and self._is_before(spot)

    def _is_before(self, spot: Spot) -> bool:
        here = np.array([planar_pose(self.context, robot_frame(self.context.snapshot)).point])
        return bool(admitted(self.context, spot, here, turn_rad=TURN_RAD + SLACK_RAD)[0])

    @staticmethod
    def _offset_m(spot: Spot, chosen: Spot) -> float:
        return dist(spot.anchor.point_m, chosen.anchor.point_m) + TIGHT_WEIGHT * max(TIGHT_M - spot.room_m, 0.0)


class LowerToPlace(ArmAction):
    """Brings what the hand holds over the spot ahead and lowers it until it stands; the base already faces the spot."""

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"lower {placement.object_id}", context)
        self._placement = placement
        self._why = ""
        self._standing = STOWED

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
        out = self._standing.extension_m - arm.extension_m < OUT_M
        return out and arm.lift_m - self._standing.lift_m < TOUCH_M

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
        covered = self._placement.spot is not None and self._placement.spot.is_covered
        # to the sides, the fingers neither push what they leave nor touch the board above
        wrist = (arm.wrist_pitch_rad, 0.0 if covered else arm.wrist_roll_rad)
        final = arm_target(hypot(x_m, y_m), pads_z_m, *wrist, context.geometry, context.limits)
        self._standing = final
        if covered:
            return self._level_way(final)
        above_m = min(final.lift_m + HOVER_M, context.limits.lift_m[1])
        steps = [replace(final, lift_m=final.lift_m + k * STEP_M) for k in range(int(SLOW_M / STEP_M), -1, -1)]
        highest_m = max(above_m, arm.lift_m)
        way = replace(arm, lift_m=highest_m), replace(final, lift_m=highest_m), replace(final, lift_m=above_m)
        return *way, *steps

    def _level_way(self, final: ArmTarget) -> tuple[ArmTarget, ...]:
        """To the height at which it comes in, with the arm drawn in, straight in, and down."""
        over = replace(final, lift_m=final.lift_m + IN_M - RELEASE_M)
        down = [replace(over, lift_m=over.lift_m - k * STEP_M) for k in range(1, int((IN_M - RELEASE_M) / STEP_M) + 1)]
        return replace(over, extension_m=self.context.body.arm.extension_m), over, *down, final


def _full(action: Action, placement: Placement) -> Status:
    message = f"{placement.target} has no free spot for {placement.object_id}."
    return action.fail(FailureCode.SUPPORT_FULL, message, (placement.target, placement.object_id))
