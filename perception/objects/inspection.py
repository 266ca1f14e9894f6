"""Where the robot still has to look: rooms from their middle, supports from near (contracts, pattern 7).

Few stops: a support that was seen well enough while the robot did something else counts as inspected. One of which its
own look shows too little, such as a chair from behind, is looked at once more from the side of the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from perception.objects.furniture.coverage import Coverage, CoverageSettings, SeenSurface
from perception.objects.seeing.membership import Surroundings
from perception.objects.seeing.projection import View
from perception.objects.tracking.track import Track
from perception.vocabulary import category_of
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.edits import Edit, PutEdge, RemoveEdge
from scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

AGENT = "objects"
_GIVEN_UP = "given up"


@dataclass(frozen=True, kw_only=True)
class InspectionSettings:
    """``covered``: share of a support that must have been seen in passing; after a look of its own of which ``enough``
    came, none follows from another side.

    ``standoff_m`` is what stays between the robot's axis and the edge of a support, ``over_rim_m`` of one that things
    are put into; ``settled_hits``: sightings before a support's size is trusted.
    """

    coverage: CoverageSettings = field(default_factory=CoverageSettings)
    covered: float = 0.85
    enough: float = 0.7
    standoff_m: float = 0.6
    over_rim_m: float = 0.45
    settled_hits: int = 5
    tries: int = 2
    turning_limit_radps: float = 0.6
    above_m: float = 0.05
    """So far above a top the camera must be to see what is on it."""

    def standoff_from(self, node: ObjectNode) -> float:
        """Meters from the edge of a support: over the rim of a container one looks from nearer."""
        return self.over_rim_m if category_of(node.label, node.size_m).container else self.standoff_m


class Inspection:
    """What has been looked at, and what to propose.

    Attributes:
        inspected: when each room and support was inspected, by node, as far as this process has seen it.
    """

    def __init__(self, settings: InspectionSettings) -> None:
        self._settings = settings
        self.inspected: dict[str, float] = {}
        self._coverage: dict[str, Coverage] = {}
        self._failures: dict[str, int] = {}
        self._sides: dict[str, float] = {}

    def looked(self, snapshot: Snapshot, stamp_s: float) -> dict[str, float]:
        """When each support and room was first looked at from near."""
        for edge in snapshot.intentions(IntentionStatus.DONE):
            if edge.agent == AGENT and self._suffices(edge):
                self.inspected.setdefault(edge.target, stamp_s)
        stamps = {node.id: node.inspected_s for node in snapshot.of_type(ObjectNode) if node.inspected_s is not None}
        return {**self.inspected, **stamps}

    def watch(
        self, tracks: Sequence[Track], view: View, surroundings: Surroundings, turning_radps: float, snapshot: Snapshot
    ) -> None:
        """Count what this view shows, in passing, of supports not inspected yet. Those higher than the camera show
        themselves only to a look of their own, and so do those that things are put into.
        """
        if turning_radps > self._settings.turning_limit_radps:
            return
        seen: SeenSurface | None = None
        for track in tracks:
            node = snapshot.get(track.node_id) if track.node_id is not None else None
            if not isinstance(node, ObjectNode) or not _worth_a_look(node) or node.id in self.inspected:
                continue
            if (
                track.room not in surroundings.T_here_room
                or node.size_m[2] > view.T_room_camera.z_m - self._settings.above_m
            ):
                continue
            seen = seen or SeenSurface.of(view, self._settings.coverage)
            if self._covered(node.id, track, seen, surroundings):
                self.inspected[node.id] = view.stamp_s

    def _covered(self, node_id: str, track: Track, seen: SeenSurface, surroundings: Surroundings) -> bool:
        """Whether all of the support has now been seen from near."""
        box = track.box.seen_from(surroundings.T_here_room[track.room])
        settings = self._settings
        coverage = self._coverage.get(node_id)
        if coverage is None:
            coverage = Coverage(settings.coverage)
            self._coverage[node_id] = coverage
        coverage.add(box, seen, inside=track.category.container)
        self._sides[node_id] = coverage.hidden_side_rad(box)
        return (
            not track.category.container and coverage.share >= settings.covered and track.hits >= settings.settled_hits
        )

    def _suffices(self, edge: HasIntentionEdge) -> bool:
        """Whether a look that was had is the last one at its target: it showed enough, or came from a chosen side."""
        coverage = self._coverage.get(edge.target)
        return coverage is None or edge.side_rad is not None or coverage.share >= self._settings.enough

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
                edits.append(self._after(edge, stamp_s))
            elif edge.status is IntentionStatus.FAILED:
                edits += [PutEdge(again) for again in self._again(edge, stamp_s)]
            elif isinstance(node, ObjectNode) and edge.status is IntentionStatus.PROPOSED and not _worth_a_look(node):
                edits.append(RemoveEdge(edge.key))
        rooms = [
            room
            for room in snapshot.of_type(RoomNode)
            if room.status is not RoomStatus.TEMPORARY and room.id not in ours
        ]
        edits += [PutEdge(_look(room.id, 0.0, stamp_s)) for room in rooms]
        supports = [node for node in snapshot.of_type(ObjectNode) if self._ready(node, snapshot, ours)]
        edits += [PutEdge(_look(node.id, self._settings.standoff_from(node), stamp_s)) for node in supports]
        return edits

    def _after(self, edge: HasIntentionEdge, stamp_s: float) -> Edit:
        """What follows a look at a support: one from the side of what it did not show, or nothing."""
        if self._suffices(edge):
            self.inspected[edge.target] = stamp_s
            return RemoveEdge(edge.key)
        return PutEdge(replace(_look(edge.target, edge.standoff_m, stamp_s), side_rad=self._sides[edge.target]))

    def _again(self, edge: HasIntentionEdge, stamp_s: float) -> list[HasIntentionEdge]:
        """Propose a failed look once more; then leave it, with its reason, as given up."""
        if edge.reason.startswith("given up") or (edge.target in self._failures and self._failures[edge.target] < 0):
            return []
        self._failures[edge.target] = self._failures.get(edge.target, 0) + 1
        if self._failures[edge.target] < self._settings.tries:
            return [replace(_look(edge.target, edge.standoff_m, stamp_s), side_rad=edge.side_rad)]
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
