"""What stands on a piece of furniture, and on which of its surfaces, as the graph believes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from scene_graph.edges import EdgeType
from scene_graph.identifiers import natural_key
from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.furniture.furniture import Furniture, Surface, nearest
from skills.geometry import Points
from skills.room_contents import in_room


@dataclass(frozen=True, kw_only=True)
class StandingSettings:
    """What is taken to stand on a surface though no relation says so."""

    around_m: float = 0.1
    """So far beside the furniture its middle may seem to be. Chosen."""
    tolerance_m: float = 0.12
    """So far over or below the surface its bottom may seem to be. Chosen."""


@dataclass(frozen=True, kw_only=True)
class Stand:
    """On what a thing stands: the furniture ``on``, and the surface there. ``point_m``: the thing's middle in its
    frame.
    """

    on: str
    furniture: Furniture
    surface: Surface
    point_m: tuple[float, float, float]


def stand_of(snapshot: Snapshot, object_id: str) -> Stand | None:
    """Where a thing stands; ``None`` where it has no support that is known."""
    on = snapshot.support_of(object_id) if object_id in snapshot else None
    node = snapshot.get(on) if on is not None else None
    if on is None or not isinstance(node, ObjectNode):
        return None
    x_m, y_m, z_m = (float(value) for value in snapshot.position(object_id, on))
    furniture = Furniture.of(node)
    surface = furniture.surface_at(z_m - snapshot.object(object_id).size_m[2] / 2)
    return Stand(on=on, furniture=furniture, surface=surface, point_m=(x_m, y_m, z_m))


def stand_below(snapshot: Snapshot, object_id: str) -> Stand | None:
    """The same for what stands below a board; ``None`` for anything else."""
    stand = stand_of(snapshot, object_id)
    return stand if stand is not None and stand.surface.is_covered else None


def surfaces_of(snapshot: Snapshot, support_id: str, held: str | None) -> tuple[Surface, ...]:
    """The surfaces of a piece of furniture; those of which only the kind tells the height are where things stand on it
    already, but for ``held``.
    """
    surfaces = Furniture.of(snapshot.object(support_id)).surfaces
    if not any(surface.is_guessed for surface in surfaces):
        return surfaces
    bottoms = [
        _bottom_m(snapshot, support_id, node)
        for node in _objects_beside(snapshot, support_id)
        if node.id != held and node.state is ObjectState.PRESENT and snapshot.support_of(node.id) == support_id
    ]
    known_m = float(np.median(bottoms)) if bottoms else None
    return tuple(s if known_m is None or not s.is_guessed else replace(s, height_m=known_m) for s in surfaces)


def stands_on(
    snapshot: Snapshot, support_id: str, held: str | None, *, settings: StandingSettings = StandingSettings()
) -> list[ObjectNode]:
    """Objects whose extent touches a surface of ``support_id``, by relation or by geometry."""
    furniture = Furniture.of(snapshot.object(support_id))
    low_m, high_m = -furniture.half_m - settings.around_m, furniture.half_m + settings.around_m
    found = []
    for node in _objects_beside(snapshot, support_id):
        if node.id in (support_id, held) or node.state is not ObjectState.PRESENT:
            continue
        if snapshot.support_of(node.id) == support_id:
            found.append(node)
            continue
        if snapshot.room_of(node.id) != snapshot.room_of(support_id) or snapshot.support_of(support_id) == node.id:
            continue
        at_m = snapshot.transform(support_id, node.id).translation_m
        bottom_m = float(at_m[2]) - node.size_m[2] / 2
        near_m = abs(bottom_m - furniture.surface_at(bottom_m).height_m)
        if ((at_m[:2] > low_m) & (at_m[:2] < high_m)).all() and near_m < settings.tolerance_m:
            found.append(node)
    return found


def stands_at(
    snapshot: Snapshot, support_id: str, surfaces: Sequence[Surface], surface: Surface, held: str | None
) -> list[ObjectNode]:
    """Those of them that stand on one of the surfaces."""
    others = stands_on(snapshot, support_id, held)
    return [node for node in others if nearest(surfaces, _bottom_m(snapshot, support_id, node)) == surface]


def extent_on(snapshot: Snapshot, support_id: str, node: ObjectNode) -> tuple[Points, Points]:
    """Middle (2,) and half extents (2,) of a thing along the axes of what carries it."""
    T_support_node = snapshot.transform(support_id, node.id)
    c, s = abs(np.cos(T_support_node.yaw_rad)), abs(np.sin(T_support_node.yaw_rad))
    half = np.array([[c, s], [s, c]]) @ np.array(node.size_m[:2]) / 2
    return np.asarray(T_support_node.translation_m[:2]), half


def _bottom_m(snapshot: Snapshot, support_id: str, node: ObjectNode) -> float:
    return float(snapshot.position(node.id, support_id)[2]) - node.size_m[2] / 2


def _objects_beside(snapshot: Snapshot, support_id: str) -> list[ObjectNode]:
    """Objects of the support's room, and whatever is said to be on it."""
    room = snapshot.room_of(support_id)
    related = (edge.source for edge in snapshot.edges_to(support_id, EdgeType.RELATION))
    near = dict.fromkeys((*(in_room(snapshot, room) if room is not None else ()), *related))
    nodes = (snapshot.get(node_id) for node_id in sorted(near, key=natural_key))
    return [node for node in nodes if isinstance(node, ObjectNode)]
