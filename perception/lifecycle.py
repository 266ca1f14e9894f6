"""The life of a concept's instances as a behaviour tree (Concepts, section 3.5 and figure 4).

Every tick walks the same four questions: do the instances we have explain what is seen; if not, can a candidate be
initialized; are the instances there still valid; and how do their affordances fare? A concept agent supplies the four
answers and the tree decides which are asked.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum

import py_trees
from py_trees.behaviour import Behaviour
from py_trees.common import Status


class Verdict(Enum):
    """What a stage of the life cycle found."""

    DONE = Status.SUCCESS
    BUSY = Status.RUNNING
    NO = Status.FAILURE


Stage = Callable[[], Verdict]


class _Question(Behaviour):
    """A leaf that asks the agent."""

    def __init__(self, name: str, answer: Stage) -> None:
        super().__init__(name)
        self._answer = answer

    def update(self) -> Status:
        status: Status = self._answer().value
        return status


class LifeCycle:
    """explain, else initialize; then maintain; then affordances."""

    def __init__(self, concept: str, *, explain: Stage, initialize: Stage, maintain: Stage, affordances: Stage) -> None:
        """Each argument answers one question.

        Args:
            concept: name, for reading the tree.
            explain: DONE when instances explain the measurements, NO when something is unexplained.
            initialize: BUSY while a candidate gathers evidence, DONE when it became an instance, NO when there is none.
            maintain: asked on every tick.
            affordances: asked on every tick.
        """
        self._asked: list[str] = []
        instances = py_trees.composites.Selector(
            f"{concept}: instances",
            memory=False,
            children=[
                _Question("explain", self._recorded("explain", explain)),
                _Question("initialize", self._recorded("initialize", initialize)),
            ],
        )
        self._root = py_trees.composites.Parallel(
            f"{concept}: life cycle",
            policy=py_trees.common.ParallelPolicy.SuccessOnAll(synchronise=False),
            children=[
                instances,
                _Question("maintain", self._recorded("maintain", maintain)),
                _Question("affordances", self._recorded("affordances", affordances)),
            ],
        )

    def tick(self) -> None:
        """Walk the tree once."""
        self._asked.clear()
        self._root.tick_once()

    @property
    def asked(self) -> tuple[str, ...]:
        """The stages of the last tick, in order."""
        return tuple(self._asked)

    def _recorded(self, name: str, answer: Stage) -> Stage:
        def ask() -> Verdict:
            self._asked.append(name)
            return answer()

        return ask
