"""Words for where things are to each other, by geometry: *between*, *left of*, *behind*, *under*.

What a panoptic scene graph states is believed first. *Left*, *right*, *behind* and *in front of* are as the robot sees
them, so they mean nothing for things in another room.
"""

from __future__ import annotations

from math import hypot

from planner.goals import gap_m
from planner.grounding.settings import GroundingSettings
from scene_graph.errors import FramesNotConnected
from scene_graph.nodes import ROBOT_ID, ROOT_ID
from scene_graph.snapshot import Snapshot

SPATIAL = {
    "under": ("under", "below", "beneath", "underneath"),
    "behind": ("behind",),
    "in front of": ("in front of",),
    "over": ("over", "above"),
    "against": ("against", "attached to", "leaning on"),
    "left of": ("left of", "to the left of", "on the left of", "on the left side of", "to the left side of"),
    "right of": ("right of", "to the right of", "on the right of", "on the right side of", "to the right side of"),
}
"""Relations that a panoptic scene graph may hold, by the word that asks for them."""
VIEWED = frozenset({"left of", "right of", "behind", "in front of"})


def relation_name(words: str) -> str:
    """The name in ``SPATIAL`` of a relation as typed."""
    return next((name for name, same in SPATIAL.items() if words in same), words)


def is_related(
    node_id: str, words: str, target: str, snapshot: Snapshot, *, settings: GroundingSettings = GroundingSettings()
) -> bool:
    """Whether a node is *under*, *left of*, *behind* … a target."""
    name = relation_name(words)
    if any(snapshot.relations(node_id, other, target) for other in SPATIAL.get(name, (words,))):
        return True
    if node_id == target or snapshot.room_of(node_id) != snapshot.room_of(target):
        return False
    if name in ("under", "over"):
        return _is_above(target, node_id, snapshot) if name == "under" else _is_above(node_id, target, snapshot)
    return name in VIEWED and is_in_view(target, snapshot) and _is_beside(node_id, name, target, snapshot, settings)


def is_in_view(node_id: str, snapshot: Snapshot) -> bool:
    """Whether the robot is in the room of a node, so that *left* has a meaning."""
    return snapshot.current_room is not None and snapshot.room_of(node_id) == snapshot.current_room


def is_between(
    node_id: str, one: str, other: str, snapshot: Snapshot, *, settings: GroundingSettings = GroundingSettings()
) -> bool:
    """Whether a node lies between two others in its room."""
    if len({node_id, one, other}) < 3 or len({snapshot.room_of(i) for i in (node_id, one, other)}) > 1:
        return False
    try:
        (x, y, _), (ax, ay, _), (bx, by, _) = (_at(i, snapshot) for i in (node_id, one, other))
    except FramesNotConnected:
        return False
    length_m = hypot(bx - ax, by - ay)
    if length_m == 0.0:
        return False
    along = ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length_m**2
    aside_m = abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length_m
    return 0.0 < along < 1.0 and aside_m <= max(settings.between_m, length_m * settings.between_share)


def leftwards_m(node_id: str, among: tuple[str, ...], snapshot: Snapshot) -> float:
    """How far left of the middle of ``among`` a node is, as the robot sees it; negative to the right."""
    places = [_at(i, snapshot) for i in among]
    middle = (sum(p[0] for p in places) / len(places), sum(p[1] for p in places) / len(places))
    x, y, _ = _at(node_id, snapshot)
    return _frame(middle, (x, y), snapshot)[1]


def _is_above(high: str, low: str, snapshot: Snapshot) -> bool:
    supported = snapshot.support_of(high) == low or snapshot.support_of(low) == high
    try:
        above = _at(high, snapshot)[2] > _at(low, snapshot)[2]
    except FramesNotConnected:
        return False
    return above and not supported and gap_m(snapshot, high, low) == 0.0


def _is_beside(node_id: str, name: str, target: str, snapshot: Snapshot, settings: GroundingSettings) -> bool:
    try:
        x, y, _ = _at(node_id, snapshot)
        tx, ty, _ = _at(target, snapshot)
        ahead_m, left_m = _frame((tx, ty), (x, y), snapshot)
    except FramesNotConnected:
        return False
    if gap_m(snapshot, node_id, target) > settings.beside_m:
        return False
    toward = {"left of": left_m, "right of": -left_m, "behind": ahead_m, "in front of": -ahead_m}[name]
    across = ahead_m if name in ("left of", "right of") else left_m
    return toward > settings.aside_m and toward >= abs(across)


def _frame(origin: tuple[float, float], point: tuple[float, float], snapshot: Snapshot) -> tuple[float, float]:
    """How far ``point`` is beyond and to the left of ``origin``, looking from the robot."""
    rx, ry, _ = _at(ROBOT_ID, snapshot)
    dx, dy = origin[0] - rx, origin[1] - ry
    length_m = hypot(dx, dy) or 1.0
    px, py = point[0] - origin[0], point[1] - origin[1]
    return (px * dx + py * dy) / length_m, (dx * py - dy * px) / length_m


def _at(node_id: str, snapshot: Snapshot) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in snapshot.position(node_id, ROOT_ID))
    return x, y, z
