"""Grounding: each reference of a request is resolved on the graph by query code, to none, one or several nodes.

None is refused with what there is instead, one is accepted, several lead to a question. What has no name is meant where
nothing else is and it most probably is that. Counting, *nearest*, *largest* and *both* are computed here, never by a
language model.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from planner.grounding.context import Context, Grounded, NoReferent
from planner.grounding.matching import Names, own_name
from planner.grounding.narrowing import Narrowing
from planner.grounding.phrasing import alternatives, phrase_text
from planner.grounding.places import Places
from planner.grounding.pronouns import Pronouns
from planner.grounding.quantities import Quantities, is_many
from planner.grounding.settings import GroundingSettings
from planner.grounding.unlabeled import likely_named
from planner.language.grammar.syntax import NounPhrase, Pronoun, Reference, Restriction, Spot
from planner.language.lexicon.vocabulary import PERSON, normal, singular, words_for
from planner.naming import name_of
from scene_graph.nodes import RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState


class Grounding:
    """Resolves references on one snapshot."""

    def __init__(
        self, snapshot: Snapshot, state: PlanState, *, settings: GroundingSettings = GroundingSettings()
    ) -> None:
        self.snapshot, self.state, self.settings = snapshot, state, settings
        self.names, self.places = Names(snapshot), Places(snapshot, state, settings)
        self.narrowing = Narrowing(snapshot, state, self, names=self.names, places=self.places, settings=settings)
        self._pronouns = Pronouns(snapshot, state, self.places)
        self._quantities = Quantities(snapshot, state, self.places)

    def things(self, reference: Reference, context: Context, *, avoid: frozenset[str] = frozenset()) -> Grounded:
        """What is to be carried, found or asked about. ``avoid``: not these, when any one will do."""
        if isinstance(reference, Pronoun):
            return self._pronouns.of(reference.word, context)
        if isinstance(reference, Spot):
            return self.spot(reference, context)
        return self._phrase(reference, context, carried=True, avoid=avoid)

    def place(self, reference: Reference, context: Context) -> Grounded:
        """One place: a room, piece of furniture, person, door or object."""
        if isinstance(reference, Pronoun):
            found = self._pronouns.of(reference.word, context)
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
        return self.places.origin(node_id)

    def matches(
        self, phrase: NounPhrase, context: Context, *, widely: bool = True, fixed: bool = False
    ) -> tuple[str, ...]:
        """Every node that fits the words of ``phrase``, whatever its quantity; options as in ``Names.named``."""
        return self.narrowing.narrow(self._named(phrase, context, widely=widely, fixed=fixed), phrase, context)

    def meant(self, phrase: NounPhrase, context: Context, *, widely: bool) -> tuple[str, ...]:
        """What is called so; else what may be called so too, as a mug a cup; else what has no name and may be that."""
        return (
            self.matches(phrase, context, widely=widely)
            or self.matches(phrase, context)
            or self.narrowing.narrow(likely_named(phrase.head, self.snapshot, self.settings), phrase, context)
        )

    def among(self, candidates: Sequence[str], phrase: NounPhrase) -> tuple[str, ...]:
        """Those of ``candidates`` that fit the modifiers of ``phrase``, whatever its noun."""
        return self.narrowing.narrow(tuple(candidates), phrase, Context())

    def speaker(self, context: Context) -> Grounded:
        """The person who asks: as told, or named user, or the only one."""
        return self._pronouns.speaker(context)

    def targets(self, restriction: Restriction, context: Context) -> tuple[str, ...]:
        """What the reference of a restriction may mean."""
        return self.narrowing.targets(restriction, context)

    def nearest(self, found: tuple[str, ...]) -> tuple[str, ...]:
        """The nearest of several that can be reached, as one; else the first."""
        return self._quantities.nearest(found)

    def _phrase(
        self, phrase: NounPhrase, context: Context, *, carried: bool, avoid: frozenset[str] = frozenset()
    ) -> Grounded:
        many = is_many(phrase)
        found = self._suited(self.meant(phrase, context, widely=many), carried=carried)
        text = phrase_text(phrase)
        if phrase.words[-1:] in (("things",), ("everything",), ("stuff",)):
            found = tuple(i for i in found if i not in self.state.missing) or found
        if phrase.exceptions and (lost := self.narrowing.missing_reference(phrase, context)) is not None:
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
        return self._quantities.chosen(phrase, found, context, avoid)

    def _others(self, found: tuple[str, ...], context: Context) -> tuple[str, ...]:
        """Those that were not spoken of; *other* means nothing when none was."""
        spoken = [i for i in (*context.fresh, *context.mentioned) if i in found]
        left = tuple(i for i in found if i not in spoken)
        return left or tuple(i for i in found if i not in spoken[:1])

    def nothing(self, phrase: NounPhrase, context: Context) -> NoReferent:
        """Why a phrase names nothing, with what there is instead."""
        bare = NounPhrase(words=phrase.words, person=phrase.person)
        same = self.matches(bare, context)
        missing = self.narrowing.missing_reference(phrase, context)
        if missing is not None:
            return missing
        misplaced = bool(same) and all(isinstance(self.snapshot.get(i), RoomNode) for i in same)
        return NoReferent(reason=alternatives(phrase, same, self.snapshot), unknown=not same, misplaced=misplaced)

    def _named(self, phrase: NounPhrase, context: Context, *, widely: bool, fixed: bool) -> tuple[str, ...]:
        head = phrase.head
        if phrase.person and head in ("me", "him"):
            spoken = self._pronouns.of(head, context)
            return spoken if isinstance(spoken, tuple) else ()
        if head in ("one", "ones"):
            head = context.noun or "thing"
        found = self.names.named(head, phrase.number, widely=widely, fixed=fixed)
        if phrase.person and not found and phrase.restrictions:
            found = self.names.named(
                PERSON, None, widely=True
            )  # *the teacher in the music room*: what he is nobody sees
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
                return tuple(i for i in rest if i not in rooms and any(self.places.is_at(i, r) for r in rooms))
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
