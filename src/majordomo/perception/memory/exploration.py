"""When is the building explored?"""

from __future__ import annotations

from dataclasses import replace

from majordomo.scene_graph.edges import IntentionStatus
from majordomo.scene_graph.memory import WorkingMemory
from majordomo.scene_graph.nodes import CrossingStatus, DoorNode, RoomNode, RoomStatus
from majordomo.scene_graph.snapshot import Snapshot

_OPEN = frozenset({IntentionStatus.PROPOSED, IntentionStatus.GRANTED, IntentionStatus.REVOKED})
_QUIET_S = 4.0
_TASK_PREFIX = "task:"


def nothing_left(snapshot: Snapshot) -> bool:
    """Whether every door is crossed or given up, every room stands, and nobody but tasks wants the robot.

    The agent that looks around in rooms asks for it by an intention, so an open one keeps the building unexplored.
    """
    rooms, doors = snapshot.of_type(RoomNode), snapshot.of_type(DoorNode)
    return (
        len(rooms) > 0
        and all(room.status is not RoomStatus.TEMPORARY for room in rooms)
        and all(not door.provisional and door.crossing is not CrossingStatus.UNCROSSED for door in doors)
        and not any(edge.status in _OPEN and not edge.agent.startswith(_TASK_PREFIX) for edge in snapshot.intentions())
    )


class ExplorationJudge:
    """Sets ``explored`` on the root when nothing has been left for a while, and takes it back when something turns up.

    The while gives every agent the time to ask for more after a room or a door was finished. Rooms with something left
    are never unloaded, so that working memory tells it all.
    """

    def __init__(self, memory: WorkingMemory) -> None:
        self._memory = memory
        self._quiet_since_s: float | None = None

    def update(self, agent: str, stamp_s: float) -> None:
        """Judge the graph as it is now."""
        snapshot = self._memory.snapshot()
        if not nothing_left(snapshot):
            self._quiet_since_s = None
        elif self._quiet_since_s is None:
            self._quiet_since_s = stamp_s
        explored = self._quiet_since_s is not None and stamp_s >= self._quiet_since_s + _QUIET_S
        if explored != snapshot.root.explored:
            with self._memory.edit(agent, stamp_s) as tx:
                tx.put(replace(snapshot.root, explored=explored))
