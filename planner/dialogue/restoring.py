"""What *put it back where it was* means on a graph: what was moved goes to where it was before."""

from __future__ import annotations

from collections.abc import Callable

from planner.dialogue.interpretation import Meant
from planner.goals import Goal, Predicate
from planner.grounding.grounding import Ambiguous, Context, Grounding, NoReferent
from planner.grounding.naming import name_of
from planner.grounding.plural_pronouns import moved
from planner.grounding.sets import Gathering, Trouble
from planner.language.grammar.syntax import Pronoun, PutBack, Reference


class Returning:
    """Gives ``PutBack`` its meaning; ``predicate`` says what putting something to a place means there."""

    def __init__(self, grounding: Grounding, gathering: Gathering, predicate: Callable[[str, str], Predicate]) -> None:
        self._snapshot, self._state = grounding.snapshot, grounding.state
        self._gathering, self._predicate = gathering, predicate

    def of(self, step: PutBack, context: Context) -> Meant | Trouble:
        """The things at the places that they were moved from."""
        things = _moved_last(step.things, context) or self._moved_before(
            self._gathering.to_carry(step.things, context), context
        )
        if not isinstance(things, tuple):
            return things
        unknown = next((i for i in things if i not in context.origins), None)
        if unknown is not None:
            name = name_of(unknown, self._snapshot)
            return NoReferent(reason=f"I do not remember that I moved {name}. Tell me where to put it.")
        places = tuple(context.origins[i] for i in things)
        goals = tuple(
            Goal(predicate=self._predicate("to", place), args=(i, place))
            for i, place in zip(things, places, strict=True)
        )
        return Meant(goals=goals, things=things, places=places)

    def among(
        self, places: Ambiguous, things: tuple[str, ...] | Trouble, context: Context
    ) -> tuple[str, ...] | Ambiguous:
        """*Back on the shelf*: of several shelves, the one that the things were on, or of several rooms, were in."""
        origins = {context.origins.get(i) for i in things} if isinstance(things, tuple) else set()
        rooms = {self._state.room_of(origin) for origin in origins if origin is not None}
        before = tuple(i for i in places.candidates if i in origins or i in rooms)
        return before if len(before) == 1 and None not in origins else places

    def _moved_before(self, found: tuple[str, ...] | Trouble, context: Context) -> tuple[str, ...] | Trouble:
        """Of several that are asked about, the one that was moved is what is put back."""
        if not isinstance(found, Ambiguous):
            return found
        moved = tuple(i for i in found.candidates if i in context.origins)
        return moved if len(moved) == 1 else found


def _moved_last(references: tuple[Reference, ...], context: Context) -> tuple[str, ...]:
    """*Put it back*: everything that the request before moved, if that was several things."""
    words = {r.word for r in references if isinstance(r, Pronoun)}
    if context.fresh or not context.earlier or len(words) != len(references) or words & {"both", "them", "all"}:
        return ()
    things = tuple(i for i in moved(context.earlier[0]) if i in context.origins)
    return things if len(things) > 1 else ()
