"""What the robot is doing and how its agents keep their rates, as ``GET /v1/status`` shows it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from app.settings import Settings
from app.stacks.robot import RobotStack
from app.stacks.stack import Stack
from app.views.scene import SceneView
from planner.tasks.queue import TaskQueue


class StatusView:
    """The status of one running stack.

    Args:
        now: robot time in seconds.
        agents: rate and busy time of every agent by its name.
        lost: why there is no robot any more, empty while there is.
    """

    def __init__(
        self,
        stack: Stack,
        scene: SceneView,
        settings: Settings,
        queue: TaskQueue,
        *,
        now: Callable[[], float],
        agents: Callable[[], dict[str, Any]],
        lost: Callable[[], str],
    ) -> None:
        self._stack, self._scene, self._settings, self._queue = stack, scene, settings, queue
        self._now, self._agents, self._lost = now, agents, lost

    def document(self) -> dict[str, Any]:
        """The body of ``GET /v1/status``."""
        stack, settings = self._stack, self._settings
        snapshot = stack.memory.snapshot()
        robot = self._scene.robot()
        current = self._queue.current
        return {
            "stamp_s": round(self._now(), 3),
            "clock": str(settings.clock),
            "house": settings.robot or settings.house,
            "exploring": stack.exploring and not snapshot.root.explored,
            "explored": snapshot.root.explored,
            "task": current.id if current else None,
            "stopped": robot["stopped"],
            "robot": {key: robot[key] for key in ("room", "localized", "pose_map", "holding")},
            "language_model": settings.llm,
            "network": stack.network,
            "agents": self._agents(),
            "simulator": self._lost() or ("running" if isinstance(stack, RobotStack) else "none"),
            "perception": stack.degraded,
            "camera": stack.look is not None,
            "revision": snapshot.revision,
        }
