"""Narrows what a noun may name by color, place, size and order: *the largest red cup next to the laptop*."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Protocol

from planner.grounding.context import Context, Grounded, NoReferent
from planner.grounding.matching import Names
from planner.grounding.openness import OPENNESS, is_open
from planner.grounding.ordering import Ordering
from planner.grounding.places import Places
from planner.grounding.settings import GroundingSettings
from planner.grounding.spatial import VIEWED, is_between, is_in_view, is_related, relation_name
from planner.language.grammar.syntax import NounPhrase, Pronoun, Reference, Restriction
from planner.language.lexicon.vocabulary import normal
from planner.language.parsing.things import knowledge
from planner.naming import name_of
from scene_graph.nodes import DoorNode, ObjectNode, ObjectState, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState

BUILDING = frozenset({"house", "home", "building", "flat", "apartment", "place", "whole house", "entire house"})
"""Words for all that is known, which narrow nothing."""
KINDS_OF_BUILDING = frozenset({"school", "hospital", "office", "studio", "villa", "clinic", "ward"})
"""Words for it as well, where no room is called so."""
_LASTING = frozenset({"color", "state", "use", "is", "kind", "sort", "spoken", "held", "of", "of person", "with"})
"""Relations that say what a thing is or whose, not where: those hold wherever it has been put."""


class Referents(Protocol):
    """Resolves the references inside a noun phrase, which are noun phrases themselves."""

    def things(self, reference: Reference, context: Context) -> Grounded: ...

    def place(self, reference: Reference, context: Context) -> Grounded: ...

    def matches(self, phrase: NounPhrase, context: Context) -> tuple[str, ...]: ...

    def meant(self, phrase: NounPhrase, context: Context, *, widely: bool) -> tuple[str, ...]: ...

    def nothing(self, phrase: NounPhrase, context: Context) -> NoReferent: ...


class Narrowing:
    """Applies the modifiers of a noun phrase to candidates."""

    def __init__(
        self,
        snapshot: Snapshot,
        state: PlanState,
        referents: Referents,
        *,
        names: Names,
        places: Places,
        settings: GroundingSettings,
    ) -> None:
        self._snapshot, self._state, self._referents = snapshot, state, referents
        self._names, self._places, self._settings = names, places, settings
        self._ordering = Ordering(snapshot, places, settings)

    def narrow(self, found: tuple[str, ...], phrase: NounPhrase, context: Context) -> tuple[str, ...]:
        """Those of ``found`` that fit color, restriction, size and superlative, in this order."""
        kept = self._colored(found, phrase.colors, any_of_them=phrase.either) if phrase.colors else list(found)
        if phrase.quantity == "this":
            kept = [i for i in kept if self._state.room_of(i) == self._snapshot.current_room] or kept
        for restriction in sorted(phrase.restrictions, key=lambda each: each.relation != "color"):
            kept = self.restricted(kept, restriction, context)
        kept = self._without(kept, phrase, context)
        for size in phrase.sizes:
            kept = self._ordering.sized(kept, size)
        if phrase.superlative is not None and kept:
            kept = self._ordering.extreme(kept, phrase.superlative, phrase.rank or 1)
        return tuple(kept)

    def _without(self, found: list[str], phrase: NounPhrase, context: Context) -> list[str]:
        excluded = {i for exception in phrase.exceptions for i in self.excepted(exception, phrase, context)}
        return [i for i in found if i not in excluded]

    def excepted(self, exception: Reference, phrase: NounPhrase, context: Context) -> tuple[str, ...]:
        """What *except the red one* leaves out of ``phrase``."""
        if isinstance(exception, NounPhrase):
            return self._referents.matches(exception, replace(context, noun=phrase.head))
        found = self._referents.things(exception, context)
        return found if isinstance(found, tuple) else ()

    def restricted(self, found: Iterable[str], restriction: Restriction, context: Context) -> list[str]:
        """Those of ``found`` that are where ``restriction`` says."""
        candidates = list(found)
        if restriction.relation == "color":
            candidates = [i for i in candidates if isinstance(self._snapshot.get(i), ObjectNode)]
        if restriction.negated and restriction.word in OPENNESS:
            other = "closed" if restriction.word == "open" else "open"
            return self._fitting(candidates, replace(restriction, word=other, negated=False), context)
        if restriction.negated:
            fitting = self._fitting(candidates, replace(restriction, negated=False), context)
            return [i for i in candidates if i not in fitting]
        fitting = self._fitting(candidates, restriction, context)
        if context.displaced.isdisjoint(candidates) or restriction.relation in _LASTING:
            return fitting
        return [i for i in candidates if i in fitting or i in context.displaced]

    def _fitting(self, candidates: list[str], restriction: Restriction, context: Context) -> list[str]:
        relation, reference = restriction.relation, restriction.reference
        if isinstance(reference, NounPhrase) and self.is_everywhere(reference):
            return candidates
        told = self._of_themselves(candidates, restriction, context)
        if told is not None:
            return told
        targets = self.targets(restriction, context)
        if relation in ("nearest", "farthest"):
            return self._places.closest(candidates, targets, farthest=relation == "farthest")
        if relation in ("of", "of person"):
            return self._of(candidates, targets, restriction)
        if relation == "near" and any(isinstance(self._snapshot.get(i), RoomNode) for i in candidates):
            doors = [set(door.rooms) for door in self._state.world.doors]
            return [i for i in candidates if any({i, target} in doors for target in targets)]
        if relation == "near":
            return self._places.next_to(candidates, targets)
        if relation == "between":
            others = self.targets(Restriction(relation="at", reference=restriction.other), context)
            return [i for i in candidates if any(self._is_between(i, a, b) for a in targets for b in others)]
        if relation == "with":
            return self._places.holding(candidates, targets)
        if relation == "same room":
            return self._places.in_same_room(candidates, targets)
        if relation in ("on", "in", "from", "at", "to", "into", "out of"):
            if restriction.other is not None:
                targets += self.targets(replace(restriction, reference=restriction.other, other=None), context)
            return self._places.at_any(candidates, targets)
        return [i for i in candidates if any(self._is_related(i, relation, target) for target in targets)]

    def _of_themselves(self, candidates: list[str], restriction: Restriction, context: Context) -> list[str] | None:
        """What is told without a second thing: color, state, *on the floor*, *the red one*, *here*; None of others."""
        here = self._snapshot.current_room
        match restriction.relation:
            case "color":
                return self._colored(candidates, (restriction.word,))
            case "state":
                return [i for i in candidates if self._is_state(i, restriction.word)]
            case "floor":
                return [i for i in candidates if self._snapshot.support_of(i) is None]
            case "is" | "kind":
                return [i for i in candidates if i in self._alike(candidates, restriction)]
            case "use":
                return self._for_use(candidates, restriction.word)
            case "sort":
                return self._of_sort(candidates, restriction)
            case "spoken" if restriction.reference is not None:
                spoken = self._referents.things(restriction.reference, context)
                return [i for i in candidates if i in spoken] if isinstance(spoken, tuple) else []
            case "held":
                return [i for i in candidates if i == self._state.holding]
            case "here":
                return [i for i in candidates if here is not None and self._places.is_at(i, here)]
            case "there":
                return self._there(candidates, context)
            case _:
                return None

    def _is_related(self, node_id: str, relation: str, target: str) -> bool:
        return is_related(node_id, relation, target, self._snapshot, settings=self._settings)

    def _is_between(self, node_id: str, one: str, other: str) -> bool:
        node = self._snapshot.get(node_id)
        if isinstance(node, DoorNode):
            return {one, other} <= set(node.rooms)
        return is_between(node_id, one, other, self._snapshot, settings=self._settings)

    def _alike(self, candidates: list[str], restriction: Restriction) -> tuple[str, ...]:
        """Those of ``candidates`` that *are the red one*, or *look like a tool*."""
        phrase = restriction.reference
        if not isinstance(phrase, NounPhrase):
            return ()
        if restriction.relation == "is":
            return self.narrow(tuple(candidates), phrase, Context())
        alike = self._referents.matches(phrase, Context())
        return tuple(i for i in candidates if i in alike)

    def _there(self, candidates: list[str], context: Context) -> list[str]:
        """Those in the room spoken of last in which there are any."""
        spoken = (*context.places, *context.fresh, *context.mentioned)
        rooms = [room for i in spoken if (room := self._state.room_of(i)) is not None]
        for room in (*rooms, self._snapshot.current_room):
            found = [i for i in candidates if room is not None and self._places.is_at(i, room)]
            if found:
                return found
        return []

    def _of(self, candidates: list[str], targets: tuple[str, ...], restriction: Restriction) -> list[str]:
        """*the desk of Anna*, *the pharmacy's counter*, *the bowl of fruit*."""
        if not targets and isinstance(restriction.reference, Pronoun):
            return candidates
        people = tuple(i for i in targets if isinstance(self._snapshot.get(i), PersonNode))
        if people:
            return self._owned(candidates, people)
        there = self._places.at_any(candidates, targets)
        return there or self._places.holding(candidates, targets)

    def _owned(self, found: list[str], owners: tuple[str, ...]) -> list[str]:
        """*Anna's mug*: the only one there is, else what is where Anna is; her room is the one she is in."""
        rooms = {self._state.room_of(owner) for owner in owners}
        if any(isinstance(self._snapshot.get(i), RoomNode) for i in found):
            return [i for i in found if i in rooms]
        return found if len(found) == 1 else [i for i in found if self._state.room_of(i) in rooms]

    def _is_state(self, node_id: str, word: str) -> bool:
        node = self._snapshot.get(node_id)
        if word in ("lost", "missing", "gone"):
            return isinstance(node, ObjectNode) and node.state is ObjectState.MISSING
        return is_open(node_id, self._snapshot) is (word == "open")

    def targets(self, restriction: Restriction, context: Context) -> tuple[str, ...]:
        """Every node the restriction's reference may mean; *the cup on the table* does not ask which table."""
        reference = restriction.reference
        if reference is None:
            return ()
        if not isinstance(reference, NounPhrase):
            found = self._referents.place(reference, context)
            return found if isinstance(found, tuple) else ()
        found = self._referents.meant(reference, context, widely=False)
        if reference.other:
            spoken = {*context.fresh, *context.mentioned}
            return tuple(i for i in found if i not in spoken) or found
        return found

    def missing_reference(self, phrase: NounPhrase, context: Context) -> NoReferent | None:
        """When it is the place in a restriction that nobody knows, that is the news."""
        for restriction in phrase.restrictions:
            for reference in (restriction.reference, restriction.other):
                trouble = self._unmet(replace(restriction, reference=reference), context)
                if trouble is not None:
                    return trouble
        for exception in phrase.exceptions:
            if isinstance(exception, NounPhrase) and not self.excepted(exception, phrase, context):
                return self._referents.nothing(exception, replace(context, noun=phrase.head))
        return None

    def _unmet(self, restriction: Restriction, context: Context) -> NoReferent | None:
        reference = restriction.reference
        if not isinstance(reference, NounPhrase) or self.is_everywhere(reference):
            return None
        targets = self.targets(restriction, context)
        if not targets:
            return self._referents.nothing(reference, context)
        relation = relation_name(restriction.relation)
        if relation in VIEWED and not any(is_in_view(target, self._snapshot) for target in targets):
            return _unseen(f"{relation} {name_of(targets[0], self._snapshot)}")
        return None

    def is_everywhere(self, place: NounPhrase) -> bool:
        """*In the house*, *in our school*: the whole building."""
        known = self._names.named(place.head, None, widely=False)
        return place.head in BUILDING or (place.head in KINDS_OF_BUILDING and not known)

    def _colored(self, found: Sequence[str], colors: Sequence[str], *, any_of_them: bool = False) -> list[str]:
        """Those of these colors; where none is, those that have them too: a phone is called by the color of its case,
        and what is seen of it is its screen.
        """
        has = any if any_of_them else all
        nodes = [(i, node) for i in found if isinstance(node := self._snapshot.node(i), ObjectNode)]
        mainly = [i for i, node in nodes if has(_color(node.color) == color for color in colors)]
        return mainly or [i for i, node in nodes if has(color in _colors(node) for color in colors)]

    def _for_use(self, candidates: list[str], purpose: str) -> list[str]:
        """Those that serve a purpose best, of those that can be carried."""
        things = [i for i in candidates if isinstance(self._snapshot.get(i), ObjectNode)]
        labels = {i: normal(self._snapshot.node(i).label) for i in things}
        meant = knowledge().meant(labels.values(), purpose)
        return [i for i, label in labels.items() if label in meant]

    def _of_sort(self, candidates: list[str], restriction: Restriction) -> list[str]:
        """Those that a noun may name, in its widest sense."""
        noun = restriction.reference.head if isinstance(restriction.reference, NounPhrase) else ""
        named = frozenset(self._names.named(noun, None, widely=True))
        return [i for i in candidates if i in named]


def _unseen(place: str) -> NoReferent:
    """Why *left of* and the like have no meaning from another room."""
    return NoReferent(reason=f"I cannot tell what is {place} from here: that depends on where one stands.", asks=True)


def _color(color: str) -> str:
    return {"grey": "gray"}.get(color.casefold(), color.casefold())


def _colors(node: ObjectNode) -> frozenset[str]:
    return frozenset(map(_color, (node.color, *node.accents)))
