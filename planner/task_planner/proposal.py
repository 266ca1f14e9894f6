"""What a language model proposes: its schema, and its check. Nothing that fails the check goes any further."""

from __future__ import annotations

import unicodedata
from collections.abc import Collection, Mapping, Sequence
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from planner.errors import WrongArity
from planner.goals import ARITY, Goal, Predicate
from planner.models.protocol import FailureKind, ModelFailure
from planner.plan import Kind

MAX_GOALS = 40
"""What the schema of an answer admits."""


class ProposedGoal(BaseModel):
    """A goal as the model writes it."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)

    predicate: str
    args: list[str] = Field(max_length=2)


class Proposal(BaseModel):
    """The model's answer."""

    model_config = ConfigDict(extra="forbid", strict=True, frozen=True)

    kind: str
    goals: list[ProposedGoal] = Field(default_factory=list, max_length=MAX_GOALS)
    question: str = Field(default="", max_length=500)
    reply: str = Field(default="", max_length=1000)


def schema(identifiers: Sequence[str]) -> dict[str, Any]:
    """JSON schema of a proposal whose arguments are ``identifiers``."""
    argument: dict[str, Any] = {"type": "string", "enum": list(identifiers)} if identifiers else {"type": "string"}
    goal = {
        "type": "object",
        "properties": {
            "predicate": {"type": "string", "enum": [predicate.value for predicate in Predicate]},
            "args": {"type": "array", "items": argument},
        },
        "required": ["predicate", "args"],
        "additionalProperties": False,
    }
    return {
        "type": "object",
        "properties": {
            "kind": {"type": "string", "enum": [kind.value for kind in Kind]},
            "goals": {"type": "array", "items": goal},
            "question": {"type": "string"},
            "reply": {"type": "string"},
        },
        "required": ["kind", "goals", "question", "reply"],
        "additionalProperties": False,
    }


def read_proposal(data: Mapping[str, Any]) -> Proposal | ModelFailure:
    """The proposal in a model's JSON object, or what is wrong with its shape."""
    try:
        proposal = Proposal.model_validate(dict(data))
    except (ValidationError, RecursionError) as error:
        return _wrong(_first_problem(error))
    proposal = proposal.model_copy(update={"question": plain(proposal.question), "reply": plain(proposal.reply)})
    if proposal.kind not in {kind.value for kind in Kind}:
        return _wrong(f"kind {proposal.kind[:40]!r} is none of {', '.join(Kind)}.")
    if proposal.kind == Kind.PLAN and not proposal.goals:
        return _wrong("a plan needs at least one goal.")
    if proposal.kind == Kind.ANSWER and not proposal.question:
        return _wrong('an answer needs the "question" in plain English.')
    if proposal.kind in (Kind.CLARIFY, Kind.REFUSE) and not proposal.reply:
        return _wrong(f'"{proposal.kind}" needs a "reply".')
    return proposal


def goals_of(proposal: Proposal, known: Collection[str]) -> tuple[Goal, ...] | ModelFailure:
    """The proposed goals, or the first flaw: predicate, number of arguments, or identifier not in ``known``."""
    goals = []
    for proposed in proposal.goals:
        if proposed.predicate not in {predicate.value for predicate in Predicate}:
            names = ", ".join(f"{predicate}/{ARITY[predicate]}" for predicate in Predicate)
            return _wrong(f"there is no predicate {proposed.predicate[:40]!r}: choose one of {names}.")
        try:
            goal = Goal(predicate=Predicate(proposed.predicate), args=tuple(proposed.args))
        except WrongArity as error:
            return _wrong(f"{error}.")
        unknown = [arg for arg in goal.args if arg not in known]
        if unknown:
            message = f"{unknown[0][:60]!r} is not an identifier in the scene: use one that is, or clarify."
            return ModelFailure(kind=FailureKind.UNKNOWN_IDENTIFIER, message=message)
        goals.append(goal)
    return tuple(goals)


def plain(text: str) -> str:
    """A model's words as plain text: control characters and lone surrogates become spaces."""
    return "".join(" " if unicodedata.category(char) in ("Cc", "Cs", "Co") else char for char in text).strip()


def _wrong(message: str) -> ModelFailure:
    return ModelFailure(kind=FailureKind.WRONG_SHAPE, message=message)


def _first_problem(error: ValidationError | RecursionError) -> str:
    if isinstance(error, RecursionError):
        return "the answer is nested too deeply."
    problem = error.errors(include_url=False, include_input=False, include_context=False)[0]
    place = ".".join(str(part) for part in problem["loc"]) or "the object"
    return f"{place}: {problem['msg'].lower()}."
