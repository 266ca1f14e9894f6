"""Everything that people and programs are shown of one running stack."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from app.counters import Counters
from app.events.stream import EventStream
from app.settings import Settings
from app.stacks.stack import Stack
from app.views.camera import CameraWindow
from app.views.metrics import MetricsView
from app.views.scene import SceneView
from app.views.status import StatusView
from planner.tasks.queue import TaskQueue

NEWEST_TASKS = 50
"""So many tasks a client of the stream is told of when it comes."""


class Views:
    """Made anew whenever a stack is started.

    Args:
        now: robot time in seconds.
        agents: rate and busy time of every agent by its name.
        lost: why there is no robot any more, empty while there is.
    """

    def __init__(
        self,
        stack: Stack,
        settings: Settings,
        queue: TaskQueue,
        stream: EventStream,
        counters: Counters,
        *,
        now: Callable[[], float],
        agents: Callable[[], dict[str, Any]],
        lost: Callable[[], str],
    ) -> None:
        self._queue = queue
        self.camera = CameraWindow(lambda: stack.look)
        self.scene = SceneView(stack, now)
        self.status = StatusView(stack, self.scene, settings, queue, now=now, agents=agents, lost=lost)
        self.metrics = MetricsView(
            stack, queue, stream, counters, now=now, agents=agents, ready=lambda: not lost() and now() > 0.0
        )

    def snapshot(self) -> Mapping[str, Any]:
        """What a client of the stream begins with."""
        return {
            "scene": self.scene.document(),
            "tasks": [task.document() for task in self._queue.tasks[-NEWEST_TASKS:]],
            "robot": self.scene.robot(),
            "status": self.status.document(),
        }
