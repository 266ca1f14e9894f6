"""What a mission is to come to, in the simulator's truth, and whether it did."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from planner.tasks.tasks import Task, TaskStatus
from simulation.houses.house import Furniture, House, room_at

HAND = "hand"
ROBOT = "robot"


@dataclass(frozen=True, kw_only=True)
class JudgingSettings:
    """Tolerances in the simulator's truth."""

    arms_length_m: float = 2.0
    """A thing is with a person when it is at most so far from where they stand: a step, and an arm's length."""
    stirred_m: float = 0.3
    """What is farther than this from where it was has been moved, and not merely nudged."""


@dataclass(frozen=True, kw_only=True)
class Scene:
    """The simulator's truth at one time, and the house it is about."""

    house: House
    truth: Mapping[str, Any]
    judging: JudgingSettings = field(default_factory=JudgingSettings)

    def thing(self, name: str) -> Mapping[str, Any] | None:
        """The record of a thing that can be moved; None once it is gone."""
        return next((record for record in self.truth["objects"] if record["id"] == name), None)

    def carriers(self, name: str) -> tuple[str, ...]:
        """What carries a thing: what it is on or in, what that is on, and so on; the nearest first."""
        found: list[str] = []
        record = self.thing(name)
        while record is not None:
            carrier = record["on"] or record["in"]
            if carrier is None or carrier in found:
                break
            found.append(carrier)
            record = self.thing(carrier)
        return tuple(found)

    def furniture(self, name: str) -> Furniture | None:
        """A piece of the house's furniture."""
        return next((item for item in self.house.furniture if item.id == name), None)

    def where(self, name: str) -> tuple[float, float] | None:
        """Where a thing, piece of furniture or person is, in the house."""
        record = self.thing(name)
        person = next((entry for entry in self.truth["people"] if entry["id"] == name), None)
        item = self.furniture(name)
        place = (
            record["position_m"] if record is not None else person["position_m"] if person is not None
            else item.pose if item is not None else None
        )  # fmt: skip
        return None if place is None else (place[0], place[1])

    @property
    def robot_at(self) -> tuple[float, float]:
        """Where the robot is, in the house."""
        x_m, y_m, _ = self.truth["robot"]["pose"]
        return x_m, y_m

    @property
    def robot_room(self) -> str | None:
        """Where the robot is."""
        return room_at(self.house, *self.robot_at)

    @property
    def holding(self) -> str | None:
        """What is between its fingers."""
        held: str | None = self.truth["robot"]["holding"]
        return held

    def is_at(self, thing: str, place: str) -> bool:
        """Whether a thing is at a place: in the hand, on or in furniture or another thing, in a room, with a person."""
        record = self.thing(thing)
        if record is None:
            return False
        if place == HAND or self.holding == thing:
            return place == HAND and self.holding == thing
        if any(room.id == place for room in self.house.rooms):
            return bool(record["room"] == place)
        person = next((entry for entry in self.truth["people"] if entry["id"] == place), None)
        if person is not None:
            return math.dist(record["position_m"][:2], person["position_m"]) <= self.judging.arms_length_m
        return place in self.carriers(thing)


@dataclass(frozen=True, kw_only=True)
class Placed:
    """``count`` of ``things``, all by default, are at one of ``places`` each."""

    things: tuple[str, ...]
    places: tuple[str, ...]
    count: int | None = None

    def met(self, scene: Scene) -> bool:
        """Whether it is so."""
        there = sum(any(scene.is_at(thing, place) for place in self.places) for thing in self.things)
        return there == (len(self.things) if self.count is None else self.count)


@dataclass(frozen=True, kw_only=True)
class RobotIn:
    """The robot is in one of these rooms."""

    rooms: tuple[str, ...]

    def met(self, scene: Scene) -> bool:
        """Whether it is so."""
        return scene.robot_room in self.rooms


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """One of the ways in which a mission may end well: all of ``states`` hold, and the reply has all of ``words``.

    ``refused``: it is to end without being done, and nothing is to move.
    """

    states: tuple[Placed | RobotIn, ...] = ()
    words: tuple[str, ...] = ()
    refused: bool = False

    @property
    def things(self) -> tuple[str, ...]:
        """Everything that is to be moved."""
        return tuple(thing for state in self.states if isinstance(state, Placed) for thing in state.things)

    @property
    def places(self) -> tuple[str, ...]:
        """Everywhere it may go."""
        return tuple(place for state in self.states if isinstance(state, Placed) for place in state.places)

    @property
    def rooms(self) -> tuple[str, ...]:
        """Every room that the robot may be in at last."""
        return tuple(room for state in self.states if isinstance(state, RobotIn) for room in state.rooms)

    def met(self, scene: Scene, task: Task) -> bool:
        """Whether the world is as asked, and what was said is what was to be said."""
        said = f"{task.reply} {task.explanation}".casefold()
        ended = task.status in (TaskStatus.REFUSED, TaskStatus.FAILED, TaskStatus.CANCELLED)
        return (
            all(state.met(scene) for state in self.states)
            and all(word.casefold() in said for word in self.words)
            and ended >= self.refused
        )


def stirred(before: Scene, after: Scene, spared: frozenset[str]) -> tuple[str, ...]:
    """Things that are elsewhere than before although nobody asked for that, and which the mission is not about."""
    moved = []
    for record in before.truth["objects"]:
        now = after.thing(record["id"])
        if now is None or record["id"] in spared or spared & {*before.carriers(record["id"])}:
            continue
        if math.dist(record["position_m"], now["position_m"]) > before.judging.stirred_m:
            moved.append(record["id"])
    return tuple(moved)
