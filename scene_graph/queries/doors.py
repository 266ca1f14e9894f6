"""Physical doors: door nodes that match each other are one (design, section 9)."""

from __future__ import annotations

from dataclasses import dataclass

from scene_graph.edges import EdgeType
from scene_graph.identifiers import natural_key
from scene_graph.nodes import CrossingStatus, DoorNode, DoorState
from scene_graph.snapshot import Snapshot


@dataclass(frozen=True, kw_only=True)
class PhysicalDoor:
    """One door of the building.

    Attributes:
        members: its nodes in natural order, one for each room from which it was seen.
        rooms: one or two rooms; the first member's own room first. Rooms that are not loaded are left out.
        state: what the member written last says, unless it does not know.
    """

    members: tuple[DoorNode, ...]
    rooms: tuple[str, ...]
    state: DoorState
    provisional: bool
    crossing: CrossingStatus

    @property
    def id(self) -> str:
        """Identifier of the first member, which stands for the door."""
        return self.members[0].id

    def side(self, room_id: str) -> DoorNode:
        """The node that belongs to the room, or the first one."""
        return next((member for member in self.members if member.rooms[0] == room_id), self.members[0])


def physical_doors(snapshot: Snapshot) -> tuple[PhysicalDoor, ...]:
    """All doors of the building, in natural order of their identifiers."""
    doors: list[PhysicalDoor] = []
    seen: set[str] = set()
    for door in snapshot.of_type(DoorNode):
        if door.id not in seen:
            members = _matched(snapshot, door.id)
            seen.update(members)
            doors.append(_joined(snapshot, members))
    return tuple(doors)


def _matched(snapshot: Snapshot, door_id: str) -> list[str]:
    found = [door_id]
    for member in found:  # grows while it is walked
        ends = [edge.target for edge in snapshot.edges_from(member, EdgeType.MATCH)]
        ends += [edge.source for edge in snapshot.edges_to(member, EdgeType.MATCH)]
        found.extend(end for end in ends if end not in found)
    return sorted(found, key=natural_key)


def _joined(snapshot: Snapshot, ids: list[str]) -> PhysicalDoor:
    members = [snapshot.door(door_id) for door_id in ids]
    own = [member.rooms[0] for member in members]
    told = [room for member in members for room in member.rooms]
    connected = [edge.target for door_id in ids for edge in snapshot.edges_from(door_id, EdgeType.CONNECTS)]
    rooms = dict.fromkeys(room for room in (*own, *told, *connected) if room is not None and room in snapshot)
    newest_first = sorted(members, key=lambda member: -snapshot.revision_of(member.id))
    known = [member.state for member in newest_first if member.state is not DoorState.UNKNOWN]
    crossed = any(member.crossing is CrossingStatus.CROSSED for member in members)
    return PhysicalDoor(
        members=tuple(members),
        rooms=tuple(rooms),
        state=known[0] if known else DoorState.UNKNOWN,
        provisional=all(member.provisional for member in members),
        crossing=CrossingStatus.CROSSED if crossed else members[0].crossing,
    )
