"""Lists of things, to be compared: those of the house by its truth, and those of the graph by a scene document.

Everything is in the house: meters and radians, z up. For scoring only.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from evaluations.mapping.floor_plan import FloorPlan, compare, placement, plan_of_house, plan_of_scene
from evaluations.perception.recognition import plain
from simulation.furnishing.catalog import category_named
from simulation.houses.house import House, room_at
from simulation.pictures.relations import Seen, Solid, true_relations

Array = NDArray[np.float64]
Size3 = tuple[float, float, float]
Relation = tuple[str, str, str]
"""Subject, predicate, object, by identifier."""

_THERE = ("present", "held")
_ANYWHERE = Seen(box_px=(0.0, 0.0, 1.0, 1.0), distance_m=1.0)
"""Where all stand equally far away, nothing stands in front of anything: that relation depends on the viewer."""


@dataclass(frozen=True, kw_only=True, eq=False)
class TrueThing:
    """A thing of the house: the center (3,) of its extent, that extent along its own axes, and its direction.

    ``on``, ``inside``: what carries or contains it.
    """

    id: str
    category: str
    position_m: Array
    size_m: Size3
    yaw_rad: float = 0.0
    furniture: bool = False
    room: str | None = None
    on: str | None = None
    inside: str | None = None

    @property
    def support(self) -> tuple[str, str] | None:
        """Predicate and carrier of a thing that something carries or contains."""
        if self.inside is not None:
            return "in", self.inside
        return ("on", self.on) if self.on is not None else None

    def gap_m(self, point_m: Array) -> float:
        """Distance of a point (3,) from its box, 0 inside."""
        dx, dy, dz = np.asarray(point_m) - self.position_m
        cos, sin = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        local = np.abs((cos * dx + sin * dy, cos * dy - sin * dx, dz))
        return float(np.linalg.norm(np.maximum(local - np.asarray(self.size_m) / 2.0, 0.0)))


@dataclass(frozen=True, kw_only=True, eq=False)
class GraphThing:
    """An object node that is said to be at its place or in the hand. ``label`` is the simulator's name of what it
    is called.

    ``room``: identifier of its room's node. ``position_m`` (3,) is in the house, laid upon it room by room.
    """

    id: str
    label: str
    position_m: Array
    size_m: Size3
    room: str | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class GraphContents:
    """What a scene document says. ``rooms``: true room -> room node; ``labels``: room node -> its label."""

    things: tuple[GraphThing, ...]
    relations: tuple[Relation, ...]
    rooms: Mapping[str, str]
    labels: Mapping[str, str]


def true_things(house: House, truth: Mapping[str, Any], sizes: Mapping[str, Size3]) -> tuple[TrueThing, ...]:
    """Furniture of the house and things of its truth.

    Args:
        house: as it was built.
        truth: the simulator's answer, with every thing that can be moved.
        sizes: extents of these by identifier (see ``sizes_of``), those that were brought in later too.
    """
    things = []
    for item in house.furniture:
        x_m, y_m, yaw_rad = item.pose
        size_m = item.size or category_named(item.category, static=True).size_m
        things.append(
            TrueThing(
                id=item.id,
                category=plain(item.category),
                position_m=np.array((x_m, y_m, size_m[2] / 2.0)),
                size_m=size_m,
                yaw_rad=yaw_rad,
                furniture=True,
                room=room_at(house, x_m, y_m),
            )
        )
    loose = [
        TrueThing(
            id=entry["id"],
            category=plain(entry["category"]),
            position_m=np.array(entry["position_m"]),
            size_m=sizes[entry["id"]],
            room=entry["room"],
            on=entry["on"],
            inside=entry["in"],
        )
        for entry in truth["objects"]
    ]
    return (*things, *loose)


def sizes_of(house: House) -> dict[str, Size3]:
    """Extent of every thing of the house that can be moved."""
    return {item.id: item.size or category_named(item.category).size_m for item in house.objects}


def true_relations_of(things: Sequence[TrueThing]) -> set[Relation]:
    """What holds between things of the same room, from wherever they are seen."""
    found: set[Relation] = set()
    for room in {thing.room for thing in things}:
        here = [thing for thing in things if thing.room == room]
        index = {thing.id: number for number, thing in enumerate(here)}
        solids = [_solid(thing, index) for thing in here]
        found |= {
            (here[subject].id, predicate, here[other].id)
            for subject, predicate, other in true_relations(solids, [_ANYWHERE] * len(here))
        }
    return found


def graph_contents(scene: Mapping[str, Any], house: House, *, lay: bool = True) -> GraphContents:
    """What a scene document of the map says, every found room laid upon the true one.

    Things in rooms that are none of the house's are placed by the pose in which the robot started; so are all, and no
    rooms are compared, unless ``lay`` is set: that takes some tenths of a second.
    """
    start = house.robot.pose
    found, true = plan_of_scene(scene, start), plan_of_house(house)
    same = compare(found, true).found if lay else {}
    places = _placements(found, true, same)
    nodes = [node for node in scene["nodes"] if node["type"] == "object" and node["state"] in _THERE]
    return GraphContents(
        things=tuple(_graph_thing(node, start, places) for node in nodes),
        relations=tuple(
            (edge["source"], edge["label"], edge["target"]) for edge in scene["edges"] if edge["type"] == "relation"
        ),
        rooms=same,
        labels={node["id"]: node["label"] for node in scene["nodes"] if node["type"] == "room"},
    )


def _placements(found: FloorPlan, true: FloorPlan, same: Mapping[str, str]) -> dict[str, tuple[Array, Array]]:
    return {ours: placement(found.rooms[ours], true.rooms[room]) for room, ours in same.items() if ours in found.rooms}


def _graph_thing(node: Mapping[str, Any], start: Sequence[float], lay: Mapping[str, tuple[Array, Array]]) -> GraphThing:
    x_m, y_m, z_m = node["position_m"]
    cos, sin = math.cos(start[2]), math.sin(start[2])
    point = np.array((start[0] + cos * x_m - sin * y_m, start[1] + sin * x_m + cos * y_m))
    if node["room"] in lay:
        rotation, shift = lay[node["room"]]
        point = rotation @ point + shift
    x, y, z = (float(side) for side in node["size_m"])
    return GraphThing(
        id=node["id"],
        label=plain(node["label"]),
        position_m=np.array((point[0], point[1], z_m)),
        size_m=(x, y, z),
        room=node["room"],
    )


def _solid(thing: TrueThing, index: Mapping[str, int]) -> Solid:
    x_m, y_m, z_m = (float(value) for value in thing.position_m)
    return Solid(
        center_m=(x_m, y_m, z_m),
        size_m=thing.size_m,
        yaw_rad=thing.yaw_rad,
        furniture=thing.furniture,
        on=index.get(thing.on or ""),
        inside=index.get(thing.inside or ""),
    )
