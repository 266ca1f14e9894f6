"""Floor plans, found and true: which rooms and doors are the same, and how far off they are (Concepts, section 4.1)."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from simulation.houses.house import OUTSIDE, House

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PlanMatching:
    """Which of two plans' rooms and doors are the same."""

    room_iou: float = 0.5
    """Rooms that share more than this are the same: then no other can be."""
    door_m: float = 0.6
    """Doors of the same rooms that are nearer than this are the same: less than the width of a door."""
    samples: int = 240
    """Along each axis of the grid on which shared area is counted."""


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanDoor:
    """A door: ``center`` (2,), ``width_m``, and the rooms it joins; one that leads outside, or where no one has been,
    has one. ``optional``: it need not be found, because it was closed all the time. ``along``: (2,) unit direction of
    the wall in whose face ``center`` is, for a door known from one side: nobody knows how thick the wall is.
    """

    center: Array
    width_m: float
    rooms: frozenset[str]
    optional: bool = False
    along: Array | None = None

    def distance_m(self, true: PlanDoor) -> float:
        """How far it is from the true one; along the wall only where its other side is unknown."""
        offset = self.center - true.center
        return float(np.linalg.norm(offset) if self.along is None else abs(offset @ self.along))


@dataclass(frozen=True, kw_only=True, eq=False)
class FloorPlan:
    """Rooms by identifier, as (N, 2) inner outlines, and doors by identifier; meters, house frame."""

    rooms: Mapping[str, Array]
    doors: Mapping[str, PlanDoor]

    def moved(self, rotation: Array, shift: Array) -> FloorPlan:
        """The plan after ``rotation`` (2, 2) and ``shift`` (2,)."""
        return FloorPlan(
            rooms={name: polygon @ rotation.T + shift for name, polygon in self.rooms.items()},
            doors={
                name: replace(
                    door,
                    center=rotation @ door.center + shift,
                    along=None if door.along is None else rotation @ door.along,
                )
                for name, door in self.doors.items()
            },
        )


@dataclass(frozen=True, kw_only=True)
class Errors:
    """Errors of what was found, in meters, one number a room or door; ``iou`` of the rooms' outlines."""

    room_position_m: tuple[float, ...]
    room_size_m: tuple[float, ...]
    iou: tuple[float, ...]
    door_position_m: tuple[float, ...]
    door_width_m: tuple[float, ...]


@dataclass(frozen=True, kw_only=True)
class Score:
    """A found floor plan against the true one.

    ``errors``: after the best rigid alignment, as in the paper; ``unaligned``: with the robot's start pose as the only
    tie. ``found``: true room -> found room.
    """

    found: Mapping[str, str]
    rooms_missed: tuple[str, ...]
    rooms_invented: tuple[str, ...]
    doors_missed: tuple[str, ...]
    doors_invented: tuple[str, ...]
    errors: Errors
    unaligned: Errors

    @property
    def topology_right(self) -> bool:
        """Whether rooms and doors, and which doors join which rooms, are all as they are in truth."""
        return not (self.rooms_missed or self.rooms_invented or self.doors_missed or self.doors_invented)


def plan_of_house(house: House) -> FloorPlan:
    """The true floor plan."""
    return FloorPlan(
        rooms={room.id: np.array(room.polygon) for room in house.rooms},
        doors={
            door.id: PlanDoor(
                center=np.array(door.center),
                width_m=door.width,
                rooms=frozenset(door.rooms) - {OUTSIDE},
                optional=door.state == "closed",
            )
            for door in house.doors
        },
    )


def plan_of_scene(scene: Mapping[str, Any], start: Sequence[float]) -> FloorPlan:
    """The plan in a scene document of the map, put where the robot started: ``start`` [x, y, yaw] in the house."""
    nodes = scene["nodes"]
    plan = FloorPlan(
        rooms={
            node["id"]: np.array(node["polygon_m"])
            for node in nodes
            if node["type"] == "room" and len(node["polygon_m"]) > 2
        },
        doors={
            node["id"]: PlanDoor(
                center=np.array(node["position_m"][:2]),
                width_m=node["width_m"],
                rooms=frozenset(node["rooms"]),
                along=_rotation(node["yaw_rad"])[:, 0] if len(node["rooms"]) == 1 else None,
            )
            for node in nodes
            if node["type"] == "door" and not node["provisional"]
        },
    )
    return plan.moved(_rotation(start[2]), np.array(start[:2]))


def in_house(points_map: Array, start: Sequence[float]) -> Array:
    """(N, 2) points of the map in the house, where the robot started at ``start`` [x, y, yaw]."""
    return np.asarray(points_map @ _rotation(start[2]).T + np.array(start[:2]))


def compare(found: FloorPlan, true: FloorPlan, matching: PlanMatching = PlanMatching()) -> Score:
    """Match rooms by shared area and doors by place and rooms; then measure.

    Rooms that no open door leads to, and their doors, cannot be found and are not missed.
    """
    same = _same_rooms(found, true, matching)
    open_to = _open_to(true, same)
    rotation, shift = _alignment(found, true, same)
    aligned = found.moved(rotation, shift)
    doors = _same_doors(aligned, true, same, matching)
    return Score(
        found=same,
        rooms_missed=tuple(room for room in true.rooms if room not in same and room in open_to),
        rooms_invented=tuple(room for room in found.rooms if room not in same.values()),
        doors_missed=tuple(
            name
            for name, door in true.doors.items()
            if name not in doors and not door.optional and door.rooms & open_to
        ),
        doors_invented=tuple(name for name in found.doors if name not in doors.values()),
        errors=_errors(aligned, true, same, doors),
        unaligned=_errors(found, true, same, doors),
    )


def placement(found: Array, true: Array) -> tuple[Array, Array]:
    """Rotation (2, 2) and shift (2,) that put a found room best upon the true one."""
    return _kabsch(*_boxes(found, true))


def iou(first: Array, second: Array, samples: int = PlanMatching.samples) -> float:
    """Shared area of two simple polygons over the area of both together, on a grid."""
    low, high = np.minimum(first.min(axis=0), second.min(axis=0)), np.maximum(first.max(axis=0), second.max(axis=0))
    axes = [low[k] + (high[k] - low[k]) * (np.arange(samples) + 0.5) / samples for k in (0, 1)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    in_first, in_second = _inside(first, points), _inside(second, points)
    return float((in_first & in_second).sum() / max(1, (in_first | in_second).sum()))


def _inside(polygon: Array, points: Array) -> NDArray[np.bool_]:
    """Even-odd rule for (N, 2) points."""
    result = np.zeros(len(points), dtype=bool)
    for (ax, ay), (bx, by) in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
        straddles = (ay > points[:, 1]) != (by > points[:, 1])
        if straddles.any():
            crossing = ax + (points[straddles, 1] - ay) / (by - ay) * (bx - ax)
            result[straddles] ^= points[straddles, 0] < crossing
    return result


def _same_rooms(found: FloorPlan, true: FloorPlan, matching: PlanMatching) -> dict[str, str]:
    names, truths = list(found.rooms), list(true.rooms)
    if not names:
        return {}
    samples = matching.samples
    shared = np.array([[iou(found.rooms[name], true.rooms[truth], samples) for name in names] for truth in truths])
    return {
        truths[row]: names[column]
        for row, column in zip(*linear_sum_assignment(-shared), strict=True)
        if shared[row, column] > matching.room_iou
    }


def _open_to(true: FloorPlan, same: Mapping[str, str]) -> set[str]:
    """True rooms that can be reached from one that was found; all when none was."""
    if not same:
        return set(true.rooms)
    reached, before = set(same), -1
    while len(reached) > before:
        before = len(reached)
        for door in true.doors.values():
            if not door.optional and door.rooms & reached:
                reached |= door.rooms
    return reached


def _same_doors(found: FloorPlan, true: FloorPlan, rooms: Mapping[str, str], matching: PlanMatching) -> dict[str, str]:
    """True door -> found door: same rooms, nearest. Of a closed door one side may be all that is known."""
    names, truths = list(found.doors), list(true.doors)
    if not names or not truths:
        return {}
    cost = np.full((len(truths), len(names)), 1e6)
    for row, truth in enumerate(truths):
        expected = {rooms.get(room) for room in true.doors[truth].rooms}
        for column, name in enumerate(names):
            ours = set(found.doors[name].rooms)
            if expected == ours or (true.doors[truth].optional and ours and ours < expected):
                cost[row, column] = math.dist(true.doors[truth].center, found.doors[name].center)
    return {
        truths[row]: names[column]
        for row, column in zip(*linear_sum_assignment(cost), strict=True)
        if cost[row, column] < matching.door_m
    }


def _alignment(found: FloorPlan, true: FloorPlan, rooms: Mapping[str, str]) -> tuple[Array, Array]:
    """Rotation (2, 2) and shift (2,) that bring the corners of the rooms' boxes together (Kabsch)."""
    if not rooms:
        return np.eye(2), np.zeros(2)
    boxes = [_boxes(found.rooms[name], true.rooms[truth]) for truth, name in rooms.items()]
    return _kabsch(np.concatenate([ours for ours, _ in boxes]), np.concatenate([theirs for _, theirs in boxes]))


def _kabsch(ours: Array, theirs: Array) -> tuple[Array, Array]:
    """Rotation (2, 2) and shift (2,) that bring (N, 2) points closest to others, one by one."""
    center, goal = ours.mean(axis=0), theirs.mean(axis=0)
    u, _, vt = np.linalg.svd((ours - center).T @ (theirs - goal))
    turn = np.diag([1.0, np.sign(np.linalg.det(vt.T @ u.T))])
    rotation = vt.T @ turn @ u.T
    return rotation, goal - rotation @ center


def _errors(found: FloorPlan, true: FloorPlan, rooms: Mapping[str, str], doors: Mapping[str, str]) -> Errors:
    boxes = [_boxes(found.rooms[name], true.rooms[truth]) for truth, name in rooms.items()]
    pairs = [(found.doors[name], true.doors[truth]) for truth, name in doors.items()]
    return Errors(
        room_position_m=tuple(float(np.linalg.norm(ours.mean(axis=0) - theirs.mean(axis=0))) for ours, theirs in boxes),
        room_size_m=tuple(float(np.abs(_sides(ours) - _sides(theirs)).mean()) for ours, theirs in boxes),
        iou=tuple(iou(found.rooms[name], true.rooms[truth]) for truth, name in rooms.items()),
        door_position_m=tuple(ours.distance_m(theirs) for ours, theirs in pairs),
        door_width_m=tuple(abs(ours.width_m - theirs.width_m) for ours, theirs in pairs),
    )


def _boxes(found: Array, true: Array) -> tuple[Array, Array]:
    """Corners (4, 2) of the bounding rectangles of both, each along its own walls, in the same order."""
    direction = _direction(true)
    quarter = math.pi / 2.0
    own = _direction(found)
    own += quarter * round((direction - own) / quarter)
    return _box(found, _rotation(own)), _box(true, _rotation(direction))


def _direction(polygon: Array) -> float:
    """Direction of the longest wall in radians."""
    sides = np.roll(polygon, -1, axis=0) - polygon
    longest = sides[np.argmax(np.linalg.norm(sides, axis=1))]
    return math.atan2(longest[1], longest[0])


def _box(polygon: Array, rotation: Array) -> Array:
    turned = polygon @ rotation
    (x0, y0), (x1, y1) = turned.min(axis=0), turned.max(axis=0)
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]]) @ rotation.T


def _sides(box: Array) -> Array:
    return np.array([np.linalg.norm(box[1] - box[0]), np.linalg.norm(box[2] - box[1])])


def _rotation(angle_rad: float) -> Array:
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[c, -s], [s, c]])
