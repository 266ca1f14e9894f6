"""From the steps of a request to what they mean together: each in turn, with what was said before it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from planner.answers.answers import Answer, Answers
from planner.dialogue.meaning import Meaning
from planner.dialogue.semantics import Semantics
from planner.dialogue.settings import DialogueSettings
from planner.grounding.context import Ambiguous, Context, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.phrasing import phrase_text, which_question
from planner.language.grammar.parser import Background, Choice, ParsedStep, Refrain, Understood
from planner.language.grammar.syntax import Ask, Mention, NounPhrase, Pronoun, Quantity
from scene_graph.nodes import RoomNode

WHETHER = "whether"
"""What a condition is asked about under that the robot cannot tell; the person settles it."""
SO, NOT_SO = "so", "not so"


@dataclass(frozen=True, kw_only=True)
class Stuck:
    """The step that means nothing, or too much, on the graph."""

    step: ParsedStep
    trouble: Trouble


class Discourse:
    """Grounds the steps of one request on one graph."""

    def __init__(self, grounding: Grounding, context: Context, settings: DialogueSettings = DialogueSettings()) -> None:
        self._grounding, self._context = grounding, context
        self._semantics, self._answers = Semantics(grounding, settings), Answers(grounding, settings.answers)

    def meanings(self, steps: Sequence[ParsedStep]) -> list[Meaning] | Stuck:
        """What every step means; a branch that is not taken means nothing."""
        found: list[Meaning] = []
        forbidden: list[Refrain] = []
        for step in steps:
            match step:
                case Understood():
                    outcome = self._semantics.of(step.readings, self._context)
                    if not isinstance(outcome, Meaning):
                        return Stuck(step=step, trouble=outcome)
                    found.append(outcome)
                    self._context = carried_on(self._context, outcome)
                case Choice():
                    chosen = self._chosen(step)
                    if isinstance(chosen, Stuck):
                        return chosen
                    found += chosen
                case Refrain():
                    forbidden.append(step)
                case Background():
                    self._context = self._told(step)
        return next((stuck for step in forbidden if (stuck := self._breach(step, found))), found)

    def _told(self, step: Background) -> Context:
        """What *it* and *him* mean after a statement; of several things, or one that is not known, it is asked."""
        things: list[tuple[str, ...]] = []
        trouble: Trouble | None = None
        context = self._context
        for is_place, readings in step.spoken:
            outcomes = [self._semantics.of((reading,), context) for reading in readings]
            meant = next((outcome for outcome in outcomes if isinstance(outcome, Meaning)), None)
            if meant is not None and meant.things and not is_place:
                things.append(meant.things)
                context = replace(context, focus=self._room(meant.things) or context.focus)
            elif meant is not None:
                context = carried_on(context, replace(meant, things=(), places=(*meant.places, *meant.things)))
            elif outcomes and not isinstance(outcomes[0], Meaning) and not is_place and _is_definite(readings):
                trouble = trouble or outcomes[0]
        if trouble is not None:
            return replace(context, unsettled=trouble)
        carried = [found for found in things if self._can_be_carried(found)] or things
        if len(carried) == 1:
            return carried_on(context, Meaning(things=carried[0]))
        if carried:
            found = tuple(i for each in carried for i in each)
            question = which_question("Which one do you mean", "it", found, self._grounding.snapshot)
            return replace(context, unsettled=Ambiguous(question=question, phrase="it", candidates=found))
        return context

    def _room(self, found: tuple[str, ...]) -> str | None:
        """*The gym is a mess*: the room that what follows is about."""
        rooms = [i for i in found if isinstance(self._grounding.snapshot.get(i), RoomNode)]
        return rooms[0] if len(found) == len(rooms) == 1 else None

    def _can_be_carried(self, found: tuple[str, ...]) -> bool:
        things = self._grounding.state.world.things
        return all(i in things and things[i].graspable for i in found)

    def _chosen(self, choice: Choice) -> list[Meaning] | Stuck:
        if choice.condition is None:
            before = self._context
            first = self.meanings(choice.then)
            if not isinstance(first, Stuck) or not isinstance(first.trouble, NoReferent):
                return first
            self._context = before
            return self.meanings(choice.otherwise)
        if not self._context.fresh and any(isinstance(t, Pronoun) for ask in choice.condition for t in ask.things):
            stuck = self._mention(choice.then)
            if stuck is not None and isinstance(stuck.trouble, Ambiguous):
                return stuck
        answer = self._answer(choice.condition)
        if not isinstance(answer, Answer):
            return Stuck(step=choice, trouble=answer)
        divided = self._divided(choice.condition[0], answer)
        if divided is not None:
            return Stuck(step=choice, trouble=divided)
        settled = self._settled(choice, answer)
        if not isinstance(settled, bool):
            return Stuck(step=choice, trouble=settled)
        holds = settled != choice.negated
        self._note(choice.condition[0], answer)
        branch = choice.then if holds else choice.otherwise
        if branch and not holds:
            self._mention(choice.then)
        if branch:
            return self.meanings(branch)
        return [Meaning(answer=f"{_statement(answer.text)} So I do nothing.", query=answer.query)]

    def _settled(self, choice: Choice, answer: Answer) -> bool | Ambiguous:
        """Whether a condition holds; one on what nobody has seen lately is asked about."""
        if answer.holds is not None:
            return answer.holds
        phrase = f"{WHETHER} {choice.text}"
        told = self._context.choices.get(phrase)
        if told:
            return told == (SO,)
        return Ambiguous(question=f"{answer.text} Is it so that {choice.text}?", phrase=phrase, candidates=())

    def _mention(self, steps: Sequence[ParsedStep]) -> Stuck | None:
        """Let pronouns lean on steps that are not carried out, if they mean something."""
        before = self._context
        outcome = self.meanings(steps)
        if isinstance(outcome, Stuck):
            self._context = before
            return outcome
        return None

    def _divided(self, asked: Ask, answer: Answer) -> Ambiguous | None:
        """*If the door is open*, where one is and another is not: which one decides is asked."""
        (thing, *_) = asked.things or (None,)
        if asked.least is not None or asked.most is not None:
            return None
        if asked.place is None or not isinstance(thing, NounPhrase) or thing.quantity not in ("the", "bare", "this"):
            return None
        every = self._grounding.matches(thing, self._context)
        chosen = self._context.choices.get(phrase_text(thing), ())
        if len(every) < 2 or chosen or set(every) <= set(answer.query.nodes) or not answer.query.nodes:
            return None
        text = phrase_text(thing)
        question = which_question("Which one do you mean", text, every, self._grounding.snapshot)
        return Ambiguous(question=question, phrase=text, candidates=every)

    def _answer(self, readings: Iterable[Ask]) -> Answer | Trouble:
        """The answer to a condition; its readings must agree."""
        outcomes = [self._answers.of(reading, self._context) for reading in readings]
        answers = [outcome for outcome in outcomes if isinstance(outcome, Answer)]
        if len({answer.holds for answer in answers}) > 1:
            return Ambiguous(
                question="I can read this condition in two ways. Can you say it differently?", phrase="", candidates=()
            )
        troubles = [outcome for outcome in outcomes if not isinstance(outcome, Answer)]
        return answers[0] if answers else troubles[0]

    def _note(self, asked: Ask, answer: Answer) -> None:
        """*If there is a cup on the table, bring it to me*: what the condition found."""
        nouns = [thing.head for thing in asked.things if isinstance(thing, NounPhrase)]
        found = tuple(i for i in answer.query.nodes if i not in self._grounding.state.missing)
        thing = asked.things[0] if asked.things else None
        stated = (asked.place, *(thing.restrictions if isinstance(thing, NounPhrase) else ()))
        places = [i for where in stated if where is not None for i in self._grounding.targets(where, self._context)]
        if len(places) == 1:
            self._context = carried_on(self._context, Meaning(places=tuple(places)))
        if asked.things and isinstance(asked.things[0], NounPhrase):
            found = found or self._grounding.matches(asked.things[0], self._context)
            near = self._grounding.nearest(found) if asked.things[0].quantity in ("a", "bare") else found
            self._context = carried_on(self._context, Meaning(things=near, noun=nouns[-1] if nouns else ""))

    def _breach(self, step: Refrain, meanings: Sequence[Meaning]) -> Stuck | None:
        """What is forbidden is left undone; a rule about the way, or one that is broken, is asked about."""
        objects = {i for meant in meanings for goal in meant.goals for i in goal.args[:1]}
        for reading in step.readings:
            things = getattr(reading, "things", ())
            phrases = [thing for thing in things if isinstance(thing, NounPhrase)]
            named = {i for phrase in phrases for i in self._grounding.matches(phrase, self._context)}
            if phrases and len(phrases) == len(things) and not named & objects and objects:
                return None
        reason = f"I will not do what I am told not to, “{step.text}”. Tell me what I shall do."
        return Stuck(step=step, trouble=Ambiguous(question=reason, phrase="", candidates=()))


def _is_definite(readings: Sequence[Mention]) -> bool:
    """*The violin* or *my violin*, which *it* may stand for; not *a kid*."""
    definite = (Quantity.THE, Quantity.THIS, Quantity.ALL, Quantity.BOTH)
    return any(isinstance(reading.thing, NounPhrase) and reading.thing.quantity in definite for reading in readings)


def carried_on(context: Context, meant: Meaning) -> Context:
    """The context for the next step."""
    moved = {i: place for i, place in meant.origins.items() if i not in context.fresh}
    return replace(
        context,
        fresh=meant.things or context.fresh,
        taken=context.taken | {goal.args[0] for goal in meant.goals if goal.object_id is not None},
        unsettled=None if meant.things else context.unsettled,
        mentioned=tuple(dict.fromkeys((*meant.things, *meant.places, *context.mentioned))),
        places=(*meant.places, *context.places),
        focus=meant.focus or context.focus,
        noun=meant.noun or context.noun,
        origins={**context.origins, **moved},
    )


def _statement(text: str) -> str:
    """An answer without its *yes* or *no*."""
    return text.removeprefix("Yes. ").removeprefix("No. ")
