"""Every time the robot tried to pick something up or to put it down, and whether that came off at the first go."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from evaluations.missions.outcome import Scene
from planner.tasks.tasks import StepStatus, Task

HANDLING = ("PICK", "PLACE")


@dataclass(frozen=True, kw_only=True)
class Attempt:
    """One go at a step. ``done``: whether the robot took it for done, and, once looked up, whether the truth agrees.

    ``calm``: nobody had interfered by then.
    """

    step: str
    skill: str
    done: bool
    calm: bool = True


class Attempts:
    """Follows the versions of one task; a step counts once it has begun and then succeeded or failed.

    Attributes:
        checked: attempts that were compared with the truth.
    """

    def __init__(self) -> None:
        self.checked: list[Attempt] = []
        self._fresh: list[Attempt] = []
        self._under_way: tuple[int, str] | None = None

    def follow(self, task: Task) -> None:
        """Take in the next version of the task; every one of them has to be shown."""
        steps = task.plan.steps if task.plan is not None else ()
        if self._under_way is not None:
            index, text = self._under_way
            step = steps[index] if index < len(steps) and steps[index].text == text else None
            if step is not None and step.status in (StepStatus.SUCCEEDED, StepStatus.FAILED):
                done = step.status is StepStatus.SUCCEEDED
                self._fresh += [Attempt(step=text, skill=step.skill, done=done)] if step.skill in HANDLING else []
            if step is None or step.status is not StepStatus.RUNNING:
                self._under_way = None
        running = next((i for i, step in enumerate(steps) if step.status is StepStatus.RUNNING), None)
        if running is not None:
            self._under_way = (running, steps[running].text)

    def check(self, scene: Scene, *, calm: bool) -> Sequence[Attempt]:
        """What was tried since the last time: a pick leaves something in the hand, a placing leaves it empty."""
        found = [
            replace(attempt, calm=calm, done=attempt.done and (scene.holding is not None) == (attempt.skill == "PICK"))
            for attempt in self._fresh
        ]
        self.checked += found
        self._fresh = []
        return found
