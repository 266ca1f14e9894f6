"""Which of several is the big one, the second largest, the one on the left."""

from __future__ import annotations

from math import prod

from planner.grounding.places import Places
from planner.grounding.settings import GroundingSettings
from planner.grounding.spatial import is_in_view, leftwards_m
from planner.language.grammar.references import COMPARATIVE
from scene_graph.nodes import ObjectNode, RoomNode
from scene_graph.snapshot import Snapshot


class Ordering:
    """Orders nodes of one graph by size, distance and side."""

    def __init__(self, snapshot: Snapshot, places: Places, settings: GroundingSettings) -> None:
        self._snapshot, self._places, self._settings = snapshot, places, settings

    def sized(self, found: list[str], size: str) -> list[str]:
        """Of several, those clearly at that end of the sizes."""
        if len(found) < 2:
            return found
        if size in COMPARATIVE:
            if len(found) == 2:
                return self.extreme(found, COMPARATIVE[size], 1)
            size = "big" if COMPARATIVE[size] == "largest" else "small"
        ordered = sorted(found, key=self._volume_m3, reverse=size == "big")
        edge, clearly = self._volume_m3(ordered[0]), self._settings.clearly_bigger
        limit = edge / clearly if size == "big" else edge * clearly
        return [i for i in found if (self._volume_m3(i) >= limit) == (size == "big") or self._volume_m3(i) == limit]

    def extreme(self, found: list[str], superlative: str, rank: int) -> list[str]:
        """The first, second … at one end; several when they are as near or large as each other."""
        if superlative in ("nearest", "farthest"):
            ordered = self._places.by_distance(found)
            return (ordered if superlative == "nearest" else ordered[::-1])[rank - 1 : rank]
        if superlative in ("leftmost", "rightmost"):
            return self._at_side(found, superlative)[rank - 1 : rank]
        volumes = sorted({self._volume_m3(i) for i in found}, reverse=superlative == "largest")
        edge = volumes[rank - 1 : rank]
        return [i for i in found if self._volume_m3(i) in edge]

    def _at_side(self, found: list[str], side: str) -> list[str]:
        """From left to right or back, as the robot sees them; all as they are when it does not."""
        if not all(is_in_view(i, self._snapshot) for i in found):
            return []
        left = {i: leftwards_m(i, tuple(found), self._snapshot) for i in found}
        return sorted(found, key=lambda i: -left[i] if side == "leftmost" else left[i])

    def _volume_m3(self, node_id: str) -> float:
        return volume_m3(node_id, self._snapshot)


def volume_m3(node_id: str, snapshot: Snapshot) -> float:
    """Of an object; of a room its area, in m²; 0 of others."""
    node = snapshot.node(node_id)
    if isinstance(node, ObjectNode):
        return prod(node.size_m)
    if isinstance(node, RoomNode):
        return _area_m2(node.polygon_m)
    return 0.0


def _area_m2(polygon: tuple[tuple[float, float], ...]) -> float:
    pairs = zip(polygon, (*polygon[1:], *polygon[:1]), strict=True)
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairs)) / 2
