"""A scripted language model that knows the right answer, and errs at a given rate as real ones do."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from copy import deepcopy
from enum import StrEnum
from random import Random
from typing import Any

from evaluations.planning.judging.expectations import (
    HAND,
    ROBOT,
    Asked,
    Condition,
    Declined,
    EndState,
    Expectation,
    Refused,
    Turn,
)
from planner.goals import Predicate
from planner.language.grammar.parser import CommandGrammar, NotUnderstood, ParsedStep
from planner.language.lexicon.lexicon import Lexicon
from planner.models.protocol import FailureKind, ModelFailure, ModelRequest
from planner.models.scripted import Line
from planner.plan import Kind
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.furniture.kinds import is_container

Proposal = dict[str, Any]


class Slip(StrEnum):
    """Ways in which models err."""

    INVENTED_IDENTIFIER = "invented_identifier"
    MISSING_STEP = "missing_step"
    SWAPPED_ARGUMENTS = "swapped_arguments"
    WRONG_ORDER = "wrong_order"
    WRONG_PREDICATE = "wrong_predicate"
    WRONG_KIND = "wrong_kind"
    PROSE = "prose"
    TRUNCATED = "truncated"
    REFUSAL = "refusal"
    TIMEOUT = "timeout"


_OF_GOALS = (Slip.INVENTED_IDENTIFIER, Slip.MISSING_STEP, Slip.WRONG_PREDICATE)
_OF_PAIRS = (Slip.SWAPPED_ARGUMENTS,)
_OF_ROWS = (Slip.WRONG_ORDER,)
_OF_ANY = (Slip.WRONG_KIND, Slip.PROSE, Slip.TRUNCATED, Slip.REFUSAL, Slip.TIMEOUT)


class Deaf(CommandGrammar):
    """A grammar that understands nothing, so that the model is asked."""

    def parse(self, text: str, lexicon: Lexicon) -> list[ParsedStep]:
        """Never more than the words."""
        del lexicon
        return [NotUnderstood(text=text)]


class Oracle:
    """Speaks for a ``ScriptedModel``: the right answer to the turn it was told of, or one with a slip.

    Args:
        rate: share of calls that slip.
        seed: the same seed, the same slips.
    """

    def __init__(self, rate: float, seed: str) -> None:
        self._rate, self._random = rate, Random(seed)
        self._right: Proposal = {}
        self.slips: list[Slip] = []

    def hear(self, turn: Turn, snapshot: Snapshot) -> None:
        """The turn that the next calls are about, and the graph as it is."""
        self._right = right_answer(turn.expected, snapshot)

    def speak(self, request: ModelRequest) -> Line:
        """One answer."""
        del request
        if self._random.random() >= self._rate:
            return self._right
        slip = self._random.choice(fitting(self._right))
        self.slips.append(slip)
        return slipped(self._right, slip, self._random)


def can_be_put(expected: Sequence[Expectation]) -> bool:
    """Whether a model can give the answer by itself; questions are answered by the graph."""
    return _spoken_of(expected) is not None


def right_answer(expected: Sequence[Expectation], snapshot: Snapshot) -> Proposal:
    """What a model should say where ``expected`` is to come out."""
    proposal: Proposal = {"kind": Kind.PLAN.value, "goals": [], "question": "", "reply": ""}
    match _spoken_of(expected):
        case EndState() as end:
            goals = [goal for stage in end.stages for condition in stage for goal in _goals(condition, snapshot)]
            return {**proposal, "goals": goals}
        case Asked():
            return {**proposal, "kind": Kind.CLARIFY.value, "reply": "Which one do you mean?"}
        case Refused(words=words) | Declined(words=words):
            named = ", ".join(ways[0].removesuffix("*") for ways in words)
            return {**proposal, "kind": Kind.REFUSE.value, "reply": f"I cannot do that: {named}."}
    return proposal


def _spoken_of(expected: Sequence[Expectation]) -> Expectation | None:
    return next((one for one in expected if isinstance(one, EndState | Asked | Refused | Declined)), None)


def _goals(condition: Condition, snapshot: Snapshot) -> list[dict[str, Any]]:
    place = condition.places[0]
    if condition.subjects == (ROBOT,):
        return [{"predicate": Predicate.ROBOT_AT.value, "args": [place]}]
    chosen = condition.subjects[: condition.count]
    if place == HAND:
        return [{"predicate": Predicate.HOLDING.value, "args": [subject]} for subject in chosen]
    return [{"predicate": _predicate(place, snapshot).value, "args": [subject, place]} for subject in chosen]


def _predicate(place: str, snapshot: Snapshot) -> Predicate:
    node = snapshot.get(place)
    if isinstance(node, PersonNode):
        return Predicate.GIVEN
    inside = isinstance(node, RoomNode) or (isinstance(node, ObjectNode) and is_container(node.label))
    return Predicate.IN if inside else Predicate.ON


def fitting(proposal: Mapping[str, Any]) -> tuple[Slip, ...]:
    """Slips that this answer can have."""
    goals = proposal["goals"]
    of_goals = _OF_GOALS if goals else ()
    of_pairs = _OF_PAIRS if any(len(goal["args"]) > 1 for goal in goals) else ()
    return of_goals + of_pairs + (_OF_ROWS if len(goals) > 1 else ()) + _OF_ANY


def slipped(right: Proposal, slip: Slip, random: Random) -> Line:
    """The right answer with one slip."""
    wrong = deepcopy(right)
    goals: list[dict[str, Any]] = wrong["goals"]
    text = json.dumps(right)
    match slip:
        case Slip.INVENTED_IDENTIFIER:
            goal = random.choice(goals)
            goal["args"][0] = f"{goal['args'][0].rpartition('_')[0]}_{random.randint(900_000, 999_999)}"
        case Slip.MISSING_STEP:
            goals.remove(random.choice(goals))
        case Slip.SWAPPED_ARGUMENTS:
            random.choice([goal for goal in goals if len(goal["args"]) > 1])["args"].reverse()
        case Slip.WRONG_ORDER:
            goals.reverse()
        case Slip.WRONG_PREDICATE:
            random.choice(goals)["predicate"] = random.choice(("put", "GOTO", "PICK", "at", "move"))
        case Slip.WRONG_KIND:
            wrong["kind"] = random.choice(("action", "execute", "PLAN", "ok"))
        case Slip.PROSE:
            return f"Sure, I can help with that!\n```json\n{text}\n```\nLet me know if {{anything}} is unclear."
        case Slip.TRUNCATED:
            cut = text[: random.randint(1, len(text) - 1)]
            return ModelFailure(kind=FailureKind.TRUNCATED, message="the answer was cut off", text=cut)
        case Slip.REFUSAL:
            return ModelFailure(kind=FailureKind.REFUSAL, message="the model refused", text="I'm sorry, I can't.")
        case Slip.TIMEOUT:
            return ModelFailure(kind=FailureKind.TIMEOUT, message="no answer in time")
    return wrong
