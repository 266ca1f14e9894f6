"""Readings of requests, and what is replied to those that cannot be carried out or not yet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from planner.answers.reports import ABILITIES
from planner.dialogue.discourse import Stuck
from planner.grounding.context import Ambiguous, NoReferent, Trouble
from planner.language.grammar.parser import Choice, NotUnderstood, ParsedStep, Unable, Understood
from planner.language.grammar.syntax import Ask
from planner.naming import aim_phrase, listed, name_of
from planner.plan import Interpretation, Kind
from scene_graph.snapshot import Snapshot


@dataclass(frozen=True, kw_only=True)
class Reading:
    """An interpretation, and what else is known of it.

    ``wholly``: every word was understood, so that no language model needs to be asked. ``asked``: the phrase that the
    question is about, when there are candidates for it.
    """

    interpretation: Interpretation
    wholly: bool = True
    asked: str = ""


def reply(kind: Kind, text: str, *, wholly: bool = True) -> Reading:
    """What is said, of a request that asks for nothing to be done."""
    return Reading(interpretation=Interpretation(kind=kind, reply=text), wholly=wholly)


def reply_when_stuck(stuck: Stuck, steps: Sequence[ParsedStep]) -> Reading:
    """Why one of several steps means nothing."""
    trouble = stuck.trouble
    if isinstance(trouble, NoReferent):
        reason = _told_of(trouble.reason, stuck.step, steps)
        trouble = replace(trouble, reason=reason, sought=trouble.sought if _is_deed(stuck.step) else "")
    return reply_to_trouble(trouble)


def reply_to_trouble(trouble: Trouble) -> Reading:
    """A question or a refusal."""
    if isinstance(trouble, Ambiguous):
        question, candidates, asked = trouble.question, trouble.candidates, trouble.phrase
        found = Interpretation(kind=Kind.CLARIFY, reply=question, candidates=candidates, asked=asked)
        return Reading(interpretation=found, asked=asked)
    kind = Kind.CLARIFY if trouble.asks else Kind.REFUSE
    found = Interpretation(kind=kind, reply=trouble.reason, sought=trouble.sought if kind is Kind.REFUSE else "")
    return Reading(interpretation=found, wholly=not trouble.unknown)


def unable_reply(unable: Sequence[Unable], count: int) -> str:
    """What is asked for and cannot be done, among ``count`` steps."""
    verbs = listed(list(dict.fromkeys(step.verb for step in unable)))
    words = listed([f"“{_short(step.text)}”" for step in unable])
    rest = " I have not started on the rest either." if count > len(unable) else ""
    return f"I cannot {verbs}, so I cannot do {words}.{rest} {ABILITIES}"


def not_understood_reply(steps: Sequence[ParsedStep]) -> str:
    """What was understood, and what was not."""
    clear = [f"“{step.text}”" for step in steps if isinstance(step, Understood)]
    unclear = [
        f"“{_short(step.text)}”{_at(step)}" for step in steps if isinstance(step, NotUnderstood) or is_open(step)
    ]
    lead = (
        f"I understood {listed(clear)}, but not {listed(unclear)}."
        if clear
        else f"I do not understand {listed(unclear)}."
    )
    return f"{lead} I have done nothing. Can you say it differently?"


def did_you_mean(found: Interpretation, snapshot: Snapshot) -> str:
    """The question that a doubtful interpretation leads to."""
    if found.lessons:
        lesson = found.lessons[0]
        return f"Shall I call {name_of(lesson.node, snapshot)} “{lesson.label or lesson.name}” from now on?"
    return f"Did you mean: {listed([aim_phrase(goal, snapshot) for goal in found.goals])}?"


def is_open(step: ParsedStep) -> bool:
    """Whether a condition was not understood."""
    return isinstance(step, Choice) and step.condition == ()


def _is_deed(step: ParsedStep) -> bool:
    """Whether something is to be done, and not only to be told."""
    return isinstance(step, Understood) and not any(isinstance(reading, Ask) for reading in step.readings)


def _at(step: ParsedStep) -> str:
    return f" because of “{step.at}”" if isinstance(step, NotUnderstood) and step.at else ""


def _short(text: str) -> str:
    return text if len(text) <= 120 else f"{text[:117]}..."


def _told_of(reason: str, step: ParsedStep, steps: Sequence[ParsedStep]) -> str:
    return reason if len(steps) == 1 else f"{reason} So I cannot do “{_short(step.text)}”, and have not started."
