"""What one step of a request means on a graph, and what several steps mean together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from planner.goals import Goal, Predicate
from planner.plan import Lesson, Query, QueryKind
from skills.state.state import PlanState


@dataclass(frozen=True, kw_only=True)
class Meaning:
    """What one step means: goals, or the answer to a question; and what it mentioned.

    ``doubt``: it was not said as a request, and is asked about first. ``told``: it is only what the next step is
    about. ``origins``: where its things were before. ``waiting``: what comes of *wait there*,
    if nothing follows.
    """

    goals: tuple[Goal, ...] = ()
    implied: bool = False
    answer: str = ""
    query: Query | None = None
    things: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    focus: str | None = None
    noun: str = ""
    doubt: bool = False
    told: bool = False
    waiting: str = ""
    lessons: tuple[Lesson, ...] = ()
    origins: Mapping[str, str] = field(default_factory=dict)


def without_steps_between(meanings: list[Meaning], state: PlanState) -> tuple[Goal, ...]:
    """The goals of all steps in order, without those that only lead to a later one about the same object.

    *Take the cup and put it on the desk* is about the desk; so is *take it to the office and put it on the desk*. The
    order of steps was told, that of goals within a step was not. *Find Ben. Which room is he in?* is a question.
    """
    meanings = [meant for k, meant in enumerate(meanings) if not _is_answered(meant, meanings[k + 1 :], state)]
    tagged = [
        (replace(goal, any_order=index > 0), meant.implied)
        for meant in meanings
        for index, goal in enumerate(meant.goals)
    ]
    kept = []
    for index, (goal, implied) in enumerate(tagged):
        later = [
            other for other, _ in tagged[index + 1 :] if goal.object_id is not None and other.args[0] == goal.args[0]
        ]
        refined = goal.predicate is Predicate.IN and any(
            state.room_of(other.args[-1]) == goal.args[-1] for other in later
        )
        again = any((other.predicate, other.args) == (goal.predicate, goal.args) for other in later)
        if not again and (not later or not (implied or refined)):
            kept.append(goal)
    return tuple(kept)


def _is_answered(meant: Meaning, later: list[Meaning], state: PlanState) -> bool:
    """Whether a step only finds what a later question asks the place of, and that is known."""
    asking = [m.query for m in later if m.query is not None and m.query.kind in (QueryKind.WHERE, QueryKind.ROOM_OF)]
    told = {i for query in asking for i in query.nodes if i not in state.missing}
    finding = (Predicate.FOUND, Predicate.ROBOT_AT)
    return (
        meant.implied
        and bool(meant.goals)
        and all(goal.predicate in finding and goal.args[0] in told for goal in meant.goals)
    )
