"""A question that goes on with another thing or place: *where is the cup? – and the book? – what about the kitchen?*"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from planner.language.grammar.syntax import Ask, NounPhrase, Restriction

_PLACED = re.compile(r"^(?P<relation>in|on|at|under|inside|next to) (?P<place>.+)$")


def place_asked(rest: str) -> tuple[str, str]:
    """The relation and the words for a place in *on the desk*; an empty relation of anything else."""
    found = _PLACED.match(rest)
    return (found["relation"], found["place"]) if found else ("", rest)


def continued(asked: Sequence[Ask], phrases: Sequence[NounPhrase], *, as_place: bool) -> tuple[Ask, ...]:
    """The questions ``asked`` with each of ``phrases`` for what they were about; none of those about nothing.

    ``as_place``: a phrase stands for the place; so it does where nothing but a place was asked about.
    """
    return tuple(
        again for ask in asked for phrase in phrases if (again := _with(ask, phrase, as_place=as_place)) is not None
    )


def _with(ask: Ask, phrase: NounPhrase, *, as_place: bool) -> Ask | None:
    place = ask.place
    if place is not None and place.reference is not None and (as_place or not ask.things):
        return replace(ask, place=replace(place, reference=phrase))
    thing = ask.things[0] if len(ask.things) == 1 else None
    if not isinstance(thing, NounPhrase):
        return None
    if as_place:
        kept = tuple(each for each in thing.restrictions if each.reference is None)
        here = Restriction(relation="at", reference=phrase)
        return replace(ask, things=(replace(thing, restrictions=(*kept, here)),))
    words = thing.words if phrase.words in (("one",), ("ones",)) else phrase.words
    return replace(ask, things=(replace(phrase, words=words),))
