"""Requests in note form: *Hairbrush. Bathroom cabinet.* is a thing, and where it is to go."""

from __future__ import annotations

from collections.abc import Sequence

from planner.grounding.context import Context
from planner.grounding.grounding import Grounding
from planner.language.grammar.parser import ParsedStep, Understood
from planner.language.grammar.syntax import Carry, Destination, NounPhrase, Perhaps, Reference, Wanted


def spelled_out(steps: Sequence[ParsedStep], grounding: Grounding, context: Context) -> Sequence[ParsedStep]:
    """A thing and a place, each said alone, as one step that carries the thing there; other steps as they are."""
    if len(steps) != 2:
        return steps
    thing, place = (_alone(step) for step in steps)
    if thing is None or place is None:
        return steps
    if not _is_carried(thing, grounding, context) or _is_carried(place, grounding, context, any_of_them=True):
        return steps
    carry = Carry(things=(thing,), destination=Destination(relation="to", reference=place))
    text = " to ".join(step.text for step in steps)
    return [Understood(text=text, readings=(Perhaps(step=carry, verbless=True, sure=True),))]


def _alone(step: ParsedStep) -> Reference | None:
    """What a step without a verb names, if it can be read in one way only."""
    readings = step.readings if isinstance(step, Understood) else ()
    found = [reading.thing for reading in readings if isinstance(reading, Wanted)]
    return found[0] if len(found) == len(readings) == 1 else None


def _is_carried(reference: Reference, grounding: Grounding, context: Context, *, any_of_them: bool = False) -> bool:
    """Whether what is named can be carried: all of it, or some; what names nothing counts as carried in doubt."""
    if not isinstance(reference, NounPhrase):
        return any_of_them
    things = grounding.state.world.things
    found = [i in things and things[i].graspable for i in grounding.matches(reference, context)]
    return any(found) or not found if any_of_them else bool(found) and all(found)
