"""A chart parser over a lattice: every reading of every word is kept until the whole sentence settles it.

Left corners from below, filtered from above as Earley does it (Earley 1970; Kay 1980, *Algorithm schemata*). What a
span means is worked out afterwards, only for spans that belong to a whole reading, cheapest first.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from heapq import nsmallest
from typing import Any

from planner.language.parsing.rules import Rule, Rules

MOST_MEANINGS = 24
"""Of a span as one symbol, so many meanings are kept, the cheapest."""


@dataclass(frozen=True, kw_only=True)
class Entry:
    """Words ``start`` to ``end`` as a terminal: ``symbol`` of the grammar, ``value`` for its meaning, and its cost.

    ``skipped``: words among them that say nothing, as bits.
    """

    symbol: int
    start: int
    end: int
    value: Any
    cost: int = 0
    skipped: int = 0


@dataclass(frozen=True)
class Reading:
    """One meaning of a span, what it costs, and which words it passes over, as bits."""

    cost: int
    value: Any
    skipped: int


@dataclass(frozen=True, kw_only=True)
class Packed:
    """A span whose meanings stay side by side, whatever stands beside it: ``kind`` names the rule."""

    kind: str
    start: int
    end: int
    readings: tuple[Reading, ...]


Actions = Callable[[str, list[Any]], Any]
"""From the name of a rule and the meanings of its parts to its meaning; None where it makes no sense."""

_Item = tuple[int, int]
"""A rule by its number, and how many of its parts are found."""


class Chart:
    """All that the words of one sentence may be, as ``start``."""

    def __init__(self, rules: Rules, actions: Actions, entries: Sequence[Entry], length: int, start: str) -> None:
        self._rules, self._actions, self._length = rules, actions, length
        self._words: dict[tuple[int, int], dict[int, list[Entry]]] = {}
        self._first = [0] * (length + 1)
        for entry in entries:
            self._words.setdefault((entry.start, entry.end), {}).setdefault(entry.symbol, []).append(entry)
            self._first[entry.start] |= 1 << entry.symbol
        self._whole: dict[tuple[int, int, int], list[int]] = {}
        """A symbol from one place to another: the rules that make it there."""
        self._cuts: dict[tuple[int, int, int, int], list[int]] = {}
        """Rule, parts found, begin, end: where the last of the parts begins."""
        self._known: dict[tuple[int, int, int], tuple[Reading, ...]] = {}
        self._found: dict[tuple[int, int, int, int], tuple[Reading, ...]] = {}
        self._start = rules.numbers[start]
        self._fill()

    def readings(self) -> tuple[Reading, ...]:
        """What all words together mean, cheapest first; empty where they are no such thing."""
        return self._readings(self._start, 0, self._length)

    def _fill(self) -> None:
        """Find every symbol between two places that may help, from left to right, the shortest first."""
        length, corners = self._length, self._rules.corners
        self._complete: list[list[dict[int, None]]] = [[{} for _ in range(length + 1)] for _ in range(length)]
        self._waiting: list[list[dict[int, list[_Item]]]] = [[{} for _ in range(length + 1)] for _ in range(length)]
        self._wanted = [0] * (length + 1)
        self._wanted[0] = corners[self._start]
        for end in range(1, length + 1):
            for begin in range(end - 1, -1, -1):
                if self._wanted[begin]:
                    self._span(begin, end)

    def _span(self, begin: int, end: int) -> None:
        wanted, found = self._wanted[begin], self._complete[begin][end]
        for symbol in self._words.get((begin, end), ()):
            if wanted >> symbol & 1:
                found[symbol] = None
        for middle in range(begin + 1, end):
            waiting = self._waiting[begin][middle]
            if waiting:
                for symbol in self._complete[middle][end]:
                    for number, dot in waiting.get(symbol, ()):
                        self._advance(number, dot, begin, middle, end)
        ranks, beginning = self._rules.ranks, self._rules.beginning
        done: set[int] = set()
        while len(done) < len(found):
            symbol = min((s for s in found if s not in done), key=ranks.__getitem__)
            done.add(symbol)
            for number, left in beginning.get(symbol, ()):
                if wanted >> left & 1:
                    self._advance(number, 0, begin, begin, end)

    def _advance(self, number: int, dot: int, begin: int, middle: int, end: int) -> None:
        """One more part of a rule is found, from ``middle``: it is complete, or waits for the next part at ``end``."""
        rule = self._rules.rules[number]
        dot += 1
        last = dot == len(rule.right)
        if not last:
            symbol = rule.right[dot]
            corner = self._rules.corners[symbol]
            if end == self._length or not corner & self._first[end]:
                return
        key = (number, dot, begin, end)
        cuts = self._cuts.get(key)
        if cuts is not None:
            cuts.append(middle)
            return
        self._cuts[key] = [middle]
        if last:
            self._whole.setdefault((rule.left, begin, end), []).append(number)
            self._complete[begin][end][rule.left] = None
        else:
            self._waiting[begin][end].setdefault(symbol, []).append((number, dot))
            self._wanted[end] |= corner

    def _readings(self, symbol: int, begin: int, end: int) -> tuple[Reading, ...]:
        key = (symbol, begin, end)
        known = self._known.get(key)
        if known is not None:
            return known
        found: dict[Hashable, Reading] = {}
        for entry in self._words.get((begin, end), {}).get(symbol, ()):
            _keep(found, Reading(entry.cost, entry.value, entry.skipped))
        for number in self._whole.get(key, ()):
            rule = self._rules.rules[number]
            for parts in self._parts(number, len(rule.right), begin, end):
                value = self._meaning(rule, parts.value)
                if value is not None:
                    _keep(found, Reading(parts.cost + rule.cost, value, parts.skipped))
        best = tuple(nsmallest(MOST_MEANINGS, found.values(), key=lambda reading: reading.cost))
        name = self._rules.names[symbol]
        if best and name in self._rules.packed:
            packed = Packed(kind=name, start=begin, end=end, readings=best)
            best = (Reading(best[0].cost, packed, 0),)
        self._known[key] = best
        return best

    def _meaning(self, rule: Rule, parts: tuple[Any, ...]) -> Any:
        if rule.action:
            return self._actions(rule.action, list(parts))
        return parts if rule.inlined else parts[0]

    def _parts(self, number: int, dot: int, begin: int, end: int) -> tuple[Reading, ...]:
        """The first ``dot`` parts of a rule side by side, as tuples."""
        if dot == 0:
            return (Reading(0, (), 0),)
        key = (number, dot, begin, end)
        known = self._found.get(key)
        if known is not None:
            return known
        rule = self._rules.rules[number]
        symbol, kept = rule.right[dot - 1], rule.kept[dot - 1]
        inlined = symbol in self._rules.inlined
        found: list[Reading] = []
        for middle in self._cuts[key]:
            before = self._parts(number, dot - 1, begin, middle) if dot > 1 else (Reading(0, (), 0),)
            for part in self._readings(symbol, middle, end):
                added = part.value if inlined else (part.value,) if kept else ()
                found += [Reading(b.cost + part.cost, b.value + added, b.skipped | part.skipped) for b in before]
        best = tuple(nsmallest(MOST_MEANINGS, found, key=lambda reading: reading.cost))
        self._found[key] = best
        return best


def _keep(found: dict[Hashable, Reading], reading: Reading) -> None:
    key = tuple(map(_hashable, reading.value)) if isinstance(reading.value, tuple) else _hashable(reading.value)
    before = found.get(key)
    if before is None or reading.cost < before.cost:
        found[key] = reading


def _hashable(value: Any) -> Hashable:
    return tuple(value.items()) if isinstance(value, dict) else value
