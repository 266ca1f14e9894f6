"""What the robot knows of in all: rooms, what it sees, what it holds, and things by their number."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from planner.answers.settings import AnswerSettings
from planner.grounding.matching import nodes_of
from planner.grounding.phrasing import article, describe, described, told_apart
from planner.naming import listed, name_of, plain_name
from scene_graph.nodes import ObjectNode, ObjectState, RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState

Told = tuple[str, tuple[str, ...]]
"""What is said, and the nodes it is about."""


class Inventory:
    """Says what there is on one graph."""

    def __init__(self, snapshot: Snapshot, state: PlanState, settings: AnswerSettings) -> None:
        self._snapshot, self._state, self._settings = snapshot, state, settings

    def of(self, nodes: Sequence[str]) -> str:
        """*A red cup and 2 × book*."""
        names = Counter(self._plain(i) for i in nodes)
        return listed([article(name) if count == 1 else f"{count} × {name}" for name, count in names.items()])

    def _plain(self, node_id: str) -> str:
        node = self._snapshot.node(node_id)
        if isinstance(node, ObjectNode):
            return plain_name(node)
        return described(node_id, self._snapshot)

    def robot_room(self) -> str:
        """Where the robot is."""
        room = self._snapshot.current_room
        if room is None:
            return "I do not know yet which room I am in."
        if not self._snapshot.room(room).label:
            return f"I am in {room}; I have no name for it."
        return f"I am in {describe(room, self._snapshot)}."

    def rooms(self) -> Told:
        """The rooms that are known."""
        rooms = tuple(node.id for node in nodes_of(self._snapshot) if isinstance(node, RoomNode))
        if not rooms:
            return "I do not know any room yet.", ()
        names = told_apart(rooms, self._snapshot)
        return f"I know {len(rooms)} room{'s' if len(rooms) > 1 else ''}: {listed(names)}.", rooms

    def seen(self) -> Told:
        """What is seen now."""
        now = self._snapshot.stamp_s - self._settings.now_s
        objects = [node for node in nodes_of(self._snapshot) if isinstance(node, ObjectNode)]
        fresh = tuple(node.id for node in objects if node.last_seen_s >= now and node.state is not ObjectState.MISSING)
        if fresh:
            return f"I see {self.of(fresh)}.", fresh
        number = f"{len(objects)} object{'s' if len(objects) != 1 else ''}"
        return f"I see no object right now. In all I know of {number}.", ()

    def holding(self) -> Told:
        """What the robot holds."""
        held = self._state.holding
        if held is None:
            return "I am holding nothing.", ()
        return f"I am holding {name_of(held, self._snapshot)}.", (held,)
