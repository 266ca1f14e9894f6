"""When is the building explored?"""

from __future__ import annotations

from dataclasses import replace

from majordomo.perception.crossing import nothing_left
from majordomo.scene_graph.memory import WorkingMemory

_QUIET_S = 4.0


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
