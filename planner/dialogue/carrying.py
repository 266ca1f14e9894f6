"""What *put the cup on the table* and *bring it to Ben* mean on a graph."""

from __future__ import annotations

from dataclasses import replace

from planner.dialogue.meaning import Meaning
from planner.dialogue.settings import DialogueSettings
from planner.goals import Goal, Predicate, holds
from planner.grounding.context import Ambiguous, Context, Grounded, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.sets import ReferenceSets, noun_of
from planner.grounding.sides import SIDES, beside
from planner.language.grammar.syntax import Carry, Destination, NounPhrase, Pronoun, Reference
from planner.language.lexicon.vocabulary import OPEN_AIR
from planner.naming import name_of
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode
from skills.room_contents import in_room

SHELF_LIKE = frozenset({"shelf", "bookshelf", "bookcase", "cabinet", "rack", "shelves", "cupboard"})
"""Labels of supports that things are put *in* as well as *on*, in a person's words."""


class Carrying:
    """Gives ``Carry`` its meaning on one graph."""

    def __init__(self, grounding: Grounding, sets: ReferenceSets, settings: DialogueSettings) -> None:
        self._grounding, self._sets, self._settings = grounding, sets, settings
        self._snapshot, self._state = grounding.snapshot, grounding.state

    def of(self, step: Carry, context: Context) -> Meaning | Trouble:
        """The things at the place."""
        if step.destination is not None and step.destination.relation in SIDES:
            sided = beside(step.destination, self._grounding, context)
            if not isinstance(sided, tuple):
                return sided
            outcome = self.of(replace(step, destination=sided[0]), context)
            return replace(outcome, answer=sided[1]) if isinstance(outcome, Meaning) else outcome
        if step.destination is not None and step.destination.relation not in ("to", "in", "on", "near"):
            relation = step.destination.relation
            spot = relation if relation.endswith("floor") else f"“{relation}” it"
            return NoReferent(reason=f"I can put things on, in or next to something, not {spot}.")
        if step.destination is None:
            things = self._sets.to_carry(step.things, context)
            if not isinstance(things, tuple):
                return things
            if not any(i in self._state.world.things and self._state.world.things[i].graspable for i in things):
                return NoReferent(
                    reason=f"I cannot carry {name_of(things[0], self._snapshot)}: it is no object for my hand."
                )
            names = " and ".join(name_of(i, self._snapshot) for i in things)
            return Ambiguous(question=f"Where should I {step.verb} {names}?", phrase="destination", candidates=())
        told = self._with_said(step.things, context)
        place = self._destination(step.destination, step.things, self._around(step.things, told))
        if not isinstance(place, str):
            unmet = self._sets.to_carry(step.things, context) if isinstance(place, Ambiguous) else None
            return unmet if isinstance(unmet, NoReferent) else place
        predicate = placing_predicate(step.destination.relation, place, self._grounding)
        room = self._state.room_of(place)
        here = in_room(self._snapshot, room) if room is not None else ()
        there = frozenset(
            i
            for i in here
            if i in self._state.places
            and holds(Goal(predicate=predicate, args=(i, place)), self._state, self._settings.goals)
        )
        if isinstance(self._snapshot.get(place), PersonNode):
            context = replace(context, mentioned=(place, *context.mentioned))  # *the desk beside him*: the recipient
        things = self._sets.to_carry(step.things, context, avoid=there | context.taken | {place})
        if not isinstance(things, tuple):
            return things
        goals = tuple(Goal(predicate=predicate, args=(i, place)) for i in things)
        noun = noun_of(step.things, context)
        origins = {i: origin for i in things if (origin := self._grounding.origin(i)) is not None}
        return Meaning(goals=goals, implied=step.implied, things=things, places=(place,), noun=noun, origins=origins)

    def _with_said(self, references: tuple[Reference, ...], context: Context) -> Context:
        """What *there* and *the other one* lean on in a destination: the things, and the places that tell them."""
        phrases = [r for r in references if isinstance(r, NounPhrase)]
        told = [x for phrase in phrases for x in phrase.restrictions]
        places = [found for x in told if len(found := self._grounding.targets(x, context)) == 1]
        things = [found for phrase in phrases if len(found := self._grounding.matches(phrase, context)) == 1]
        said = tuple(i for found in (*things, *places) for i in found)
        return replace(context, mentioned=(*said, *context.mentioned)) if said else context

    def _around(self, references: tuple[Reference, ...], context: Context) -> Context:
        """*The cups on the kitchen table in the sink*: of several sinks, the one in the room that was named."""
        told = [x for r in references if isinstance(r, NounPhrase) for x in r.restrictions]
        rooms = {self._state.room_of(i) for x in told for i in self._grounding.targets(x, context)}
        (room, *others) = rooms or {None}
        return context if room is None or others or context.focus else replace(context, focus=room)

    def _destination(self, destination: Destination, things: tuple[Reference, ...], context: Context) -> str | Trouble:
        """One place; *it* is never the thing that is carried."""
        reference = destination.reference
        if isinstance(reference, Pronoun) and reference.word in ("it", "them", "both", "all") and reference in things:
            return NoReferent(reason="I do not know what you mean by “it”.")
        found = self._grounding.place(reference, context)
        if isinstance(found, Ambiguous) and destination.back:
            found = self._where_it_was(found, self._sets.to_carry(things, context), context)
        if not isinstance(found, tuple):
            return found
        if isinstance(reference, Pronoun) and set(found) <= self._named(things, context):
            found = context.places[:1] or found  # *if the box is empty, put the folder in it*
        if len(found) > 1:
            question = "Which one of them do you mean?"
            return Ambiguous(question=question, phrase="", candidates=found)
        return found[0]

    def _named(self, references: tuple[Reference, ...], context: Context) -> set[str]:
        phrases = [r for r in references if isinstance(r, NounPhrase)]
        return {i for phrase in phrases for i in self._grounding.matches(phrase, context)}

    def _where_it_was(self, places: Ambiguous, things: Grounded, context: Context) -> tuple[str, ...] | Ambiguous:
        """*Back on the shelf*: of several shelves, the one that the things were on, or of several rooms, were in."""
        origins = {context.origins.get(i) for i in things} if isinstance(things, tuple) else set()
        rooms = {self._state.room_of(origin) for origin in origins if origin is not None}
        before = tuple(i for i in places.candidates if i in origins or i in rooms)
        return before if len(before) == 1 and None not in origins else places


def placing_predicate(relation: str, place: str, grounding: Grounding) -> Predicate:
    """What putting something *to*, *in*, *on* or *near* a place means there."""
    node, thing = grounding.snapshot.get(place), grounding.state.world.things.get(place)
    if relation == "near":
        return Predicate.NEAR
    if isinstance(node, PersonNode) and relation == "to":
        return Predicate.GIVEN
    if isinstance(node, RoomNode) and (relation in ("to", "in") or node.label in OPEN_AIR):
        return Predicate.IN
    container = thing is not None and thing.container
    shelf = isinstance(node, ObjectNode) and node.support and node.label in SHELF_LIKE
    if relation == "in":
        return Predicate.ON if shelf and not container else Predicate.IN
    if relation == "to" and isinstance(node, ObjectNode) and not (node.support or container):
        return Predicate.NEAR
    return Predicate.IN if container else Predicate.ON
