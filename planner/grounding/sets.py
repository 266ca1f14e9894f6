"""Everything that several references mean together: *the cups and the bottle on the table*."""

from __future__ import annotations

from dataclasses import replace

from planner.grounding.context import Ambiguous, Context, Grounded, NoReferent
from planner.grounding.grounding import Grounding
from planner.language.grammar.syntax import NounPhrase, Quantity, Reference
from planner.language.lexicon.vocabulary import singular


class ReferenceSets:
    """Resolves lists of references on one graph."""

    def __init__(self, grounding: Grounding) -> None:
        self._grounding = grounding

    def to_carry(
        self, references: tuple[Reference, ...], context: Context, *, avoid: frozenset[str] = frozenset()
    ) -> Grounded:
        """As ``all_of``, but no question is asked about things that cannot be carried anyway."""
        found = self.all_of(references, context, avoid=avoid)
        if isinstance(found, Ambiguous) and found.candidates:
            things = [self._grounding.state.world.things.get(i) for i in found.candidates]
            if not any(thing is not None and thing.graspable for thing in things):
                return NoReferent(reason=f"I cannot carry “{found.phrase}”: it is too big for my hand, or no object.")
        return found

    def all_of(
        self, references: tuple[Reference, ...], context: Context, *, avoid: frozenset[str] = frozenset()
    ) -> Grounded:
        """Everything the references mean, each once. A last restriction may be meant for all of them."""
        references = _same_noun(_same_quantity(references))
        shared = _shared(references)
        if shared != references:
            found = self._each(shared, context, avoid)
            if isinstance(found, tuple):
                return found
        return self._each(references, context, avoid)

    def _each(self, references: tuple[Reference, ...], context: Context, avoid: frozenset[str]) -> Grounded:
        found: dict[str, None] = {}
        for reference in references:
            here = replace(context, noun=noun_of((reference,), context) or context.noun)
            one = self._grounding.things(reference, here, avoid=avoid | frozenset(found))
            if not isinstance(one, tuple):
                return one
            found.update(dict.fromkeys(one))
            context = replace(context, noun=noun_of((reference,), context) or context.noun)
        return tuple(found)


def _shared(references: tuple[Reference, ...]) -> tuple[Reference, ...]:
    """The references with the last one's restriction given to those before it that have none."""
    last = references[-1]
    if len(references) < 2 or not isinstance(last, NounPhrase) or not last.restrictions:
        return references
    return tuple(
        replace(r, restrictions=last.restrictions) if isinstance(r, NounPhrase) and not r.restrictions else r
        for r in references
    )


def _same_quantity(references: tuple[Reference, ...]) -> tuple[Reference, ...]:
    """*All the cups and bottles*: a bare noun takes the article of the one before it."""
    settled: list[Reference] = []
    for reference in references:
        before = settled[-1] if settled else None
        settled.append(_like(before, reference) if isinstance(before, NounPhrase) else reference)
    return tuple(settled)


def _same_noun(references: tuple[Reference, ...]) -> tuple[Reference, ...]:
    """*The red and the green cup*: what comes without a noun before one that has it."""
    last = references[-1]
    if not isinstance(last, NounPhrase) or last.head in ("one", "ones"):
        return references
    first = references[0]
    if not isinstance(first, NounPhrase) or first.words != ("one",):
        return references
    return tuple(
        replace(r, words=(singular(last.head),)) if isinstance(r, NounPhrase) and r.words == ("one",) else r
        for r in references
    )


def _like(before: NounPhrase, reference: Reference) -> Reference:
    if not isinstance(reference, NounPhrase) or reference.quantity is not Quantity.BARE:
        return reference
    shared = before.quantity in (Quantity.ALL, Quantity.THE)
    return replace(reference, quantity=before.quantity) if shared else reference


def noun_of(references: tuple[Reference, ...], context: Context) -> str:
    """The noun that *the red one* would stand for after these references."""
    heads = [r.head for r in references if isinstance(r, NounPhrase) and r.head not in ("one", "ones")]
    return heads[-1] if heads else context.noun
