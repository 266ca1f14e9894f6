"""What a question is about on the graph, and whether what it asks is so."""

from __future__ import annotations

from collections.abc import Sequence

from planner.grounding.context import Context, Grounded, NoReferent
from planner.grounding.grounding import Grounding
from planner.grounding.matching import nodes_of
from planner.grounding.openness import about_openness, undecided, without_openness
from planner.language.grammar.syntax import Ask, NounPhrase, Quantity, Reference, Restriction
from planner.language.lexicon.vocabulary import is_plural
from planner.plan import QueryKind
from scene_graph.nodes import ObjectNode, PersonNode


class Subjects:
    """Finds what questions are about on one graph."""

    def __init__(self, grounding: Grounding) -> None:
        self._grounding = grounding
        self._snapshot, self._state = grounding.snapshot, grounding.state

    def found(self, ask: Ask, context: Context) -> Grounded:
        """Everything the question is about, present or missing."""
        found: dict[str, None] = {}
        for reference in ask.things or (None,):
            here = self.candidates(reference, context)
            if not isinstance(here, tuple):
                return here
            if ask.place is not None:
                lost = self._unknown_place(ask.place, context)
                if lost is not None:
                    return lost
                here = tuple(self._grounding.narrowing.restricted(here, ask.place, context))
            found.update(dict.fromkeys(here))
        return tuple(found)

    def candidates(self, reference: Reference | None, context: Context) -> Grounded:
        """Everything a reference may mean; of none, and of *anything*, all things and persons."""
        if isinstance(reference, NounPhrase) and reference.words == ("anything",):
            reference = None
        if reference is None:
            return tuple(node.id for node in nodes_of(self._snapshot) if isinstance(node, ObjectNode | PersonNode))
        if isinstance(reference, NounPhrase):
            return self._grounding.matches(reference, context, fixed=True)
        return self._grounding.things(reference, context)

    def targets(self, ask: Ask, context: Context) -> tuple[str, ...]:
        """The places that a question names."""
        return self._grounding.targets(ask.place, context) if ask.place is not None else ()

    def undecided(self, ask: Ask, context: Context) -> tuple[str, ...]:
        """The doors and rooms that a question about openness cannot tell."""
        if not about_openness(ask):
            return ()
        wanted = ask.things[0] if ask.things else None
        every = self.candidates(without_openness(wanted) if isinstance(wanted, NounPhrase) else wanted, context)
        return undecided(every, self._snapshot) if isinstance(every, tuple) else ()

    def holds(self, ask: Ask, found: Sequence[str], context: Context) -> bool | None:
        """Whether it is so; None if that depends on doors that nobody has seen lately."""
        if ask.kind not in (QueryKind.EXISTS, QueryKind.HOLDING):
            return None
        number = len([i for i in found if i not in self._state.missing])
        at_most = number + len(self.undecided(ask, context))
        so = {self._is_enough(ask, count, context) for count in (number, at_most)}
        return None if len(so) > 1 else so.pop() != ask.negated

    def _is_enough(self, ask: Ask, number: int, context: Context) -> bool:
        """Whether ``number`` things are as many as the question speaks of."""
        enough = (1 if ask.most is None else 0) if ask.least is None else ask.least
        wanted = ask.things[0] if ask.things else None
        if isinstance(wanted, NounPhrase) and wanted.quantity is Quantity.SOME:
            enough = wanted.count or enough
        if ask.place is not None and speaks_of_all(wanted):
            every = self.candidates(wanted, context)
            enough = len(every) if isinstance(every, tuple) else enough
        return number >= enough and (ask.most is None or number <= ask.most)

    def _unknown_place(self, place: Restriction, context: Context) -> NoReferent | None:
        if isinstance(place.reference, NounPhrase) and self._grounding.narrowing.is_everywhere(place.reference):
            return None
        if place.reference is None or self._grounding.targets(place, context):
            return None
        if isinstance(place.reference, NounPhrase):
            return self._grounding.nothing(place.reference, context)
        return NoReferent(reason="I do not know which place you mean.")


def speaks_of_all(reference: Reference | None) -> bool:
    """*All cups*, *both doors*, *the cups*."""
    if not isinstance(reference, NounPhrase):
        return False
    several = is_plural(reference.words[-1]) if reference.words else False
    return reference.quantity in (Quantity.ALL, Quantity.BOTH) or (reference.quantity is Quantity.THE and several)
