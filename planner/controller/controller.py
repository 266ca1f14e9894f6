"""The Controller: watches, while a step is carried out, whether what the plan counts on still holds."""

from __future__ import annotations

from collections.abc import Sequence

from planner.controller.questions import (
    DoIKnowWhereIAm,
    DoIStillHoldIt,
    DoSensorsSpeak,
    IsThereTime,
    IsTheSupportThere,
    IsTheWayOpen,
    Question,
    WasIPushed,
    WhereIsTheObject,
)
from planner.controller.situation import Situation
from skills.failures import Failure

QUESTIONS: tuple[Question, ...] = (
    DoSensorsSpeak(),
    WasIPushed(),
    DoIKnowWhereIAm(),
    DoIStillHoldIt(),
    WhereIsTheObject(),
    IsTheSupportThere(),
    IsTheWayOpen(),
    IsThereTime(),
)
"""What is asked at every tick, the most basic first: who does not know where it is cannot tell what has moved."""


class Controller:
    """Asks its questions in order and answers with the first failure. Keeps nothing between ticks."""

    def __init__(self, questions: Sequence[Question] = QUESTIONS) -> None:
        self._questions = tuple(questions)

    def check(self, situation: Situation) -> Failure | None:
        """The first thing that is amiss, ``None`` when the step may go on."""
        for question in self._questions:
            failure = question.ask(situation)
            if failure is not None:
                return failure
        return None
