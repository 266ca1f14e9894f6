"""Words with a meaning of their own: closed-class phrases, and the nouns and names of the live graph."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from planner.language.lexicon.spelling import (
    ORDINARY,
    beside_keys,
    closest,
    is_swapped,
    other_vowel,
    sound,
    sounding_alike,
    without_vowels,
)
from planner.language.lexicon.vocabulary import COLORS, known_nouns, normal, singular
from planner.language.lexicon.words import phrase_table

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
_LONG = frozenset(word for word in KNOWN_WORDS | COLORS.keys() if len(word) > 3)
_TITLES = {"dr": "doctor", "doc": "doctor", "mr": "mister", "mrs": "missus", "prof": "professor", "sr": "sister"}
"""Titles as they are written short."""
_SHORT = frozenset(word for word in PHRASE_WORDS if len(word) < 4)
_SOUNDS = sounding_alike(word for word in PHRASE_WORDS | KNOWN_WORDS if len(word) > 2)
_SMALL = frozenset(
    {"the", "to", "in", "on", "me", "my", "from", "with", "and", "for", "where", "what", "which", "who", "how", "put",
     "bring", "take", "get", "give", "go", "can", "could", "you", "please", "is", "are", "many", "it", "of", "at",
     "into", "them", "this", "that", "here", "there", "back", "over", "next", "need", "want", "find", "come", "move"}
)  # fmt: skip
"""Small words, which are often typed a key beside."""
_UNDERSTOOD = KNOWN_WORDS | PHRASE_WORDS | ORDINARY


@dataclass(frozen=True)
class Lexicon:
    """Names of the live graph as tuples of words: nouns (labels, taught names, rooms) and persons.

    ``parts``: the words of all of them. ``last``: the last words of nouns of several. ``verbs``: what
    the skills of installed packages are for. ``colors``: those of things here.
    """

    nouns: frozenset[tuple[str, ...]] = frozenset()
    persons: frozenset[tuple[str, ...]] = frozenset()
    longest: int = field(default=4)
    parts: frozenset[str] = frozenset()
    last: frozenset[str] = frozenset()
    verbs: frozenset[str] = frozenset()
    colors: frozenset[str] = frozenset()

    @classmethod
    def of(
        cls,
        nouns: Iterable[str],
        persons: Iterable[str] = (),
        verbs: Iterable[str] = (),
        colors: Iterable[str] = (),
    ) -> Lexicon:
        """From labels and names as they stand in the graph, and verbs for skills of installed packages."""
        split = frozenset(tuple(normal(noun).split()) for noun in nouns if normal(noun))
        people = frozenset(tuple(normal(person).split()) for person in persons if normal(person))
        longest = max((len(words) for words in split | people | KNOWN), default=1)
        parts = frozenset(part for words in split | people for part in words)
        return cls(
            nouns=split,
            persons=people,
            longest=longest,
            parts=parts,
            last=frozenset(noun[-1] for noun in split if len(noun) > 1),
            verbs=frozenset(verbs),
            colors=frozenset(colors),
        )

    def person(self, words: tuple[str, ...]) -> str:
        """The whole name of the person called so: by it, or by a part that is nobody else's and no other word."""
        if words in self.persons:
            return " ".join(words)
        if len(words) != 1 or words in PHRASES or self.is_noun(words):
            return ""
        found = [name for name in self.persons if len(name) > 1 and words[0] in name]
        return " ".join(found[0]) if len(found) == 1 else ""

    def meant(self, word: str) -> str:
        """``word``, or the one name of the graph that it is a slip of."""
        if _TITLES.get(word, "") in self.parts and word not in self.parts:
            return _TITLES[word]
        if (
            word in _UNDERSTOOD
            or word in self.colors
            or self.is_noun((word,))
            or word in self.parts
            or singular(word) in self.parts
        ):
            return word
        alike_letters = _SWAPPED.get((word[:1], "".join(sorted(word))), ()) if len(word) > 2 else ()
        swapped = [other for other in (*alike_letters, *self._short_parts(word)) if is_swapped(word, other)]
        if len(swapped) == 1:
            return swapped[0]
        alike = _SOUNDS.get(sound(word), frozenset()) | {part for part in self.parts if sound(part) == sound(word)}
        if len(alike) == 1 and word.isalpha() and (len(word) > 3 or alike <= self.parts):
            return min(alike)
        return (
            closest(word, self.parts)
            or other_vowel(word, self.parts | _LONG)
            or closest(word, _LONG)
            or without_vowels(word, PHRASE_WORDS | self.parts)
            or word
        )

    def _short_parts(self, word: str) -> tuple[str, ...]:
        """Names of three letters with the letters of ``word``: *cpu* for *cup*."""
        return tuple(
            part for part in self.parts if len(part) == 3 and part[0] == word[0] and sorted(part) == sorted(word)
        )

    def small(self, word: str) -> str:
        """*fron*, *witj*: the small word that an unknown one is by a key next to the right one."""
        known = word in _UNDERSTOOD or word in self.colors or self.is_noun((word,)) or word in self.parts
        return word if known or word in COLORS else beside_keys(word, _SMALL) or word

    def respaced(self, one: str, other: str) -> tuple[str, str]:
        """Two words with the space between them a letter to the left or right, if only that makes both known."""
        if self._knows(one) and self._knows(other):
            return one, other
        if self._knows(one) and other[:1] == one[-1:] and self._knows(other[1:]) and len(other) > 3:
            return one, other[1:]  # *the eyogurt*, of *th eyogurt*
        found = []
        if not self._knows(one) and (not self._knows(other) or one[-1:] + other in _SMALL):
            found.append((one[:-1], one[-1:] + other))
        if not self._knows(other) and (not self._knows(one) or one + other[:1] in _SMALL):
            found.append((one + other[:1], other[1:]))
        known = [pair for pair in found if all(map(self._knows, pair))]
        return known[0] if len(known) == 1 else (one, other)

    def _knows(self, word: str) -> bool:
        known = word in PHRASE_WORDS | KNOWN_WORDS or word in COLORS or self.is_noun((word,))
        known = known or word in self.parts or singular(word) in self.parts | KNOWN_WORDS
        return known and (len(word) > 1 or word in ("a", "i"))

    def joined(self, one: str, other: str) -> str:
        """*Hair brush* as *hairbrush*: two words typed apart that only together name something; else empty."""
        whole = one + other
        known = self.is_noun((whole,)) or whole in self.parts
        apart = self.is_noun((one, other)) or not known or one in _SHORT
        return "" if apart else whole

    def parted(self, word: str) -> tuple[str, ...]:
        """*Thegreen* as *the green*: an article typed together with a word that is known, or two words of one name."""
        rest = word.removeprefix("the")
        known = rest in _UNDERSTOOD or rest in COLORS or self.is_noun((rest,)) if len(rest) > 2 else False
        new = word not in _UNDERSTOOD and not self.is_noun((word,)) and word not in self.parts
        if rest != word and known and new:
            return ("the", rest)
        return self._compound(word) if new and word not in COLORS and len(word) > 5 else (word,)

    def _compound(self, word: str) -> tuple[str, ...]:
        """*Toycar* as *toy car*: a name of two words that was typed as one."""
        halves = ((word[:cut], word[cut:]) for cut in range(3, len(word) - 2))
        return next((pair for pair in halves if self.is_noun(pair)), (word,))

    def can_own(self, words: tuple[str, ...]) -> bool:
        """Whether *'s* may follow: the name of a person, of a thing or room, or the last word of a room's name."""
        last = len(words) == 1 and words[0] in self.last
        return last or words in self.persons or self.is_noun(words) or words[1:] == ("room",)

    def is_noun(self, words: tuple[str, ...]) -> bool:
        """Whether ``words`` name something here or in the vocabulary, in the singular or plural; none names nothing."""
        if not words:
            return False
        one = (*words[:-1], singular(words[-1]))
        return words in self.nouns or one in self.nouns or words in KNOWN or one in KNOWN
