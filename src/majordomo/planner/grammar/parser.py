"""The command grammar: text to readings of its steps, with no look at what the words refer to."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

from lark import Lark, Token, Tree, UnexpectedInput
from lark.lexer import Lexer
from lark.visitors import CollapseAmbiguities

from majordomo.planner.grammar.lexer import Lexicon, Terminal, clauses, typed
from majordomo.planner.grammar.phrases import is_sensible
from majordomo.planner.grammar.reading import Reader
from majordomo.planner.grammar.syntax import NounPhrase, Step

MAX_STEPS = 20
MAX_STEP_TOKENS = 60
MAX_READINGS = 24
_QUESTION_STARTS = frozenset(
    [
        "WHERE",
        "WHAT",
        "WHICH",
        "WHO",
        "HOW_MANY",
        "COUNT",
        "LIST",
        "TELL",
        "BE",
        "DO",
        "CAN",
        "CAN_YOU",
        "WHICH_ROOM",
        "WHICH_ROOMS",
        "LIST_ROOMS",
        "WHETHER",
        "HELP",
    ]
)


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


ParsedStep = Understood | NotUnderstood | Unable


class _TokenStream(Lexer):
    """Hands Lark the terminals that ``lexer.clauses`` found."""

    __future_interface__ = 1

    def __init__(self, lexer_conf: Any) -> None:
        pass

    def lex(self, lexer_state: Any, parser_state: Any = None) -> Iterator[Token]:
        del parser_state
        for terminal in lexer_state.text:
            yield Token(terminal.type, terminal.value)


class CommandGrammar:
    """Parses requests. One instance serves all graphs; the names of a graph come with the lexicon."""

    def __init__(self) -> None:
        """Builds Lark's tables, so that the first request does not wait for them."""
        _lark()

    def parse(self, text: str, lexicon: Lexicon) -> list[ParsedStep]:
        """The steps of ``text`` in order; empty when it holds only courtesy, one not understood when too many."""
        steps = clauses(text, lexicon)
        if len(steps) > MAX_STEPS:
            return [NotUnderstood(text=f"{len(steps)} steps at once; I take at most {MAX_STEPS}")]
        return [self._step(step) for step in steps]

    def phrase(self, text: str, lexicon: Lexicon) -> tuple[NounPhrase, ...]:
        """Readings of ``text`` as a single noun phrase (*the blue one*), for answers to a question."""
        steps = clauses(text, lexicon)
        if len(steps) != 1:
            return ()
        readings = _readings("np", steps[0])
        return tuple(reading for reading in readings if isinstance(reading, NounPhrase))

    def _step(self, step: Sequence[Terminal]) -> ParsedStep:
        text = typed(step)
        unable = next((token for token in step if token.type == "UNABLE"), None)
        if unable is not None:
            return Unable(text=text, verb=unable.value)
        if len(step) > MAX_STEP_TOKENS:
            return NotUnderstood(text=text[:200])
        strange = next((token for token in step if token.type in ("MEANING", "JUNK")), None)
        if strange is not None:
            return NotUnderstood(text=text, at=strange.typed)
        readings = tuple(_readings("question" if step[0].type in _QUESTION_STARTS else "command", step))
        return Understood(text=text, readings=readings) if readings else NotUnderstood(text=text)


@cache
def _lark() -> Lark:
    source = resources.files(__package__).joinpath("commands.lark").read_text(encoding="utf-8")
    return Lark(
        source,
        parser="earley",
        lexer=_TokenStream,
        ambiguity="explicit",
        start=["command", "question", "np"],
        maybe_placeholders=False,
    )


def _readings(start: str, step: Sequence[Terminal]) -> list[Any]:
    try:
        forest: Tree[Token] = _lark().parse(step, start=start)
    except UnexpectedInput:
        return []
    trees = CollapseAmbiguities().transform(forest)
    found: list[Any] = []
    for tree in trees[:MAX_READINGS]:
        reading = Reader().transform(tree)
        if reading not in found and _sensible(reading):
            found.append(reading)
    return found


def _sensible(value: Any) -> bool:
    if isinstance(value, NounPhrase) and not is_sensible(value):
        return False
    parts = value if isinstance(value, tuple) else tuple(vars(value).values()) if hasattr(value, "__dict__") else ()
    return all(_sensible(part) for part in parts if not isinstance(part, str))
