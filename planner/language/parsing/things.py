"""What things are for, like and made of, as the lexicon tells: which of those here is *something to cut with*."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache
from math import log

from planner.language.lexicon.vocabulary import normal, singular, words_for
from planner.language.parsing.words import blocks, phrases

ENOUGH = 0.45
"""The share of a purpose, by the weight of its words, that has to be told of a thing. Chosen."""
NEARLY = 0.8
"""Things that fit so nearly as well as the best are meant as well. Chosen."""
WEIGHTS = {"for": 1.0, "is": 0.9, "like": 0.7, "of": 0.5, "has": 0.5, "also": 0.9}
"""How much each kind of knowledge counts: what a thing is for tells most."""


@dataclass(frozen=True, kw_only=True)
class Thing:
    """What the lexicon knows of a kind of thing: stems of words with how much they tell of it."""

    label: str
    told: Mapping[str, float] = field(default_factory=dict)


@cache
def empty_words() -> frozenset[str]:
    """Words of a purpose that tell nothing of it."""
    return frozenset(phrases("purposes"))


def stem(word: str) -> str:
    """A word without the endings of English: *cutting*, *cuts* and *cut* are the same."""
    word = singular(word)
    for ending, least in (("ing", 3), ("ed", 3), ("er", 4), ("es", 3), ("e", 3), ("ly", 4)):
        if word.endswith(ending) and len(word) - len(ending) >= least:
            word = word[: -len(ending)]
            break
    return word[:-1] if len(word) > 3 and word[-1] == word[-2] else word


def stems(text: str) -> list[str]:
    """The stems of the words of ``text`` that tell something."""
    words = (word.strip(".,;:!?'\"") for word in text.casefold().replace("-", " ").split())
    return [stem(word) for word in words if word and word not in empty_words()]


class Knowledge:
    """All that the lexicon knows of things."""

    def __init__(self) -> None:
        self._things: dict[str, Thing] = {}
        for label, lines in blocks("things"):
            told: dict[str, float] = {}
            for text, weight in [(label, 0.9), *((v, WEIGHTS.get(key, 0.0)) for key, values in lines for v in values)]:
                for word in stems(text):
                    told[word] = max(told.get(word, 0.0), weight)
            self._things[label] = Thing(label=label, told=told)
        every = Counter(word for thing in self._things.values() for word in thing.told)
        count = len(self._things) or 1
        self._weight = {word: log(count / number) for word, number in every.items()}
        self._unknown = log(count) if count > 1 else 1.0
        self._also = {
            name: label for label, lines in blocks("things") for key, v in lines if key == "also" for name in v
        }

    def thing(self, label: str) -> Thing | None:
        """What is known of a label of the graph, by any of its names or its last word."""
        base = normal(label)
        for name in (base, singular(base), *sorted(words_for(base)), base.rpartition(" ")[2]):
            found = self._things.get(name) or self._things.get(self._also.get(name, ""))
            if found is not None:
                return found
        return None

    def fit(self, label: str, purpose: str) -> float:
        """How much of ``purpose`` is told of what is called ``label``: 0 to 1."""
        thing, wanted = self.thing(label), stems(purpose)
        if thing is None or not wanted:
            return 0.0
        weights = {word: self._weight.get(word, self._unknown) for word in wanted}
        return sum(thing.told.get(word, 0.0) * weight for word, weight in weights.items()) / sum(weights.values())

    def meant(self, labels: Iterable[str], purpose: str) -> frozenset[str]:
        """Those of ``labels`` that fit ``purpose`` best; none where none fits well enough."""
        fits = {label: self.fit(label, purpose) for label in set(labels)}
        best = max(fits.values(), default=0.0)
        return frozenset(label for label, fit in fits.items() if best >= ENOUGH and fit >= NEARLY * best)


@cache
def knowledge() -> Knowledge:
    """What the lexicon knows, read once."""
    return Knowledge()
