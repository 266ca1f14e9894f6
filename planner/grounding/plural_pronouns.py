"""What *them* and *both* stand for after several requests: things that were moved one after the other."""

from __future__ import annotations

from collections.abc import Sequence

from planner.language.lexicon.vocabulary import ALWAYS_PLURAL, is_plural, normal
from planner.plan import Exchange
from skills.state.state import PlanState

BOTH = 2


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
