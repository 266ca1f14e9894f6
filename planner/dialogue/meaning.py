"""From readings to goals: each step of a request is grounded in turn, and what it mentions serves the next.

A step with several readings keeps those that the graph makes sense of. Exactly one such reading is accepted.
"""

from __future__ import annotations

from dataclasses import replace

from planner.answers.answers import Answer, Answers
from planner.dialogue.interpretation import Meant
from planner.dialogue.motion import Going
from planner.dialogue.restoring import Returning
from planner.dialogue.teaching import Teaching
from planner.goals import Goal, Predicate, holds
from planner.grounding.grounding import Ambiguous, Context, Grounding, NoReferent
from planner.grounding.naming import aim_phrase, name_of
from planner.grounding.sets import Gathering, Trouble, noun_of
from planner.grounding.sides import SIDES, beside
from planner.language.grammar.syntax import (
    Ask,
    Carry,
    Destination,
    Find,
    Go,
    Mention,
    NounPhrase,
    Operate,
    Perhaps,
    Pick,
    Pronoun,
    PutBack,
    PutDown,
    Quantity,
    Reference,
    Restriction,
    Several,
    Step,
    Teach,
    Wanted,
    is_wish,
)
from planner.language.lexicon.vocabulary import OPEN_AIR
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode
from skills.room_contents import in_room

MAX_MENTIONED = 6
SHELF_LIKE = frozenset({"shelf", "bookshelf", "bookcase", "cabinet", "rack", "shelves", "cupboard"})
"""Labels of supports that things are put *in* as well as *on*, in a person's words."""


Outcome = Meant | Trouble


class Meaning:
    """Gives readings their meaning on one graph."""

    def __init__(self, grounding: Grounding) -> None:
        self._grounding = grounding
        self._snapshot, self._state = grounding.snapshot, grounding.state
        self._answers = Answers(grounding)
        self._gathering = Gathering(grounding)
        self._teaching = Teaching(grounding)
        self._going = Going(grounding)
        self._returning = Returning(grounding, self._gathering, self.predicate)

    def of(self, readings: tuple[Step, ...], context: Context) -> Outcome:
        """The one meaning of a step, or why there is none.

        Parallel wording (*the cup on the table and the book on the desk*) is taken at its word, if it makes sense. A
        reading that leaves a choice open is asked about, even if another would settle it. What is wanted is where it is
        said to be, if it is there. Readings that hold already
        give way to readings that ask for something, and those that follow from another to that one.
        """
        parallel = tuple(reading for reading in readings if isinstance(reading, Several))
        others = tuple(reading for reading in readings if reading not in parallel)
        returned = [self._returning.of(reading, context) for reading in others if isinstance(reading, PutBack)]
        if len(returned) == 1 and isinstance(returned[0], Meant):
            return returned[0]
        wished = [self._step(reading, context) for reading in others if is_wish(reading)]
        if len(wished) == 1 and isinstance(wished[0], Meant):
            return wished[0]
        outcomes = [self._step(reading, context) for reading in parallel]
        if all(isinstance(outcome, NoReferent) for outcome in outcomes):
            outcomes += [self._step(reading, context) for reading in others]
        meant = [outcome for outcome in outcomes if isinstance(outcome, Meant)]
        open_choices = [outcome for outcome in outcomes if isinstance(outcome, Ambiguous) and outcome.candidates]
        if open_choices:
            return open_choices[0]
        if not meant:
            return _clearest([outcome for outcome in outcomes if not isinstance(outcome, Meant)])
        news = [m for m in meant if not m.goals or not all(holds(goal, self._state) for goal in m.goals)] or meant
        distinct = list({(m.goals, m.lessons): m for m in reversed(news)}.values())[::-1]
        distinct = [m for m in distinct if self._can_be_carried(m)] or distinct
        strongest = [m for m in distinct if not any(self._follows(m, other) for other in distinct if other is not m)]
        return strongest[0] if len(strongest) == 1 else self._either(strongest or distinct)

    def _can_be_carried(self, meant: Meant) -> bool:
        """Whether nothing is to be moved that stands where it stands, such as a counter."""
        things = self._state.world.things
        moved = [goal.object_id for goal in meant.goals if goal.object_id is not None]
        return all(i not in things or things[i].graspable for i in moved)

    def _follows(self, weak: Meant, strong: Meant) -> bool:
        """Whether goals like *in the kitchen* follow from goals like *on the table*, which stands in the kitchen."""
        pairs = list(zip(weak.goals, strong.goals, strict=False))
        same = len(weak.goals) == len(strong.goals) and all(w.args[0] == s.args[0] for w, s in pairs)
        return same and all(
            w.predicate is Predicate.IN and s.args[-1] != w.args[-1] and self._state.room_of(s.args[-1]) == w.args[-1]
            for w, s in pairs
        )

    def _either(self, meanings: list[Meant]) -> Ambiguous:
        ways = [" and ".join(aim_phrase(goal, self._snapshot) for goal in m.goals) for m in meanings]
        return Ambiguous(question=f"Did you mean to {', or to '.join(ways)}?", phrase="", candidates=())

    def _step(self, step: Step, context: Context) -> Outcome:
        match step:
            case Carry():
                return self._carry(step, context)
            case Several():
                return self._several(step, context)
            case Pick():
                return self._handle(step.things, Predicate.HOLDING, context)
            case Find():
                return self._find(step, context)
            case Go():
                return self._going.to(step, context)
            case Operate():
                return self._going.operated(step, context)
            case PutDown():
                return self._put_down(step, context)
            case PutBack():
                return self._returning.of(step, context)
            case Perhaps() | Wanted() | Mention():
                return self._said(step, context)
            case Teach():
                return self._teaching.of(step, context)
            case Ask():
                answer = self._answers.of(step, context)
                if not isinstance(answer, Answer):
                    return answer
                return Meant(answer=answer.text, query=answer.query, things=answer.query.nodes[:MAX_MENTIONED])

    def _said(self, step: Perhaps | Wanted | Mention, context: Context) -> Outcome:
        """What is asked for without a verb, or only told."""
        match step:
            case Perhaps():
                return self._perhaps(step, context)
            case Wanted():
                return self._wanted(step, context)
            case Mention():
                return self._mention(step, context)

    def _perhaps(self, step: Perhaps, context: Context) -> Outcome:
        outcome = self._carry(step.step, context)
        if not isinstance(outcome, Meant) or step.sure:
            return outcome
        is_so = all(holds(goal, self._state) for goal in outcome.goals)
        return replace(outcome, doubt=is_so or not step.verbless)

    def _wanted(self, step: Wanted, context: Context) -> Outcome:
        """A place is gone to, a thing is brought; which it is, is asked, unless it was said with a *please*."""
        if isinstance(step.thing, NounPhrase) and not self._grounding.matches(step.thing, context):
            unknown = self._grounding.nothing(step.thing, context).reason
            return NoReferent(reason=f"I do not understand that. {unknown}", unknown=True, asks=True)
        matched = self._grounding.matches(step.thing, context) if isinstance(step.thing, NounPhrase) else ()
        things = self._state.world.things
        carried = any(i in things and things[i].graspable for i in matched)
        me = Destination(relation="to", reference=Pronoun(word="me"))
        deed = Carry(things=(step.thing,), destination=me) if carried else Go(target=step.thing)
        outcome = self._step(deed, context)
        return replace(outcome, doubt=True) if isinstance(outcome, Meant) else outcome

    def _mention(self, step: Mention, context: Context) -> Outcome:
        """What was told must be so; *a mug* is the one mug there, or a question."""
        thing = step.thing
        if isinstance(thing, NounPhrase) and thing.quantity is Quantity.A:
            thing = replace(thing, quantity=Quantity.THE, count=None)
        found = self._gathering.all_of((thing, *step.more), context)
        if not isinstance(found, tuple):
            return found
        if all(isinstance(self._snapshot.get(i), PersonNode) for i in found):
            return Meant(places=found, told=True)
        who = self._grounding.place(step.who, context) if step.who is not None else ()
        people = who if isinstance(who, tuple) else ()
        return Meant(things=found, places=people, noun=noun_of((thing,), context), told=True)

    def _carry(self, step: Carry, context: Context) -> Outcome:
        if step.destination is not None and step.destination.relation in SIDES:
            sided = beside(step.destination, self._grounding, context)
            if not isinstance(sided, tuple):
                return sided
            outcome = self._carry(replace(step, destination=sided[0]), context)
            return replace(outcome, answer=sided[1]) if isinstance(outcome, Meant) else outcome
        if step.destination is not None and step.destination.relation not in ("to", "in", "on", "near"):
            relation = step.destination.relation
            spot = relation if relation.endswith("floor") else f"“{relation}” it"
            return NoReferent(reason=f"I can put things on, in or next to something, not {spot}.")
        if step.destination is None:
            things = self._gathering.to_carry(step.things, context)
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
            unmet = self._gathering.to_carry(step.things, context) if isinstance(place, Ambiguous) else None
            return unmet if isinstance(unmet, NoReferent) else place
        predicate = self.predicate(step.destination.relation, place)
        room = self._state.room_of(place)
        here = in_room(self._snapshot, room) if room is not None else ()
        there = frozenset(
            i
            for i in here
            if i in self._state.places and holds(Goal(predicate=predicate, args=(i, place)), self._state)
        )
        if isinstance(self._snapshot.get(place), PersonNode):
            context = replace(context, mentioned=(place, *context.mentioned))  # *the desk beside him*: the recipient
        things = self._gathering.to_carry(step.things, context, avoid=there | context.taken | {place})
        if not isinstance(things, tuple):
            return things
        goals = tuple(Goal(predicate=predicate, args=(i, place)) for i in things)
        noun = noun_of(step.things, context)
        origins = {i: origin for i in things if (origin := self._grounding.origin(i)) is not None}
        return Meant(goals=goals, implied=step.implied, things=things, places=(place,), noun=noun, origins=origins)

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

    def _several(self, step: Several, context: Context) -> Outcome:
        goals: tuple[Goal, ...] = ()
        things: tuple[str, ...] = ()
        places: tuple[str, ...] = ()
        for part in step.steps:
            outcome = self._carry(part, context) if isinstance(part, Carry) else self._going.to(part, context)
            if not isinstance(outcome, Meant):
                return outcome
            goals, things, places = goals + outcome.goals, things + outcome.things, outcome.places + places
            mentioned = (*outcome.things, *outcome.places, *context.mentioned)
            taken = context.taken | {*outcome.things}
            context = replace(context, mentioned=mentioned, noun=outcome.noun or context.noun, taken=taken)
        origins = {i: place for i in things if (place := self._grounding.origin(i)) is not None}
        doubt = step.verbless and all(holds(goal, self._state) for goal in goals)
        return Meant(goals=goals, things=things, places=places, noun=context.noun, origins=origins, doubt=doubt)

    def _destination(self, destination: Destination, things: tuple[Reference, ...], context: Context) -> str | Trouble:
        """One place; *it* is never the thing that is carried."""
        reference = destination.reference
        if isinstance(reference, Pronoun) and reference.word in ("it", "them", "both", "all") and reference in things:
            return NoReferent(reason="I do not know what you mean by “it”.")
        found = self._grounding.place(reference, context)
        if isinstance(found, Ambiguous) and destination.back:
            found = self._returning.among(found, self._gathering.to_carry(things, context), context)
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

    def predicate(self, relation: str, place: str) -> Predicate:
        """What putting something *to*, *in*, *on* or *near* a place means there."""
        node, thing = self._snapshot.get(place), self._state.world.things.get(place)
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

    def _taken_out(self, references: tuple[Reference, ...], context: Context) -> bool:
        """Whether things are to leave a room, which does not say where to."""
        away = [x for r in references if isinstance(r, NounPhrase) for x in r.restrictions if x.relation == "out of"]
        places = [i for x in away for i in self._grounding.targets(x, context)]
        return any(isinstance(self._snapshot.get(i), RoomNode) for i in places)

    def _handle(self, references: tuple[Reference, ...], predicate: Predicate, context: Context) -> Outcome:
        things = self._gathering.to_carry(references, context)
        if not isinstance(things, tuple):
            return things
        if self._taken_out(references, context):
            return Ambiguous(question="Where should I take it?", phrase="destination", candidates=())
        goals = tuple(Goal(predicate=predicate, args=(i,)) for i in things)
        return Meant(
            goals=goals, implied=predicate is Predicate.HOLDING, things=things, noun=noun_of(references, context)
        )

    def _find(self, step: Find, context: Context) -> Outcome:
        references = step.things
        if step.place is not None:
            within = Restriction(relation="at", reference=step.place)
            references = tuple(
                replace(r, restrictions=(within,)) if isinstance(r, NounPhrase) and not r.restrictions else r
                for r in references
            )
        found = self._gathering.all_of(references, context)
        if not isinstance(found, tuple):
            return found
        goals = tuple(
            Goal(predicate=Predicate.FOUND if self._is_object(i) else Predicate.ROBOT_AT, args=(i,)) for i in found
        )
        return Meant(goals=goals, implied=True, things=found, noun=noun_of(references, context))

    def _put_down(self, step: PutDown, context: Context) -> Outcome:
        things = self._gathering.all_of(step.things, context)
        if not isinstance(things, tuple):
            return things
        room = self._state.robot_room
        if things != (self._state.holding,) and not set(things) <= set(context.fresh):
            names = " and ".join(name_of(i, self._snapshot) for i in things)
            return NoReferent(reason=f"I am not holding {names}.")
        if room is None:
            return NoReferent(reason="I do not know which room I am in.")
        place = context.focus or room
        goals = tuple(Goal(predicate=Predicate.IN, args=(i, place)) for i in things)
        return Meant(goals=goals, things=things, places=(place,))

    def _is_object(self, node_id: str) -> bool:
        return isinstance(self._snapshot.get(node_id), ObjectNode)


def _clearest(troubles: list[Trouble]) -> Trouble:
    """A question with candidates says most; then any question; then the first reason that takes no room for a thing."""
    questions = [trouble for trouble in troubles if isinstance(trouble, Ambiguous)]
    with_candidates = [question for question in questions if question.candidates]
    likely = [trouble for trouble in troubles if not isinstance(trouble, NoReferent) or not trouble.misplaced]
    return (with_candidates or questions or likely or troubles)[0]
