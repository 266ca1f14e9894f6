"""Furniture and things of the house as bodies in the physics client: putting them, and where they stand."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import pybullet as p

from simulation.errors import DisturbError
from simulation.furnishing.catalog import Category, category_named, rgb_of
from simulation.houses.house import Furniture, House, Object, Place, room_at
from simulation.houses.placement import Standing, free_spot, to_house
from simulation.world.bodies import make_body, place_body
from simulation.world.physics import PhysicsSettings
from simulation.world.solids import Solids

Pose2 = tuple[float, float, float]
Size3 = tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class Thing:
    """A body of the house and what it is."""

    id: str
    body: int
    category: Category
    size_m: Size3
    color: str
    movable: bool


class Things:
    """All furniture and things by house id."""

    def __init__(self, house: House, client: int, solids: Solids, physics: PhysicsSettings) -> None:
        self._house, self._client, self._solids, self._physics = house, client, solids, physics
        self._all: dict[str, Thing] = {}

    def __contains__(self, name: object) -> bool:
        return name in self._all

    def __iter__(self) -> Iterator[Thing]:
        return iter(self._all.values())

    def of_body(self, body: int) -> Thing | None:
        """The thing that is this body."""
        return next((thing for thing in self if thing.body == body), None)

    def forget(self, name: str) -> None:
        """Strike a thing off; its body is somebody else's to remove."""
        del self._all[name]

    def records(self, holding: str | None) -> list[dict[str, Any]]:
        """What can be moved, as the truth shows it."""
        return [self._record(thing, holding) for thing in self if thing.movable]

    def put_furniture(self, item: Furniture) -> None:
        """Stand a piece of furniture on the floor, for good."""
        category = category_named(item.category, item.size, static=True)
        size_m = item.size or category.size_m
        parts = category.parts(size_m, rgb_of(category, item.color))
        body = make_body(self._client, parts, 0.0, size_m[2], self._physics)
        self._solids.add_body(body, parts, size_m[2], fixed=True)
        place_body(self._client, body, (item.pose[0], item.pose[1], 0.0), item.pose[2], size_m[2])
        self._all[item.id] = Thing(
            id=item.id, body=body, category=category, size_m=size_m, color=item.color or category.color, movable=False
        )

    def put_object(self, item: Object) -> None:
        """Bring a new thing in.

        Raises:
            DisturbError: there is no room where it should go.
        """
        category = category_named(item.category, item.size)
        size_m = item.size or category.size_m
        mass_kg = category.mass_kg or 5.0
        parts = category.parts(size_m, rgb_of(category, item.color))
        body = make_body(self._client, parts, mass_kg, size_m[2], self._physics)
        self._solids.add_body(body, parts, size_m[2], fixed=False)
        thing = Thing(
            id=item.id, body=body, category=category, size_m=size_m, color=item.color or category.color, movable=True
        )
        place = Place.model_validate({"on": item.on, "in": item.in_, "offset": item.offset, "pose": item.pose})
        self._all[item.id] = thing
        self.place(thing, place)

    def place(self, thing: Thing, place: Place) -> None:
        """Put a thing somewhere at once, at rest.

        Raises:
            DisturbError: there is no such place, or no room in it.
        """
        self._solids.touch()
        if place.pose is not None:
            x_m, y_m, *rest = place.pose
            z_m, yaw_rad = (rest[0], rest[1]) if len(rest) == 2 else (0.0, rest[0] if rest else 0.0)
            place_body(self._client, thing.body, (x_m, y_m, z_m + 0.002), yaw_rad, thing.size_m[2])
            return
        carrier = self.named(place.on or place.in_, "to.on" if place.on else "to.in")
        pose, height_m = self._top(carrier, inside=place.in_ is not None)
        offset = place.offset or self._free_offset(carrier, pose, thing)
        x_m, y_m = to_house(pose, offset)
        place_body(self._client, thing.body, (x_m, y_m, height_m + 0.002), pose[2], thing.size_m[2])

    def _free_offset(self, carrier: Thing, pose: Pose2, thing: Thing) -> tuple[float, float]:
        others = [
            Standing(center_m=self._position(other)[:2], radius_m=max(other.size_m[:2]) / 2)
            for other in self._all.values()
            if other.movable and other.id not in (thing.id, carrier.id)
        ]
        offset = free_spot(
            pose, carrier.size_m[:2], max(thing.size_m[:2]) / 2, others, self._floor_around(carrier, pose)
        )
        if offset is None:
            raise DisturbError("to.on", f"no room for {thing.id} on {carrier.id}")
        return offset

    def _floor_around(self, carrier: Thing, pose: Pose2) -> list[tuple[float, float]]:
        """Floor points beside a piece of furniture that are in a room and not inside other furniture."""
        half_x, half_y = carrier.size_m[0] / 2 + 0.4, carrier.size_m[1] / 2 + 0.4
        beside = [to_house(pose, offset) for offset in ((half_x, 0.0), (-half_x, 0.0), (0.0, half_y), (0.0, -half_y))]
        return [
            point for point in beside if room_at(self._house, *point) is not None and not self._blocked(point, carrier)
        ]

    def _blocked(self, point: tuple[float, float], carrier: Thing) -> bool:
        for thing in self._all.values():
            if thing.movable or thing.id == carrier.id:
                continue
            if math.dist(point, self._position(thing)[:2]) < min(thing.size_m[:2]) / 2 + 0.2:
                return True
        return False

    def _record(self, thing: Thing, holding: str | None) -> dict[str, Any]:
        x_m, y_m, z_m = self._position(thing)
        carrier = None if thing.id == holding else self._carrier(thing)
        inside = carrier is not None and carrier.category.container and self._top(carrier, inside=True)[1] > z_m - 0.3
        contained = inside and carrier is not None and z_m < self._position(carrier)[2] + carrier.size_m[2] / 2
        return {
            "id": thing.id,
            "category": thing.category.name,
            "color": thing.color,
            "position_m": [x_m, y_m, z_m],
            "room": room_at(self._house, x_m, y_m),
            "on": carrier.id if carrier is not None and not contained else None,
            "in": carrier.id if carrier is not None and contained else None,
        }

    def _carrier(self, thing: Thing) -> Thing | None:
        """What a thing rests on, by contact from below."""
        contacts = p.getContactPoints(bodyA=thing.body, physicsClientId=self._client) or ()
        below = (self.of_body(int(contact[2])) for contact in contacts if contact[7][2] > 0.5)
        return next((carrier for carrier in below if carrier is not None), None)

    def _top(self, carrier: Thing, *, inside: bool) -> tuple[Pose2, float]:
        """Pose of a carrier in the plane, and the height on which things stand on it or in it."""
        position, quaternion = p.getBasePositionAndOrientation(carrier.body, physicsClientId=self._client)
        yaw_rad = p.getEulerFromQuaternion(quaternion)[2]
        level = carrier.category.levels[0] if inside or carrier.category.levels else 1.0
        bottom_m = position[2] - carrier.size_m[2] / 2
        return (position[0], position[1], yaw_rad), bottom_m + level * carrier.size_m[2]

    def _position(self, thing: Thing) -> Size3:
        position: Size3 = p.getBasePositionAndOrientation(thing.body, physicsClientId=self._client)[0]
        return position

    def named(self, name: str | None, path: str) -> Thing:
        """The thing of this id.

        Raises:
            DisturbError: naming the field ``path``, and what there is.
        """
        if name is None or name not in self._all:
            raise DisturbError(path, f"no {name!r}; there are {', '.join(self._all) or 'none'}")
        return self._all[name]
