"""The house document of design section 4: what stands where, as a person writes it.

Lengths in meters, angles in radians, in house coordinates: z up, floor at 0.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from simulation.houses.polygons import Point2, contains, distance_to_boundary

OUTSIDE = "outside"
ROBOT = "robot"

Id = Annotated[str, Field(min_length=1, max_length=80)]
Number = Annotated[float, Field(strict=True)]
Length = Annotated[Number, Field(gt=0.0, le=200.0)]
Coordinate = Annotated[Number, Field(ge=-1000.0, le=1000.0)]
Angle = Annotated[Number, Field(ge=-1000.0, le=1000.0)]
Pose2 = tuple[Coordinate, Coordinate, Angle]
Pose3 = tuple[Coordinate, Coordinate, Coordinate, Angle]
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
    pose: Pose3 | None = None


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
    """Something that happens in the house; which fields belong to what, ``disturbances`` tells."""

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
