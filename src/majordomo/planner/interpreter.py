"""The front end that needs no language model: text to a checked interpretation by grammar, grounding and verifier."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from majordomo.planner.answers import ABILITIES
from majordomo.planner.grammar.lexer import Lexicon
from majordomo.planner.grammar.parser import CommandGrammar, NotUnderstood, ParsedStep, Unable, Understood
from majordomo.planner.grammar.tokens import text_flaw
from majordomo.planner.grounding import Ambiguous, Context, Grounding, NoReferent
from majordomo.planner.matching import nouns_of
from majordomo.planner.meaning import Meaning
from majordomo.planner.meant import Meant, without_steps_between
from majordomo.planner.naming import listed
from majordomo.planner.plan import Dialogue, Interpretation, Kind
from majordomo.planner.verifier import Verifier
from majordomo.scene_graph.nodes import PersonNode
from majordomo.scene_graph.snapshot import Snapshot

Choices = dict[str, tuple[str, ...]]


@dataclass(frozen=True, kw_only=True)
class Reading:
    """An interpretation, and what else is known of it.

    ``wholly``: every word was understood, so that no language model needs to be asked. ``asked``: the phrase that the
    question is about, when there are candidates for it.
    """

    interpretation: Interpretation
    wholly: bool = True
    asked: str = ""


class Interpreter:
    """Interprets requests on a graph. Pure: the same text, graph and dialogue give the same interpretation."""

    def __init__(self, grammar: CommandGrammar, verifier: Verifier) -> None:
        self._grammar, self._verifier = grammar, verifier
        self._lexicon: tuple[Snapshot, Lexicon] | None = None

    def read(self, text: str, snapshot: Snapshot, dialogue: Dialogue, choices: Choices | None = None) -> Reading:
        """What ``text`` means; ``choices`` settles phrases that were asked about before."""
        flaw = text_flaw(text)
        if flaw is not None:
            return _reading(Kind.REFUSE, flaw)
        steps = self._grammar.parse(text, self.lexicon(snapshot))
        if not steps:
            return _reading(Kind.ANSWER, f"What can I do for you? {ABILITIES}")
        unable = [step for step in steps if isinstance(step, Unable)]
        if unable:
            return _reading(Kind.REFUSE, _unable_reply(unable, len(steps)))
        if any(isinstance(step, NotUnderstood) for step in steps):
            return _reading(Kind.CLARIFY, _not_understood_reply(steps), wholly=False)
        understood = [step for step in steps if isinstance(step, Understood)]
        return self._ground(understood, snapshot, dialogue, choices or {})

    def grounding(self, snapshot: Snapshot) -> Grounding:
        """References on ``snapshot``."""
        return Grounding(snapshot, self._verifier.state(snapshot))

    def lexicon(self, snapshot: Snapshot) -> Lexicon:
        """Nouns and names of the graph; those of the last graph asked for are kept."""
        if self._lexicon is None or self._lexicon[0] is not snapshot:
            names = [person.name for person in snapshot.of_type(PersonNode) if person.name]
            self._lexicon = (snapshot, Lexicon.of(nouns_of(snapshot), names))
        return self._lexicon[1]

    def _ground(self, steps: Sequence[Understood], snapshot: Snapshot, dialogue: Dialogue, choices: Choices) -> Reading:
        meaning = Meaning(self.grounding(snapshot))
        context = Context(speaker=dialogue.speaker, mentioned=dialogue.mentioned, choices=choices)
        meanings: list[Meant] = []
        for step in steps:
            outcome = meaning.of(step.readings, context)
            if isinstance(outcome, Ambiguous):
                reply = outcome.question
                found = Interpretation(kind=Kind.CLARIFY, reply=reply, candidates=outcome.candidates)
                return Reading(interpretation=found, asked=outcome.phrase)
            if isinstance(outcome, NoReferent):
                return _reading(Kind.REFUSE, _whole(outcome.reason, step, steps), wholly=not outcome.unknown)
            meanings.append(outcome)
            context = _carried_on(context, outcome)
        return Reading(interpretation=self._checked(meanings, snapshot))

    def _checked(self, meanings: list[Meant], snapshot: Snapshot) -> Interpretation:
        goals = without_steps_between(meanings, self._verifier.state(snapshot))
        answers = " ".join(meant.answer for meant in meanings if meant.answer)
        mentioned = tuple(dict.fromkeys(i for meant in reversed(meanings) for i in (*meant.things, *meant.places)))
        queries = [meant.query for meant in meanings if meant.query is not None]
        if not goals:
            query = queries[0] if queries else None
            return Interpretation(kind=Kind.ANSWER, reply=answers, query=query, mentioned=mentioned)
        flaws = self._verifier.verify_goals(goals, snapshot)
        if flaws:
            reasons = " ".join(flaw.message[:1].upper() + flaw.message[1:] for flaw in flaws[:3])
            return Interpretation(kind=Kind.REFUSE, reply=reasons, mentioned=mentioned)
        return Interpretation(kind=Kind.PLAN, goals=goals, reply=answers, mentioned=mentioned)


def _carried_on(context: Context, meant: Meant) -> Context:
    """The context for the next step."""
    return replace(
        context,
        fresh=meant.things or context.fresh,
        mentioned=tuple(dict.fromkeys((*meant.things, *meant.places, *context.mentioned))),
        places=(*meant.places, *context.places),
        focus=meant.focus or context.focus,
        noun=meant.noun or context.noun,
    )


def _reading(kind: Kind, reply: str, *, wholly: bool = True) -> Reading:
    return Reading(interpretation=Interpretation(kind=kind, reply=reply), wholly=wholly)


def _unable_reply(unable: Sequence[Unable], count: int) -> str:
    verbs = listed(list(dict.fromkeys(step.verb for step in unable)))
    words = listed([f"“{_short(step.text)}”" for step in unable])
    rest = " I have not started on the rest either." if count > len(unable) else ""
    return f"I cannot {verbs}, so I cannot do {words}.{rest} {ABILITIES}"


def _not_understood_reply(steps: Sequence[ParsedStep]) -> str:
    clear = [f"“{step.text}”" for step in steps if isinstance(step, Understood)]
    unclear = [f"“{_short(step.text)}”{_at(step)}" for step in steps if isinstance(step, NotUnderstood)]
    lead = (
        f"I understood {listed(clear)}, but not {listed(unclear)}."
        if clear
        else f"I do not understand {listed(unclear)}."
    )
    return f"{lead} I have done nothing. Can you say it differently?"


def _at(step: NotUnderstood) -> str:
    return f" because of “{step.at}”" if step.at else ""


def _short(text: str) -> str:
    return text if len(text) <= 120 else f"{text[:117]}..."


def _whole(reason: str, step: Understood, steps: Sequence[Understood]) -> str:
    return reason if len(steps) == 1 else f"{reason} So I cannot do “{_short(step.text)}”, and have not started."
