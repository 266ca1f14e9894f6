"""The command grammar: text to readings of its steps, with no look at what the words refer to."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from importlib import resources
from typing import Any

from lark import Lark, Token, Tree, UnexpectedInput
from lark.lexer import Lexer
from lark.visitors import CollapseAmbiguities

from planner.language.grammar.agreement import is_sensible
from planner.language.grammar.lookahead import LookaheadParser
from planner.language.grammar.reading import Reader
from planner.language.grammar.syntax import (
    Ask,
    Carry,
    Mention,
    NounPhrase,
    Perhaps,
    Reference,
    Step,
    Teach,
    Wanted,
    along,
    leans,
)
from planner.language.lexicon.lexicon import Lexicon
from planner.language.lexicon.terminals import ACTING, Terminal
from planner.language.sentences.background import is_bodily, is_told, names_nothing, spoken_of
from planner.language.sentences.lexer import asks, clauses, sentences, typed
from planner.language.sentences.sentences import Clause, Forbidden, Fork, Part, Structure, Unclear

MAX_STEPS = 20
MAX_STEP_TOKENS = 60
MAX_SENTENCE_TOKENS = 200
MAX_READINGS = 24
_SOFT = frozenset({"tidy", "call", "label", "rename", "relabel"})
"""Verbs that are understood in some sentences only, and refused by name in all others."""
_MOVING = frozenset({"run", "drive", "walk", "roll", "head", "navigate"})
"""Verbs of going that mean something else with *a* thing: *run a bath*, *drive a car*."""


@dataclass(frozen=True, kw_only=True)
class Understood:
    """One step that parsed: its words, and every reading of them."""

    text: str
    readings: tuple[Step, ...]


@dataclass(frozen=True, kw_only=True)
class NotUnderstood:
    """One step that did not parse: its words, and the word at which the grammar gave up, if it can be named."""

    text: str
    at: str = ""


@dataclass(frozen=True, kw_only=True)
class Unable:
    """One step that asks for something outside the robot's skills, by the verb."""

    text: str
    verb: str


@dataclass(frozen=True, kw_only=True)
class Refrain:
    """One step that is not to be done: its words, and every reading of what it forbids."""

    text: str
    readings: tuple[Step, ...]


@dataclass(frozen=True, kw_only=True)
class Choice:
    """Steps that depend on a question; ``condition`` None: ``otherwise`` is for when ``then`` has no referent."""

    text: str
    condition: tuple[Ask, ...] | None
    negated: bool
    then: tuple[ParsedStep, ...]
    otherwise: tuple[ParsedStep, ...]


@dataclass(frozen=True, kw_only=True)
class Background:
    """What is only told: its words, and the readings of each thing that it speaks of, with whether it is a place."""

    text: str
    spoken: tuple[tuple[bool, tuple[Mention, ...]], ...] = ()


ParsedStep = Understood | NotUnderstood | Unable | Refrain | Choice | Background


def flattened(steps: Iterable[ParsedStep]) -> Iterator[ParsedStep]:
    """Every step, those of both branches of a choice included."""
    for step in steps:
        yield step
        if isinstance(step, Choice):
            yield from flattened((*step.then, *step.otherwise))


class _TokenStream(Lexer):
    """Hands Lark the terminals that ``lexer.sentences`` found."""

    __future_interface__ = 1

    def __init__(self, lexer_conf: Any) -> None:
        pass

    def lex(self, lexer_state: Any, parser_state: Any = None) -> Iterator[Token]:
        del parser_state
        yield from lexer_state.text


class CommandGrammar:
    """Parses requests. One instance serves all graphs; the names of a graph come with the lexicon."""

    def __init__(self) -> None:
        """Builds Lark's tables, so that the first request does not wait for them."""
        _lark()

    def parse(self, text: str, lexicon: Lexicon) -> list[ParsedStep]:
        """The steps of ``text`` in order; empty when it holds only courtesy, one not understood when too many."""
        found = sentences(text, lexicon)
        count = sum(len(clauses(sentence)) for sentence in found)
        if count > MAX_STEPS:
            return [NotUnderstood(text=f"{count} steps at once; I take at most {MAX_STEPS}")]
        long = next((sentence for sentence in found if len(sentence) > MAX_SENTENCE_TOKENS), None)
        if long is not None:
            return [NotUnderstood(text=typed(long)[:200])]
        structure = Structure(_parses)
        for sentence in found:
            structure.add(sentence)
        return _linked(structure.parts, _going_along(structure.parts, [_parsed(part) for part in structure.parts]))

    def phrase(self, text: str, lexicon: Lexicon) -> tuple[NounPhrase, ...]:
        """Readings of ``text`` as a single noun phrase (*the blue one*), for answers to a question."""
        found = sentences(text, lexicon)
        if len(found) != 1 or len(found[0]) > MAX_STEP_TOKENS:
            return ()
        readings = _readings("referred", found[0])
        return tuple(reading for reading in readings if isinstance(reading, NounPhrase))


def _going_along(parts: Sequence[Part], steps: list[ParsedStep]) -> list[ParsedStep]:
    """*Bring the apple to the shelf, then the cup too*: what has no verb and place goes where the one before does."""
    for index in range(1, len(steps)):
        before, step, part = steps[index - 1], steps[index], parts[index]
        if not (isinstance(before, Understood) and isinstance(step, Understood)):
            continue
        if isinstance(part, Clause) and part.elliptic and not any(map(_is_placed, step.readings)):
            readings = (along(reading, leader) for reading in step.readings for leader in before.readings)
            steps[index] = replace(step, readings=tuple(dict.fromkeys(readings)))
    return steps


def _is_placed(reading: Step) -> bool:
    return isinstance(reading, Carry) and not reading.implied and reading.destination is not None


def _linked(parts: Sequence[Part], steps: list[ParsedStep]) -> list[ParsedStep]:
    """The steps with statements set aside, and with what *the key, bring it to Ben* begins with as what it is about."""
    told = [
        isinstance(part, Clause)
        and (_asks_nothing(step) or _is_news(part, step, steps[k + 1 :]))
        and is_told(part.tokens)
        for k, (part, step) in enumerate(zip(parts, steps, strict=True))
    ]
    if any(isinstance(step, Understood | Choice) and not aside for step, aside in zip(steps, told, strict=True)):
        steps = [
            _background(part.tokens) if aside and isinstance(part, Clause) else step
            for part, step, aside in zip(parts, steps, told, strict=True)
        ]
    for index, (part, step) in enumerate(zip(parts, steps, strict=True)):
        after = next((other for other in steps[index + 1 :] if not isinstance(other, Background)), None)
        if after is None or not _refers_back(after):
            continue
        if isinstance(part, Clause) and isinstance(step, Understood | NotUnderstood):
            steps[index] = _topic(part.tokens, step)
    return steps


def _asks_nothing(step: ParsedStep) -> bool:
    """Whether a step means nothing by itself, or only *the desk is a mess*."""
    if isinstance(step, Understood):
        return all(
            (isinstance(r, Wanted) and _is_somebody(r.thing)) or (isinstance(r, Teach) and not r.named and not r.mine)
            for r in step.readings
        )
    return isinstance(step, NotUnderstood | Unable)


def _is_news(part: Clause, step: ParsedStep, after: Sequence[ParsedStep]) -> bool:
    """*I have a headache*, before a request that does not lean on it."""
    mentions = isinstance(step, Understood) and all(isinstance(r, Mention) and not r.lost for r in step.readings)
    leaning = bool(after) and _refers_back(after[0])
    return mentions and names_nothing(part.tokens) and (is_bodily(part.tokens) or not leaning)


def _is_somebody(thing: Reference) -> bool:
    """*Ben drinks*, read as a name of two words."""
    return isinstance(thing, NounPhrase) and thing.person and len(thing.words) > 1


def _background(tokens: Sequence[Terminal]) -> Background:
    spoken = []
    for is_place, span in spoken_of(tokens):
        ends = range(len(span), 0, -1)
        readings = next((found for end in ends if (found := tuple(_readings("topic", span[:end])))), ())
        spoken.append((is_place, readings))
    return Background(text=typed(tokens), spoken=tuple(spoken))


def _refers_back(step: ParsedStep) -> bool:
    steps = (step,) if not isinstance(step, Choice) else (*step.then, *step.otherwise)
    return any(isinstance(each, Understood) and any(map(leans, each.readings)) for each in steps)


def _topic(tokens: Sequence[Terminal], step: Understood | NotUnderstood) -> ParsedStep:
    """A noun phrase without a verb as what the next step is about."""
    if isinstance(step, Understood) and not all(isinstance(r, Wanted | Perhaps) for r in step.readings):
        return step
    topics = tuple(_readings("topic", tokens))
    return Understood(text=step.text, readings=topics) if topics else step


def _parsed(part: Part) -> ParsedStep:
    match part:
        case Clause():
            return _step(part.tokens)
        case Forbidden():
            verb = next((k for k, token in enumerate(part.tokens) if token.type in ACTING), len(part.tokens))
            readings = tuple(_readings("command", part.tokens[verb:])) if verb < len(part.tokens) else ()
            return Refrain(text=typed(part.tokens), readings=readings)
        case Unclear():
            unable = next((token for token in part.tokens if token.type == "UNABLE"), None)
            text = typed(part.tokens)
            return Unable(text=text, verb=unable.value) if unable is not None else NotUnderstood(text=text)
        case Fork():
            asked = tuple(r for r in _readings("condition", part.condition) if isinstance(r, Ask))
            return Choice(
                text=typed(part.condition),
                condition=asked if part.condition else None,
                negated=part.negated,
                then=tuple(map(_parsed, part.then)),
                otherwise=tuple(map(_parsed, part.otherwise)),
            )


def _step(step: Sequence[Terminal]) -> ParsedStep:
    text = typed(step)
    unable = next((token for token in step if token.type == "UNABLE"), None)
    if unable is not None:
        return Unable(text=text, verb=unable.value)
    if len(step) > MAX_STEP_TOKENS:
        return NotUnderstood(text=text[:200])
    strange = next((token for token in step if token.type in ("MEANING", "JUNK", "PAST")), None)
    if strange is not None:
        return NotUnderstood(text=text, at=strange.typed)
    readings = tuple(_readings("question" if asks(step) else "command", step)) or tuple(_readings("narrated", step))
    if step[0].typed in _SOFT and not any(_is_settled(reading) for reading in readings):
        return Unable(text=text, verb=step[0].typed)
    if step[0].typed in _MOVING and len(step) > 1 and step[1].type == "A":
        return Unable(text=text, verb=step[0].typed)
    if readings:
        return Understood(text=text, readings=readings)
    return NotUnderstood(text=text, at=step[0].typed if step[0].type == "WORD" else "")


def _is_settled(reading: Step) -> bool:
    return not isinstance(reading, Carry) or reading.destination is not None


@cache
def _lark() -> LookaheadParser:
    source = resources.files(__package__).joinpath("commands.lark").read_text(encoding="utf-8")
    lark = Lark(
        source,
        parser="earley",
        lexer=_TokenStream,
        ambiguity="explicit",
        start=["command", "deed", "question", "condition", "referred", "narrated", "topic"],
        maybe_placeholders=False,
    )
    return LookaheadParser(lark)


def _forest(start: str, step: Sequence[Terminal]) -> Tree[Token] | None:
    return _parse(start, tuple(step))


@lru_cache(maxsize=512)
def _parse(start: str, step: tuple[Terminal, ...]) -> Tree[Token] | None:
    tokens = tuple(Token(terminal.type, terminal.value) for terminal in step)
    try:
        return _lark().parse(tokens, start)
    except UnexpectedInput:
        return None


def _parses(start: str, tokens: Sequence[Terminal]) -> bool:
    """Whether ``start`` derives ``tokens``; a bare statement is no command."""
    if len(tokens) > MAX_STEP_TOKENS or any(token.type in ("UNABLE", "MEANING", "JUNK") for token in tokens):
        return False
    return _forest(start, tokens) is not None


def _readings(start: str, step: Sequence[Terminal]) -> list[Any]:
    return list(_read(start, tuple(step)))


@lru_cache(maxsize=512)
def _read(start: str, step: tuple[Terminal, ...]) -> tuple[Any, ...]:
    """The readings of terminals: the same words are read once, whatever the graph."""
    forest = _forest(start, step)
    if forest is None:
        return ()
    trees = CollapseAmbiguities().transform(forest)
    found: list[Any] = []
    for tree in trees[:MAX_READINGS]:
        reading = Reader().transform(tree)
        if reading not in found and _sensible(reading):
            found.append(reading)
    return tuple(found)


def _sensible(value: Any) -> bool:
    if isinstance(value, NounPhrase) and not is_sensible(value):
        return False
    parts = value if isinstance(value, tuple) else tuple(vars(value).values()) if hasattr(value, "__dict__") else ()
    return all(_sensible(part) for part in parts if not isinstance(part, str))
