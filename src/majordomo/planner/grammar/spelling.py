"""Typing mistakes: a long word that is spelled almost like exactly one word of the graph is taken for it."""

from __future__ import annotations

from collections.abc import Iterable

MIN_LETTERS = 5
MIN_REPLACED = 7
"""A replaced letter makes another word more often than a lost one does."""
MIN_TWICE = 8


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
