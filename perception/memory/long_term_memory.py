"""The long-term memory agent (Concepts, section 3.6): which room the robot is in, how rooms hang together, and which
of them working memory holds.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from perception.lidar.slice import OutlineSlicer
from perception.memory.exploration import ExplorationJudge, ExplorationSettings
from perception.memory.room_layout import LAYOUT_AGENT, LayoutSettings, RoomLayout
from perception.memory.room_transition import RoomTransition, TransitionSettings
from perception.memory.working_set import WorkingSet, WorkingSetSettings
from perception.sensing import SensorBuffer
from scene_graph.memory import WorkingMemory


@dataclass(frozen=True, kw_only=True)
class LongTermMemorySettings:
    """Settings of every part."""

    working_set: WorkingSetSettings = field(default_factory=WorkingSetSettings)
    exploration: ExplorationSettings = field(default_factory=ExplorationSettings)
    layout: LayoutSettings = field(default_factory=LayoutSettings)
    transition: TransitionSettings = field(default_factory=TransitionSettings)


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
        settings: LongTermMemorySettings = LongTermMemorySettings(),
        slicer: OutlineSlicer | None = None,
        period_s: float = 0.1,
    ) -> None:
        self.period_s = period_s
        self._layout = RoomLayout(memory, settings.layout)
        self._transition = RoomTransition(self.name, memory, buffer, settings=settings.transition, slicer=slicer)
        self._working_set = WorkingSet(self.name, memory, settings.working_set)
        self._judge = ExplorationJudge(memory, settings.exploration)

    async def step(self, stamp_s: float) -> None:
        """Follow the robot through doors, keep the layout, page rooms, and say when nothing is left to explore."""
        self._transition.run(stamp_s)
        self._layout.update(stamp_s)
        self._working_set.update(stamp_s)
        self._judge.update(self.name, stamp_s)
