"""The long-term memory agent (Concepts, section 3.6): which room the robot is in, how rooms hang together, and which
of them working memory holds.
"""

from __future__ import annotations

from perception.lidar.slice import OutlineSlicer
from perception.memory.exploration import ExplorationJudge
from perception.memory.room_layout import LAYOUT_AGENT, RoomLayout
from perception.memory.room_transition import RoomTransition
from perception.memory.working_set import WorkingSet, WorkingSetSettings
from perception.sensing import SensorBuffer
from scene_graph.memory import WorkingMemory


class LongTermMemory:
    """Agent that hangs the robot from the room it is in, joins rooms by doors, keeps their layout, and unloads them.

    A memory without long-term memory keeps all rooms.
    """

    name = LAYOUT_AGENT

    def __init__(
        self,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        *,
        settings: WorkingSetSettings | None = None,
        slicer: OutlineSlicer | None = None,
        period_s: float = 0.1,
    ) -> None:
        self.period_s = period_s
        self._layout = RoomLayout(memory)
        self._transition = RoomTransition(self.name, memory, buffer, slicer=slicer)
        self._working_set = WorkingSet(self.name, memory, settings)
        self._judge = ExplorationJudge(memory)

    async def step(self, stamp_s: float) -> None:
        """Follow the robot through doors, keep the layout, page rooms, and say when nothing is left to explore."""
        self._transition.run(stamp_s)
        self._layout.update(stamp_s)
        self._working_set.update(stamp_s)
        self._judge.update(self.name, stamp_s)
