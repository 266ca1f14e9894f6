"""Where the robot still has to look: rooms from their middle, supports from near (contracts, pattern 7).

Few stops: a support whose top was seen well enough while the robot did something else counts as inspected.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from majordomo.perception.objects.membership import Surroundings
from majordomo.perception.objects.projection import View, project
from majordomo.perception.objects.surface import Box
from majordomo.perception.objects.track import Track
from majordomo.perception.vocabulary import category_of
from majordomo.scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from majordomo.scene_graph.edits import Edit, PutEdge, RemoveEdge
from majordomo.scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState, RoomNode, RoomStatus
from majordomo.scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]
AGENT = "objects"
_GIVEN_UP = "given up"


@dataclass(frozen=True, kw_only=True)
class InspectionSettings:
    """``near_m``: from so near the smallest things get enough pixels. ``covered``: share of the top that must have
    been seen so.

    ``standoff_m`` is what stays between the robot's axis and the edge of a support; ``settled_hits``: sightings
    before a support's size is trusted.
    """

    near_m: float = 1.9
    covered: float = 0.85
    frames: int = 2
    standoff_m: float = 0.6
    standoff_limits_m: tuple[float, float] = (0.9, 1.6)
    settled_hits: int = 5
    tries: int = 2
    turning_limit_radps: float = 0.6

    def standoff_from(self, node: ObjectNode) -> float:
        """Meters from the middle of a support: its half short side and an arm's length."""
        low_m, high_m = self.standoff_limits_m
        return float(np.clip(self.standoff_m + min(node.size_m[:2]) / 2.0, low_m, high_m))


class Inspection:
    """What has been looked at, and what to propose.

    Attributes:
        inspected: when each room and support was inspected, by node, as far as this process has seen it.
    """

    def __init__(self, settings: InspectionSettings) -> None:
        self._settings = settings
        self.inspected: dict[str, float] = {}
        self._coverage: dict[str, NDArray[np.int64]] = {}
        self._failures: dict[str, int] = {}

    def looked(self, snapshot: Snapshot, stamp_s: float) -> dict[str, float]:
        """When each support and room was first looked at from near."""
        for edge in snapshot.intentions(IntentionStatus.DONE):
            if edge.agent == AGENT:
                self.inspected.setdefault(edge.target, stamp_s)
        stamps = {node.id: node.inspected_s for node in snapshot.of_type(ObjectNode) if node.inspected_s is not None}
        return {**self.inspected, **stamps}

    def watch(
        self, tracks: Sequence[Track], view: View, surroundings: Surroundings, turning_radps: float, snapshot: Snapshot
    ) -> None:
        """Count what this view shows, in passing, of supports not inspected yet."""
        if turning_radps > self._settings.turning_limit_radps:
            return
        for track in tracks:
            node = snapshot.get(track.node_id) if track.node_id is not None else None
            if not isinstance(node, ObjectNode) or not _worth_a_look(node) or node.id in self.inspected:
                continue
            if track.room in surroundings.T_here_room and self._covered(node.id, track, view, surroundings):
                self.inspected[node.id] = view.stamp_s

    def _covered(self, node_id: str, track: Track, view: View, surroundings: Surroundings) -> bool:
        """Whether all of the support's top has now been seen from near."""
        T = surroundings.T_here_room[track.room]
        box = Box(T.apply(track.position), track.box.size_m, track.box.yaw_rad + T.yaw_rad)
        grid = _top_grid(box)
        seen = self._coverage.setdefault(node_id, np.zeros(len(grid), dtype=np.int64))
        seen += _visible_from_near(grid, view, self._settings.near_m)
        share = float(np.mean(seen >= self._settings.frames))
        return share >= self._settings.covered and track.hits >= self._settings.settled_hits

    def edits(self, snapshot: Snapshot, stamp_s: float) -> list[Edit]:
        """Looks to propose, propose again or take back; a look at a support that is done leaves its stamp in
        ``inspected``.

        The edge of a room's look stays after it is done or given up: it is the record that the room was looked around.
        """
        ours = {edge.target: edge for edge in snapshot.intentions() if edge.agent == AGENT}
        edits: list[Edit] = []
        for target, edge in ours.items():
            node = snapshot.get(target)
            if isinstance(node, ObjectNode) and edge.status is IntentionStatus.DONE:
                self.inspected[target] = stamp_s
                edits.append(RemoveEdge(edge.key))
            elif edge.status is IntentionStatus.FAILED:
                edits += [PutEdge(again) for again in self._again(edge, stamp_s)]
            elif isinstance(node, ObjectNode) and edge.status is IntentionStatus.PROPOSED and not _worth_a_look(node):
                edits.append(RemoveEdge(edge.key))
        rooms = [
            room for room in snapshot.of_type(RoomNode) if room.status is RoomStatus.PERMANENT and room.id not in ours
        ]
        edits += [PutEdge(_look(room.id, 0.0, stamp_s)) for room in rooms]
        supports = [node for node in snapshot.of_type(ObjectNode) if self._ready(node, snapshot, ours)]
        edits += [PutEdge(_look(node.id, self._settings.standoff_from(node), stamp_s)) for node in supports]
        return edits

    def _again(self, edge: HasIntentionEdge, stamp_s: float) -> list[HasIntentionEdge]:
        """Propose a failed look once more; then leave it, with its reason, as given up."""
        if edge.reason.startswith("given up") or (edge.target in self._failures and self._failures[edge.target] < 0):
            return []
        self._failures[edge.target] = self._failures.get(edge.target, 0) + 1
        if self._failures[edge.target] < self._settings.tries:
            return [_look(edge.target, edge.standoff_m, stamp_s)]
        reason = f"{_GIVEN_UP} after {self._settings.tries} tries: {edge.reason or 'no reason said'}"
        return [_look(edge.target, edge.standoff_m, edge.proposed_s, IntentionStatus.FAILED, reason)]

    def _ready(self, node: ObjectNode, snapshot: Snapshot, ours: dict[str, HasIntentionEdge]) -> bool:
        """A support that stands, is not inspected, and whose room has been looked around already."""
        if node.id in ours or node.id in self.inspected:
            return False
        room = snapshot.room_of(node.id)
        looked = room is not None and room in ours and not ours[room].is_open
        return looked and _worth_a_look(node) and node.observations >= self._settings.settled_hits


def _worth_a_look(node: ObjectNode) -> bool:
    furniture = category_of(node.label, node.size_m).furniture
    return node.support and furniture and node.inspected_s is None and node.state is ObjectState.PRESENT


def _look(
    target: str, standoff_m: float, stamp_s: float, status: IntentionStatus = IntentionStatus.PROPOSED, reason: str = ""
) -> HasIntentionEdge:
    return HasIntentionEdge(
        source=ROBOT_ID,
        target=target,
        agent=AGENT,
        action=IntentionAction.LOOK,
        status=status,
        priority=Priority.LOOK_AROUND,
        standoff_m=standoff_m,
        proposed_s=stamp_s,
        reason=reason,
    )


def _top_grid(box: Box) -> Array:
    """(30, 3) points on the top of a box, a tenth of its sides in from the rim."""
    x, y = np.meshgrid(np.linspace(-0.4, 0.4, 6), np.linspace(-0.4, 0.4, 5))
    local = np.stack((x.ravel() * box.size_m[0], y.ravel() * box.size_m[1], np.full(30, box.size_m[2] / 2.0)), axis=1)
    return box.place(local)


def _visible_from_near(points: Array, view: View, near_m: float) -> NDArray[np.bool_]:
    """Which points are in the image, near, not hidden, and not looked at from below."""
    pixels, depth_m = project(view.T_room_camera.inverse().apply(points), view.intrinsics)
    with np.errstate(invalid="ignore"):
        inside = (
            (pixels >= 3.0).all(axis=1)
            & (pixels[:, 0] < view.intrinsics.width - 3.0)
            & (pixels[:, 1] < view.intrinsics.height - 3.0)
            & (depth_m > 0.2)
            & (depth_m < near_m)
        )
    u, v = np.round(np.where(inside[:, None], pixels, 0.0)).astype(np.int64).T
    measured_m = view.depth_m[v, u]
    unhidden = (measured_m > 0.0) & (measured_m > depth_m - 0.35)
    return np.asarray(inside & unhidden & (view.T_room_camera.z_m > points[:, 2] + 0.05))
