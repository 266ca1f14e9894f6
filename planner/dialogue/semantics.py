"""From readings to goals: each step of a request is grounded in turn, and what it mentions serves the next.

A step with several readings keeps those that the graph makes sense of. Exactly one such reading is accepted.
"""

from __future__ import annotations

from dataclasses import replace

from planner.answers.answers import Answer, Answers
from planner.dialogue.carrying import Carrying, placing_predicate
from planner.dialogue.meaning import Meaning
from planner.dialogue.motion import Motion
from planner.dialogue.restoring import Restoring
from planner.dialogue.settings import DialogueSettings
from planner.dialogue.teaching import Teaching
from planner.goals import Goal, Predicate, holds
from planner.grounding.context import Ambiguous, Context, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.sets import ReferenceSets, noun_of
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
    Swap,
    Teach,
    Wanted,
    is_wish,
)
from planner.naming import aim_phrase, name_of
from scene_graph.nodes import ObjectNode, PersonNode, RoomNode

Outcome = Meaning | Trouble


class Semantics:
    """Gives readings their meaning on one graph."""

    def __init__(self, grounding: Grounding, settings: DialogueSettings = DialogueSettings()) -> None:
        self._grounding, self._settings = grounding, settings
        self._snapshot, self._state = grounding.snapshot, grounding.state
        self._answers = Answers(grounding, settings.answers)
        self._sets = ReferenceSets(grounding)
        self._teaching = Teaching(grounding)
        self._motion = Motion(grounding)
        self._restoring = Restoring(grounding, self._sets)
        self._carrying = Carrying(grounding, self._sets, settings)

    def of(self, readings: tuple[Step, ...], context: Context) -> Outcome:
        """The one meaning of a step, or why there is none.

        Parallel wording (*the cup on the table and the book on the desk*) is taken at its word, if it makes sense. A
        reading that leaves a choice open is asked about, even if another would settle it. What is wanted is where it is
        said to be, if it is there. Readings that hold already
        give way to readings that ask for something, and those that follow from another to that one.
        """
        parallel = tuple(reading for reading in readings if isinstance(reading, Several))
        others = tuple(reading for reading in readings if reading not in parallel)
        restored = [self._restoring.of(reading, context) for reading in others if isinstance(reading, PutBack)]
        if len(restored) == 1 and isinstance(restored[0], Meaning):
            return restored[0]
        wished = [self._step(reading, context) for reading in others if is_wish(reading)]
        if len(wished) == 1 and isinstance(wished[0], Meaning):
            return wished[0]
        outcomes = [self._step(reading, context) for reading in parallel]
        if all(isinstance(outcome, NoReferent) for outcome in outcomes):
            outcomes += [self._step(reading, context) for reading in others]
        meant = [outcome for outcome in outcomes if isinstance(outcome, Meaning)]
        open_choices = [outcome for outcome in outcomes if isinstance(outcome, Ambiguous) and outcome.candidates]
        if open_choices:
            return open_choices[0]
        if not meant:
            return _clearest([outcome for outcome in outcomes if not isinstance(outcome, Meaning)])
        news = [
            m
            for m in meant
            if not m.goals or not all(holds(goal, self._state, self._settings.goals) for goal in m.goals)
        ] or meant
        distinct = list({(m.goals, m.lessons): m for m in reversed(news)}.values())[::-1]
        distinct = [m for m in distinct if self._can_be_carried(m)] or distinct
        strongest = [m for m in distinct if not any(self._follows(m, other) for other in distinct if other is not m)]
        return strongest[0] if len(strongest) == 1 else self._either(strongest or distinct)

    def _can_be_carried(self, meant: Meaning) -> bool:
        """Whether nothing is to be moved that stands where it stands, such as a counter."""
        things = self._state.world.things
        moved = [goal.object_id for goal in meant.goals if goal.object_id is not None]
        return all(i not in things or things[i].graspable for i in moved)

    def _follows(self, weak: Meaning, strong: Meaning) -> bool:
        """Whether goals like *in the kitchen* follow from goals like *on the table*, which stands in the kitchen."""
        pairs = list(zip(weak.goals, strong.goals, strict=False))
        same = len(weak.goals) == len(strong.goals) and all(w.args[0] == s.args[0] for w, s in pairs)
        return same and all(
            w.predicate is Predicate.IN and s.args[-1] != w.args[-1] and self._state.room_of(s.args[-1]) == w.args[-1]
            for w, s in pairs
        )

    def _either(self, meanings: list[Meaning]) -> Ambiguous:
        ways = [" and ".join(aim_phrase(goal, self._snapshot) for goal in m.goals) for m in meanings]
        return Ambiguous(question=f"Did you mean to {', or to '.join(ways)}?", phrase="", candidates=())

    def _step(self, step: Step, context: Context) -> Outcome:
        match step:
            case Carry():
                return self._carrying.of(step, context)
            case Several() | Swap():
                return self._several(step, context) if isinstance(step, Several) else self._swapped(step, context)
            case Pick():
                return self._handle(step.things, Predicate.HOLDING, context)
            case Find():
                return self._find(step, context)
            case Go():
                return self._motion.to(step, context)
            case Operate():
                return self._motion.operated(step, context)
            case PutDown():
                return self._put_down(step, context)
            case PutBack():
                return self._restoring.of(step, context)
            case Perhaps() | Wanted() | Mention():
                return self._said(step, context)
            case Teach():
                return self._teaching.of(step, context)
            case Ask():
                answer = self._answers.of(step, context)
                if not isinstance(answer, Answer):
                    return answer
                return Meaning(
                    answer=answer.text, query=answer.query, things=answer.query.nodes[: self._settings.most_mentioned]
                )

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
        outcome = self._carrying.of(step.step, context)
        if not isinstance(outcome, Meaning) or step.sure:
            return outcome
        is_so = all(holds(goal, self._state, self._settings.goals) for goal in outcome.goals)
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
        return replace(outcome, doubt=True) if isinstance(outcome, Meaning) else outcome

    def _mention(self, step: Mention, context: Context) -> Outcome:
        """What was told must be so; *a mug* is the one mug there, or a question."""
        thing = step.thing
        if isinstance(thing, NounPhrase) and thing.quantity is Quantity.A:
            thing = replace(thing, quantity=Quantity.THE, count=None)
        found = self._sets.all_of((thing, *step.more), context)
        if not isinstance(found, tuple):
            return found
        if all(isinstance(self._snapshot.get(i), PersonNode) for i in found):
            return Meaning(places=found, told=True)
        who = self._grounding.place(step.who, context) if step.who is not None else ()
        people = who if isinstance(who, tuple) else ()
        return Meaning(things=found, places=people, noun=noun_of((thing,), context), told=True)

    def _several(self, step: Several, context: Context) -> Outcome:
        goals: tuple[Goal, ...] = ()
        things: tuple[str, ...] = ()
        places: tuple[str, ...] = ()
        for part in step.steps:
            outcome = self._carrying.of(part, context) if isinstance(part, Carry) else self._motion.to(part, context)
            if not isinstance(outcome, Meaning):
                return outcome
            goals, things, places = goals + outcome.goals, things + outcome.things, outcome.places + places
            mentioned = (*outcome.things, *outcome.places, *context.mentioned)
            taken = context.taken | {*outcome.things}
            context = replace(context, mentioned=mentioned, noun=outcome.noun or context.noun, taken=taken)
        origins = {i: place for i in things if (place := self._grounding.origin(i)) is not None}
        doubt = step.verbless and all(holds(goal, self._state, self._settings.goals) for goal in goals)
        return Meaning(goals=goals, things=things, places=places, noun=context.noun, origins=origins, doubt=doubt)

    def _swapped(self, step: Swap, context: Context) -> Outcome:
        """Each of two things where the other is now; each of two groups likewise, if each stands at one place."""
        one = self._sets.all_of(step.things[:1], context)
        if not isinstance(one, tuple):
            return one
        groups: list[tuple[str, ...]] = [(i,) for i in one] if len(step.things) == 1 else [one]
        for reference in step.things[1:]:
            other = self._sets.all_of((reference,), replace(context, taken=context.taken | {*one}))
            if not isinstance(other, tuple):
                return other
            groups.append(other)
        if len(groups) != 2:
            return Ambiguous(question="Which two things should change places?", phrase="", candidates=())
        places = [{self._grounding.origin(i) for i in group} for group in groups]
        if any(len(place) != 1 or None in place for place in places):
            return NoReferent(reason="I do not know where each of them is, so I cannot let them change places.")
        goals = tuple(
            Goal(predicate=placing_predicate("to", place, self._grounding), args=(i, place))
            for group, where in zip(groups, reversed(places), strict=True)
            for place in where
            if place is not None
            for i in group
        )
        things = tuple(i for group in groups for i in group)
        return Meaning(goals=goals, things=things, noun=noun_of(step.things, context))

    def _taken_out(self, references: tuple[Reference, ...], context: Context) -> bool:
        """Whether things are to leave a room, which does not say where to."""
        away = [x for r in references if isinstance(r, NounPhrase) for x in r.restrictions if x.relation == "out of"]
        places = [i for x in away for i in self._grounding.targets(x, context)]
        return any(isinstance(self._snapshot.get(i), RoomNode) for i in places)

    def _handle(self, references: tuple[Reference, ...], predicate: Predicate, context: Context) -> Outcome:
        things = self._sets.to_carry(references, context)
        if not isinstance(things, tuple):
            return things
        if self._taken_out(references, context):
            return Ambiguous(question="Where should I take it?", phrase="destination", candidates=())
        goals = tuple(Goal(predicate=predicate, args=(i,)) for i in things)
        return Meaning(
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
        found = self._sets.all_of(references, context)
        if not isinstance(found, tuple):
            return found
        goals = tuple(
            Goal(predicate=Predicate.FOUND if self._is_object(i) else Predicate.ROBOT_AT, args=(i,)) for i in found
        )
        return Meaning(goals=goals, implied=True, things=found, noun=noun_of(references, context))

    def _put_down(self, step: PutDown, context: Context) -> Outcome:
        things = self._sets.all_of(step.things, context)
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
        return Meaning(goals=goals, things=things, places=(place,))

    def _is_object(self, node_id: str) -> bool:
        return isinstance(self._snapshot.get(node_id), ObjectNode)


def _clearest(troubles: list[Trouble]) -> Trouble:
    """A question with candidates says most; then any question; then the first reason that takes no room for a thing."""
    questions = [trouble for trouble in troubles if isinstance(trouble, Ambiguous)]
    with_candidates = [question for question in questions if question.candidates]
    likely = [trouble for trouble in troubles if not isinstance(trouble, NoReferent) or not trouble.misplaced]
    return (with_candidates or questions or likely or troubles)[0]
