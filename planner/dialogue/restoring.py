"""What *put it back where it was* means on a graph: what was moved goes to where it was before."""

from __future__ import annotations

from planner.dialogue.carrying import placing_predicate
from planner.dialogue.meaning import Meaning
from planner.goals import Goal
from planner.grounding.context import Ambiguous, Context, Grounded, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.pronouns import moved
from planner.grounding.sets import ReferenceSets
from planner.language.grammar.syntax import Pronoun, PutBack, Reference
from planner.naming import name_of


class Restoring:
    """Gives ``PutBack`` its meaning."""

    def __init__(self, grounding: Grounding, sets: ReferenceSets) -> None:
        self._grounding, self._snapshot, self._sets = grounding, grounding.snapshot, sets

    def of(self, step: PutBack, context: Context) -> Meaning | Trouble:
        """The things at the places that they were moved from."""
        things = _moved_last(step.things, context) or self._moved_before(
            self._sets.to_carry(step.things, context), context
        )
        if not isinstance(things, tuple):
            return things
        unknown = next((i for i in things if i not in context.origins), None)
        if unknown is not None:
            name = name_of(unknown, self._snapshot)
            return NoReferent(reason=f"I do not remember that I moved {name}. Tell me where to put it.")
        places = tuple(context.origins[i] for i in things)
        goals = tuple(
            Goal(predicate=placing_predicate("to", place, self._grounding), args=(i, place))
            for i, place in zip(things, places, strict=True)
        )
        return Meaning(goals=goals, things=things, places=places)

    def _moved_before(self, found: Grounded, context: Context) -> Grounded:
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
