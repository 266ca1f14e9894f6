"""*Left of the vase*, *between the knife and the fork*: what can be done of it is putting a thing down beside them."""

from __future__ import annotations

from dataclasses import replace

from planner.grounding.context import Ambiguous, Context, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.language.grammar.syntax import Destination, NounPhrase, Quantity
from planner.naming import at, name_of

SIDES = frozenset(
    {"between", "left of", "right of", "to the left of", "to the right of", "on the left of", "on the right of",
     "on the left side of", "on the right side of", "to the left side of", "to the right side of", "behind",
     "in front of", "opposite", "across from", "facing", "against"}
)  # fmt: skip
"""Relations of which only *beside* can be done: the arm puts things down where there is room."""


def beside(destination: Destination, grounding: Grounding, context: Context) -> tuple[Destination, str] | Trouble:
    """What a thing beside others is put on, and what has to be said of it; beside furniture there is nothing."""
    places: list[str] = []
    for reference in (destination.reference, destination.other):
        if reference is None:
            continue
        found = grounding.place(reference, context)
        if not isinstance(found, tuple):
            return found
        if len(found) > 1:
            return Ambiguous(question="Which one of them do you mean?", phrase="", candidates=found)
        places += found
    snapshot = grounding.snapshot
    supports = {snapshot.support_of(place) for place in places}
    names = " and ".join(name_of(place, snapshot) for place in places)
    if len(supports) > 1:
        return NoReferent(reason=f"I cannot put anything {destination.relation} {names}: they stand apart.")
    (support,) = supports
    if support is None:
        return NoReferent(reason=f"I can put things on, in or next to {names}, not “{destination.relation}” it.")
    told = f"I put it {at(support, snapshot)}, beside {names}; I do not choose the side."
    phrase = NounPhrase(words=(support,), quantity=Quantity.THE)
    return replace(destination, relation="to", reference=phrase, other=None), told
