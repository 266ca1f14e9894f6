"""The house document of design section 4: what stands where, as a person writes it, checked on load.

Lengths in meters, angles in radians, in house coordinates: z up, floor at 0.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from simulation.errors import DisturbError, HouseError
from simulation.houses.polygons import Point2, contains, distance_to_boundary

OUTSIDE = "outside"
ROBOT = "robot"

Id = Annotated[str, Field(min_length=1, max_length=80)]
Length = Annotated[float, Field(gt=0.0, le=200.0)]
Coordinate = Annotated[float, Field(ge=-1000.0, le=1000.0)]
Pose2 = tuple[Coordinate, Coordinate, float]
Size3 = tuple[Length, Length, Length]


class _Strict(BaseModel):
    model_config = ConfigDict(
        extra="forbid", frozen=True, allow_inf_nan=False, validate_by_name=False, validate_by_alias=True
    )


class Room(_Strict):
    """``polygon``: the inner side of its walls, counter-clockwise. ``label``: what people call it, else its id."""

    id: Id
    label: str = ""
    polygon: Annotated[tuple[tuple[Coordinate, Coordinate], ...], Field(min_length=3)]


class Door(_Strict):
    """An opening in the wall between two rooms, or a room and ``"outside"``, with a panel when closed."""

    id: Id
    rooms: tuple[Id, Id]
    center: tuple[Coordinate, Coordinate]
    width: Length = 0.9
    height: Length = 2.0
    state: Literal["open", "closed"] = "open"


class Furniture(_Strict):
    """``pose`` [x, y, yaw] of its center on the floor; ``size`` along its own x, y and z; its front is -y.

    Without ``size`` it has the usual one of its category.
    """

    id: Id
    category: Id
    color: str | None = None
    pose: Pose2
    size: Size3 | None = None


class Object(_Strict):
    """A thing that can be moved, at exactly one of ``on``, ``in`` (an id) and ``pose`` [x, y, z of its bottom, yaw].

    ``offset``: from the center of what carries it, in that one's own frame; without it a free spot is found.
    """

    id: Id
    category: Id
    color: str | None = None
    size: Size3 | None = None
    on: Id | None = None
    in_: Id | None = Field(default=None, alias="in")
    offset: tuple[Coordinate, Coordinate] | None = None
    pose: tuple[Coordinate, Coordinate, Coordinate, float] | None = None


class Person(_Strict):
    """``pose`` [x, y, yaw]. ``name``: what people call them; the id when left out."""

    id: Id
    name: str = ""
    pose: Pose2


class Robot(_Strict):
    """Where the robot starts: ``pose`` [x, y, yaw]."""

    pose: Pose2


class Place(_Strict):
    """Where something goes: exactly one of ``on``, ``in`` and ``pose``.

    ``pose`` is [x, y, z, yaw] for an object, [x, y, yaw] for furniture, a person or the robot; a person
    who walks may be told [x, y].
    """

    on: Id | None = None
    in_: Id | None = Field(default=None, alias="in")
    offset: tuple[Coordinate, Coordinate] | None = None
    pose: Annotated[tuple[Coordinate, ...], Field(min_length=2, max_length=4)] | None = None


class Disturbance(_Strict):
    """Something that happens in the house.

    ``object`` belongs to ``add``, ``to`` to ``move`` and ``walk``, ``id`` to all but ``add``.
    """

    do: Literal["move", "remove", "add", "close_door", "open_door", "walk"]
    id: Id | None = None
    to: Place | None = None
    object: Object | None = None


class Event(Disturbance):
    """A disturbance at simulated time ``at_s``."""

    at_s: Annotated[float, Field(ge=0.0)]


class Noise(_Strict):
    """Standard deviations of the sensors: LiDAR range in meters, odometry as a share of distance and of angle, depth in
    meters per square meter of distance.
    """

    lidar_range_std_m: Annotated[float, Field(ge=0.0)] = 0.02
    odometry_distance_ratio: Annotated[float, Field(ge=0.0)] = 0.01
    odometry_angle_ratio: Annotated[float, Field(ge=0.0)] = 0.01
    depth_std_m_per_m2: Annotated[float, Field(ge=0.0)] = 0.0015


class House(_Strict):
    """A whole house. Only ``rooms``, ``doors`` and ``robot`` are required."""

    name: str = "house"
    wall_thickness: Annotated[float, Field(ge=0.02, le=1.0)] = 0.2
    wall_height: Annotated[float, Field(ge=1.0, le=20.0)] = 2.5
    rooms: Annotated[tuple[Room, ...], Field(min_length=1)]
    doors: tuple[Door, ...]
    furniture: tuple[Furniture, ...] = ()
    objects: tuple[Object, ...] = ()
    people: tuple[Person, ...] = ()
    robot: Robot
    events: tuple[Event, ...] = ()
    noise: Noise = Noise()


def builtin_houses() -> tuple[str, ...]:
    """Names of the houses that ship with the package, sorted."""
    folder = resources.files("simulation") / "houses"
    return tuple(sorted(entry.name.removesuffix(".json") for entry in folder.iterdir() if entry.name.endswith(".json")))


def load_house(path_or_name: str | Path) -> House:
    """Read the house of that built-in name, or else the file.

    Raises:
        HouseError: no such house or file, or it is not one that can be built.
    """
    name = str(path_or_name)
    if name in builtin_houses():
        return parse_house((resources.files("simulation") / "houses" / f"{name}.json").read_text("utf-8"))
    try:
        text = Path(name).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else "not a text file"
        known = ", ".join(builtin_houses())
        raise HouseError(
            name if name.strip() else repr(name),
            f"cannot be read ({reason}), and no house has that name; built in: {known}",
        ) from error
    return parse_house(text)


def parse_house(text: str) -> House:
    """Read and check a house document.

    Raises:
        HouseError: with the path of the offending field, or line and column where it is no JSON.
    """
    # The checks are written in terms of the models above.
    from simulation.houses.house_checks import check_house

    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise HouseError(f"line {error.lineno} column {error.colno}", f"not JSON: {error.msg}") from error
    except RecursionError as error:
        raise HouseError("", "not a house: nested too deeply") from error
    try:
        house = House.model_validate(document)
    except ValidationError as error:
        raise HouseError(*_first_problem(error)) from error
    check_house(house)
    return house


def parse_disturbance(document: Any) -> Disturbance:
    """Read one event without ``at_s``; whether the house allows it shows when it is carried out.

    Raises:
        DisturbError: with the path of the offending field.
    """
    from simulation.houses.house_checks import check_disturbance

    try:
        disturbance = Disturbance.model_validate(document)
    except ValidationError as error:
        raise DisturbError(*_first_problem(error)) from error
    try:
        check_disturbance(disturbance, "")
    except HouseError as error:
        raise DisturbError(error.path, error.problem) from error
    return disturbance


def room_at(house: House, x_m: float, y_m: float) -> str | None:
    """Id of the room whose polygon holds the point; in a wall or doorway the nearest room within a wall's thickness."""
    point: Point2 = (x_m, y_m)
    for room in house.rooms:
        if contains(room.polygon, point):
            return room.id
    nearest_m, nearest = min((distance_to_boundary(point, room.polygon), room.id) for room in house.rooms)
    return nearest if nearest_m <= house.wall_thickness else None


def furniture_places(house: House) -> dict[str, tuple[str, str]]:
    """Furniture id -> (category, label of the room it stands in; "" when in none)."""
    labels = {room.id: room.label or room.id for room in house.rooms}
    places: dict[str, tuple[str, str]] = {}
    for item in house.furniture:
        room = room_at(house, item.pose[0], item.pose[1])
        places[item.id] = (item.category, labels[room] if room is not None else "")
    return places


def field_path(location: Sequence[int | str]) -> str:
    """``("doors", 1, "center")`` as ``doors[1].center``."""
    path = ""
    for part in location:
        path += f"[{part}]" if isinstance(part, int) else f".{part}" if path else part
    return path


def _first_problem(error: ValidationError) -> tuple[str, str]:
    """Path and problem of the first finding; how many more there are is told too."""
    findings = error.errors(include_url=False, include_context=False)
    more = f" (and {len(findings) - 1} more)" if len(findings) > 1 else ""
    message = findings[0]["msg"]
    return field_path(findings[0]["loc"]), f"{message[:1].lower()}{message[1:]}{more}"
