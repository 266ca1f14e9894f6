"""From tokens to entries: all that each word may be, alone and with those after it, as the lexicon has it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

from lark import Token as LarkToken

from planner.language.lexicon.lexicon import Lexicon
from planner.language.lexicon.vocabulary import PERSON_WORDS, normal, singular
from planner.language.parsing.chart import Entry
from planner.language.parsing.rules import Rules
from planner.language.parsing.tokens import Token
from planner.language.parsing.words import MOVING, Words

_IDENTIFIER = re.compile(r"[^\W_]+(?:_[^\W_]+)*_\d+")
_DOOR = frozenset({"door", "doors", "doorway", "doorways"})
CHANGING = frozenset(
    {*MOVING, "WANT", "NOT", "NEVER", "NO", "EXCEPT", "WHETHER", "UNLESS", "PROVIDED", "OTHERWISE", "UNABLE"}
)
"""Words that do not stand in what is only told."""
UNKNOWN, STRAY, SLIP, FILLED = 4, 1, 2, 3


class Lattice:
    """The entries of one sentence."""

    def __init__(self, tokens: Sequence[Token], words: Words, lexicon: Lexicon, rules: Rules) -> None:
        self._tokens, self._words, self._lexicon, self._rules = tokens, words, lexicon, rules
        self._texts = [token.text for token in tokens]
        self._meant = [self._slip(token) for token in tokens]

    def entries(self) -> list[Entry]:
        """All entries, with what says nothing behind them, and before the first of them, as part of them."""
        plain = [entry for start in range(len(self._tokens)) for entry in self._at(start)]
        return self._stretched(plain)

    def _slip(self, token: Token) -> str:
        if token.kind != "word" or token.text in self._words.single:
            return token.text
        slip = self._lexicon.meant(token.text)
        return self._lexicon.small(token.text) if slip == token.text else slip

    def _at(self, start: int) -> Iterable[Entry]:
        token = self._tokens[start]
        if token.kind == "comma":
            yield from self._entry("COMMA", ",", start, start + 1)
        elif token.kind == "quoted":
            yield from self._entry("NOUN", normal(token.text), start, start + 1)
        elif token.kind == "number":
            whole = token.text.isdecimal()
            yield from self._entry("NUMBER" if whole else "DECIMAL", token.text, start, start + 1)
        elif token.kind == "word":
            yield from self._phrases(start)
            yield from self._single(start)
        yield from self._entry("ANY", token.text, start, start + 1, FILLED)
        if token.kind == "word" and self._is_told(token.text):
            yield from self._entry("TOLD", token.text, start, start + 1, FILLED)

    def _phrases(self, start: int) -> Iterable[Entry]:
        longest = max(self._words.longest, self._lexicon.longest)
        for end in range(start + 1, min(start + longest, len(self._tokens)) + 1):
            if self._tokens[end - 1].kind != "word" and not (
                end - start > 1 and self._tokens[end - 1].kind == "number"
            ):
                break
            for cost, texts in ((0, self._texts), (SLIP, self._meant)):
                words = tuple(texts[start:end])
                if cost and words == tuple(self._texts[start:end]):
                    continue
                yield from self._named(words, start, end, cost)

    def _named(self, words: tuple[str, ...], start: int, end: int, cost: int) -> Iterable[Entry]:
        phrase = " ".join(words)
        for sense in self._words.senses.get(words, ()):
            yield from self._entry(sense.terminal, sense.value, start, end, cost)
        literal = self._rules.literals.get(phrase)
        if literal is not None:
            yield Entry(symbol=literal, start=start, end=end, value=phrase, cost=cost)
        lexicon = self._lexicon
        if person := lexicon.person(words):
            yield from self._entry("NAME", person, start, end, cost)
        if phrase in lexicon.colors:
            yield from self._entry("COLOR", phrase, start, end, cost)
        if len(words) == 1 and (phrase in PERSON_WORDS or singular(phrase) in PERSON_WORDS):
            yield from self._entry("PERSON", phrase, start, end, cost)
        if phrase.endswith(("'s", "s'")):
            owner = tuple(phrase.removesuffix("'s").removesuffix("s'").split())
            if lexicon.can_own(owner):
                yield from self._entry("POSSESSIVE", phrase, start, end, cost)
        if phrase in _DOOR:
            yield from self._entry("DOOR", phrase, start, end, cost)
        if lexicon.is_noun(words) and (phrase not in self._words.closed or words in lexicon.nouns):
            yield from self._entry("NOUN", phrase, start, end, cost)
        else:
            plain = phrase.replace("'", "").replace("-", " ")
            if plain != phrase and lexicon.is_noun(tuple(plain.split())):
                yield from self._entry("NOUN", plain, start, end, cost)

    def _single(self, start: int) -> Iterable[Entry]:
        text = self._texts[start]
        if _IDENTIFIER.fullmatch(text):
            yield from self._entry("IDENTIFIER", text, start, start + 1)
        if text.endswith("'s") and len(text) > 3:
            yield from self._entry("POSSESSIVE", text, start, start + 1, UNKNOWN)
        if text not in self._words.closed and (text,) not in self._words.courtesy:
            known = text in self._words.single
            yield from self._entry("WORD", text, start, start + 1, UNKNOWN + (UNKNOWN if known else 0))

    def _is_told(self, text: str) -> bool:
        """Whether a word may stand in what is only told: no thing that is here, no deed, nothing that changes one."""
        senses = self._words.senses.get((text,), ())
        here = self._lexicon.is_noun((text,)) or singular(text) in self._lexicon.parts
        return not here and not any(sense.terminal in CHANGING for sense in senses)

    def _entry(self, terminal: str, value: str, start: int, end: int, cost: int = 0) -> Iterable[Entry]:
        symbol = self._rules.numbers.get(terminal)
        if symbol is not None:
            meaning: Any = LarkToken(terminal, value)
            yield Entry(symbol=symbol, start=start, end=end, value=meaning, cost=cost)

    def _skips(self) -> dict[int, list[tuple[int, int]]]:
        """Where words that say nothing begin: where they end, and what it costs to pass over them."""
        found: dict[int, list[tuple[int, int]]] = {}
        for start, token in enumerate(self._tokens):
            if token.kind == "mark":
                found.setdefault(start, []).append((start + 1, 0))
            if start and token.kind == "word" and token.text == self._texts[start - 1]:
                found.setdefault(start, []).append((start + 1, STRAY))  # said twice
            if token.kind == "comma":
                found.setdefault(start, []).append((start + 1, STRAY))
            for end in range(start + 1, min(start + self._words.longest, len(self._tokens)) + 1):
                if tuple(self._texts[start:end]) in self._words.courtesy:
                    found.setdefault(start, []).append((end, 0))
        return found

    def _stretched(self, entries: list[Entry]) -> list[Entry]:
        skips = self._skips()
        reach: dict[int, dict[int, int]] = {}
        for start in range(len(self._tokens), -1, -1):
            cheapest = {start: 0}
            for end, cost in skips.get(start, ()):
                for further, more in reach[end].items():
                    cheapest[further] = min(cheapest.get(further, 99), cost + more)
            reach[start] = cheapest
        found = []
        for entry in entries:
            for end, cost in reach[entry.end].items():
                bits = (1 << end) - (1 << entry.end)
                found.append(replace(entry, end=end, cost=entry.cost + cost, skipped=bits) if bits else entry)
        lead = {end: cost for end, cost in reach[0].items() if end}
        found += [
            replace(
                entry, start=0, cost=entry.cost + lead[entry.start], skipped=entry.skipped | ((1 << entry.start) - 1)
            )
            for entry in found
            if entry.start in lead
        ]
        return found
