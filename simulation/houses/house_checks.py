"""What a house must satisfy beyond the types of its fields; each finding names the path of the field."""

from __future__ import annotations

import math
from collections.abc import Iterable

from simulation.errors import HouseError
from simulation.houses.colors import is_color
from simulation.houses.house import OUTSIDE, ROBOT, Disturbance, Door, House, Object, Room
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
        check_object(thing, f"objects[{index}]")
        _check_carrier(thing, carriers, f"objects[{index}]")
    _check_stacks(house)
    if not any(contains(room.polygon, house.robot.pose[:2]) for room in house.rooms):
        raise HouseError("robot.pose", "is in no room")
    _check_events(house)


def check_object(thing: Object, path: str) -> None:
    """One place, a known look."""
    given = [name for name, value in (("on", thing.on), ("in", thing.in_), ("pose", thing.pose)) if value is not None]
    if len(given) != 1:
        raise HouseError(path, f"needs exactly one of on, in and pose; it has {' and '.join(given) or 'none'}")
    if thing.offset is not None and thing.pose is not None:
        raise HouseError(f"{path}.offset", "belongs to on or in, not to pose")
    _check_color(thing.color, path)


def check_disturbance(event: Disturbance, path: str) -> None:
    """The fields that its kind of disturbance needs are there, and no others."""
    prefix = f"{path}." if path else ""
    needed = {"add": {"object"}, "move": {"id", "to"}, "walk": {"id", "to"}}.get(event.do, {"id"})
    for name in ("id", "to", "object"):
        given = getattr(event, name) is not None
        if name in needed and not given:
            raise HouseError(f"{prefix}{name}", f"is required to {event.do}")
        if given and name not in needed:
            raise HouseError(f"{prefix}{name}", f"does not belong to {event.do}")
    if event.object is not None:
        check_object(event.object, f"{prefix}object")
    if event.to is not None:
        to = event.to
        given_places = [name for name in ("on", "in_", "pose") if getattr(to, name) is not None]
        if len(given_places) != 1:
            raise HouseError(f"{prefix}to", "needs exactly one of on, in and pose")
        if event.do == "walk" and to.pose is None:
            raise HouseError(f"{prefix}to", "a person walks to a pose")
        if to.offset is not None and to.pose is not None:
            raise HouseError(f"{prefix}to.offset", "belongs to on or in, not to pose")


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
    if color is not None and not is_color(color):
        raise HouseError(f"{path}.color", f"unknown color '{color}'; use a name like 'light blue' or #rrggbb")


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
        check_disturbance(event, f"events[{index}]")
        if event.object is not None:
            movable.add(event.object.id)
        known = doors if event.do.endswith("_door") else people if event.do == "walk" else movable | people
        if event.id is not None and event.id not in known:
            raise HouseError(
                f"events[{index}].id",
                f"nothing there to {event.do} with id '{event.id}'; there are: {', '.join(sorted(known))}",
            )
