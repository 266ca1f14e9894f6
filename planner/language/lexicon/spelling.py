"""Typing mistakes: a long word that is spelled almost like exactly one word of the graph is taken for it."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

MIN_LETTERS = 5
MIN_REPLACED = 7
"""A replaced letter makes another word more often than a lost one does."""
MIN_TWICE = 8


ORDINARY = frozenset(
    {"acre", "angel", "ate", "badger", "bandana", "bare", "bat", "battle", "bean", "beard", "bears", "been", "beer",
     "beers", "being", "bell", "bells", "best", "bill", "bills", "boat", "bond", "bone", "book", "boot", "bored",
     "brain", "bread", "break", "bride", "bull", "bulls", "bunch", "cap", "cape", "card", "care", "cart", "cartoon",
     "cartoons", "cat", "chops", "coat", "cold", "collar", "collars", "cone", "cook", "cord", "dairy", "dart", "dear",
     "diary", "dill", "discs", "disk", "disks", "done", "drain", "dull", "earth", "east", "eat", "eats", "felt",
     "fine", "flour", "fond", "food", "foot", "form", "forms", "gallery", "gap", "goat", "gone", "good", "grain",
     "hat", "hate", "hated", "hates", "heart", "hood", "hook", "hummer", "juicer", "lame", "lap", "late", "latter",
     "least", "left", "line", "listen", "litter", "look", "loop", "lots", "male", "map", "mat", "meal", "mine",
     "mint", "mints", "moat", "moose", "nap", "nest", "night", "nine", "nook", "pain", "part", "party", "pasta",
     "paste", "peer", "pets", "phone", "phoney", "pine", "plain", "plan", "plane", "platter", "platters", "play",
     "pond", "pool", "post", "pots", "pray", "pride", "quiet", "quite", "race", "rain", "rat", "read", "rest",
     "robed", "rook", "root", "rose", "sacred", "sale", "sauce", "sauces", "save", "scanner", "scared", "seal",
     "seat", "shop", "shops", "sign", "silent", "slate", "slot", "soda", "song", "sore", "soup", "soups", "speak",
     "spinner", "spot", "stale", "staple", "staples", "stature", "statute", "steak", "steal", "step", "stone",
     "tablet", "tablets", "tale", "tales", "tap", "tape", "taste", "tea", "teas", "test", "thing", "tone", "took",
     "tops", "trail", "train", "tray", "trial", "trowel", "trowels", "united", "vase", "vest", "waste", "west",
     "wine", "wood", "zone"},
)  # fmt: skip
"""English words that are nobody's slip of another word, though letters or sounds would allow it."""
_HARD_C = re.compile(r"c(?![eihky])")
_SPELLINGS = (
    ("ph", "f"),
    ("sh", "ch"),
    ("sc", "s"),
    ("ck", "k"),
    ("z", "s"),
    ("gh", "g"),
    ("wh", "w"),
    ("qu", "kw"),
    ("y", "i"),
)


@lru_cache(maxsize=8192)
def sound(word: str) -> str:
    """Roughly how a word sounds: *sizzors* and *scissors*, *farmacy* and *pharmacy* are the same."""
    word = _HARD_C.sub("k", word)
    for spelled, heard in _SPELLINGS:
        word = word.replace(spelled, heard)
    return "".join(letter for index, letter in enumerate(word) if index == 0 or letter != word[index - 1])


def sounding_alike(words: Iterable[str]) -> dict[str, frozenset[str]]:
    """Words by their ``sound``."""
    found: dict[str, frozenset[str]] = {}
    for word in words:
        found[sound(word)] = found.get(sound(word), frozenset()) | {word}
    return found


def other_vowel(word: str, words: Iterable[str]) -> str | None:
    """*Docter*, *tabel*: the one of ``words`` with the same consonants and one other vowel; None of several."""
    if len(word) < MIN_LETTERS - 1 or not word.isalpha():
        return None
    bare = _VOWELS.sub("_", word)
    found = {
        other
        for other in words
        if len(other) == len(word)
        and other != word
        and _VOWELS.sub("_", other) == bare
        and sum(a != b for a, b in zip(word, other, strict=True)) == 1
    }
    return min(found) if len(found) == 1 else None


def without_vowels(word: str, words: Iterable[str]) -> str | None:
    """*Frm*, *kitchn*: the one of ``words`` that is ``word`` with vowels put back in; None of several."""
    bare = _VOWELS.sub("", word)
    if len(word) < 3 or len(bare) < 2 or (len(word) == 3 and bare != word):
        return None
    found = {
        other
        for other in words
        if other[:1] == word[:1]
        and len(word) < len(other) <= len(word) + 3
        and _VOWELS.sub("", other) == bare
        and _is_within(word, other)
    }
    return min(found) if len(found) == 1 else None


_VOWELS = re.compile(r"(?<=.)[aeiou]")


def _is_within(word: str, other: str) -> bool:
    letters = iter(other)
    return all(letter in letters for letter in word)


_ROWS = ("qwertyuiop", "asdfghjkl", "zxcvbnm")
_PLACE = {key: (column + 0.5 * row, row) for row, keys in enumerate(_ROWS) for column, key in enumerate(keys)}


def beside_keys(word: str, words: Iterable[str]) -> str | None:
    """The one of ``words`` that ``word`` is with one key beside the right one, hit twice or not at all; None of "
    "several.
    """
    if len(word) < 3 or word in ORDINARY or not word.isalpha():
        return None
    found = {other for other in words if _is_beside(word, other) or _is_doubled(word, other) or _lacks(word, other)}
    return min(found) if len(found) == 1 else None


def _is_beside(word: str, other: str) -> bool:
    wrong = [(a, b) for a, b in zip(word, other, strict=False) if a != b]
    if len(word) != len(other) or len(wrong) != 1:
        return False
    (x, row), (to_x, to_row) = (_PLACE.get(key, (99.0, 99)) for key in wrong[0])
    return abs(x - to_x) <= 1.0 and abs(row - to_row) <= 1


def _lacks(word: str, other: str) -> bool:
    """*ther* for *there*: a letter of a longer word, not its first, is lost."""
    long = len(other) == len(word) + 1 and len(other) > 4
    return long and any(other[:k] + other[k + 1 :] == word for k in range(1, len(other)))


def _is_doubled(word: str, other: str) -> bool:
    return any(word[k] == word[k - 1] and word[:k] + word[k + 1 :] == other for k in range(1, len(word)))


def is_swapped(word: str, other: str) -> bool:
    """Whether one letter has moved: *teh*, *pare* for *pear*."""
    moved = (word[:k] + word[k + 1 :] for k in range(1, len(word)))
    return any(rest == other[:k] + other[k + 1 :] for rest in moved for k in range(1, len(other)))


def closest(word: str, words: Iterable[str]) -> str | None:
    """The one of ``words`` that ``word`` was meant to be; None when there is none or more than one."""
    if len(word) < MIN_LETTERS or not word.isalpha():
        return None
    found = {other for other in words if other[:1] == word[:1] and _is_slip(word, other)}
    stems = {other.removesuffix("s") for other in found}
    return min(found, key=lambda other: (abs(len(other) - len(word)), other)) if len(stems) == 1 else None


def _is_slip(word: str, other: str) -> bool:
    if len(other) < MIN_LETTERS - 1 or abs(len(word) - len(other)) > 2 or word == other:
        return False
    distance, replaced = _distance(word, other)
    if distance == 1:
        return not replaced or len(word) >= MIN_REPLACED
    return distance == 2 and min(len(word), len(other)) >= MIN_TWICE


def _distance(one: str, other: str) -> tuple[int, bool]:
    """Letters lost, added, replaced or swapped with their neighbor; whether the words are of one length otherwise."""
    table = [[i + j if i * j == 0 else 0 for j in range(len(other) + 1)] for i in range(len(one) + 1)]
    for i in range(1, len(one) + 1):
        for j in range(1, len(other) + 1):
            same = one[i - 1] == other[j - 1]
            table[i][j] = min(table[i - 1][j] + 1, table[i][j - 1] + 1, table[i - 1][j - 1] + (not same))
            if i > 1 and j > 1 and one[i - 1] == other[j - 2] and one[i - 2] == other[j - 1]:
                table[i][j] = min(table[i][j], table[i - 2][j - 2] + 1)
    return table[-1][-1], len(one) == len(other) and sorted(one) != sorted(other)
