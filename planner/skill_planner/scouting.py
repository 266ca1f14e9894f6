"""Scouting: looking for a kind of thing of which none was ever seen, or for somebody when nobody is, before a request
is turned down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from planner.explainer.explainer import scouted_sentence
from planner.goals import Goal
from planner.grounding.unlabeled import likely_label
from planner.language.lexicon.vocabulary import PERSON, normal, words_for
from planner.plan import Flaw, Impossible, Plan, Reinterpret
from planner.skill_planner.replanner import ObjectSearch, Verifier
from scene_graph.nodes import ObjectNode, ObjectState, PersonNode
from scene_graph.snapshot import Snapshot

Sighting = tuple[str, str, str | None]


def kinds_called(said: str) -> frozenset[str]:
    """Labels that a person may mean by a word."""
    return frozenset(words_for(said) | {said})


@dataclass(kw_only=True)
class KindSearch(ObjectSearch):
    """The search for any thing of a kind; ``object_id`` is what people call it. ``known``: what was seen before."""

    known: frozenset[Sighting] = field(default_factory=frozenset)

    def found(self, snapshot: Snapshot) -> bool:
        """Whether something is called so that was not before, or is of another color or elsewhere."""
        return not sightings(self.object_id, snapshot) <= self.known


class Scout:
    """Makes the plans of a search for a kind of thing. Whether what is seen then is what was asked for, the request
    says when it is understood again.
    """

    def __init__(self, kind: str, verifier: Verifier, stamp_s: float) -> None:
        self._verifier = verifier
        self._search = KindSearch(object_id=kind, since_s=stamp_s)

    def tour(self, snapshot: Snapshot) -> Plan | None:
        """Places to look at next, given that what is known now is not what was asked for; None when none is left."""
        search = self._search
        search.known = sightings(search.object_id, snapshot)
        looked = (*search.looked, *search.skipped)
        return self._verifier.scouting_plan(search.object_id, snapshot, search.since_s, looked)

    def told(self, snapshot: Snapshot) -> str:
        """Where the robot has looked, as a sentence; nothing if nowhere."""
        whom = "anybody" if PERSON in kinds_called(self._search.object_id) else "it"
        return scouted_sentence(self._search.looked, self._search.skipped, snapshot, what=whom)

    def search_for(self, object_id: str) -> ObjectSearch:
        """The search itself."""
        del object_id
        return self._search

    def plan(self, goals: Sequence[Goal], snapshot: Snapshot, stamp_s: float) -> Plan | Impossible | Reinterpret:
        """The rest of the tour; nothing but understanding anew when something was found or no place is left."""
        del goals, stamp_s
        if self._search.found(snapshot):
            return Reinterpret()
        return self.tour(snapshot) or Reinterpret()

    def flaws(self, plan: Plan, snapshot: Snapshot) -> Sequence[Flaw]:
        """What keeps the rest of a plan from being carried out."""
        return self._verifier.check_plan(plan, snapshot) if plan.revision != snapshot.revision else ()


def sightings(kind: str, snapshot: Snapshot) -> frozenset[Sighting]:
    """Things that are there and are, or most probably are, called so: identifier, colors, and what carries them; people
    with the room that they are in.
    """
    called = kinds_called(kind)
    people = snapshot.of_type(PersonNode) if PERSON in called else ()
    return frozenset((person.id, "", snapshot.room_of(person.id)) for person in people) | frozenset(
        (node.id, " ".join((node.color, *sorted(node.accents))), snapshot.support_of(node.id))
        for node in snapshot.of_type(ObjectNode)
        if node.state is not ObjectState.MISSING and (likely_label(node) or normal(node.label)) in called
    )
