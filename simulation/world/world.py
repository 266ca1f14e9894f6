"""A house in a PyBullet physics client: walls, doors, furniture, things and people, and what happens to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pybullet as p

from simulation.errors import DisturbError
from simulation.houses.house import ROBOT, Disturbance, House, Object, Place
from simulation.world.bodies import make_block, make_floor, wake_bodies
from simulation.world.people import HEIGHT_M, Walker, person_body, person_parts
from simulation.world.physics import PhysicsSettings
from simulation.world.solids import Solids
from simulation.world.things import Things
from simulation.world.walls import Opening, openings, panel, wall_blocks

WALL_RGB = (0.90, 0.89, 0.85)
FLOOR_RGB = (0.62, 0.55, 0.47)
DOOR_RGB = (0.55, 0.38, 0.24)

Pose2 = tuple[float, float, float]
Size3 = tuple[float, float, float]


class World:
    """A house built in an existing PyBullet client. Things have settled when the constructor returns.

    Sets gravity, not the time step. ``move_robot`` is set by the engine: it carries out ``move`` of the id "robot".
    """

    def __init__(
        self, house: House, *, client: int, rng: np.random.Generator, physics: PhysicsSettings = PhysicsSettings()
    ) -> None:
        self.house, self._physics = house, physics
        self.move_robot: Callable[[Pose2], None] | None = None
        self.solids = Solids(client)
        self._client, self._rng = client, rng
        self._things = Things(house, client, self.solids, physics)
        self._structure: dict[int, str] = {}
        self._panels: dict[str, int] = {}
        self._walkers: dict[str, Walker] = {}
        self._due = sorted(house.events, key=lambda event: event.at_s)
        p.setGravity(0.0, 0.0, -physics.gravity_mps2, physicsClientId=client)
        self._gaps: dict[str, Opening] = {gap.door.id: gap for gap in openings(house)}
        self._build()

    def category_of(self, body_id: int) -> str | None:
        """Category of a body: "bottle", "person", "wall", "floor", "door" …; ``None`` for what is not the house's."""
        if body_id in self._structure:
            return self._structure[body_id]
        name = self.id_of(body_id)
        if name is None:
            return None
        return "person" if name in self._walkers else self._things.named(name, "id").category.name

    def id_of(self, body_id: int) -> str | None:
        """House id of furniture, a thing or a person."""
        thing = self._things.of_body(body_id)
        if thing is not None:
            return thing.id
        return next((name for name, walker in self._walkers.items() if walker.body == body_id), None)

    def apply(self, event: Disturbance) -> None:
        """Carry out one disturbance at once.

        Raises:
            DisturbError: it cannot happen in this house as it is now.
        """
        match event.do:
            case "move":
                self._move(self._named(event.id), event.to or Place())
            case "remove":
                self._remove(self._named(event.id))
            case "add":
                self._add(event.object)
            case "close_door":
                self._close(self._named(event.id))
            case "open_door":
                self._open(self._named(event.id))
            case "walk":
                self._walk(self._named(event.id), event.to or Place())
        wake_bodies(self._client, (thing.body for thing in self._things if thing.movable))

    def advance(self, dt_s: float, now_s: float) -> None:
        """Carry out the house's events due at ``now_s`` and let people walk on for ``dt_s``."""
        while self._due and self._due[0].at_s <= now_s:
            self.apply(self._due.pop(0))
        walking = [walker for walker in self._walkers.values() if walker.walks]
        strangers = self._strangers() if walking else []
        for walker in walking:
            walker.advance(dt_s, strangers)

    def truth(
        self,
        *,
        stamp_s: float,
        robot_pose: Pose2,
        holding: str | None,
        collisions: int,
        touched: Sequence[str] = (),
    ) -> dict[str, Any]:
        """Body of ``GET /v1/simulation/truth``, in house coordinates; for evaluations, also where people are and what
        the robot ``touched`` lately, newest last, by identifier in the house or by kind.
        """
        return {
            "stamp_s": round(stamp_s, 6),
            "house": self.house.name,
            "robot": {"pose": list(robot_pose), "holding": holding},
            "objects": self._things.records(holding),
            "doors": [
                {"id": door.id, "state": "closed" if door.id in self._panels else "open"} for door in self.house.doors
            ],
            "people": [{"id": name, "position_m": list(walker.position_m)} for name, walker in self._walkers.items()],
            "collisions": collisions,
            "touched": list(touched),
        }

    def _build(self) -> None:
        corners = [point for room in self.house.rooms for point in room.polygon]
        low = (min(x for x, _ in corners) - 1.0, min(y for _, y in corners) - 1.0)
        high = (max(x for x, _ in corners) + 1.0, max(y for _, y in corners) + 1.0)
        self._structure[make_floor(self._client, low, high, FLOOR_RGB, self._physics)] = "floor"
        for block in wall_blocks(self.house):
            body = make_block(self._client, block, WALL_RGB)
            self._structure[body] = "wall"
            self.solids.add_block(body, block)
        for door in self.house.doors:
            if door.state == "closed":
                self._close(door.id)
        for furniture in self.house.furniture:
            self._things.put_furniture(furniture)
        for person in self.house.people:
            body = person_body(self._client, self._physics)
            self._walkers[person.id] = Walker(self._client, body, person.pose)
            self.solids.add_body(body, person_parts(), HEIGHT_M, fixed=False)
        for thing in self.house.objects:
            self._things.put_object(thing)
        for _ in range(self._physics.settle_steps):
            p.stepSimulation(physicsClientId=self._client)

    def _move(self, name: str, place: Place) -> None:
        if name == ROBOT:
            if self.move_robot is None or place.pose is None or len(place.pose) < 3:
                raise DisturbError("to.pose", "the robot is moved to [x, y, yaw]")
            self.move_robot((place.pose[0], place.pose[1], place.pose[2]))
        elif name in self._walkers:
            if place.pose is None:
                raise DisturbError("to.pose", "a person is moved to [x, y, yaw]")
            self._walkers[name].put((place.pose[0], place.pose[1], place.pose[2] if len(place.pose) > 2 else 0.0))
        else:
            self._things.place(self._things.named(name, "id"), place)

    def _remove(self, name: str) -> None:
        body = self._walkers.pop(name).body if name in self._walkers else self._things.named(name, "id").body
        if name in self._things:
            self._things.forget(name)
        self.solids.remove(body)
        p.removeBody(body, physicsClientId=self._client)

    def _add(self, item: Object | None) -> None:
        if item is None:
            raise DisturbError("object", "missing")
        if item.id in self._things or item.id in self._walkers:
            raise DisturbError("object.id", f"there is a {item.id} already")
        self._things.put_object(item)

    def _close(self, name: str) -> None:
        gap = self._gap(name)
        if name not in self._panels:
            block = panel(gap)
            body = self._panels[name] = make_block(self._client, block, DOOR_RGB)
            self._structure[body] = "door"
            self.solids.add_block(body, block)

    def _open(self, name: str) -> None:
        self._gap(name)
        if name in self._panels:
            body = self._panels.pop(name)
            self.solids.remove(body)
            p.removeBody(body, physicsClientId=self._client)
            del self._structure[body]

    def _walk(self, name: str, place: Place) -> None:
        if name not in self._walkers:
            raise DisturbError("id", f"no person {name!r}; there are {', '.join(self._walkers) or 'none'}")
        if place.pose is None:
            raise DisturbError("to.pose", "a person walks to [x, y]")
        self._walkers[name].walk_to((place.pose[0], place.pose[1]))

    def _strangers(self) -> list[tuple[float, float]]:
        """Where bodies stand that are not the house's: the robot."""
        known = {*self._structure, *(thing.body for thing in self._things)}
        known |= {walker.body for walker in self._walkers.values()}
        count = p.getNumBodies(physicsClientId=self._client)
        bodies = [p.getBodyUniqueId(index, physicsClientId=self._client) for index in range(count)]
        return [_planar(body, self._client) for body in bodies if body not in known]

    def _named(self, name: str | None) -> str:
        if name is None:
            raise DisturbError("id", "missing")
        return name

    def _gap(self, name: str) -> Opening:
        if name not in self._gaps:
            raise DisturbError("id", f"no door {name!r}; there are {', '.join(self._gaps) or 'none'}")
        return self._gaps[name]


def _planar(body: int, client: int) -> tuple[float, float]:
    """Where a body stands; a body on planar joints stands where its first moving links are."""
    if p.getNumJoints(body, physicsClientId=client) > 2:
        x_m, y_m, _ = p.getLinkState(body, 2, physicsClientId=client)[0]
        return x_m, y_m
    x_m, y_m, _ = p.getBasePositionAndOrientation(body, physicsClientId=client)[0]
    return x_m, y_m
