"""What the parts of the door concept work on in one step: the room, its evidence, and the doors known in it."""

from __future__ import annotations

from dataclasses import dataclass

from perception.doors.room_evidence import RoomEvidence, Span
from perception.doors.wall_evidence import Gap
from perception.localization.doorways import doors_in
from perception.localization.room_model import RoomModel
from scene_graph.identifiers import wall_id_of
from scene_graph.nodes import DoorNode
from scene_graph.snapshot import Snapshot


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """The current room with everything its walls have shown so far."""

    snapshot: Snapshot
    room: RoomModel
    evidence: RoomEvidence
    stamp_s: float

    def wall_length_m(self, wall: int) -> float:
        return float(self.evidence.walls.length_m[wall])

    def wall_exists(self, wall: int) -> bool:
        """Whether the wall is in the graph: of a partial room, unseen walls are not."""
        return wall_id_of(self.room.room_id, wall) in self.snapshot

    def doors(self) -> list[tuple[DoorNode, int, Span]]:
        """Known doors of the room, each with its wall's index and its place in the wall."""
        found: list[tuple[DoorNode, int, Span]] = []
        for wall in range(len(self.room.polygon)):
            wall_id = wall_id_of(self.room.room_id, wall)
            for door, station_m in doors_in(self.snapshot, wall_id):
                center_m = station_m + self.wall_length_m(wall) / 2.0
                found.append((door, wall, Span(center_m=center_m, width_m=door.width_m)))
        return found

    def unexplained(self) -> list[tuple[int, Gap]]:
        """Gaps and closed leaves that are none of the known doors, with the index of their wall."""
        known = self.doors()
        return [
            (wall, gap)
            for wall in range(len(self.room.polygon))
            if self.wall_exists(wall)
            for gap in (*self.evidence.gaps(wall), *self.evidence.recesses(wall))
            if not any(other == wall and span.overlaps(gap) for _, other, span in known)
        ]

    def unseen(self) -> list[tuple[int, Gap]]:
        """Stretches of wall that could hide a door, with the index of their wall."""
        known = self.doors()
        return [
            (wall, stretch)
            for wall in range(len(self.room.polygon))
            if self.wall_exists(wall)
            for stretch in self.evidence.unseen(wall, [span for _, other, span in known if other == wall])
        ]
