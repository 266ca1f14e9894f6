"""Requests to the readings of their steps, with no look at what the words refer to."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import cache
from importlib import resources
from typing import Any

from planner.language.grammar.agreement import is_sensible
from planner.language.grammar.children import values_of
from planner.language.grammar.parser import (
    MAX_STEPS,
    Background,
    Choice,
    NotUnderstood,
    ParsedStep,
    Refrain,
    Understood,
    flattened,
)
from planner.language.grammar.parser import Unable as UnableStep
from planner.language.grammar.syntax import (
    Ask,
    Carry,
    Go,
    NounPhrase,
    Perhaps,
    Pick,
    Pronoun,
    Reference,
    Step,
    Wanted,
    along,
)
from planner.language.lexicon.lexicon import Lexicon
from planner.language.parsing.chart import MOST_MEANINGS, Chart, Packed, Reading
from planner.language.parsing.lattice import Lattice
from planner.language.parsing.parts import Branching, Elliptic, First
from planner.language.parsing.rules import Rules
from planner.language.parsing.sentence import SentenceReader
from planner.language.parsing.tokens import Token, sentences, tokens_of, typed
from planner.language.parsing.words import english

MAX_TOKENS = 60
PACKED = ("clause", "done", "refrain", "elliptic", "unable", "aside", "condition")
"""Rules whose meanings stay side by side until the graph settles them."""


@cache
def rules() -> Rules:
    """The grammar."""
    source = resources.files(__package__).joinpath("request.lark").read_text(encoding="utf-8")
    return Rules(
        source,
        ("sentence", "run_on", "referred"),
        packed=("clause", "refrain", "elliptic", "unable", "aside", "condition"),
    )


_READER = SentenceReader()


def _act(name: str, children: list[Any]) -> Any:
    act = getattr(_READER, name, None)
    value = act(children) if act is not None else values_of(children)[0]
    return value if _is_sensible(value) else None


def _is_sensible(value: Any) -> bool:
    if isinstance(value, NounPhrase):
        return bool(value.words) and is_sensible(value)
    if isinstance(value, tuple):
        return all(map(_is_sensible, value))
    things = getattr(value, "things", None)
    return all(map(_is_sensible, things)) if isinstance(things, tuple) else True


class RequestGrammar:
    """Parses requests. One instance serves all graphs; the names of a graph come with the lexicon."""

    def __init__(self) -> None:
        rules(), english()

    def parse(self, text: str, lexicon: Lexicon) -> list[ParsedStep]:
        """The steps of ``text`` in order; empty when it holds only courtesy, one not understood when too many."""
        steps: list[ParsedStep] = []
        for sentence in sentences(tokens_of(text, english().contractions)):
            if len(sentence) > MAX_TOKENS:
                return [NotUnderstood(text=typed(sentence)[:200])]
            readings = read(sentence, lexicon, "sentence") or read(sentence, lexicon, "run_on")
            if not readings:
                if not _is_courtesy(sentence):
                    steps.append(NotUnderstood(text=typed(sentence)))
                continue
            steps = _assembled(sentence, readings, steps)
        return _gathered(steps)[:MAX_STEPS]

    def phrase(self, text: str, lexicon: Lexicon) -> tuple[NounPhrase, ...]:
        """Readings of ``text`` as a single noun phrase (*the blue one*), for answers to a question."""
        found = sentences(tokens_of(text, english().contractions))
        if len(found) != 1:
            return ()
        return tuple(r.value for r in read(found[0], lexicon, "referred") if isinstance(r.value, NounPhrase))


def read(sentence: Sequence[Token], lexicon: Lexicon, start: str) -> tuple[Reading, ...]:
    """All readings of a sentence as ``start``, cheapest first."""
    entries = Lattice(sentence, english(), lexicon, rules()).entries()
    return Chart(rules(), _act, entries, len(sentence), start).readings()


def _is_courtesy(sentence: Sequence[Token]) -> bool:
    texts = [token.text for token in sentence if token.kind not in ("mark", "comma")]
    reach = {0}
    for start in range(len(texts)):
        if start in reach:
            reach |= {end for end in range(start + 1, len(texts) + 1) if tuple(texts[start:end]) in english().courtesy}
    return len(texts) in reach


def _assembled(
    sentence: Sequence[Token], readings: Sequence[Reading], before: Sequence[ParsedStep]
) -> list[ParsedStep]:
    """The steps ``before`` and those of the cheapest reading that is understood; of the cheapest if there is none."""
    first: list[ParsedStep] = []
    for reading in readings:
        steps = list(before)
        _Assembly(sentence, steps).add(reading.value)
        if not any(isinstance(step, NotUnderstood) for step in flattened(steps)):
            return steps
        first = first or steps
    return first


def _gathered(steps: Sequence[ParsedStep]) -> list[ParsedStep]:
    """*Take the cup and the fork from the table. Then put them on the desk*: what is only taken up is put there."""
    found: list[ParsedStep] = []
    taken: list[Understood] = []
    for step in steps:
        if isinstance(step, Understood) and taken and any(map(_leans, step.readings)):
            several = any(map(_several, filter(_leans, step.readings)))
            leads = taken if several else taken[-1:]
            found += [] if several else taken[:-1]
            readings = dict.fromkeys(
                replace(carry, things=things)
                for reading in filter(_leans, step.readings)
                if isinstance(carry := reading.step if isinstance(reading, Perhaps) else reading, Carry)
                for things in _combinations(leads)
            )
            found.append(Understood(text=step.text, readings=tuple(readings)))
            taken = []
        elif isinstance(step, Understood) and all(map(_is_taken, step.readings)):
            taken.append(step)
        else:
            found += [*taken, step]
            taken = []
    return [*found, *taken]


def _leans(reading: Step) -> bool:
    words = ("it", "them", "both", "all", "that")
    carry = reading.step if isinstance(reading, Perhaps) else reading
    return isinstance(carry, Carry) and all(isinstance(x, Pronoun) and x.word in words for x in carry.things)


def _several(reading: Step) -> bool:
    carry = reading.step if isinstance(reading, Perhaps) else reading
    return isinstance(carry, Carry) and any(isinstance(x, Pronoun) and x.word != "it" for x in carry.things)


def _is_taken(reading: Step) -> bool:
    """Whether things are only taken up, or cleared off a place, with no word about where to."""
    return isinstance(reading, Pick) or (
        isinstance(reading, Carry)
        and (reading.destination is None or reading.implied)
        and not any(isinstance(x, Pronoun) for x in reading.things)
    )


def _combinations(leads: Sequence[Understood]) -> list[tuple[Reference, ...]]:
    found: list[tuple[Reference, ...]] = [()]
    for lead in leads:
        named = [reading.things for reading in lead.readings if isinstance(reading, Carry | Pick)]
        found = [(*before, *things) for before in found for things in named][:MOST_MEANINGS]
    return found


class _Assembly:
    """Puts the parts of a sentence behind the steps before."""

    def __init__(self, sentence: Sequence[Token], steps: list[ParsedStep]) -> None:
        self._sentence, self._steps = sentence, steps

    def add(self, parts: Iterable[Any]) -> None:
        for part in parts:
            self._add(part)

    def _text(self, packed: Packed) -> str:
        return typed(self._sentence[packed.start : packed.end])

    def _inner(self, parts: Iterable[Any], before: Sequence[ParsedStep] = ()) -> tuple[ParsedStep, ...]:
        steps = list(before)
        _Assembly(self._sentence, steps).add(parts)
        return tuple(steps[len(before) :])

    def _add(self, part: Any) -> None:
        steps = self._steps
        if isinstance(part, Branching):
            self._branch(part)
        elif isinstance(part, First):
            last = steps.pop() if steps else None
            self.add(part.then)
            steps += [last] if last is not None else []
        elif isinstance(part, tuple):
            self.add(part)
        elif isinstance(part, Packed):
            steps.append(self._step(part))

    def _step(self, packed: Packed) -> ParsedStep:
        text = self._text(packed)
        cheapest = packed.readings[0].cost
        values = tuple(reading.value for reading in packed.readings if reading.cost <= cheapest)
        if packed.kind == "refrain":
            return Refrain(text=text, readings=tuple(v for v in values if v != "unclear"))
        if packed.kind == "unable":
            return UnableStep(text=text, verb=values[0].verb)
        if packed.kind == "aside":
            return Background(text=text)
        if packed.kind == "elliptic":
            before = next((s for s in reversed(self._steps) if isinstance(s, Understood)), None)
            full = tuple(
                dict.fromkeys(
                    step
                    for value in values
                    for leader in (before.readings if before else ())
                    if (step := _completed(value, leader)) is not None
                )
            )
            if not full and before is None:
                full = tuple(dict.fromkeys(Wanted(thing=v.destination.reference) for v in values if _is_whither(v)))
            return Understood(text=text, readings=full) if full else NotUnderstood(text=text)
        return Understood(text=text, readings=values)

    def _branch(self, part: Branching) -> None:
        steps = self._steps
        if part.before and steps:
            last = steps.pop()
            asked = tuple(r for r in last.readings if isinstance(r, Ask)) if isinstance(last, Understood) else ()
            if asked:
                then, otherwise = self._inner(part.then), self._inner(part.otherwise)
                steps.append(
                    Choice(text=last.text, condition=asked, negated=part.negated, then=then, otherwise=otherwise)
                )
            elif isinstance(last, Choice) and not last.otherwise:
                steps.append(replace(last, otherwise=self._inner(part.then, last.then)))
            elif part.negated:
                then = (last,)
                otherwise = self._inner(part.then, then)
                steps.append(Choice(text=last.text, condition=None, negated=False, then=then, otherwise=otherwise))
            else:
                steps.append(NotUnderstood(text=last.text))
            return
        then = self._inner(part.then)
        condition = None
        text = ""
        if part.condition is not None:
            cheapest = part.condition.readings[0].cost
            condition = tuple(
                r.value for r in part.condition.readings if r.cost <= cheapest and isinstance(r.value, Ask)
            )
            text = self._text(part.condition)
        otherwise = self._inner(part.otherwise, then)
        steps.append(Choice(text=text, condition=condition, negated=part.negated, then=then, otherwise=otherwise))


def _is_whither(part: Elliptic) -> bool:
    """*To the kitchen!*: a place to go to."""
    return part.destination is not None and not part.things


def _completed(part: Elliptic, leader: Step) -> Step | None:
    """What a step without a verb means after ``leader``."""
    if isinstance(leader, Go) and part.destination is not None and not part.things:
        return replace(leader, target=part.destination.reference)
    if isinstance(leader, Carry):
        things = part.things or (Pronoun(word="them"),)
        if part.destination is None:
            return along(replace(leader, things=things), leader) if part.things else None
        return replace(leader, things=things, destination=part.destination, implied=False)
    return None
