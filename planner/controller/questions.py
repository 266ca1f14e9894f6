"""The Controller's questions: one small object for each thing that can go wrong while a step is carried out."""

from __future__ import annotations

from dataclasses import dataclass
from math import dist, sqrt
from typing import Protocol

from planner.controller.situation import ExpectedObject, Situation, is_missing, position_in, robot_jump_m, way
from planner.naming import at, name_of, whereabouts
from scene_graph.nodes import ROBOT_ID, DoorNode, DoorState, ObjectNode, ObjectState
from skills.failures import Evidence, Failure, FailureCode


class Question(Protocol):
    """Something that a step counts on. Pure: the same situation, the same answer."""

    def ask(self, situation: Situation) -> Failure | None:
        """``None`` when all is well, else what is amiss and on what evidence."""
        ...


@dataclass(frozen=True, kw_only=True)
class WhereIsTheObject:
    """Objects to be picked up are where the plan found them: not gone, not moved, not on another support.

    ``moved_m``: a smaller shift is left to the skill's own look. ``shifted_m``: less than this with another support is
    the relation changing its mind, not the object its place.
    """

    moved_m: float = 0.3
    shifted_m: float = 0.15

    def ask(self, situation: Situation) -> Failure | None:
        """Ask for every object in turn."""
        for expected in situation.expected.objects:
            if not situation.touches(expected.id):
                failure = self._gone(expected, situation) or self._moved(expected, situation)
                if failure is not None:
                    return failure
        return None

    def _gone(self, expected: ExpectedObject, situation: Situation) -> Failure | None:
        if not is_missing(expected.id, situation.snapshot):
            return None
        name, place = name_of(expected.id, situation.snapshot), _expected_place(expected, situation)
        message = f"{_capital(name)} is no longer {place}; I saw the empty place at {situation.stamp_s:.0f} s."
        return _failure(FailureCode.OBJECT_GONE, message, situation, expected.id, expected.support)

    def _moved(self, expected: ExpectedObject, situation: Situation) -> Failure | None:
        snapshot = situation.snapshot
        now = position_in(expected.id, expected.room, snapshot)
        if expected.position_m is None or now is None:
            return None
        shift_m = dist(expected.position_m, now)
        other_room = snapshot.room_of(expected.id) != expected.room
        support = snapshot.support_of(expected.id)
        other_support = None not in (support, expected.support) and support != expected.support
        if not other_room and shift_m <= (self.shifted_m if other_support else self.moved_m):
            return None
        name, place = name_of(expected.id, snapshot), _expected_place(expected, situation)
        where = whereabouts(expected.id, snapshot)
        new_place = f"I see it {where}" if where != place else f"it has moved by {shift_m:.1f} m"
        message = f"{_capital(name)} is no longer where it was, {place}: {new_place}."
        return _failure(FailureCode.OBJECT_MOVED, message, situation, expected.id, support, saw=f"{shift_m:.2f} m away")


@dataclass(frozen=True, kw_only=True)
class DoIStillHoldIt:
    """What was picked up is still in the gripper, until the skill itself lets go."""

    def ask(self, situation: Situation) -> Failure | None:
        """Compare the graph's ``holding`` with what the plan counts on."""
        held, robot = situation.expected.held, situation.snapshot.robot
        if held is None or robot is None or robot.holding == held:
            return None
        if situation.step.skill != "GOTO" and (situation.gripping != held or situation.status.startswith("releasing")):
            return None
        node, name = situation.snapshot.get(held), _capital(name_of(held, situation.snapshot))
        if isinstance(node, ObjectNode) and node.state is ObjectState.PRESENT:
            message = f"{name} fell out of my gripper; I see it {whereabouts(held, situation.snapshot)}."
            return _failure(FailureCode.DROPPED, message, situation, held)
        return _failure(FailureCode.SLIPPED, f"{name} slipped out of my gripper.", situation, held)


@dataclass(frozen=True, kw_only=True)
class IsTheSupportThere:
    """What an object is to be put on is still there."""

    def ask(self, situation: Situation) -> Failure | None:
        """Ask for every support of the steps to come."""
        for support in situation.expected.supports:
            if is_missing(support, situation.snapshot):
                message = f"{_capital(name_of(support, situation.snapshot))} is not where it was."
                return _failure(FailureCode.SUPPORT_GONE, message, situation, support)
        return None


@dataclass(frozen=True, kw_only=True)
class IsTheWayOpen:
    """No door that is still ahead on the planned way has been closed."""

    def ask(self, situation: Situation) -> Failure | None:
        """Look for a closed door among those of the plan that are still ahead."""
        snapshot = situation.snapshot
        closed = [door for door in situation.expected.doors if _is_closed(door, situation)]
        if not closed:
            return None
        ahead = way(situation.step, snapshot, only_open=False)
        for door in closed:
            if door in ahead:
                message = f"{_capital(name_of(door, snapshot))} has been closed."
                return _failure(FailureCode.DOOR_CLOSED, message, situation, door)
        return None


@dataclass(frozen=True, kw_only=True)
class DoSensorsSpeak:
    """No sensor has been silent for longer than ``silent_s``."""

    silent_s: float = 2.0

    def ask(self, situation: Situation) -> Failure | None:
        """Name the sensor that has been silent longest."""
        ages = situation.sensor_ages_s
        if not ages:
            return None
        sensor, age_s = max(ages.items(), key=lambda item: (item[1], item[0]))
        if age_s <= self.silent_s:
            return None
        message = f"My {sensor} has been silent for {age_s:.1f} s."
        return _failure(FailureCode.SENSOR_SILENT, message, situation, saw=f"{sensor}: newest data {age_s:.2f} s old")


@dataclass(frozen=True, kw_only=True)
class DoIKnowWhereIAm:
    """The robot's position is known better than ``sigma_m`` (one standard deviation, horizontally)."""

    sigma_m: float = 0.5

    def ask(self, situation: Situation) -> Failure | None:
        """Read the covariance of the robot's pose in its room."""
        edge = situation.snapshot.parent(ROBOT_ID)
        if edge is None:
            return None
        sigma_m = sqrt(max(float(edge.covariance[0, 0]), float(edge.covariance[1, 1]), 0.0))
        if sigma_m <= self.sigma_m:
            return None
        message = "I do not know well enough where I am."
        return _failure(FailureCode.LOCALIZATION_LOST, message, situation, ROBOT_ID, saw=f"sigma {sigma_m:.2f} m")


@dataclass(frozen=True, kw_only=True)
class WasIPushed:
    """The robot's pose does not jump: between looks it moves no farther than ``speed_mps`` allows, plus ``jump_m``, and
    into another room only through a door of its way.
    """

    jump_m: float = 0.5
    speed_mps: float = 1.0

    def ask(self, situation: Situation) -> Failure | None:
        """Compare with the pose of the tick before."""
        carried = _carried_into(situation)
        if carried is not None:
            message = f"I was carried into {name_of(carried, situation.snapshot)}."
            return _failure(FailureCode.ROBOT_MOVED, message, situation, ROBOT_ID, carried)
        moved = robot_jump_m(situation.previous, situation.snapshot) if situation.previous is not None else None
        if moved is None or moved[0] <= self.jump_m + self.speed_mps * max(moved[1], 0.0):
            return None
        message = f"I was moved by {moved[0]:.1f} m without driving."
        return _failure(
            FailureCode.ROBOT_MOVED, message, situation, ROBOT_ID, saw=f"{moved[0]:.2f} m in {moved[1]:.2f} s"
        )


@dataclass(frozen=True, kw_only=True)
class IsThereTime:
    """The step has not acted for longer than its time limit."""

    def ask(self, situation: Situation) -> Failure | None:
        """Compare acting time with the limit."""
        if situation.active_s <= situation.timeout_s:
            return None
        message = f"This took longer than {situation.timeout_s:.0f} s."
        return _failure(FailureCode.TIMEOUT, message, situation, saw=f"{situation.active_s:.1f} s")


def _expected_place(expected: ExpectedObject, situation: Situation) -> str:
    place = expected.support or expected.room
    return at(place, situation.snapshot) if place is not None else "where I had seen it"


def _carried_into(situation: Situation) -> str | None:
    """The room that the robot is in now and was not a tick ago, unless a door of its way, or one being crossed, leads
    there.
    """
    before = situation.previous.current_room if situation.previous is not None else None
    now = situation.snapshot.current_room
    if before is None or now is None or before == now or situation.status.startswith("crossing"):
        return None
    doors = (situation.snapshot.get(door) for door in situation.expected.doors)
    through = any(isinstance(door, DoorNode) and {before, now} == set(door.rooms) for door in doors)
    return None if through else now


def _is_closed(door_id: str, situation: Situation) -> bool:
    node = situation.snapshot.get(door_id)
    return isinstance(node, DoorNode) and node.state is DoorState.CLOSED


def _failure(code: FailureCode, message: str, situation: Situation, *nodes: str | None, saw: str = "") -> Failure:
    named = tuple(node for node in nodes if node is not None)
    observation = saw or f"graph revision {situation.snapshot.revision} at {situation.stamp_s:.2f} s"
    evidence = Evidence(nodes=named, revision=situation.snapshot.revision, observation=observation)
    return Failure(code=code, message=message, evidence=evidence)


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]
