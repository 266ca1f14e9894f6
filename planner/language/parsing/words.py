"""The words of the language, read from its data files: what each may be, and which carry courtesy only."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib import resources

LANGUAGE = "planner.language.english"
MOVING = ("BRING", "GET", "TAKE", "CARRY", "MOVE", "RETURN", "GIVE", "PUT", "DROP", "PICK", "SUPPLY")
"""Verbs by which things are moved; their participles are ``MOVED``."""
CONTENT = ("PART", "STUFF", "PLACES", "MOVING", "BATTERY", "LOCATION", "FREE", "EMPTY", "CLEARED")
"""Classes of words that name things or properties as well."""
SHADES = ("light", "dark", "bright", "pale")
_CHOICE = re.compile(r"\([^()\[\]]*\)|\[[^()\[\]]*\]")
"""The innermost choice."""
_DOUBLING = frozenset("tgnp")


@dataclass(frozen=True, kw_only=True)
class Sense:
    """What some words are: a terminal and its canonical form."""

    terminal: str
    value: str


class Words:
    """Phrases with all their senses, and those that say nothing."""

    def __init__(self) -> None:
        """Reads the data files."""
        table: dict[tuple[str, ...], dict[Sense, None]] = {}
        for phrase, terminal, value in _senses():
            table.setdefault(tuple(phrase.split()), {})[Sense(terminal=terminal, value=value)] = None
        self.senses: Mapping[tuple[str, ...], tuple[Sense, ...]] = {key: tuple(found) for key, found in table.items()}
        self.courtesy = frozenset(tuple(phrase.split()) for phrase in phrases("courtesy"))
        self.contractions: Mapping[str, str] = {key: " ".join(value) for key, value in _entries("contractions")}
        self.closed = frozenset(
            phrase
            for terminal, listed in _entries("words")
            if terminal not in CONTENT
            for phrase in listed
            if " " not in phrase
        )
        self.longest = max(map(len, (*self.senses, *self.courtesy)))
        self.single = frozenset(word for phrase in (*self.senses, *self.courtesy) for word in phrase)


@cache
def english() -> Words:
    """The words of English."""
    return Words()


def _lines(name: str) -> Iterator[str]:
    """Lines of a data file, without comments, each with the indented lines that go on with it."""
    file = resources.files(LANGUAGE).joinpath(f"{name}.txt")
    text = file.read_text(encoding="utf-8") if file.is_file() else ""
    whole = ""
    for line in text.splitlines():
        if line.startswith("#") or not line.strip():
            continue
        if line.startswith(" "):
            whole += " " + line.strip()
            continue
        if whole:
            yield whole
        whole = line.strip()
    if whole:
        yield whole


def blocks(name: str) -> Iterator[tuple[str, list[tuple[str, list[str]]]]]:
    """Entries of a data file with an indented line for each kind of knowledge: label, then key and values."""
    file = resources.files(LANGUAGE).joinpath(f"{name}.txt")
    label, lines = "", list[tuple[str, list[str]]]()
    for line in file.read_text(encoding="utf-8").splitlines():
        if line.startswith("#") or not line.strip():
            continue
        if line.startswith(" "):
            key, _, values = line.strip().partition(":")
            lines.append((key, [value.strip() for value in values.split(",") if value.strip()]))
            continue
        if label:
            yield label, lines
        label, lines = line.strip(), []
    if label:
        yield label, lines


def phrases(name: str) -> Iterator[str]:
    """The phrases of a data file that has nothing else."""
    for line in _lines(name):
        for phrase in filter(None, map(str.strip, line.split(","))):
            yield from expanded(phrase)


def _entries(name: str) -> Iterator[tuple[str, list[str]]]:
    for line in _lines(name):
        key, _, phrases = line.partition(":")
        yield key.strip(), [each for phrase in phrases.split(",") if phrase.strip() for each in expanded(phrase)]


def _senses() -> Iterator[tuple[str, str, str]]:
    """Phrase, terminal, canonical form."""
    for terminal, listed in _entries("words"):
        for phrase in listed:
            yield phrase, terminal, phrase
    yield from _verbs()
    yield from _nouns_and_adjectives()


def _verbs() -> Iterator[tuple[str, str, str]]:
    forms = dict(_entries("forms"))
    for terminal, listed in _entries("verbs"):
        for phrase in listed:
            yield phrase, terminal, phrase
            yield gerund(phrase), terminal, phrase
            yield third_person(phrase), terminal, phrase
            for past in participles(phrase, forms):
                yield past, "MOVED" if terminal in MOVING else f"{terminal}_PAST", phrase


def _nouns_and_adjectives() -> Iterator[tuple[str, str, str]]:
    for color, listed in _entries("colors"):
        for phrase in listed:
            yield phrase, "ORANGE" if color == "orange" else "COLOR", color
            for shade in SHADES:
                yield f"{shade} {phrase}", "COLOR", color
    for phrase in phrases("roles"):
        yield phrase, "PERSON", phrase
        yield f"{phrase}s", "PERSON", phrase
    for _, listed in _entries("qualities"):
        for phrase in listed:
            yield phrase, "QUALITY", phrase
    for number, listed in _entries("numbers"):
        for phrase in listed:
            yield phrase, "NUMBER", number


def expanded(phrase: str) -> list[str]:
    """All phrases that one with *(a|b)* for either and *[a]* for what may be missing stands for."""
    match = _CHOICE.search(phrase)
    if match is None:
        return [" ".join(phrase.split())] if phrase.strip() else []
    choices = match[0][1:-1].split("|") + ([""] if match[0][0] == "[" else [])
    return [whole for choice in choices for whole in expanded(phrase[: match.start()] + choice + phrase[match.end() :])]


def gerund(verb: str) -> str:
    """*bring* becomes *bringing*, *take* becomes *taking*, *put* becomes *putting*; of a phrase, its first word."""
    first, space, rest = verb.partition(" ")
    if first.endswith("e") and not first.endswith("ee"):
        stem = first[:-1]
    elif (len(first) == 3 and first[-1] in _DOUBLING and first[1] in "aeiou") or first in ("drop", "swap", "grab"):
        stem = first + first[-1]
    else:
        stem = first
    return f"{stem}ing{space}{rest}"


def third_person(verb: str) -> str:
    """*bring* becomes *brings*, *go* becomes *goes*, *carry* becomes *carries*; of a phrase, its first word."""
    first, space, rest = verb.partition(" ")
    if first.endswith(("s", "sh", "ch", "x", "z", "o")):
        first += "es"
    elif first.endswith("y") and first[-2:-1] not in "aeiou":
        first = first[:-1] + "ies"
    else:
        first += "s"
    return f"{first}{space}{rest}"


def participles(verb: str, irregular: Mapping[str, list[str]]) -> list[str]:
    """*bring* becomes *brought*, *carry* becomes *carried*; of a phrase, its first word."""
    first, space, rest = verb.partition(" ")
    if first in irregular:
        found = irregular[first]
    elif first.endswith("e"):
        found = [first + "d"]
    elif first.endswith("y") and first[-2:-1] not in "aeiou":
        found = [first[:-1] + "ied"]
    else:
        found = [first + "ed"]
    return [f"{past}{space}{rest}" for past in found]
