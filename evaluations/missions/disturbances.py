"""What people and chance do while the robot works: when, what exactly, and what can still come of the request then."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

from numpy.random import Generator

from evaluations.missions.clutter import boxes_over
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, Scene
from evaluations.missions.ways import Ways, WaySettings
from planner.tasks.tasks import Task, TaskStatus
from simulation.furnishing.catalog import category_named
from simulation.houses.house import Door, House, room_at
from skills.failures import FailureCode

Event = Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class DisturbanceSettings:
    """When and how people and chance interfere; chosen, so that the robot can notice."""

    begun_s: float = 1.5
    """So long the robot has been on its way before anything happens."""
    near_m: float = 1.4
    """From so near the robot sees what happens to the thing that it is about to take."""
    crate_m: tuple[float, float, float] = (0.5, 0.5, 0.5)
    least_drive_m: float = 1.2
    """Doors closer to the robot are not shut in its face, nor is anything put there: it may be within them."""
    from_people_m: float = 0.55
    from_things_m: float = 0.45
    """The robot is not set down on anybody's feet, nor on what lies on the floor."""
    lowest_m: float = 0.15
    highest_m: float = 1.05
    """Things are put elsewhere only onto tops of these heights, as they are asked for to be put."""
    aside_m: float = 0.8
    """So far from its middle what slips falls to the floor."""
    push_m: float = 0.3
    push_rad: float = 0.5
    """Half a step aside, and turned."""


@dataclass(frozen=True, kw_only=True)
class Moment:
    """What a disturbance is chosen from. ``ways``: over the house as it is; ``since_s``: since the robot got going."""

    scene: Scene
    mission: Mission
    task: Task
    ways: Ways
    since_s: float
    rng: Generator
    settings: DisturbanceSettings = field(default_factory=DisturbanceSettings)

    @property
    def thing(self) -> str | None:
        """What the mission moves, the first of them that is not where it is to go."""
        places = self.mission.places
        todo = [t for t in self.mission.things if not any(self.scene.is_at(t, place) for place in places)]
        return todo[0] if todo else None

    @property
    def place(self) -> str | None:
        """Where that may go."""
        return self.mission.places[0] if self.mission.places else None

    def where(self, name: str) -> tuple[float, float] | None:
        """Where a thing, piece of furniture, room or person is, in the house."""
        return self.scene.where(name) or self.ways.middle_of(name)


@dataclass(frozen=True, kw_only=True)
class Disturbance:
    """``due``: whether the time for it has come. ``deeds``: ways to do it, each a list of events, the first that the
    house allows is done. ``reasons``: what the robot may rightly give as its reason where the request then cannot be
    fulfilled any more; ``blocks``: whether that has to be found out from the ways that are left. ``carries``: it
    happens while something is carried somewhere; ``furniture``: to the furniture that it is to go on.
    """

    name: str
    due: Callable[[Moment], bool]
    deeds: Callable[[Moment], Sequence[Sequence[Event]]]
    reasons: frozenset[FailureCode] = frozenset()
    blocks: bool = False
    carries: bool = False
    furniture: bool = False

    def fits(self, mission: Mission, house: House) -> bool:
        """Whether it can happen to a mission at all."""
        places = [place for place in mission.places if place != HAND]
        on = [place for place in places if any(item.id == place for item in house.furniture)]
        return bool(mission.things) and (bool(places) or not self.carries) and (bool(on) or not self.furniture)

    @property
    def ends_it(self) -> bool:
        """Whether nothing can come of the request afterwards, whatever the house is like."""
        return bool(self.reasons) and not self.blocks


def _driving(moment: Moment) -> bool:
    """Under way to the thing, with an empty hand."""
    return (
        moment.task.status is TaskStatus.RUNNING
        and moment.since_s > moment.settings.begun_s
        and moment.scene.holding is None
    )


def _carrying(moment: Moment) -> bool:
    """Under way with what was asked for."""
    held = moment.scene.holding
    return (
        held is not None
        and held in moment.mission.things
        and _distance(moment, moment.place) > moment.settings.least_drive_m
    )


def _near(moment: Moment) -> bool:
    """Close to the thing, with an empty hand."""
    return _driving(moment) and _distance(moment, moment.thing) < moment.settings.near_m


def _on_the_way(moment: Moment) -> bool:
    """A door is still to be driven through."""
    return (
        moment.task.status is TaskStatus.RUNNING
        and moment.since_s > moment.settings.begun_s
        and _door_ahead(moment) is not None
    )


def _distance(moment: Moment, name: str | None) -> float:
    at = moment.where(name) if name is not None else None
    return math.dist(at, moment.scene.robot_at) if at is not None else math.inf


def _door_ahead(moment: Moment) -> Door | None:
    """The first door on the way to what the robot wants next that it is not in already."""
    goal = moment.place if moment.scene.holding is not None else moment.thing
    at = moment.where(goal) if goal is not None else None
    if at is None:
        return None
    doors = moment.ways.doors_between(moment.scene.robot_at, at)
    ahead = [door for door in doors if math.dist(door.center, moment.scene.robot_at) > moment.settings.least_drive_m]
    return ahead[0] if ahead else None


def _elsewhere(moment: Moment, *, same_room: bool) -> list[list[Event]]:
    """Put the thing onto another piece of furniture, one that the robot can be asked to get to."""
    thing = moment.thing
    record = moment.scene.thing(thing) if thing is not None else None
    if thing is None or record is None:
        return []
    house, settings = moment.scene.house, moment.settings
    spots = []
    for item in house.furniture:
        kind = category_named(item.category, item.size, static=True)
        top_m = kind.levels[0] * (item.size or kind.size_m)[2]
        there = room_at(house, item.pose[0], item.pose[1]) == record["room"]
        taken = item.id in moment.mission.places or item.id == record["on"]
        if kind.support and settings.lowest_m <= top_m <= settings.highest_m and not taken and there == same_room:
            spots.append(item.id)
    moment.rng.shuffle(spots)
    passable, begin = Ways(moment.scene, spared=(thing,), radius_m=WaySettings().passable_m), moment.scene.robot_at
    reached = [s for s in spots if (at := moment.where(s)) is not None and math.isfinite(passable.length_m(begin, at))]
    return [[{"do": "move", "id": thing, "to": {"on": spot}}] for spot in reached]


def _aside(moment: Moment) -> list[list[Event]]:
    """Let the thing in the hand fall to the floor beside the robot."""
    held = moment.scene.holding
    x_m, y_m, yaw_rad = moment.scene.truth["robot"]["pose"]
    turns = (0.6, -0.6, 1.0, -1.0, 1.5, -1.5)
    away_m = moment.settings.aside_m
    spots = [(x_m + away_m * math.cos(yaw_rad + turn), y_m + away_m * math.sin(yaw_rad + turn)) for turn in turns]
    free = [spot for spot in spots if moment.ways.is_free(spot)]
    return [[{"do": "move", "id": held, "to": {"pose": [x, y, 0.0, 0.0]}}] for x, y in free]


def _removed(moment: Moment) -> list[list[Event]]:
    return [[{"do": "remove", "id": moment.thing}]] if moment.thing is not None else []


def _crowded(moment: Moment) -> list[list[Event]]:
    """Fill every level of the place with boxes, side by side, around what stands there."""
    item = moment.scene.furniture(moment.place) if moment.place is not None else None
    if item is None:
        return []
    boxes = [
        {
            "id": f"crowd_{item.id}_{number}",
            "category": "box",
            "size": [*block.size_m],
            "pose": [*block.center_m[:2], block.center_m[2] - block.size_m[2] / 2, block.yaw_rad],
        }
        for number, block in enumerate(boxes_over(item, moment.scene))
    ]
    return [[{"do": "add", "object": box} for box in boxes]]


def _taken_away(moment: Moment) -> list[list[Event]]:
    item = moment.scene.furniture(moment.place) if moment.place is not None else None
    return [[{"do": "remove", "id": item.id}]] if item is not None else []


def _shut(moment: Moment) -> list[list[Event]]:
    door = _door_ahead(moment)
    return [[{"do": "close_door", "id": door.id}]] if door is not None else []


def _crate(moment: Moment) -> list[list[Event]]:
    """A crate in the doorway."""
    door = _door_ahead(moment)
    if door is None:
        return []
    pose = [*door.center, 0.0, 0.0]
    crate = {"id": f"crate_{door.id}", "category": "box", "size": [*moment.settings.crate_m], "pose": pose}
    return [[{"do": "add", "object": crate}]]


def _stroll(moment: Moment) -> list[list[Event]]:
    """A person walks into the doorway that the robot is heading for; they go on after a while."""
    door = _door_ahead(moment)
    people = [entry["id"] for entry in moment.scene.truth["people"] if entry["id"] not in moment.mission.places]
    if door is None:
        return []
    return [[{"do": "walk", "id": person, "to": {"pose": [*door.center]}}] for person in people]


def _push(moment: Moment) -> list[list[Event]]:
    """Half a step aside, and turned."""
    x_m, y_m, yaw_rad = moment.scene.truth["robot"]["pose"]
    push_m, push_rad = moment.settings.push_m, moment.settings.push_rad
    turned = yaw_rad + float(moment.rng.choice((-push_rad, push_rad)))
    around = [k * math.pi / 4 for k in range(8)]
    moment.rng.shuffle(around)
    spots = [(x_m + push_m * math.cos(a), y_m + push_m * math.sin(a)) for a in around]
    free = [spot for spot in spots if moment.ways.is_free(spot) and not _is_taken(moment, spot)]
    return [[{"do": "move", "id": "robot", "to": {"pose": [*spot, turned]}}] for spot in free]


def _carry_off(moment: Moment) -> list[list[Event]]:
    """Into another room."""
    rooms = [room.id for room in moment.scene.house.rooms if room.id != moment.scene.robot_room]
    moment.rng.shuffle(rooms)
    spots = [spot for room in rooms if (spot := moment.ways.middle_of(room)) is not None]
    turn = float(moment.rng.uniform(-math.pi, math.pi))
    return [[{"do": "move", "id": "robot", "to": {"pose": [*s, turn]}}] for s in spots if not _is_taken(moment, s)]


def _is_taken(moment: Moment, spot: tuple[float, float]) -> bool:
    """Whether somebody stands there, or something lies there now, as what the robot has just put on the floor."""
    truth, held, settings = moment.scene.truth, moment.scene.holding, moment.settings
    lying = [each for each in truth["objects"] if not (each["on"] or each["in"]) and each["id"] != held]
    taken = [(each, settings.from_people_m) for each in truth["people"]]
    taken += [(each, settings.from_things_m) for each in lying]
    return any(math.dist(each["position_m"][:2], spot) < away_m for each, away_m in taken)


def _onto_furniture(moment: Moment) -> bool:
    return moment.place is not None and moment.place != HAND and moment.scene.furniture(moment.place) is not None


_ALL = (
    Disturbance(name="moved_unseen", due=_driving, deeds=lambda moment: _elsewhere(moment, same_room=False)),
    Disturbance(name="moved_in_view", due=_near, deeds=lambda moment: _elsewhere(moment, same_room=True)),
    Disturbance(name="removed", due=_driving, deeds=_removed, reasons=frozenset({FailureCode.OBJECT_GONE})),
    Disturbance(name="slipped", due=_carrying, deeds=_aside, carries=True),
    Disturbance(
        name="support_full",
        due=lambda moment: _onto_furniture(moment) and _carrying(moment),
        deeds=_crowded,
        reasons=frozenset({FailureCode.SUPPORT_FULL}),
        furniture=True,
    ),
    Disturbance(name="person_in_way", due=_on_the_way, deeds=_stroll),
    Disturbance(name="pushed", due=_driving, deeds=_push),
    Disturbance(name="kidnapped", due=_driving, deeds=_carry_off),
    Disturbance(
        name="door_closed",
        due=_on_the_way,
        deeds=_shut,
        reasons=frozenset({FailureCode.DOOR_CLOSED, FailureCode.WAY_BLOCKED}),
        blocks=True,
    ),
    Disturbance(
        name="way_blocked",
        due=_on_the_way,
        deeds=_crate,
        reasons=frozenset({FailureCode.WAY_BLOCKED}),
        blocks=True,
    ),
    Disturbance(
        name="support_gone",
        due=lambda moment: _onto_furniture(moment) and _carrying(moment),
        deeds=_taken_away,
        reasons=frozenset({FailureCode.SUPPORT_GONE}),
        furniture=True,
    ),
)

DISTURBANCES: Mapping[str, Disturbance] = MappingProxyType({each.name: each for each in _ALL})
"""All of them by name; what leaves least behind comes first, in the house and in what the robot believes of it."""
