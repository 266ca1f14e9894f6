"""What agrees with what in a noun phrase: number, articles, and the same thing said twice."""

from __future__ import annotations

from dataclasses import replace

from planner.language.grammar.syntax import NounPhrase, Quantity, Reference
from planner.language.lexicon.vocabulary import is_plural, singular

_KINDS_IN_MASS = frozenset({"fruit", "food", "cutlery", "stationery", "crockery", "silverware", "clothing"})
_MASSES = _KINDS_IN_MASS | {"laundry", "medicine"}


def generic(reference: Reference) -> Reference:
    """*Cups go in the sink*, *medicine belongs in the cabinet*: said of the kind, it is meant for all of it."""
    if not isinstance(reference, NounPhrase) or not reference.words or reference.number is not None:
        return reference
    mass = reference.words[-1] in _MASSES and reference.quantity is Quantity.THE
    bare = reference.quantity is Quantity.BARE and (is_plural(reference.head) or reference.words[-1] in _MASSES)
    return replace(reference, quantity=Quantity.ALL) if mass or bare else reference


def is_collective(phrase: NounPhrase) -> bool:
    """*The fruit from the bowl*, *the keys on the desk*: all of it, though it is no plural in form."""
    told = any(each.relation in _PLACED for each in phrase.restrictions)
    definite = phrase.quantity is Quantity.THE and phrase.superlative is None and phrase.rank is None
    return definite and ((told and bool(_KINDS_IN_MASS & {*phrase.words[-1:]})) or phrase.words[-1:] in _EITHER_NUMBER)


_PLACED = frozenset({"in", "on", "from", "at", "off", "out of", "near"})
_EITHER_NUMBER = (("keys",), ("chips",), ("dishes",))
"""Plurals that are said of one thing as well."""


def is_definite(reference: Reference) -> bool:
    """*My medicine*, *the cups*: certain ones."""
    return isinstance(reference, NounPhrase) and reference.quantity is Quantity.THE


def may_follow(first: Reference, second: Reference) -> bool:
    """Whether *X, Y* without *and* may be a list: not *the nearest ball, any ball*, nor *cups in the sink, plates*."""
    if not isinstance(first, NounPhrase) or not isinstance(second, NounPhrase) or second.words in _ONE:
        return True
    return not first.restrictions and singular(first.head) != singular(second.head)


_ONE = (("one",), ("ones",))


def may_except(phrase: NounPhrase) -> bool:
    """Whether something can be left out of it: of *all cups* or *any cup*, not of *the box*."""
    several = phrase.quantity not in (Quantity.THE, Quantity.THIS, Quantity.BARE)
    return not phrase.exceptions or several or is_plural(phrase.words[-1])


def apposed(first: Reference, second: Reference) -> tuple[Reference, ...]:
    """*The cup, the red one*: one thing, said twice."""
    if not isinstance(first, NounPhrase) or not isinstance(second, NounPhrase) or second.words not in _ONE:
        return (first, second)
    if (is_plural(first.words[-1]) if first.words else False) and second.words == ("one",):
        return (first, second)
    superlative, rank = second.superlative or first.superlative, second.rank or first.rank
    colors, sizes = (*first.colors, *second.colors), (*first.sizes, *second.sizes)
    restrictions = (*first.restrictions, *second.restrictions)
    return (replace(first, colors=colors, sizes=sizes, restrictions=restrictions, superlative=superlative, rank=rank),)


def _is_several(reference: Reference | None) -> bool:
    return isinstance(reference, NounPhrase) and bool(reference.words) and is_plural(reference.words[-1])


def is_sensible(phrase: NounPhrase) -> bool:
    """Whether number and noun agree: *both the cup* is not English, so such a reading is dropped."""
    if not phrase.words:
        return False
    if phrase.other and phrase.rank is not None:
        return False
    if phrase.quantity in (Quantity.BOTH, Quantity.EXACTLY) and (phrase.count or 0) > 1:
        return singular(phrase.words[-1]) != phrase.words[-1] or phrase.words[-1] in ("ones", "people")
    if phrase.words == ("one",):
        return not any(each.relation == "of" and _is_several(each.reference) for each in phrase.restrictions)
    return True
