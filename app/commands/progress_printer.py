"""Tells a person in a terminal what becomes of a task: its plan, each step, what failed, how it ended."""

from __future__ import annotations

from collections.abc import Iterator

from rich.console import Console
from rich.text import Text

from client import Task

STYLES = {
    "succeeded": "green",
    "failed": "red",
    "refused": "red",
    "cancelled": "yellow",
    "running": "cyan",
    "skipped": "dim",
    "plan": "bold",
    "new plan": "bold yellow",
}
_WIDTH = 10


class ProgressPrinter:
    """Prints what is new about one task, a line each."""

    def __init__(self, console: Console) -> None:
        self._console = console
        self._told: set[tuple[object, ...]] = set()
        self._plans: list[tuple[str, ...]] = []

    def tell(self, task: Task) -> None:
        """Print what has not been printed yet."""
        for key, word, text in self._lines(task):
            if key not in self._told:
                self._told.add(key)
                line = Text.assemble((f"{word:>{_WIDTH}}", STYLES.get(word, "")), "  ", text)
                self._console.print(line, soft_wrap=True)

    def _lines(self, task: Task) -> Iterator[tuple[tuple[object, ...], str, str]]:
        """What there is to tell: what tells it from all else, its first word, and the rest."""
        number = self._number_of_plan(task)
        if task.plan is not None:
            steps = ", ".join(str(step) for step in task.plan.steps) or "nothing has to be done"
            yield ("plan", number), "plan" if number == 1 else "new plan", steps
            for index, step in enumerate(task.plan.steps):
                if step.status != "pending":
                    yield (number, index, step.status), step.status, f"{step}{_duration(step.seconds, step.status)}"
        for index, failure in enumerate(task.failures):
            yield ("failure", index), "failed", f"{failure.message} {failure.suggestion}".strip()
        if task.status in ("paused", "running"):
            yield ("status", task.status), task.status, task.explanation
        if task.ended:
            yield ("end",), task.status, task.explanation or task.reply

    def _number_of_plan(self, task: Task) -> int:
        """Which plan of the task this is, from 1; 0 while there is none."""
        if task.plan is not None:
            steps = (str(task.replans), *(str(step) for step in task.plan.steps))
            if not self._plans or self._plans[-1] != steps:
                self._plans.append(steps)
        return len(self._plans)


def _duration(seconds: float, status: str) -> str:
    return f"  ({seconds:.1f} s)" if status in ("succeeded", "failed") and seconds else ""
