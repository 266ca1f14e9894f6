"""What *me*, *it*, *there*, *them* and *both* stand for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from planner.grounding.context import Context, Grounded, NoReferent
from planner.grounding.phrasing import ambiguous
from planner.grounding.places import Places
from planner.language.lexicon.vocabulary import ALWAYS_PLURAL, PERSON, is_plural, normal
from planner.plan import Exchange
from scene_graph.nodes import ROBOT_ID, ObjectNode, PersonNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState

BOTH = 2
"""Things that *both* speaks of."""


class Pronouns:
    """Resolves pronouns on one snapshot."""

    def __init__(self, snapshot: Snapshot, state: PlanState, places: Places) -> None:
        self._snapshot, self._state, self._places = snapshot, state, places

    def of(self, word: str, context: Context) -> Grounded:
        """What a pronoun stands for; persons in *him*, things in the others."""
        if word == "me":
            return self.speaker(context)
        if word == "here":
            speaker = self.speaker(context)
            room = self._snapshot.current_room
            return (room,) if isinstance(speaker, NoReferent) and room is not None else speaker
        if word == "that":
            return self._it(replace(context, fresh=context.fresh[:1]))
        if word == "start":
            room = self._state.robot_room
            return (room,) if room is not None else NoReferent(reason="I do not know which room I am in.")
        if word == "you":
            return (ROBOT_ID,)
        if word == "there":
            return self._there(context) or NoReferent(reason="I do not know which place you mean by “there”.")
        if word == "him":
            people = [i for i in context.mentioned if isinstance(self._snapshot.get(i), PersonNode)]
            people = [i for i in people if (i,) != self.speaker(context)]
            return tuple(people[:1]) or NoReferent(reason="I do not know whom you mean.")
        if word == "both":
            spoken = tuple(i for i in context.mentioned if i in context.taken)
            last = self._told_last(context)
            pair = two_of(context.fresh, spoken, context.earlier) or (last if len(last) == 2 else ())
            return pair or NoReferent(reason="I do not know which two things you mean.", asks=True)
        if word in ("them", "all") and not context.fresh:
            together = self._told_last(context) or moved_together(
                context.earlier, self._state, everything=word == "all"
            )
            if len(together) > 1:
                return together
        return self._it(context)

    def speaker(self, context: Context) -> Grounded:
        """The person who asks: as told, or named user, or the only one."""
        if context.speaker is not None and context.speaker in self._snapshot:
            return (context.speaker,)
        people = self._snapshot.of_type(PersonNode)
        users = [person.id for person in people if person.name.casefold() in ("user", "me")]
        if len(users) == 1 or len(people) == 1:
            return tuple(users) or (people[0].id,)
        if not people:
            return NoReferent(reason="I see nobody, so I do not know where you are.", sought=PERSON)
        return ambiguous("you", tuple(person.id for person in people), context, "Who of them are you", self._snapshot)

    def _there(self, context: Context) -> tuple[str, ...]:
        """The place spoken of last; else where the request before led; else where what was found is."""
        if context.places:
            return context.places[:1]
        placed = [goal.args[-1] for exchange in context.earlier[:1] for goal in exchange.goals[-1:]]
        spoken = [i for i in (*placed, *context.fresh, *context.mentioned) if i in self._snapshot]
        rooms = [i for i in spoken if not isinstance(self._snapshot.get(i), ObjectNode) or self._is_place(i)]
        origins = [origin for i in context.last[:1] if (origin := self._places.origin(i)) is not None]
        return tuple((rooms or origins)[:1])

    def _told_last(self, context: Context) -> tuple[str, ...]:
        """What an answer spoke of, if the turn before was a question."""
        asked = not context.earlier or not context.earlier[0].goals
        return self._carriable(context.last) if asked else ()

    def _carriable(self, spoken: Sequence[str]) -> tuple[str, ...]:
        """The things among what was spoken of: those that can be carried, if there are any."""
        objects = tuple(i for i in spoken if isinstance(self._snapshot.get(i), ObjectNode))
        return tuple(i for i in objects if not self._is_place(i)) or objects

    def _is_place(self, node_id: str) -> bool:
        thing = self._state.world.things.get(node_id)
        return thing is not None and not thing.graspable

    def _it(self, context: Context) -> Grounded:
        if context.unsettled is not None:
            return tuple(context.choices.get("it", ())) or context.unsettled
        if context.fresh:
            return context.fresh
        if self._state.holding is not None:
            return (self._state.holding,)
        objects = [i for i in context.mentioned if isinstance(self._snapshot.get(i), ObjectNode)]
        return tuple(objects[:1]) or NoReferent(reason="I do not know what you mean by “it”.")


def moved_together(earlier: Sequence[Exchange], state: PlanState, *, everything: bool = False) -> tuple[str, ...]:
    """What *them* means when the request before moved things, the newest first.

    Several things of one request; else the one thing, with those that the requests right before took to the same
    place, unless it is many by its name, as scissors are. ``everything``: wherever they were taken.
    """
    runs = [moved(exchange) for exchange in earlier]
    last = runs[0] if runs else ()
    if not everything and (len(last) != 1 or _is_many(last[0], state)):
        return last
    found = dict.fromkeys(last)
    for before in runs[1:]:
        beside = [i for i in before if everything or i in found or _are_together(i, last[0], state)]
        if not before or len(beside) != len(before):
            break
        found.update(dict.fromkeys(before))
    return tuple(found)


def two_of(fresh: tuple[str, ...], spoken: tuple[str, ...], earlier: Sequence[Exchange]) -> tuple[str, ...]:
    """What *both* means: the two things of the step before, or of this request so far; else the two that one request
    moved, or the last two one each; else nothing.
    """
    runs = [moved(exchange) for exchange in earlier]
    before = () if fresh else ((runs[0] if runs else ()), _singles(runs))
    return next((pair for pair in (fresh, spoken, *before) if len(pair) == BOTH), ())


def moved(exchange: Exchange) -> tuple[str, ...]:
    """The things that a request was to handle, each once."""
    return tuple(dict.fromkeys(i for goal in exchange.goals if (i := goal.object_id) is not None))


def _singles(runs: Sequence[tuple[str, ...]]) -> tuple[str, ...]:
    """The things of the latest requests that each moved one, up to two."""
    found: dict[str, None] = {}
    for run in runs:
        if len(run) != 1 or len(found) == BOTH:
            break
        found.update(dict.fromkeys(run))
    return tuple(found)


def _are_together(one: str, other: str, state: PlanState) -> bool:
    place = state.places.get(one)
    return place is not None and place == state.places.get(other)


def _is_many(object_id: str, state: PlanState) -> bool:
    thing = state.world.things.get(object_id)
    name = normal(thing.label) if thing is not None else ""
    return name in ALWAYS_PLURAL or is_plural(name)
