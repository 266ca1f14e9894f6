"""The Task Planner: a request's words to goals, an answer, a question or a refusal (design, section 8).

The grammar is tried first on every turn. A language model, when there is one, takes what the grammar cannot parse; what
it proposes is checked, and flaws go back to it as one sentence. When it fails, the grammar's own answer stands and
says so.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from itertools import zip_longest
from typing import Any

from planner.dialogue.disambiguation import described
from planner.dialogue.discourse import NOT_SO, SO, WHETHER
from planner.dialogue.interpreter import DOUBT, Choices, Interpreter
from planner.dialogue.replies import Reading
from planner.dialogue.revision import revision
from planner.dialogue.selection import NOTHING_THEN, agrees, confirms, declines, left_out, select
from planner.grounding.phrasing import AMONG
from planner.language.grammar.parser import CommandGrammar
from planner.language.sentences.tokens import text_flaw
from planner.models.protocol import CORRECTABLE, FailureKind, LanguageModel, ModelFailure
from planner.plan import Dialogue, Interpretation, Kind, Offer
from planner.skill_planner.verifier import Verifier
from planner.task_planner.model_rounds import ModelRounds
from planner.task_planner.settings import TaskPlannerSettings
from scene_graph.snapshot import Snapshot

Journal = Callable[[dict[str, Any]], None]


def no_journal(entry: dict[str, Any]) -> None:
    """Keeps nothing."""
    del entry


class TaskPlanner:
    """Interprets requests; made once for a service.

    Args:
        grammar: the command grammar.
        verifier: checks goals; holds the skills.
        model: takes what the grammar cannot parse; None for the grammar alone.
        journal: told every prompt and raw answer, as plain data.
        settings: limits of the rounds with a model, and by what words are understood.
    """

    def __init__(
        self,
        grammar: CommandGrammar,
        verifier: Verifier,
        model: LanguageModel | None = None,
        *,
        journal: Journal = no_journal,
        settings: TaskPlannerSettings = TaskPlannerSettings(),
    ) -> None:
        self._grammar = grammar
        self._interpreter = Interpreter(grammar, verifier, settings.dialogue)
        self._rounds = ModelRounds(model, verifier, journal, settings) if model is not None else None

    async def interpret(self, text: str, snapshot: Snapshot, dialogue: Dialogue) -> Interpretation:
        """What ``text`` means on ``snapshot``, with the answers to earlier questions about it."""
        reading = self.read(text, snapshot, dialogue)
        if reading.wholly or self._rounds is None:
            return reading.interpretation
        outcome = await self._rounds.run(text, snapshot, dialogue)
        if isinstance(outcome, ModelFailure):
            return _without_model(reading.interpretation, outcome)
        if outcome.kind is Kind.ANSWER:
            return self._answered(outcome, reading, snapshot, dialogue)
        return replace(outcome, sought=reading.interpretation.sought) if outcome.kind is Kind.REFUSE else outcome

    def read(self, text: str, snapshot: Snapshot, dialogue: Dialogue) -> Reading:
        """The grammar's reading of the request and the answers given so far."""
        offers = dialogue.offers[: len(dialogue.answers)]
        told = [
            (answer, self._told(offer or Offer(), answer, snapshot))
            for (_, answer), offer in zip_longest(dialogue.answers, offers)
        ]
        choices: Choices = {phrase: chosen for _, settled in told for phrase, chosen in settled.items()}
        reading = self._interpreter.read(text, snapshot, dialogue, choices)
        for answer, settled in told:
            if reading.interpretation.kind is not Kind.CLARIFY:
                break
            if settled or not answer.strip():
                continue
            if declines(answer) and not reading.asked.startswith(WHETHER):
                return Reading(interpretation=Interpretation(kind=Kind.REFUSE, reply=NOTHING_THEN))
            text, choices = self._take_answer(text, answer, reading, choices, snapshot)
            reading = self._interpreter.read(text, snapshot, dialogue, choices)
        return reading

    def _told(self, offer: Offer, answer: str, snapshot: Snapshot) -> Choices:
        """What an answer chose of what its question offered, as far as that is still known; empty where it says
        something else. What was offered may not be what would be asked now.
        """
        if not (offer.asked and offer.candidates and answer.strip()) or text_flaw(answer) is not None:
            return {}
        about = revision(answer)
        words = about.rest if about is not None and about.how == "correct" else answer
        chosen = select(words, offer.candidates, snapshot, self._interpreter, self._grammar)
        return {offer.asked: tuple(i for i in chosen if i in snapshot)} if chosen else {}

    def _take_answer(
        self, text: str, answer: str, reading: Reading, choices: Choices, snapshot: Snapshot
    ) -> tuple[str, Choices]:
        """The request and the settled phrases after one answer: a choice, a destination, or a new request."""
        if text_flaw(answer) is not None:
            return text, choices
        if reading.asked == DOUBT and agrees(answer):
            return text, {**choices, DOUBT: (DOUBT,)}
        so = confirms(answer, reading.asked) if reading.asked.startswith(WHETHER) else None
        if so is not None:
            return text, {**choices, reading.asked: (SO if so else NOT_SO,)}
        candidates = reading.interpretation.candidates
        if candidates and left_out(answer):
            chosen = select(answer, candidates, snapshot, self._interpreter, self._grammar)
            return text, {**choices, reading.asked: chosen} if chosen else choices
        about = revision(answer)
        if about is not None and about.how == "correct":
            answer = about.rest
        settled = self._settled(answer, reading, snapshot) if candidates else {}
        if settled:
            return text, {**choices, **settled}
        if reading.asked == "destination":
            for wording in (f"{text} {answer}", f"{text} to {answer}", f"{text} on {answer}"):
                parsed = self._interpreter.read(wording, snapshot, Dialogue(), choices)
                if parsed.wholly and parsed.asked != "destination":
                    return wording, choices
        if about is not None and reading.asked:
            wording = _with_other(text, reading.asked, answer)
            if self._interpreter.read(wording, snapshot, Dialogue(), {}).wholly and wording != text:
                return wording, {}
        return self._restated(text, answer, choices, snapshot, was_parsed=reading.wholly)

    def _settled(self, answer: str, reading: Reading, snapshot: Snapshot) -> Choices:
        """The candidates that an answer chooses; else those that it leaves of more, which are asked about again."""
        interpreter, candidates = self._interpreter, reading.interpretation.candidates
        chosen = select(answer, candidates, snapshot, interpreter, self._grammar)
        if chosen:
            return {reading.asked: chosen}
        left = described(answer, candidates, interpreter.lexicon(snapshot), interpreter.grounding(snapshot))
        return {f"{AMONG}{reading.asked}": left} if reading.asked and 1 < len(left) < len(candidates) else {}

    def _restated(
        self, text: str, answer: str, choices: Choices, snapshot: Snapshot, *, was_parsed: bool
    ) -> tuple[str, Choices]:
        """An answer that is a whole request takes the old one's place; one that says nothing leaves it open."""
        parsed = self._interpreter.read(answer, snapshot, Dialogue(), {}, verbless=False)
        return (answer, {}) if parsed.wholly or not was_parsed else (text, choices)

    def _answered(
        self, proposed: Interpretation, reading: Reading, snapshot: Snapshot, dialogue: Dialogue
    ) -> Interpretation:
        """A model only rephrases questions; the graph answers them."""
        answer = self._interpreter.read(proposed.reply, snapshot, dialogue)
        if answer.wholly and answer.interpretation.kind in (Kind.ANSWER, Kind.REFUSE):
            return replace(answer.interpretation, kind=Kind.ANSWER, source=proposed.source)
        return reading.interpretation


def _with_other(text: str, asked: str, answer: str) -> str:
    """*Put the white cup on the table* with *the blue one* in the place of *the white cup*."""
    said = " ".join(text.casefold().split())
    meant = re.sub(r"\bone\b", asked.rpartition(" ")[2], answer.casefold())
    return re.sub(rf"\b(?:the|a|an|my) {re.escape(asked)}(?= |$|[.,!?])", lambda _: meant, said, count=1)


def _without_model(interpretation: Interpretation, failure: ModelFailure) -> Interpretation:
    if failure.kind is FailureKind.RESTING:
        note = f"({failure.message}.)"
    else:
        what = "gave no usable answer" if failure.kind in CORRECTABLE else "is not available"
        what = "cannot take this request" if failure.kind is FailureKind.PROMPT_TOO_LONG else what
        note = f"(The language model {what}: {failure.message}.)".replace("..", ".")
    return replace(interpretation, reply=f"{interpretation.reply} {note}")
