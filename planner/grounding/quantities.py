"""How many of the things that fit a phrase it means: *a cup*, *both cups*, *the cup*, *half of the cups*."""

from __future__ import annotations

from dataclasses import replace

from planner.grounding.context import Context, Grounded, NoReferent
from planner.grounding.phrasing import ambiguous, describe, phrase_text
from planner.grounding.places import Places
from planner.language.grammar.agreement import is_collective
from planner.language.grammar.syntax import NounPhrase, Quantity
from planner.language.lexicon.vocabulary import is_plural
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState


class Quantities:
    """Chooses among the matches of a phrase on one graph."""

    def __init__(self, snapshot: Snapshot, state: PlanState, places: Places) -> None:
        self._snapshot, self._state, self._places = snapshot, state, places

    def chosen(self, phrase: NounPhrase, found: tuple[str, ...], context: Context, avoid: frozenset[str]) -> Grounded:
        """Those of ``found`` that are meant; ``avoid``: not these, when any one will do."""
        if phrase.rank is not None and phrase.superlative is None:
            return self._ranked(phrase, found, context)
        if phrase == NounPhrase(words=("one",)) and context.noun:
            return self._any(phrase, found, avoid)
        match phrase.quantity:
            case Quantity.A if _by_use(phrase) and len({self._snapshot.node(i).label for i in found}) > 1:
                return self._one(phrase_text(phrase), found, context)  # a knife or scissors: which is asked
            case Quantity.A | Quantity.SOME:
                return self._any(phrase, found, avoid)
            case Quantity.ALL:
                return found
            case Quantity.BOTH | Quantity.EXACTLY:
                return self._count(phrase, found, context)
            case _ if (_plural(phrase) and phrase.quantity is not Quantity.BARE) or is_collective(phrase):
                return found
            case _:
                last = phrase.words == ("one",) and not context.fresh
                return self._one(phrase_text(phrase), found, replace(context, fresh=context.last) if last else context)

    def nearest(self, found: tuple[str, ...]) -> tuple[str, ...]:
        """The nearest of several that can be reached, as one; else the first."""
        return tuple(self._places.by_distance(found)[:1]) or found[:1]

    def _ranked(self, phrase: NounPhrase, found: tuple[str, ...], context: Context) -> Grounded:
        """*The second cup*: nobody said in which order, so it is asked, unless there are too few."""
        if len(found) >= (phrase.rank or 0):
            ask = "I know no order of them. Which one do you mean"
            return ambiguous(phrase_text(phrase), found, context, ask, self._snapshot)
        seen = "; ".join(describe(i, self._snapshot) for i in found)
        return NoReferent(reason=f"I know of only {len(found)}: {seen}.")

    def _one(self, text: str, found: tuple[str, ...], context: Context) -> Grounded:
        if len(found) > 1:
            spoken = tuple(i for i in found if i in context.fresh)
            focused = tuple(i for i in found if context.focus is not None and self._state.room_of(i) == context.focus)
            there = tuple(i for i in found if i not in self._state.missing)
            for preferred in (spoken, focused, there):
                if len(preferred) == 1:
                    return preferred
        return found if len(found) == 1 else ambiguous(text, found, context, "Which one do you mean", self._snapshot)

    def _any(self, phrase: NounPhrase, found: tuple[str, ...], avoid: frozenset[str]) -> Grounded:
        """The nearest of those that will do, unless there are too few."""
        wanted = phrase.count or 1
        if phrase.share:
            left = int(phrase.share.rpartition(" ")[2]) if phrase.share != "half" else len(found) / 2
            if left != int(left) or len(found) <= left:
                seen = "; ".join(describe(i, self._snapshot) for i in found[:4])
                return NoReferent(reason=f"I know of {len(found)}, which is not to be shared so: {seen}.", asks=True)
            wanted = len(found) - int(left)
        fit = [i for i in found if i not in avoid and i != self._state.holding and i not in self._state.missing]
        fit = self._places.by_distance(fit) or list(found)
        if len(fit) < wanted:
            seen = "; ".join(describe(i, self._snapshot) for i in found[:4])
            return NoReferent(reason=f"I know of only {len(fit)} that fit “{phrase_text(phrase)}”: {seen}.")
        return tuple(fit[:wanted])

    def _count(self, phrase: NounPhrase, found: tuple[str, ...], context: Context) -> Grounded:
        if len(found) == phrase.count:
            return found
        if len(found) > (phrase.count or 0):
            return ambiguous(
                phrase_text(phrase), found, context, f"I know of {len(found)}. Which do you mean", self._snapshot
            )
        seen = "; ".join(describe(i, self._snapshot) for i in found)
        return NoReferent(reason=f"I know of only {len(found)} that fits “{phrase_text(phrase)}”: {seen}.")


def _by_use(phrase: NounPhrase) -> bool:
    """*Something to cut with*."""
    return any(restriction.relation == "use" for restriction in phrase.restrictions)


def is_many(phrase: NounPhrase) -> bool:
    """Whether a phrase means several: *all cups*, *both*, *two cups*, *the cups*."""
    several = (Quantity.ALL, Quantity.BOTH, Quantity.SOME, Quantity.EXACTLY)
    return phrase.quantity in several or _plural(phrase)


def _plural(phrase: NounPhrase) -> bool:
    return bool(phrase.words) and (is_plural(phrase.words[-1]) or phrase.words[-1] == "ones")
