"""What is told in one breath with a request: *he cannot read in that light, he wants the flashlight*.

With a comma, with *as* or *before*, or with nothing at all between, as in speech that was typed by a machine.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from planner.language.lexicon.terminals import ACTING, Terminal
from planner.language.sentences.background import is_told
from planner.language.sentences.lexer import trimmed

Tokens = Sequence[Terminal]
Parses = Callable[[str, Tokens], bool]
_REASONS = frozenset({"as", "since", "because", "cause", "for"})
_PERSONS = frozenset({"NAME", "HIM", "PERSON", "I"})
_BEGIN_STATEMENT = frozenset({"I", "IT", "HIM", "NAME", "THERE"})
_GOES_ON = frozenset({"BE", "TO", "CAN", "DO", "NOT", "SHOULD", "HAVE", "I", "HIM", "FOR", "FROM", "WITH", "THE", "A"})
"""After these no new statement or request begins."""
MIN_TOLD = 3


def apart(step: Tokens, parses: Parses) -> list[list[Terminal]]:
    """The statement and the request that ``step`` consists of, in their order; empty if it does not."""
    for index in range(1, len(step)):
        for left, right in _cut(step, index):
            if not left or not right:
                continue
            if is_told(left) and _is_request(right, step[index - 1 : index + 1], parses):
                return [left, right]
            if is_told(left) and (rest := apart(right, parses) if step[index].type == "COMMA" else []):
                return [left, *rest]
            if len(right) >= MIN_TOLD and is_told(right) and _is_request(left, step[index : index + 1], parses):
                return [left, right]
    return []


def _cut(step: Tokens, index: int) -> list[tuple[list[Terminal], list[Terminal]]]:
    """Left and right of ``index``, if something may begin there."""
    token = step[index]
    left, right = trimmed(step[:index]), trimmed(step[index:])
    if token.typed in _REASONS and token.type in ("MEANING", "WORD", "FOR"):
        return [(left, trimmed(step[index + 1 :]))]
    if token.type == "AND" and index + 1 < len(step) and step[index + 1].type == "WANTS" and step[0].type in _PERSONS:
        return [(left, [step[0], *right])]
    if token.type in ("COMMA", "AND"):
        return [(left, right)]
    begins = token.type in _BEGIN_STATEMENT or (token.type in ACTING and not token.typed.split()[0].endswith("ing"))
    return [(left, right)] if begins and step[index - 1].type not in _GOES_ON else []


def _is_request(tokens: Tokens, between: Tokens, parses: Parses) -> bool:
    """Whether ``tokens`` are read as a command; where no comma stands ``between``, by its verb."""
    breaks = not between or any(token.type == "COMMA" for token in between)
    verb = tokens[0].type in ACTING or any(token.type in ("WANTS", "SHOULD", "BELONG") for token in tokens)
    return (breaks or verb) and not is_told(tokens) and parses("command", tokens)
