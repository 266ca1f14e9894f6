"""What a house must satisfy beyond the types of its fields; each finding names the path of the field."""

from __future__ import annotations

import math
from collections.abc import Iterable

from simulation.errors import DisturbError, HouseError
from simulation.houses.colors import color_problem
from simulation.houses.disturbances import check_object, parse_disturbance
from simulation.houses.house import OUTSIDE, ROBOT, Door, Event, House, Object, Room
from simulation.houses.polygons import (
    contains,
    crossing_sides,
    distance_to_boundary,
    distance_to_segment,
    edges,
    overlap,
    signed_area,
)

DOOR_SLACK_M = 0.15
"""How far beyond a wall's thickness a door's center may be from its rooms: walls of two rooms need not touch."""

_MIN_AREA_M2 = 0.01
_FIT_M = 0.02


def check_house(house: House) -> None:
    """Check everything in document order of the parts.

    Raises:
        HouseError: the first finding.
    """
    _check_ids(house)
    for index, room in enumerate(house.rooms):
        _check_polygon(room, f"rooms[{index}].polygon")
    _check_overlaps(house)
    rooms = {room.id: room for room in house.rooms}
    for index, door in enumerate(house.doors):
        _check_door(door, house, rooms, f"doors[{index}]")
    for index, item in enumerate(house.furniture):
        _check_color(item.color, f"furniture[{index}]")
    carriers = {item.id for item in house.furniture} | {item.id for item in house.objects}
    for index, thing in enumerate(house.objects):
        _check_place(thing, f"objects[{index}]")
        _check_color(thing.color, f"objects[{index}]")
        _check_carrier(thing, carriers, f"objects[{index}]")
    _check_stacks(house)
    if not any(contains(room.polygon, house.robot.pose[:2]) for room in house.rooms):
        raise HouseError("robot.pose", "is in no room")
    _check_events(house)


def _check_ids(house: House) -> None:
    """Unique among rooms, and unique among all that stands in them."""
    _unique((f"rooms[{i}].id", room.id) for i, room in enumerate(house.rooms))
    named = [(f"doors[{i}].id", door.id) for i, door in enumerate(house.doors)]
    named += [(f"furniture[{i}].id", item.id) for i, item in enumerate(house.furniture)]
    named += [(f"objects[{i}].id", thing.id) for i, thing in enumerate(house.objects)]
    named += [(f"people[{i}].id", person.id) for i, person in enumerate(house.people)]
    _unique(named)


def _unique(named: Iterable[tuple[str, str]]) -> None:
    seen: dict[str, str] = {}
    for path, identifier in named:
        if identifier in (ROBOT, OUTSIDE):
            raise HouseError(path, f"'{identifier}' is reserved")
        if identifier in seen:
            raise HouseError(path, f"'{identifier}' is already the id of {seen[identifier].removesuffix('.id')}")
        seen[identifier] = path


def _check_polygon(room: Room, path: str) -> None:
    for index, (a, b) in enumerate(edges(room.polygon)):
        if math.dist(a, b) < 1e-6:
            raise HouseError(f"{path}[{index}]", "is the same point as the next one")
    sides = crossing_sides(room.polygon)
    if sides is not None:
        raise HouseError(path, f"is not simple: sides {sides[0]} and {sides[1]} meet")
    area_m2 = signed_area(room.polygon)
    if area_m2 <= -_MIN_AREA_M2:
        raise HouseError(path, "runs clockwise; list its points counter-clockwise")
    if area_m2 < _MIN_AREA_M2:
        raise HouseError(path, "encloses no area")


def _check_overlaps(house: House) -> None:
    for index, room in enumerate(house.rooms):
        for other in house.rooms[:index]:
            if overlap(other.polygon, room.polygon):
                raise HouseError(f"rooms[{index}].polygon", f"overlaps room '{other.id}'")


def _check_door(door: Door, house: House, rooms: dict[str, Room], path: str) -> None:
    for index, name in enumerate(door.rooms):
        if name not in rooms and name != OUTSIDE:
            raise HouseError(f"{path}.rooms[{index}]", f"no room '{name}'; rooms: {', '.join(rooms)}")
    if door.rooms[0] == door.rooms[1]:
        raise HouseError(f"{path}.rooms", "a door joins two rooms")
    if door.height > house.wall_height:
        raise HouseError(f"{path}.height", f"is higher than the walls ({house.wall_height} m)")
    for name in door.rooms:
        if name != OUTSIDE:
            _check_door_at(door, rooms[name], house.wall_thickness + DOOR_SLACK_M, path)


def _check_door_at(door: Door, room: Room, reach_m: float, path: str) -> None:
    """The center is at the room's wall, and the opening fits between that wall's ends."""
    away_m = distance_to_boundary(door.center, room.polygon)
    if away_m > reach_m + 1e-9:
        raise HouseError(
            f"{path}.center", f"is {away_m:.2f} m from the walls of room '{room.id}', not between its two rooms"
        )
    if contains(room.polygon, door.center) and away_m > _FIT_M:
        raise HouseError(f"{path}.center", f"lies inside room '{room.id}', not between its two rooms")
    a, b = min(edges(room.polygon), key=lambda side: distance_to_segment(door.center, *side))
    length_m = math.dist(a, b)
    along_m = ((door.center[0] - a[0]) * (b[0] - a[0]) + (door.center[1] - a[1]) * (b[1] - a[1])) / length_m
    if min(along_m, length_m - along_m) < door.width / 2 - _FIT_M:
        raise HouseError(
            f"{path}.width",
            f"{door.width} m at this center do not fit into the {length_m:.2f} m wall of room '{room.id}'",
        )


def _check_color(color: str | None, path: str) -> None:
    problem = color_problem(color)
    if problem is not None:
        raise HouseError(f"{path}.color", problem)


def _check_place(thing: Object, path: str) -> None:
    try:
        check_object(thing.model_dump(by_alias=True, exclude_none=True))
    except HouseError as error:
        raise HouseError(_below(path, error.path), error.problem) from error


def _check_carrier(thing: Object, carriers: set[str], path: str) -> None:
    for field, carrier in (("on", thing.on), ("in", thing.in_)):
        if carrier is not None and carrier not in carriers:
            raise HouseError(
                f"{path}.{field}", f"no furniture or object '{carrier}'; there are: {', '.join(sorted(carriers))}"
            )


def _check_stacks(house: House) -> None:
    """Nothing stands, by way of others, on itself."""
    below = {thing.id: thing.on or thing.in_ for thing in house.objects}
    for index, thing in enumerate(house.objects):
        seen, at = {thing.id}, below[thing.id]
        while at is not None and at in below:
            if at in seen:
                raise HouseError(f"objects[{index}]", f"'{thing.id}' stands on itself by way of '{at}'")
            seen.add(at)
            at = below[at]


def _check_events(house: House) -> None:
    """Each is well-formed and names what is there at the start or was added before."""
    movable = {thing.id for thing in house.objects} | {item.id for item in house.furniture} | {ROBOT}
    people, doors = {person.id for person in house.people}, {door.id for door in house.doors}
    for index, event in sorted(enumerate(house.events), key=lambda numbered: numbered[1].at_s):
        _check_event(event, f"events[{index}]")
        if event.object is not None:
            movable.add(event.object.id)
        known = doors if event.do.endswith("_door") else people if event.do == "walk" else movable | people
        if event.id is not None and event.id not in known:
            raise HouseError(
                f"events[{index}].id",
                f"nothing there to {event.do} with id '{event.id}'; there are: {', '.join(sorted(known))}",
            )


def _check_event(event: Event, path: str) -> None:
    """It has what its kind needs, and nothing else."""
    try:
        parse_disturbance(event.model_dump(by_alias=True, exclude_none=True, exclude={"at_s"}))
    except DisturbError as error:
        raise HouseError(_below(path, error.path), error.problem) from error


def _below(path: str, field: str) -> str:
    return f"{path}.{field}" if field else path
