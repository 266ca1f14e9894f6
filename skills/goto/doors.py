"""Doors: stand in front of one, and drive straight through, beside what lies in the way where that leaves room.

A door's frame has its origin at the gap's center on the floor, y into the room it belongs to. Here the *axis* of a
crossing has x in the direction of travel and y to the left, so that progress, offset and heading error are one pose.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import atan2, cos, hypot, pi

import numpy as np
from py_trees.common import Status

from scene_graph.edges import EdgeType
from scene_graph.nodes import PersonNode
from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.failures import FailureCode
from skills.geometry import Points, Pose2, wrap_rad
from skills.goto.lanes import Lane, clear_lane
from skills.navigation.driver import Driver, Progress
from skills.navigation.driving import DriveTo
from skills.navigation.goals import at_poses
from skills.navigation.plan import GoalSource
from skills.navigation.pose import footprint_radius_m, in_base, look_around, planar_pose, robot_frame
from skills.navigation.pursuit import turn_rate
from skills.navigation.safety import admissible
from skills.navigation.settings import DriverSettings
from skills.obstacles.cells import CELL_M
from skills.obstacles.local_map import standing


class ApproachDoor(DriveTo):
    """Drives to the place in front of a door from which it is crossed, facing it."""

    def __init__(self, context: RobotContext, door_id: str) -> None:
        super().__init__(context, door_id, _in_front(context, door_id))
        self.name = f"approach {door_id}"

    def fail(self, code: FailureCode, message: str, nodes: Sequence[str] = (), observation: str = "") -> Status:
        """Record why, and that this door is blocked if it is."""
        _note_blocked(self.context, self.target, code)
        return super().fail(code, message, nodes, observation)


class CrossDoor(Action):
    """Drives through a door along its axis until the base stands ``beyond_m`` beyond the wall, by default 0.9 m.

    Where something lies in the way it drives beside the axis or aslant to it, as near to it as there is room, and lines
    up again for that. When the robot is placed into the far room on the way, it goes on by that room's own node of the
    same door. Fails with DOOR_CLOSED, PERSON_IN_WAY or WAY_BLOCKED, and then backs out of the gap first.
    """

    timeout_s = 60.0

    def __init__(self, context: RobotContext, door_id: str, *, beyond_m: float | None = None) -> None:
        super().__init__(f"cross {door_id}", context)
        self.door_id = door_id
        self._settings = settings = context.settings.goto.crossing
        self._beyond_m = settings.lanes.beyond_m if beyond_m is None else beyond_m
        self._driver: Driver | None = None
        self._free_s = 0.0
        self._giving_up: tuple[FailureCode, str] | None = None
        self._lane, self._lanes = self._straight(), 0
        self._anew = self._squeezes = self._foresaw = False

    def fail(self, code: FailureCode, message: str, nodes: Sequence[str] = (), observation: str = "") -> Status:
        """Record why, and that this door is blocked if it is."""
        _note_blocked(self.context, self.door_id, code)
        return super().fail(code, message, nodes, observation)

    def begin(self) -> None:
        """Say which door, and line up first when not in front of it."""
        self._free_s, self._giving_up, self._driver = self.context.stamp_s, None, None
        self._lane, self._lanes = self._straight(), 0
        self._anew = self._squeezes = self._foresaw = False
        self.context.announce(f"crossing {self.door_id}")
        if self.door_id in self.context.snapshot and not self._lined_up(self._base_on_axis()):
            self._line_up_on(self._straight())

    def _straight(self) -> Lane:
        return Lane(settings=self._settings.lanes)

    def _line_up_on(self, lane: Lane) -> None:
        self._lane = lane
        source = _in_front(self.context, self.door_id, lane)
        self._driver = Driver(self.context, source, settings=_lining_up(self.context))

    def step(self) -> Status:
        """Line up, then drive along the axis."""
        if self.door_id not in self.context.snapshot:
            return self.fail(FailureCode.WAY_BLOCKED, f"{self.door_id} is no longer on my map.")
        if self._driver is not None:
            return self._line_up(self._driver)
        look_around(self.context)
        base = self._base_on_axis()
        if self._anew:
            return self._begin_anew(base)
        if self._giving_up is not None:
            return self._back_out(base, *self._giving_up)
        if base.x_m - self._settings.lanes.wall_m >= self._beyond_m:
            return Status.SUCCESS
        return Status.RUNNING if self._foresees(base) else self._advance(base)

    def _line_up(self, driver: Driver) -> Status:
        progress = driver.step()
        if progress in (Progress.NO_WAY, Progress.BLOCKED):
            return self.fail(FailureCode.WAY_BLOCKED, f"no free way leads in front of {self.door_id}.", (self.door_id,))
        if progress is Progress.ARRIVED:
            self._driver, self._free_s = None, self.context.stamp_s
        return Status.RUNNING

    def _foresees(self, base: Pose2) -> bool:
        """Whether what is seen from before the door lies in the way and leaves room beside: that lane is taken at once,
        but for a person, who gets time to move away.
        """
        if self._foresaw or base.x_m > -self.context.limits.footprint_radius_m:
            return False
        self._foresaw = True
        points = base.apply(self._points_base())
        if self._lane.is_clear(points, self._radius_m(), base.x_m) or self._person_in_gap() is not None:
            return False
        lane = self._clear_lane(base)
        if lane is None or lane.is_like(self._lane):
            return False
        self._lanes += 1
        self._line_up_on(lane)
        return True

    def _advance(self, base: Pose2) -> Status:
        context, settings = self.context, self._settings
        aim_m = self._lane.y_m(base.x_m + settings.look_ahead_m)
        error = wrap_rad(atan2(aim_m - base.y_m, settings.look_ahead_m) - base.yaw_rad)
        turning = abs(error) > settings.turn_in_place_rad
        fastest_mps = settings.squeeze_mps if self._squeezes else settings.speed_mps
        speed = 0.0 if turning else fastest_mps * max(cos(2 * error), 0.3)
        wanted = (speed, turn_rate(error, context.limits))
        linear, angular = self._admissible(*wanted)
        context.commands.drive = (linear, angular)
        if turning or linear > 0:
            self._free_s = context.stamp_s
            return Status.RUNNING
        return self._blocked(base)

    def _blocked(self, base: Pose2) -> Status:
        """Something is ahead: a closed door is told at once, anything else gets time to move away."""
        waited_s = self.context.stamp_s - self._free_s
        if base.x_m - self._settings.lanes.wall_m > self.context.limits.footprint_radius_m + 0.05:
            return Status.SUCCESS  # through the wall already; what blocks stands in the far room
        if waited_s > self._settings.closed_s and self._panel_share() >= self._settings.panel_share:
            self._giving_up = (FailureCode.DOOR_CLOSED, f"{self.door_id} is closed.")
        elif waited_s > self._settings.patience_s and not self._takes_another_lane(base):
            person = self._person_in_gap()
            if person is not None:
                self._giving_up = (FailureCode.PERSON_IN_WAY, f"{person} stands in {self.door_id}.")
            else:
                self._giving_up = (FailureCode.WAY_BLOCKED, f"something blocks {self.door_id}.")
        return Status.RUNNING

    def _takes_another_lane(self, base: Pose2) -> bool:
        """Whether there is a lane that has not been tried; where none is clear, one that is clear for the bare body."""
        if self._lanes == self._settings.tries:
            return False
        self._lanes += 1
        lane = self._clear_lane(base)
        if lane is None and not self._squeezes:
            self._squeezes = True
            lane = self._clear_lane(base)
        if lane is None or (lane.is_like(self._lane) and not self._squeezes):
            return False
        self._lane, self._anew = lane, True
        return True

    def _begin_anew(self, base: Pose2) -> Status:
        """Leave the gap backwards and line up for another lane."""
        if self._is_out(base):
            self._anew = False
            self._line_up_on(self._lane)
        return Status.RUNNING

    def _back_out(self, base: Pose2, code: FailureCode, message: str) -> Status:
        """Leave the gap backwards before failing, so that the next plan starts from open floor."""
        if self._is_out(base):
            share = f"points fill {100 * self._panel_share():.0f} % of the gap"
            return self.fail(code, message, (self.door_id,), share)
        return Status.RUNNING

    def _is_out(self, base: Pose2) -> bool:
        """Whether the base stands before the gap; drives it backwards as long as it does not and can."""
        linear, _ = self._admissible(-0.15, 0.0)
        if linear == 0.0 or base.x_m < -0.55:
            return True
        self.context.commands.drive = (linear, 0.0)
        return False

    def _clear_lane(self, base: Pose2) -> Lane | None:
        """The lane on which the way from here on is clear; ``None`` where none is."""
        half_m = self._radius_m() + (0.0 if self._squeezes else self._settings.lane_spare_m)
        width_m = self.context.snapshot.door(self.door_id).width_m
        points = base.apply(self._points_base())
        return clear_lane(points, half_m=half_m, width_m=width_m, base_x_m=base.x_m, settings=self._settings.lanes)

    def _lined_up(self, base: Pose2) -> bool:
        in_front = -1.3 < base.x_m < -0.35 and abs(base.y_m) < 0.10
        return in_front or (base.x_m >= -0.35 and abs(base.y_m) < 0.20)

    def _base_on_axis(self) -> Pose2:
        """Pose of the base on the crossing's axis; x is 0 at the near face of the wall."""
        snapshot = self.context.snapshot
        tracked = tracked_door(snapshot, self.door_id)
        base = Pose2.of(in_base(self.context, tracked).inverse())
        if tracked == self.door_id:
            return Pose2(-base.y_m, base.x_m, wrap_rad(base.yaw_rad + pi / 2))
        return Pose2(base.y_m + self._settings.lanes.wall_m, -base.x_m, wrap_rad(base.yaw_rad - pi / 2))

    def _admissible(self, linear_mps: float, angular_radps: float) -> tuple[float, float]:
        context = self.context
        safety = context.settings.navigation.safety
        return admissible(linear_mps, angular_radps, self._points_base(), self._radius_m(), context.limits, safety)

    def _points_base(self) -> Points:
        """What was hit lately, and around what is known to lie on the floor of both rooms, which is soon overlooked."""
        context, snapshot = self.context, self.context.snapshot
        frame = robot_frame(snapshot)
        rooms = {snapshot.door(door).rooms[0] for door in (self.door_id, *twins_of(snapshot, self.door_id))}
        low = [
            box.outline(CELL_M)
            for box in standing(snapshot, frame, small_only=True, rooms=rooms, settings=context.settings.obstacles.map)
        ]
        return planar_pose(context, frame).inverse_apply(np.concatenate([context.surroundings.points(), *low]))

    def _radius_m(self) -> float:
        return footprint_radius_m(self.context) - (
            self.context.settings.navigation.plan.squeeze_m if self._squeezes else 0.0
        )

    def _panel_share(self) -> float:
        """Share of the gap's width that the newest scan's high points fill within the wall, but for those on people."""
        door = self.context.snapshot.door(self.door_id)
        points, settings = self.context.obstacles_base, self._settings
        low, high = settings.panel_heights
        tall = (points[:, 2] > low * door.height_m) & (points[:, 2] < high * door.height_m)
        on_axis = self._base_on_axis().apply(self._beside_people(points[tall, :2]))
        within = on_axis[(on_axis[:, 0] > -0.10) & (on_axis[:, 0] < settings.lanes.wall_m + 0.10)]
        half_m = door.width_m / 2 - settings.panel_bin_m
        edges = np.arange(-half_m, half_m + 1e-9, settings.panel_bin_m)
        return float((np.histogram(within[:, 1], edges)[0] > 0).mean())

    def _beside_people(self, points: Points) -> Points:
        """Those of ``points`` (N, 2) in the base's frame that are not on somebody whom the robot knows."""
        people = [in_base(self.context, person.id) for person in self.context.snapshot.of_type(PersonNode)]
        for T_base_person in people:
            points = points[
                np.hypot(points[:, 0] - T_base_person.x_m, points[:, 1] - T_base_person.y_m) > self._settings.person_m
            ]
        return points

    def _person_in_gap(self) -> str | None:
        snapshot = self.context.snapshot
        for person in snapshot.of_type(PersonNode):
            x_m, y_m, _ = snapshot.position(person.id, self.door_id)
            if hypot(x_m, y_m) < 1.0:
                return person.id
        return None


class EnterRoom(Action):
    """Waits until the graph places the robot in a room it has just driven into; goes on anyway after a while."""

    def __init__(self, context: RobotContext, room: str, patience_s: float = 4.0) -> None:
        super().__init__(f"enter {room}", context)
        self.room, self._patience_s = room, patience_s

    def step(self) -> Status:
        """Wait."""
        arrived = self.context.snapshot.current_room == self.room
        return Status.SUCCESS if arrived or self.elapsed_s > self._patience_s else Status.RUNNING


def _note_blocked(context: RobotContext, door_id: str, code: FailureCode) -> None:
    if code is FailureCode.WAY_BLOCKED:
        context.blocked_doors[door_id] = context.stamp_s


def tracked_door(snapshot: Snapshot, door_id: str) -> str:
    """The node of the same physical door that belongs to the robot's room; ``door_id`` itself when none does."""
    own_room, room = snapshot.door(door_id).rooms[0], snapshot.current_room
    if room == own_room:
        return door_id
    twins = [twin for twin in twins_of(snapshot, door_id) if snapshot.door(twin).rooms[0] == room]
    return twins[0] if twins else door_id


def twins_of(snapshot: Snapshot, door_id: str) -> list[str]:
    """Other nodes of the same physical door."""
    found = [edge.target for edge in snapshot.edges_from(door_id, EdgeType.MATCH)]
    return sorted(found + [edge.source for edge in snapshot.edges_to(door_id, EdgeType.MATCH)])


def _in_front(context: RobotContext, door_id: str, lane: Lane | None = None) -> GoalSource:
    settings = context.settings.goto.crossing
    lane = lane or Lane(settings=settings.lanes)
    fronts_m = (settings.lanes.front_m, *settings.other_fronts_m)
    places = [(x_m, y_m) for x_m in settings.aside_m for y_m in fronts_m]
    places += [(x_m, y_m) for y_m in settings.thresholds_m for x_m in settings.aside_m]
    heading_rad = lane.bearing_rad - pi / 2
    return at_poses(context, door_id, [(lane.y_m(-y_m) + x_m, y_m, heading_rad) for x_m, y_m in places])


def _lining_up(context: RobotContext) -> DriverSettings:
    return replace(context.settings.navigation.driver, position_m=context.settings.goto.crossing.position_m)
