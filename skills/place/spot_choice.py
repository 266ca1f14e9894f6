"""Where to put down what the hand holds: a free spot that the arm reaches, looked over again from near."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from itertools import chain
from math import dist, hypot, inf

import numpy as np
from py_trees.common import Status

from scene_graph.nodes import ObjectNode
from skills.action import Action, RobotContext
from skills.arm.approach import reaches_m, ring
from skills.arm.arm_way import (
    nearest_to,
    passing_over,
    people_here,
    routes_around,
    spared_nodes,
    underside_of_held_m,
)
from skills.failures import FailureCode
from skills.furniture.standing import stands_on
from skills.geometry import Points
from skills.navigation.pose import look_around, planar_pose, robot_frame
from skills.navigation.route import Routes
from skills.place.place_spot import Spot
from skills.place.seen_in_way import Seen
from skills.place.settings import PutDownSettings
from skills.place.spot_reach import Placement, admitted, is_within_lift, pressing_m


class ChooseSpot(Action):
    """Chooses, among the free spots, the one that is cheapest to reach from here.

    Fails with SUPPORT_FULL where there is none, or where other things leave only such as cannot be reached, and with
    PERSON_IN_WAY where one could be reached were it not for somebody who is there.
    """

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"choose a spot at {placement.target}", context)
        self._placement, self._settings = placement, context.settings.place.put_down

    def step(self) -> Status:
        """Work it out at once."""
        if self._placement.target not in self.context.snapshot:
            return self.fail(FailureCode.SUPPORT_GONE, f"{self._placement.target} is no longer on my map.")
        look_around(self.context)
        spots = list(self._placement.spots())
        if not spots:
            return _full(self, self._placement)
        found = (self._cheapest(group) for group in chain([spots], self._placement.further()))
        spot = _first_unbarred((best for best in found if best is not None), self.context.settings.reach.barred_cost_m)
        if spot is None:
            return self._out_of_reach(spots)
        self._placement.spot = spot
        return Status.SUCCESS

    def _out_of_reach(self, spots: Sequence[Spot]) -> Status:
        """Fail because of what keeps the robot from all of them: people, who go on by themselves, or things on the
        support, or the building.
        """
        target, if_empty, people = self._placement.target, self._placement.spots_if_empty(), people_here(self.context)
        snapshot, frame = self.context.snapshot, robot_frame(self.context.snapshot)
        furniture = isinstance(snapshot.get(target), ObjectNode)
        things = [node.id for node in stands_on(snapshot, target, None)] if furniture else []
        if people and self._cheapest(spots, people=people) is not None:
            person = nearest_to(snapshot, people, spots[0].anchor.position(snapshot, frame), frame)
            message = f"{person} stands where I would have to be, or to reach, to put something down at {target}."
            return self.fail(FailureCode.PERSON_IN_WAY, message, (person, target))
        if self._cheapest(if_empty, people=people, things=things) is not None:
            return _full(self, self._placement)
        message = f"there is no free place from which the arm reaches {target}."
        return self.fail(FailureCode.UNREACHABLE, message, (target,), f"{len(spots)} spots tried")

    def _cheapest(
        self, spots: Sequence[Spot], *, people: Sequence[str] = (), things: Sequence[str] = ()
    ) -> tuple[float, Spot] | None:
        """The one that is cheapest to reach from here, with as little as may be in the arm's way, after what it costs;
        ``None`` where none can be reached. ``people`` and ``things`` are thought away.
        """
        within = [spot for spot in spots if is_within_lift(self.context, spot)]
        if len(within) > self._settings.most_spots:
            within = [within[int(i)] for i in np.linspace(0, len(within) - 1, self._settings.most_spots)]
        if not within:
            return None
        routes = self._routes(within, people)
        least_m, best, spared = inf, None, {*people, *things}
        for cost_m, i in sorted((self._cost_m(routes, spot, spared), i) for i, spot in enumerate(within)):
            if cost_m >= least_m:
                break
            if (total_m := self._total_m(routes, within[i], spared)) < least_m:
                least_m, best = total_m, within[i]
        return None if best is None else (least_m, best)

    def _routes(self, spots: Sequence[Spot], people: Sequence[str]) -> Routes:
        """The ways from here on a map that shows all the spots."""
        snapshot = self.context.snapshot
        frame = robot_frame(snapshot)
        centers = [spot.anchor.position(snapshot, frame) for spot in spots]
        points = [(float(x), float(y)) for x, y, _ in centers]
        return routes_around(self.context, planar_pose(self.context, frame).point, points, spared=people)

    def _cost_m(self, routes: Routes, spot: Spot, spared: Collection[str]) -> float:
        """Way to the best place to stand for a spot, plus a little for a tight one."""
        return float(self._ways_m(routes, spot, spared)[1].min()) + self._price_m(spot)

    def _price_m(self, spot: Spot) -> float:
        """What a spot costs wherever one stands: a tight or hidden one, or one before other things, is as good as one
        that is so much farther.
        """
        return _crowding_m(spot, self._settings) + self._hidden_m(spot)

    def _ways_m(self, routes: Routes, spot: Spot, spared: Collection[str]) -> tuple[Points, Points]:
        """Places (N, 2) from which the hand gets to a spot, and the cost (N,) of the way to each."""
        snapshot = self.context.snapshot
        center = spot.anchor.position(snapshot, robot_frame(snapshot))[:2]
        radii_m = reaches_m(self.context, self.context.body.arm.wrist_pitch_rad)[:-1]
        places = ring(center, radii_m, self.context.settings.approach.angles)[0]
        free = admitted(self.context, spot, places, spared=spared)
        return places, np.where(free, routes.cost_at(places), np.inf)

    def _total_m(self, routes: Routes, spot: Spot, spared: Collection[str]) -> float:
        """Cost with what the arm would have to pass over, from the best place to stand."""
        places, ways_m = self._ways_m(routes, spot, spared)
        reached = np.isfinite(ways_m)
        over_m = _reaching_m(self.context, self._placement, spot, places[reached], spared=spared)
        return float((ways_m[reached] + over_m).min()) + self._price_m(spot)

    def _hidden_m(self, spot: Spot) -> float:
        """The lower a board, the more of it the one above hides from the camera: a price, in meters of way."""
        if not spot.is_covered:
            return 0.0
        snapshot = self.context.snapshot
        z_m = float(spot.anchor.position(snapshot, robot_frame(snapshot))[2])
        return max(self.context.geometry.camera_height_m - z_m, 0.0)


class CheckSpot(Action):
    """Looks the chosen spot over once perception has seen it from near; takes another within reach when it is taken.

    Fails with SUPPORT_FULL where there is none any more, or where the camera sees something in the way to all that are
    in view which the graph does not have yet.
    """

    def __init__(self, context: RobotContext, placement: Placement) -> None:
        super().__init__(f"check the spot at {placement.target}", context)
        self._placement, self._settings = placement, context.settings.place.put_down

    def step(self) -> Status:
        """Compare with the free spots of now."""
        chosen = self._placement.spot
        if chosen is None or chosen.anchor.node_id not in self.context.snapshot:
            return self.fail(FailureCode.SUPPORT_GONE, f"{self._placement.target} is no longer on my map.")
        if chosen.inside:
            return Status.SUCCESS
        here = self._placement.spots_at(chosen.anchor.node_id)
        within = [(self._offset_m(spot, chosen), i) for i, spot in enumerate(here) if self._within_reach(spot)]
        if not within:
            return _full(self, self._placement)
        seen, least_m, best = Seen(self.context, self._placement.target), inf, None
        for offset_m, i in sorted(within):
            if offset_m >= least_m:
                break
            cost_m = offset_m + self._over_m(here[i])
            if cost_m < least_m and not seen.is_in_way_to(here[i]) and self._is_looked_at(here[i], chosen, seen):
                least_m, best = cost_m, i
        if best is None:
            self.context.blocked_spots[chosen.anchor.node_id, chosen.anchor.point_m] = self.context.stamp_s
            return _full(self, self._placement, "I see something there that I do not know yet")
        self._placement.spot = here[best]
        return Status.SUCCESS

    def _is_looked_at(self, spot: Spot, chosen: Spot, seen: Seen) -> bool:
        """What is not about where the robot looks must be seen to be there; what is may be behind its hand."""
        near = dist(spot.anchor.point_m, chosen.anchor.point_m) < self._settings.looked_at_m
        return near or spot.is_covered or seen.shows(spot)

    def _within_reach(self, spot: Spot) -> bool:
        x_m, y_m, _ = spot.anchor.in_base(self.context)
        nearest_m, *_, farthest_m = reaches_m(self.context, self.context.body.arm.wrist_pitch_rad)
        slack_m, gap_m = self._settings.slack_m, self.context.settings.place.spots.gap_m
        near = nearest_m - slack_m < hypot(x_m, y_m) < farthest_m + slack_m and spot.room_m >= gap_m
        return near and is_within_lift(self.context, spot) and self._is_before(spot)

    def _is_before(self, spot: Spot) -> bool:
        return bool(admitted(self.context, spot, self._here(), slack_rad=self._settings.slack_rad)[0])

    def _over_m(self, spot: Spot) -> float:
        """What it costs that the arm passes over things on its way from here."""
        return float(_reaching_m(self.context, self._placement, spot, self._here())[0])

    def _here(self) -> Points:
        return np.array([planar_pose(self.context, robot_frame(self.context.snapshot)).point])

    def _offset_m(self, spot: Spot, chosen: Spot) -> float:
        return dist(spot.anchor.point_m, chosen.anchor.point_m) + _crowding_m(spot, self._settings)


def _reaching_m(
    context: RobotContext, placement: Placement, spot: Spot, places: Points, *, spared: Collection[str] = ()
) -> Points:
    """What it costs, (N,), that the arm passes over things on its way to a spot straight from (N, 2) places, or that
    the hand comes down on some.
    """
    snapshot = context.snapshot
    target = spot.anchor.position(snapshot, robot_frame(snapshot))
    no_obstacle = spared_nodes(snapshot, placement.target, spot.anchor.node_id) | set(spared)
    over_m = passing_over(context, target, underside_of_held_m(context, float(target[2])), places, no_obstacle)
    return over_m + pressing_m(context, spot, places, spared=spared)


def _first_unbarred(choices: Iterable[tuple[float, Spot]], barred_cost_m: float) -> Spot | None:
    """Of spots, each after what it costs, the first to which the arm gets without meeting anything, else the first."""
    first: Spot | None = None
    for cost_m, spot in choices:
        if cost_m < barred_cost_m:
            return spot
        first = first or spot
    return first


def _crowding_m(spot: Spot, settings: PutDownSettings) -> float:
    """What it costs, in meters of way, that there is little air around a spot, or that it is before other things."""
    tight_m = 0.0 if spot.inside else max(settings.tight_m - spot.air_m, 0.0)
    return settings.tight_weight * tight_m + settings.barring_cost_m * spot.bars


def _full(action: Action, placement: Placement, seen: str = "") -> Status:
    message = f"{placement.target} has no free spot for {placement.object_id}."
    return action.fail(FailureCode.SUPPORT_FULL, message, (placement.target, placement.object_id), seen)
