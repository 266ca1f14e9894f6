"""Answers that compare: which room has the most cups, which of two things is bigger or nearer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from planner.answers.reports import Report, one_place
from planner.grounding.context import Context, Grounded, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.ordering import volume_m3
from planner.grounding.phrasing import describe, phrase_text
from planner.language.grammar.syntax import Ask, NounPhrase, Quantity, Reference
from planner.language.lexicon.vocabulary import singular
from planner.naming import capital, listed
from planner.plan import QueryKind

COMPARING = frozenset({QueryKind.MOST, QueryKind.MORE, QueryKind.COMPARE})


class Comparison:
    """Answers the kinds of ``COMPARING`` on one graph."""

    def __init__(self, grounding: Grounding) -> None:
        self._grounding = grounding
        self._snapshot, self._state = grounding.snapshot, grounding.state

    def of(self, ask: Ask, context: Context) -> Report | Trouble:
        """The answer, or why there is none."""
        match ask.kind:
            case QueryKind.MOST:
                return self._most(ask, context)
            case QueryKind.MORE:
                return self._more(ask, context)
            case _:
                return self._compared(ask, context)

    def _most(self, ask: Ask, context: Context) -> Report | Trouble:
        """The places with the most or the fewest of something; places without any count for the fewest."""
        place, wanted = ask.things
        places = self._every(place, context)
        counted = self._counted(wanted, context)
        if not isinstance(places, tuple):
            return places
        if not isinstance(counted, tuple):
            return counted
        numbers = {i: self._number_at(i, counted) for i in places}
        best = (max if ask.word == "most" else min)(numbers.values())
        chosen = [i for i in places if numbers[i] == best]
        return Report(text=self._told(chosen, best, wanted), nodes=tuple(chosen))

    def _more(self, ask: Ask, context: Context) -> Report | Trouble:
        """Which of two places has more of something."""
        wanted, *places = ask.things
        counted = self._counted(wanted, context)
        found = [self._one(place, context) for place in places]
        lost = next((each for each in (*found, counted) if not isinstance(each, str | tuple)), None)
        if lost is not None or not isinstance(counted, tuple):
            return lost if lost is not None else NoReferent(reason="I do not know what you mean.")
        named = [each for each in found if isinstance(each, str)]
        numbers = {i: self._number_at(i, counted) for i in named}
        ordered = sorted(named, key=lambda i: -numbers[i] if ask.word == "more" else numbers[i])
        told = [f"{self._called(i)}: {_many(numbers[i], wanted)}" for i in ordered]
        lead = "As many. " if len(set(numbers.values())) == 1 else ""
        if ask.least:
            lead = f"{'Yes' if not lead and ordered[0] == named[0] else 'No'}. {lead}"
        return Report(text=f"{lead}{capital('; '.join(told))}.", nodes=tuple(ordered))

    def _compared(self, ask: Ask, context: Context) -> Report | Trouble:
        """Which of two things is bigger, smaller, nearer to the robot or farther, with *yes* or *no* if asked so."""
        found = [self._one(thing, context) for thing in ask.things]
        nodes = [each for each in found if isinstance(each, str)]
        if len(nodes) < len(found):
            return next(each for each in found if not isinstance(each, str))
        sizes = {i: self._measure(i, ask.word) for i in nodes}
        unknown = [self._called(i) for i, size in sizes.items() if size is None]
        if unknown or len(sizes) < len(ask.things):
            why = "there is only one." if not unknown else f"I have no measure of {listed(unknown)}."
            return Report(text=f"I cannot compare them: {why}", nodes=tuple(nodes))
        first, second = (sizes[i] or 0.0 for i in nodes)
        if first == second:
            return Report(text="Neither, as far as I can tell: they measure the same.", nodes=tuple(nodes))
        wins = (first > second) == (ask.word in ("bigger", "farther"))
        one, other = nodes if wins else nodes[::-1]
        yes = ("Yes: " if wins else "No: ") if ask.least else ""
        told = f"{self._called(one)} is {ask.word} than {self._called(other)}."
        return Report(text=f"{yes}{told if yes else capital(told)}", nodes=tuple(nodes))

    def _measure(self, node_id: str, word: str) -> float | None:
        if word in ("nearer", "farther"):
            return self._state.distance_m(self._state.robot_at, node_id)
        return volume_m3(node_id, self._snapshot) or None

    def _every(self, reference: Reference, context: Context) -> Grounded:
        if not isinstance(reference, NounPhrase):
            return self._grounding.things(reference, context)
        found = self._grounding.matches(reference, context, fixed=True)
        return found or self._grounding.nothing(reference, context)

    def _counted(self, wanted: Reference, context: Context) -> Grounded:
        """What is counted: of *things*, those that can be carried."""
        found = self._every(wanted, context)
        if not isinstance(found, tuple):
            return found
        things = self._state.world.things
        present = tuple(i for i in found if i not in self._state.missing)
        if isinstance(wanted, NounPhrase) and singular(wanted.head) in ("thing", "stuff", "object", "item"):
            return tuple(i for i in present if i in things and things[i].graspable)
        return present

    def _one(self, reference: Reference, context: Context) -> str | Trouble:
        known = replace(reference, quantity=Quantity.THE) if isinstance(reference, NounPhrase) else reference
        return one_place(self._grounding, known, context)

    def _number_at(self, place: str, counted: Sequence[str]) -> int:
        return sum(self._grounding.places.is_at(i, place) for i in counted)

    def _told(self, places: Sequence[str], number: int, wanted: Reference) -> str:
        names = [self._called(i) for i in places]
        if len(names) == 1:
            return f"{capital(names[0])}, with {_many(number, wanted)}."
        return f"{capital(listed(names))}, with {_many(number, wanted)} each."

    def _called(self, node_id: str) -> str:
        return describe(node_id, self._snapshot)


def _many(number: int, wanted: Reference) -> str:
    if not isinstance(wanted, NounPhrase):
        return str(number)
    words = (singular(wanted.head) if number == 1 else wanted.head).split(" ")
    return f"{number or 'no'} {phrase_text(replace(wanted, words=tuple(words), quantity=Quantity.BARE))}"
