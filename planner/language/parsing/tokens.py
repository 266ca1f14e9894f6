"""From characters to tokens: words, numbers and marks with the place where they stand; nothing is dropped."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

_TOKEN = re.compile(
    r"""
    "(?P<quoted>[^"\n]{1,80})"                                  # a name in quotation marks is one noun
  | (?P<number>\d+(?:[.,]\d+)?(?![^\W\d_]|_)|\d+(?:[.,]\d+)?(?=(?:mm|cm|km|m|ft)\b))  # 2, 0.2, 20cm
  | (?P<word>[^\W_]+(?:[_'&\-][^\W_]+)*'?)                        # letters and digits, joined by _ ' -
  | (?P<stop>[.;!?…]+|\n+)
  | (?P<comma>[,:–—]|-+)
  | (?P<mark>\S)
    """,
    re.VERBOSE,
)
_QUOTES = str.maketrans({"’": "'", "‘": "'", "“": '"', "”": '"', "„": '"', "`": "'", "&": " and ", "+": " and "})
_UNSEEN = frozenset({"Cf", "Mn", "Me"})
"""Unicode's categories of what is not seen: zero-width characters, marks on letters that no composed letter has."""


@dataclass(frozen=True, kw_only=True)
class Token:
    """One token. ``kind``: word, number, quoted, comma, stop or mark. ``text``: in lower case, without accents that
    nobody sees. ``typed``: as it was written. ``capital``: it begins with a capital letter.
    """

    kind: str
    text: str
    typed: str
    capital: bool = False


def tokens_of(text: str, contractions: Mapping[str, str]) -> list[Token]:
    """The tokens of ``text`` in order; a contraction as the words that it stands for, the first of them as typed."""
    clean = "".join(
        char for char in unicodedata.normalize("NFKC", text) if unicodedata.category(char) not in _UNSEEN
    ).translate(_QUOTES)
    found: list[Token] = []
    for match in _TOKEN.finditer(clean):
        kind = match.lastgroup or "mark"
        typed = match.group(kind)
        words = typed.casefold().split()
        if kind == "word":
            words = [part for word in words for part in _expanded(word, contractions)]
        for index, word in enumerate(words or [typed]):
            shown = typed if index == 0 else ""
            found.append(Token(kind=kind, text=word, typed=shown, capital=typed[:1].isupper()))
        if kind == "quoted":
            found[-len(words) :] = [Token(kind=kind, text=" ".join(words), typed=typed, capital=True)]
    return found


def _expanded(word: str, contractions: Mapping[str, str]) -> list[str]:
    if word in contractions:
        return contractions[word].split()
    if word.endswith("n't") and len(word) > 4:
        return [word[:-3], "not"]
    return [word]


def sentences(tokens: Sequence[Token]) -> list[list[Token]]:
    """Tokens from one full stop to the next, the stops left out."""
    found: list[list[Token]] = [[]]
    for token in tokens:
        if token.kind == "stop":
            found.append([])
        else:
            found[-1].append(token)
    return [sentence for sentence in found if any(token.kind in ("word", "number", "quoted") for token in sentence)]


def typed(tokens: Sequence[Token]) -> str:
    """Tokens as they were written."""
    return " ".join(token.typed for token in tokens if token.typed).replace(" ,", ",")
