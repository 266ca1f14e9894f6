"""A stored scene graph and a planner, for people who have a graph and want plans."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from app.events.event_log import EventLog
from app.exchange.stored_graph import load_graph
from app.persistence.node_history import NodeHistory
from app.scheduler import Agent
from perception.objects.seeing.look import Look
from perception.ports import RgbdFrame
from planner.executor.executor import OnEvent
from planner.language.grammar.parser import CommandGrammar
from planner.mission.offline import OfflineMission
from planner.models.protocol import LanguageModel
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from planner.tasks.queue import TaskQueue
from scene_graph.memory import WorkingMemory
from skills.registry import load_registry


class GraphStack:
    """A stored scene graph and a planner; nothing moves."""

    def __init__(
        self,
        memory: WorkingMemory,
        queue: TaskQueue,
        model: LanguageModel | None,
        log: EventLog | None = None,
        *,
        grammar: CommandGrammar | None = None,
    ) -> None:
        self.memory = memory
        self.history = NodeHistory()
        self._started = time.monotonic() - memory.snapshot().stamp_s
        self._stopped = False
        skills = load_registry()
        verifier = Verifier(skills)
        self._log = log or EventLog(None)
        planner = TaskPlanner(
            grammar or CommandGrammar(),
            verifier,
            model,
            journal=lambda entry: self._log.write(self.now(), "model", entry),
        )
        on_event: OnEvent = lambda event: self._log.write(event["stamp_s"], "mission", event)  # noqa: E731
        self.agents: Sequence[Agent] = [OfflineMission(memory, queue, planner, verifier, on_event=on_event)]

    @classmethod
    def load(cls, path: Path, queue: TaskQueue, model: LanguageModel | None, log: EventLog | None = None) -> GraphStack:
        """Read the graph from a file.

        Raises:
            SceneFormatError: naming the offending field.
        """
        return cls(WorkingMemory(load_graph(path)), queue, model, log)

    @property
    def path_room(self) -> tuple[tuple[float, float], ...]:
        """Nothing drives."""
        return ()

    @property
    def stopped(self) -> bool:
        """Whether a person stopped; it is remembered although nothing moves."""
        return self._stopped

    @property
    def network(self) -> str | None:
        """Nothing is seen."""
        return None

    @property
    def look(self) -> Look | None:
        """There is no camera."""
        return None

    @property
    def frame(self) -> RgbdFrame | None:
        """There is no camera."""
        return None

    @property
    def exploring(self) -> bool:
        """A stored graph is not explored."""
        return False

    @property
    def degraded(self) -> str | None:
        """No perception, nothing wrong with it."""
        return None

    def now(self) -> float:
        """Seconds of the stored graph's clock, which goes on from the graph's stamp."""
        return time.monotonic() - self._started

    def stop(self) -> None:
        """Remember the stop."""
        self._stopped = True

    def release_stop(self) -> None:
        """Forget the stop."""
        self._stopped = False

    async def close(self) -> None:
        """Nothing to release."""
