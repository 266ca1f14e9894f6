"""A wish to be in one known room after another, as an agent would have it: through the graph."""

from __future__ import annotations

import numpy as np

from scene_graph.edges import EdgeKey, EdgeType, HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, RoomNode

_ENDED = (IntentionStatus.DONE, IntentionStatus.FAILED)


class Patrol:
    """Proposes visits to rooms drawn at random.

    Attributes:
        visits, failed: how many were proposed, and how many of them could not be done.
    """

    def __init__(self, agent: str, memory: WorkingMemory, *, seed: int = 0) -> None:
        self._agent, self._memory = agent, memory
        self._random = np.random.default_rng(seed)
        self._goal: str | None = None
        self.visits, self.failed = 0, 0

    def step(self, stamp_s: float) -> None:
        """Choose the next room when the last one was reached, or given up."""
        snapshot = self._memory.snapshot()
        key = EdgeKey(EdgeType.HAS_INTENTION, ROBOT_ID, self._goal, self._agent) if self._goal else None
        edge = snapshot.edges.get(key) if key else None
        if isinstance(edge, HasIntentionEdge) and edge.status not in _ENDED:
            return
        self.failed += isinstance(edge, HasIntentionEdge) and edge.status is IntentionStatus.FAILED
        here = snapshot.current_room
        others = [room.id for room in self._memory.building().of_type(RoomNode) if room.id != here]
        if not others:
            return
        self.visits += 1
        self._goal = str(self._random.choice(others))
        visit = HasIntentionEdge(
            source=ROBOT_ID,
            target=self._goal,
            agent=self._agent,
            action=IntentionAction.VISIT,
            priority=Priority.VISIT_DOOR,
            proposed_s=stamp_s,
        )
        with self._memory.edit(self._agent, stamp_s) as tx:
            if edge is not None:
                tx.remove(edge.key)
            tx.put(visit)
