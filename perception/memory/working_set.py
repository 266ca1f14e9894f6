"""Which rooms working memory holds: those around the robot, and those that somebody needs (Concepts, section 4)."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from dataclasses import dataclass

from perception.crossing import door_being_crossed
from scene_graph.edges import HasIntentionEdge
from scene_graph.long_term.room_parts import keeps_in_use, unfinished
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode, RoomNode
from scene_graph.queries.topology import Topology
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class WorkingSetSettings:
    """How long rooms are held."""

    linger_s: float = 5.0
    """A room stays for so long after nobody needs it, so that turning back in a door loads nothing. Chosen."""


class WorkingSet:
    """Loads rooms before they are entered and unloads them when they are of no use.

    Held are the robot's room and those behind its doors, so that every far side is there before its door is crossed;
    rooms in which something is left to explore or that an open intention names; and, for a task, the rooms of what it
    names and those on the way there. While a door is being crossed into the unknown, nothing is unloaded: the old room
    goes when the new one stands. While the robot is in no room, everything stays as it is.
    """

    def __init__(self, agent: str, memory: WorkingMemory, settings: WorkingSetSettings = WorkingSetSettings()) -> None:
        self._agent = agent
        self._memory = memory
        self._settings = settings
        self._idle_since_s: dict[str, float] = {}
        self._way: tuple[tuple[Topology, str, frozenset[str]], frozenset[str]] | None = None

    def update(self, stamp_s: float) -> None:
        """Bring working memory in line with what is needed now."""
        if not self._memory.can_unload:
            return
        wanted = self._wanted(self._memory.snapshot())
        missing = [room for room in wanted if room not in self._memory.snapshot()]
        if missing:
            self._memory.load(*missing, agent=self._agent, stamp_s=stamp_s)
        self._let_go(wanted, stamp_s)

    def _wanted(self, snapshot: Snapshot) -> dict[str, None]:
        """The rooms to hold, in the order in which they were thought of."""
        here = snapshot.current_room
        if here is None:
            return dict.fromkeys(room.id for room in snapshot.of_type(RoomNode))
        rooms = [here, *neighbors(snapshot, here), *self._memory.unfinished]
        rooms += [room.id for room in snapshot.of_type(RoomNode) if unfinished(room)]
        rooms += [door.rooms[0] for door in snapshot.of_type(DoorNode) if unfinished(door)]
        asked = [edge for edge in snapshot.intentions() if edge.is_open]
        rooms += self._rooms_of(edge.target for edge in asked)
        rooms += sorted(self._on_the_way(here, frozenset(self._rooms_of(_named(asked)))))
        return dict.fromkeys(rooms)

    def _rooms_of(self, node_ids: Iterable[str]) -> list[str]:
        homes = (self._memory.room_of(node_id) for node_id in node_ids)
        return [home for home in homes if home is not None]

    def _on_the_way(self, here: str, goals: frozenset[str]) -> frozenset[str]:
        """Rooms on the shortest ways from here to each of the goals, and the goals."""
        if goals <= {here}:
            return goals
        topology = Topology.from_snapshot(self._memory.building())
        asked = (topology, here, goals)
        if self._way is None or self._way[0] != asked:
            ways = [topology.path(here, goal) for goal in sorted(goals)]
            self._way = (asked, goals.union(*(way.rooms for way in ways if way is not None)))
        return self._way[1]

    def _let_go(self, wanted: dict[str, None], stamp_s: float) -> None:
        """Unload what nobody has needed for a while."""
        snapshot = self._memory.snapshot()
        idle = [room.id for room in snapshot.of_type(RoomNode) if room.id not in wanted]
        self._idle_since_s = {room: self._idle_since_s.get(room, stamp_s) for room in idle}
        if door_being_crossed(snapshot) is not None:
            return
        patience_s = self._settings.linger_s
        gone = [room for room, since_s in self._idle_since_s.items() if stamp_s >= since_s + patience_s]
        gone = [room for room in gone if keeps_in_use(snapshot, room) is None]
        if gone:
            self._memory.unload(*gone, agent=self._agent, stamp_s=stamp_s)
            logger.debug("unloaded %s", ", ".join(gone), extra={"rooms": gone})


def neighbors(snapshot: Snapshot, room_id: str) -> list[str]:
    """Rooms known to lie behind the doors of a room, loaded or not, in the order of the doors."""
    found: dict[str, None] = {}
    for door in snapshot.of_type(DoorNode):
        near, far = door.rooms
        if far is not None and room_id in (near, far):
            found[far if near == room_id else near] = None
    return list(found)


def _named(edges: Iterable[HasIntentionEdge]) -> list[str]:
    return [node_id for edge in edges for node_id in edge.needs]
