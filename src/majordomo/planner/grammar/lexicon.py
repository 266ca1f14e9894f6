"""Words with a meaning of their own: closed-class phrases, and the nouns and names of the live graph."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from majordomo.planner.grammar.spelling import closest
from majordomo.planner.grammar.words import phrase_table
from majordomo.planner.vocabulary import COLORS, known_nouns, normal, singular

PHRASES = phrase_table()
"""Closed-class phrases as words, with terminal and canonical form."""
PHRASE_WORDS = frozenset(word for words in PHRASES for word in words)
LONGEST = max(len(words) for words in PHRASES)
KNOWN = frozenset(tuple(normal(noun).split()) for noun in known_nouns())
KNOWN_WORDS = frozenset(word for words in KNOWN for word in words)


def _by_letters() -> dict[tuple[str, str], tuple[str, ...]]:
    """Words of four letters or more, and colors, by first letter and letters: two letters that change places."""
    found: dict[tuple[str, str], tuple[str, ...]] = {}
    for word in sorted(COLORS.keys() | {word for word in PHRASE_WORDS | KNOWN_WORDS if len(word) > 3}):
        key = (word[0], "".join(sorted(word)))
        found[key] = (*found.get(key, ()), word)
    return found


_SWAPPED = _by_letters()


@dataclass(frozen=True)
class Lexicon:
    """Names of the live graph as tuples of words: nouns (labels, taught names, rooms) and persons."""

    nouns: frozenset[tuple[str, ...]] = frozenset()
    persons: frozenset[tuple[str, ...]] = frozenset()
    longest: int = field(default=4)

    @classmethod
    def of(cls, nouns: Iterable[str], persons: Iterable[str] = ()) -> Lexicon:
        """From labels and names as they stand in the graph."""
        split = frozenset(tuple(normal(noun).split()) for noun in nouns if normal(noun))
        people = frozenset(tuple(normal(person).split()) for person in persons if normal(person))
        return cls(split, people, max((len(words) for words in split | people | KNOWN), default=1))

    def meant(self, word: str) -> str:
        """``word``, or the one name of the graph that it is a slip of."""
        if (word,) in PHRASES or self.is_noun((word,)) or word in KNOWN_WORDS | PHRASE_WORDS:
            return word
        swapped = _SWAPPED.get((word[:1], "".join(sorted(word))), ()) if len(word) > 2 else ()
        if len(swapped) == 1 and not self.is_person(word):
            return swapped[0]
        parts = {part for words in self.nouns | self.persons for part in words}
        return word if word in parts or singular(word) in parts else closest(word, parts) or word

    def is_person(self, word: str) -> bool:
        """Whether a word is part of somebody's name."""
        return any(word in person for person in self.persons)

    def can_own(self, words: tuple[str, ...]) -> bool:
        """Whether *'s* may follow: the name of a person, of a thing or room, or the last word of a room's name."""
        last = {noun[-1] for noun in self.nouns if len(noun) > 1} if len(words) == 1 else ()
        return words in self.persons or self.is_noun(words) or (words[0] in last) or words[1:] == ("room",)

    def is_noun(self, words: tuple[str, ...]) -> bool:
        """Whether ``words`` name something here or in the vocabulary, in the singular or plural."""
        one = (*words[:-1], singular(words[-1]))
        return words in self.nouns or one in self.nouns or words in KNOWN or one in KNOWN
