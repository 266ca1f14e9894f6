"""Whether what came of a turn is what was expected."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum

from evaluations.planning.conversation import ANSWER, CLARIFY, CONTROL, PLAN, REFUSE, Outcome
from evaluations.planning.judging.expectations import (
    HAND,
    ROBOT,
    Answered,
    Asked,
    Condition,
    Controlled,
    Declined,
    EndState,
    Expectation,
    Refused,
    Seek,
    Taught,
    Words,
)
from planner.plan import Source
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode
from skills.state.state import PlanState


class Verdict(StrEnum):
    """Right; not right, but nothing was done; something was done that was not asked for."""

    RIGHT = "right"
    MISSED = "missed"
    WRONG_ACTION = "wrong_action"


@dataclass(frozen=True, kw_only=True)
class Judgement:
    """``reason`` says what is amiss."""

    verdict: Verdict
    reason: str = ""


def judge(outcome: Outcome, expected: Iterable[Expectation], *, own_words: bool = False) -> Judgement:
    """Right when one of the expectations is met; a wrong action when none is and the robot acts.

    ``own_words``: a language model asks, which names no candidates.
    """
    reasons = [amiss(outcome, _without_candidates(one) if own_words else one) for one in expected]
    if "" in reasons:
        return Judgement(verdict=Verdict.RIGHT)
    verdict = Verdict.WRONG_ACTION if outcome.acts else Verdict.MISSED
    return Judgement(verdict=verdict, reason=reasons[0])


def amiss(outcome: Outcome, expected: Expectation) -> str:
    """What keeps ``outcome`` from being as expected, ``""`` when nothing does."""
    if outcome.obstacle:
        return f"the plan cannot be carried out: {outcome.obstacle}"
    match expected:
        case EndState():
            return _end_amiss(outcome, expected)
        case Seek():
            sought = outcome.source == Source.SEARCH and expected.object_id in outcome.sought
            return "" if sought else f"{_told(outcome)}, where {expected.object_id} should be looked for"
        case Taught():
            return _taught_amiss(outcome, expected)
        case Answered():
            return _acts_instead(outcome, {ANSWER, REFUSE}) or _words_amiss(
                outcome.said, expected.words, expected.never
            )
        case Asked():
            return _acts_instead(outcome, {CLARIFY}) or _candidates_amiss(outcome, expected)
        case Refused():
            return _acts_instead(outcome, {REFUSE}) or _words_amiss(outcome.said, expected.words)
        case Declined():
            return _acts_instead(outcome, {REFUSE, CLARIFY}) or _words_amiss(outcome.said, expected.words)
        case Controlled():
            done = outcome.kind == CONTROL and outcome.said == expected.word
            return "" if done else f"{_told(outcome)}, where {expected.word} was meant"


def _without_candidates(expected: Expectation) -> Expectation:
    return Asked() if isinstance(expected, Asked) else expected


def _end_amiss(outcome: Outcome, expected: EndState) -> str:
    if outcome.kind not in (PLAN, ANSWER):
        return f"{_told(outcome)}, where something should be done"
    at = 0
    for stage in expected.stages:
        came = [i for i in range(at, len(outcome.trail)) if all(_met(c, outcome, i, stage) for c in stage)]
        if not came:
            return f"{_shown(stage)} does not come true in its turn: {_done(outcome)}"
        at = came[0]
    last = len(outcome.trail) - 1
    lasting = _lasting(expected)
    for condition in lasting:
        if not _met(condition, outcome, last, lasting):
            return f"{_shown((condition,))} is not so in the end: {_done(outcome)}"
    subjects = {subject for stage in expected.stages for c in stage for subject in c.subjects} | {*expected.aside}
    moved = [i for i in _moved(outcome.trail[0], outcome.trail[last]) if i not in subjects]
    return f"{', '.join(moved)} should have stayed: {_done(outcome)}" if moved else ""


def _lasting(expected: EndState) -> list[Condition]:
    """The last that is said of each subject; where the robot was sent before something else does not last."""
    *_, final = expected.stages
    last: dict[tuple[str, ...], list[Condition]] = {}
    for stage in expected.stages:
        said = [condition for condition in stage if condition.subjects != (ROBOT,) or stage is final]
        for condition in said:
            last[condition.subjects] = [other for other in said if other.subjects == condition.subjects]
    return [condition for conditions in last.values() for condition in conditions]


def _met(condition: Condition, outcome: Outcome, index: int, beside: Sequence[Condition]) -> bool:
    """``beside``: what else is to be so then; of three cups, two may go here and one there."""
    start, state = outcome.trail[0], outcome.trail[index]
    if condition.subjects == (ROBOT,):
        return any(
            place == state.robot_room or (place in outcome.after and _at(state, place, outcome))
            for place in condition.places
        )
    there = [i for i in condition.subjects if _placed(i, condition.places, state)]
    if condition.count == len(condition.subjects):
        return len(there) == condition.count
    elsewhere = {place for other in beside if other is not condition for place in other.places}
    moved = {i for i in _moved(start, state) if i in condition.subjects}
    here = moved & set(there)
    return len(here) == condition.count and all(_placed(i, tuple(elsewhere), state) for i in moved - here)


def _at(state: PlanState, place: str, outcome: Outcome) -> bool:
    return not isinstance(outcome.after.get(place), RoomNode) and state.is_at(place)


def _placed(object_id: str, places: tuple[str, ...], state: PlanState) -> bool:
    if state.holding == object_id:
        return HAND in places
    at = state.places.get(object_id)
    return at is not None and (at[1] in places or state.room_of(object_id) in places)


def _moved(start: PlanState, end: PlanState) -> list[str]:
    objects = dict.fromkeys((*start.places, *end.places))
    return [i for i in objects if start.places.get(i) != end.places.get(i)]


def _taught_amiss(outcome: Outcome, expected: Taught) -> str:
    node = outcome.after.get(expected.node_id)
    names = {node.label} if isinstance(node, RoomNode | ObjectNode) else set()
    names |= {node.name} if isinstance(node, PersonNode | ObjectNode) else set()
    known = expected.name.casefold() in {name.casefold() for name in names}
    return "" if known and not outcome.acts else f"{_told(outcome)}, and {expected.node_id} is not {expected.name}"


def _acts_instead(outcome: Outcome, kinds: set[str]) -> str:
    if outcome.kind in kinds and not outcome.acts:
        return ""
    return f"{_told(outcome)}, where {' or '.join(sorted(kinds))} was expected"


def _candidates_amiss(outcome: Outcome, expected: Asked) -> str:
    if not expected.candidates or outcome.candidates == expected.candidates:
        return ""
    return (
        f"asks about {', '.join(sorted(outcome.candidates)) or 'nothing'}, not {', '.join(sorted(expected.candidates))}"
    )


def _words_amiss(said: str, words: Words, never: tuple[str, ...] = ()) -> str:
    missing = [" or ".join(ways) for ways in words if not any(_says(said, way) for way in ways)]
    wrong = [word for word in never if _says(said, word)]
    problems = [f"{word!r} is not said" for word in missing] + [f"{word!r} is said" for word in wrong]
    return f"{', '.join(problems)}: {said!r}" if problems else ""


def _says(said: str, word: str) -> bool:
    """Whether a word, or any word that begins so when it ends in ``*``, is in what was said; ``_`` counts as space."""
    said, word = (text.casefold().replace("_", " ") for text in (said, word))
    end = "" if word.endswith("*") else r"(?!\w)"
    pattern = r"(?<!\w)" + re.escape(word.removesuffix("*")) + end
    return re.search(pattern, said) is not None


def _told(outcome: Outcome) -> str:
    if outcome.kind == PLAN:
        return f"plans {_done(outcome)}"
    return f"{outcome.kind}: {outcome.said!r}"


def _done(outcome: Outcome) -> str:
    return ", ".join(step.text for step in outcome.steps) or "nothing is done"


def _shown(conditions: tuple[Condition, ...]) -> str:
    return "; ".join(f"{c.count} of {' '.join(c.subjects)} -> {'|'.join(c.places)}" for c in conditions)
