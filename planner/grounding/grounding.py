"""Grounding: each reference of a request is resolved on the graph by query code, to none, one or several nodes.

None is refused with what there is instead, one is accepted, several lead to a question. What has no name is meant where
nothing else is and it most probably is that. Counting, *nearest*, *largest* and *both* are computed here, never by a
language model.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from planner.grounding.matching import Names, own_name
from planner.grounding.naming import name_of
from planner.grounding.narrowing import Narrowing
from planner.grounding.phrasing import alternatives, describe, phrase_text, which_question
from planner.grounding.plural_pronouns import moved_together, two_of
from planner.grounding.unlabeled import perhaps
from planner.language.grammar.agreement import is_collective
from planner.language.grammar.syntax import NounPhrase, Pronoun, Quantity, Reference, Restriction, Spot
from planner.language.lexicon.vocabulary import PERSON, is_plural, normal, singular, words_for
from planner.plan import Exchange
from scene_graph.nodes import ROBOT_ID, ObjectNode, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState


@dataclass(frozen=True, kw_only=True)
class NoReferent:
    """A reference names nothing; ``reason`` says so, with what there is instead.

    ``unknown``: no word is known. ``misplaced``: a room was looked for in a place, as in *the kitchen on the desk*.
    ``asks``: the reason is a question, and an answer would settle it. ``sought``: the kind of thing that was never
    seen; somewhere there may be one.
    """

    reason: str
    unknown: bool = False
    misplaced: bool = False
    asks: bool = False
    sought: str = ""


@dataclass(frozen=True, kw_only=True)
class Ambiguous:
    """A reference names several nodes; ``question`` asks which, ``phrase`` is what was said."""

    question: str
    phrase: str
    candidates: tuple[str, ...]


AMONG = "among "
"""Before a phrase: the candidates that an answer left, when it did not leave one."""
Grounded = tuple[str, ...] | NoReferent | Ambiguous


@dataclass(kw_only=True)
class Context:
    """What references may lean on.

    ``mentioned``: identifiers, the newest first. ``places``: places spoken of, the newest first. ``choices``: answers
    to earlier questions, by phrase. ``focus``: the room the request has just gone to. ``noun``: for *the red one*.
    ``origins``: where things were before they were moved. ``earlier``: what was asked before, the newest first.
    ``taken``: things of the steps before, which *one more* is not.
    ``last``: what the turn before spoke of. ``displaced``: things of which words about their place were true when they
    were said.
    ``unsettled``: why *it* names nothing, when what was spoken of last is not known.
    """

    speaker: str | None = None
    mentioned: tuple[str, ...] = ()
    fresh: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    focus: str | None = None
    noun: str = ""
    origins: Mapping[str, str] = field(default_factory=dict)
    earlier: tuple[Exchange, ...] = ()
    unsettled: NoReferent | Ambiguous | None = None
    taken: frozenset[str] = frozenset()
    last: tuple[str, ...] = ()
    displaced: frozenset[str] = frozenset()


class Grounding:
    """Resolves references on one snapshot."""

    nowhere = Context()
    """Nothing that references may lean on."""

    def __init__(self, snapshot: Snapshot, state: PlanState) -> None:
        self.snapshot, self.state = snapshot, state
        self.names = Names(snapshot)
        self._narrowing = Narrowing(snapshot, state, self)

    def things(self, reference: Reference, context: Context, *, avoid: frozenset[str] = frozenset()) -> Grounded:
        """What is to be carried, found or asked about. ``avoid``: not these, when any one will do."""
        if isinstance(reference, Pronoun):
            return self._pronoun(reference.word, context)
        if isinstance(reference, Spot):
            return self.spot(reference, context)
        return self._phrase(reference, context, carried=True, avoid=avoid)

    def place(self, reference: Reference, context: Context) -> Grounded:
        """One place: a room, piece of furniture, person, door or object."""
        if isinstance(reference, Pronoun):
            found = self._pronoun(reference.word, context)
            return found[:1] if isinstance(found, tuple) else found
        if isinstance(reference, Spot):
            return self.spot(reference, context)
        return self._phrase(reference, context, carried=False)

    def spot(self, spot: Spot, context: Context) -> Grounded:
        """*where the apple is*: what the apple stands on, or its room; *where it was*: before it was moved."""
        found = self.things(spot.thing, context)
        if not isinstance(found, tuple):
            return found
        origins = context.origins if spot.past else {}
        spots = {i: origins.get(i) or self.origin(i) for i in found}
        unknown = next((i for i, place in spots.items() if place is None), None)
        if unknown is not None:
            return NoReferent(reason=f"I do not know where {name_of(unknown, self.snapshot)} is.")
        return tuple(dict.fromkeys(place for place in spots.values() if place is not None))

    def origin(self, node_id: str) -> str | None:
        """Where a thing is now, as a place to put it back: its support, else its room."""
        return self.snapshot.support_of(node_id) or self.state.room_of(node_id)

    def unseen(self, place: str) -> NoReferent:
        """Why *left of* and the like have no meaning from another room."""
        return NoReferent(
            reason=f"I cannot tell what is {place} from here: that depends on where one stands.", asks=True
        )

    def matches(
        self, phrase: NounPhrase, context: Context, *, widely: bool = True, fixed: bool = False
    ) -> tuple[str, ...]:
        """Every node that fits the words of ``phrase``, whatever its quantity; options as in ``Names.named``."""
        return self._narrowing.narrow(self._named(phrase, context, widely=widely, fixed=fixed), phrase, context)

    def meant(self, phrase: NounPhrase, context: Context, *, widely: bool) -> tuple[str, ...]:
        """What is called so; else what may be called so too, as a mug a cup; else what has no name and may be that."""
        return (
            self.matches(phrase, context, widely=widely)
            or self.matches(phrase, context)
            or self._narrowing.narrow(perhaps(phrase.head, self.snapshot), phrase, context)
        )

    def among(self, candidates: Sequence[str], phrase: NounPhrase) -> tuple[str, ...]:
        """Those of ``candidates`` that fit the modifiers of ``phrase``, whatever its noun."""
        return self._narrowing.narrow(tuple(candidates), phrase, Context())

    def speaker(self, context: Context) -> Grounded:
        """The person who asks: as told, or named user, or the only one."""
        if context.speaker is not None and context.speaker in self.snapshot:
            return (context.speaker,)
        people = self.snapshot.of_type(PersonNode)
        users = [person.id for person in people if person.name.casefold() in ("user", "me")]
        if len(users) == 1 or len(people) == 1:
            return tuple(users) or (people[0].id,)
        if not people:
            return NoReferent(reason="I see nobody, so I do not know where you are.", sought=PERSON)
        return self._ambiguous("you", tuple(person.id for person in people), context, "Who of them are you")

    def _pronoun(self, word: str, context: Context) -> Grounded:
        if word == "me":
            return self.speaker(context)
        if word == "here":
            speaker = self.speaker(context)
            room = self.snapshot.current_room
            return (room,) if isinstance(speaker, NoReferent) and room is not None else speaker
        if word == "that":
            return self._it(replace(context, fresh=context.fresh[:1]))
        if word == "start":
            room = self.state.robot_room
            return (room,) if room is not None else NoReferent(reason="I do not know which room I am in.")
        if word == "you":
            return (ROBOT_ID,)
        if word == "there":
            return self._there(context) or NoReferent(reason="I do not know which place you mean by “there”.")
        if word == "him":
            people = [i for i in context.mentioned if isinstance(self.snapshot.get(i), PersonNode)]
            people = [i for i in people if (i,) != self.speaker(context)]
            return tuple(people[:1]) or NoReferent(reason="I do not know whom you mean.")
        if word == "both":
            spoken = tuple(i for i in context.mentioned if i in context.taken)
            last = self._told_last(context)
            pair = two_of(context.fresh, spoken, context.earlier) or (last if len(last) == 2 else ())
            return pair or NoReferent(reason="I do not know which two things you mean.", asks=True)
        if word in ("them", "all") and not context.fresh:
            together = self._told_last(context) or moved_together(context.earlier, self.state, everything=word == "all")
            if len(together) > 1:
                return together
        return self._it(context)

    def _there(self, context: Context) -> tuple[str, ...]:
        """The place spoken of last; else where the request before led; else where what was found is."""
        if context.places:
            return context.places[:1]
        placed = [goal.args[-1] for exchange in context.earlier[:1] for goal in exchange.goals[-1:]]
        spoken = [i for i in (*placed, *context.fresh, *context.mentioned) if i in self.snapshot]
        rooms = [i for i in spoken if not isinstance(self.snapshot.get(i), ObjectNode) or self._is_place(i)]
        origins = [origin for i in context.last[:1] if (origin := self.origin(i)) is not None]
        return tuple((rooms or origins)[:1])

    def _told_last(self, context: Context) -> tuple[str, ...]:
        """What an answer spoke of, if the turn before was a question."""
        asked = not context.earlier or not context.earlier[0].goals
        return self._carriable(context.last) if asked else ()

    def _carriable(self, spoken: Sequence[str]) -> tuple[str, ...]:
        """The things among what was spoken of: those that can be carried, if there are any."""
        objects = tuple(i for i in spoken if isinstance(self.snapshot.get(i), ObjectNode))
        return tuple(i for i in objects if not self._is_place(i)) or objects

    def _is_place(self, node_id: str) -> bool:
        thing = self.state.world.things.get(node_id)
        return thing is not None and not thing.graspable

    def _it(self, context: Context) -> Grounded:
        if context.unsettled is not None:
            return tuple(context.choices.get("it", ())) or context.unsettled
        if context.fresh:
            return context.fresh
        if self.state.holding is not None:
            return (self.state.holding,)
        objects = [i for i in context.mentioned if isinstance(self.snapshot.get(i), ObjectNode)]
        return tuple(objects[:1]) or NoReferent(reason="I do not know what you mean by “it”.")

    def _phrase(
        self, phrase: NounPhrase, context: Context, *, carried: bool, avoid: frozenset[str] = frozenset()
    ) -> Grounded:
        many = phrase.quantity in (Quantity.ALL, Quantity.BOTH, Quantity.SOME, Quantity.EXACTLY) or _plural(phrase)
        found = self._suited(self.meant(phrase, context, widely=many), carried=carried)
        text = phrase_text(phrase)
        if phrase.words[-1:] in (("things",), ("everything",), ("stuff",)):
            found = tuple(i for i in found if i not in self.state.missing) or found
        if phrase.exceptions and (lost := self._narrowing.missing_reference(phrase, context)) is not None:
            return lost
        if phrase.other:
            found = self._others(found, context)
        told = tuple(i for i in context.choices.get(text, ()) if i in self.snapshot)
        chosen = tuple(i for i in told if i in found) or self._suited(told, carried=carried)
        if chosen:
            return chosen
        if not found:
            lacking = self.nothing(phrase, context)
            may_be = carried and not phrase.person and not lacking.misplaced
            return replace(lacking, sought=singular(phrase.head)) if may_be else lacking
        if phrase.rank is not None and phrase.superlative is None:
            return self._ranked(phrase, found, context)
        if phrase == NounPhrase(words=("one",)) and context.noun:
            return self._any(phrase, found, avoid)
        match phrase.quantity:
            case Quantity.A | Quantity.SOME:
                return self._any(phrase, found, avoid)
            case Quantity.ALL:
                return found
            case Quantity.BOTH | Quantity.EXACTLY:
                return self._count(phrase, found, context)
            case _ if (_plural(phrase) and phrase.quantity is not Quantity.BARE) or is_collective(phrase):
                return found
            case _:
                last = phrase.words == ("one",) and not context.fresh
                return self._one(text, found, replace(context, fresh=context.last) if last else context)

    def _others(self, found: tuple[str, ...], context: Context) -> tuple[str, ...]:
        """Those that were not spoken of; *other* means nothing when none was."""
        spoken = [i for i in (*context.fresh, *context.mentioned) if i in found]
        left = tuple(i for i in found if i not in spoken)
        return left or tuple(i for i in found if i not in spoken[:1])

    def _ranked(self, phrase: NounPhrase, found: tuple[str, ...], context: Context) -> Grounded:
        """*The second cup*: nobody said in which order, so it is asked, unless there are too few."""
        if len(found) >= (phrase.rank or 0):
            return self._ambiguous(
                phrase_text(phrase), found, context, "I know no order of them. Which one do you mean"
            )
        seen = "; ".join(describe(i, self.snapshot) for i in found)
        return NoReferent(reason=f"I know of only {len(found)}: {seen}.")

    def _one(self, text: str, found: tuple[str, ...], context: Context) -> Grounded:
        if len(found) > 1:
            spoken = tuple(i for i in found if i in context.fresh)
            focused = tuple(i for i in found if context.focus is not None and self.state.room_of(i) == context.focus)
            there = tuple(i for i in found if i not in self.state.missing)
            for preferred in (spoken, focused, there):
                if len(preferred) == 1:
                    return preferred
        return found if len(found) == 1 else self._ambiguous(text, found, context, "Which one do you mean")

    def targets(self, restriction: Restriction, context: Context) -> tuple[str, ...]:
        """What the reference of a restriction may mean."""
        return self._narrowing.targets(restriction, context)

    def nearest(self, found: tuple[str, ...]) -> tuple[str, ...]:
        """The nearest of several that can be reached, as one; else the first."""
        return tuple(self._narrowing.by_distance(found)[:1]) or found[:1]

    def _any(self, phrase: NounPhrase, found: tuple[str, ...], avoid: frozenset[str]) -> Grounded:
        """The nearest of those that will do, unless there are too few."""
        wanted = phrase.count or 1
        if phrase.share:
            left = int(phrase.share.rpartition(" ")[2]) if phrase.share != "half" else len(found) / 2
            if left != int(left) or len(found) <= left:
                seen = "; ".join(describe(i, self.snapshot) for i in found[:4])
                return NoReferent(reason=f"I know of {len(found)}, which is not to be shared so: {seen}.", asks=True)
            wanted = len(found) - int(left)
        fit = [i for i in found if i not in avoid and i != self.state.holding and i not in self.state.missing]
        fit = self._narrowing.by_distance(fit) or list(found)
        if len(fit) < wanted:
            seen = "; ".join(describe(i, self.snapshot) for i in found[:4])
            return NoReferent(reason=f"I know of only {len(fit)} that fit “{phrase_text(phrase)}”: {seen}.")
        return tuple(fit[:wanted])

    def _count(self, phrase: NounPhrase, found: tuple[str, ...], context: Context) -> Grounded:
        if len(found) == phrase.count:
            return found
        if len(found) > (phrase.count or 0):
            return self._ambiguous(phrase_text(phrase), found, context, f"I know of {len(found)}. Which do you mean")
        seen = "; ".join(describe(i, self.snapshot) for i in found)
        return NoReferent(reason=f"I know of only {len(found)} that fits “{phrase_text(phrase)}”: {seen}.")

    def _ambiguous(self, text: str, found: tuple[str, ...], context: Context, ask: str) -> Grounded:
        chosen = tuple(i for i in context.choices.get(text, ()) if i in found)
        if chosen:
            return chosen
        found = tuple(i for i in context.choices.get(f"{AMONG}{text}", ()) if i in found) or found
        return Ambiguous(question=which_question(ask, text, found, self.snapshot), phrase=text, candidates=found)

    def nothing(self, phrase: NounPhrase, context: Context) -> NoReferent:
        bare = NounPhrase(words=phrase.words, person=phrase.person)
        same = self.matches(bare, context)
        missing = self._narrowing.missing_reference(phrase, context)
        if missing is not None:
            return missing
        misplaced = bool(same) and all(isinstance(self.snapshot.get(i), RoomNode) for i in same)
        return NoReferent(reason=alternatives(phrase, same, self.snapshot), unknown=not same, misplaced=misplaced)

    def _named(self, phrase: NounPhrase, context: Context, *, widely: bool, fixed: bool) -> tuple[str, ...]:
        head = phrase.head
        if phrase.person and head in ("me", "him"):
            spoken = self._pronoun(head, context)
            return spoken if isinstance(spoken, tuple) else ()
        if head in ("one", "ones"):
            head = context.noun or "thing"
        found = self.names.named(head, phrase.number, widely=widely, fixed=fixed)
        if len(found) == 1 or len(head.split()) < 2:
            return found
        return self._named_in_room(phrase, widely=widely) or found or tuple(self._rooms_with(head))

    def _named_in_room(self, phrase: NounPhrase, *, widely: bool) -> tuple[str, ...]:
        """*the kitchen table*: a table in the kitchen."""
        words = " ".join(phrase.words).split()
        for split in range(len(words) - 1, 0, -1):
            lead = " ".join(words[:split])
            called = words_for(lead) | {lead, f"{lead} room"}
            every = self.snapshot.of_type(RoomNode)
            rooms = [room.id for room in every if normal(room.label) in called or own_name(normal(room.label)) == lead]
            rooms = rooms or self._rooms_with(lead)
            if rooms:
                rest = self.names.named(" ".join(words[split:]), phrase.number, widely=widely)
                return tuple(i for i in rest if i not in rooms and any(self._narrowing.is_at(i, r) for r in rooms))
        return ()

    def _rooms_with(self, said: str) -> list[str]:
        """*the piano room*: rooms known by what is in them."""
        thing, _, last = said.rpartition(" ")
        if last != "room" or not thing:
            return []
        inside = self.names.named(thing, None, widely=False, fixed=True)
        return list(dict.fromkeys(room for i in inside if (room := self.state.room_of(i)) is not None))

    def _suited(self, found: tuple[str, ...], *, carried: bool) -> tuple[str, ...]:
        """Of several, those that can be carried, or that one can put something on, in or before, if there are any."""
        if len(found) < 2:
            return found
        things = self.state.world.things
        if carried:
            fit = tuple(i for i in found if i in things and things[i].graspable)
        else:
            fit = tuple(i for i in found if i in things and not things[i].graspable)
        return fit or found


def _plural(phrase: NounPhrase) -> bool:
    return bool(phrase.words) and (is_plural(phrase.words[-1]) or phrase.words[-1] == "ones")
