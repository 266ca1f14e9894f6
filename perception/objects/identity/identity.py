"""Is a new sighting a new thing, or a known one that was moved while nobody looked?

Decided once, when the sighting is confirmed, by the odds

    P(old one has left its place, and is here) x likeness
    -----------------------------------------------------
    P(a look-alike nobody has seen before is here)

The old one has left with ``1 - existence exp(-age / tau)``: certain when it is missing, growing with the time since
it was last seen. What is missing must be somewhere, and this may well be it; what may merely have left may be anywhere
(``here``). A look-alike is unlikely where one has looked before and seen nothing (``look_alike_known``), and
quite possible in a place seen for the first time (``look_alike_new``). Two that were seen at the same time are two.
With several candidates the best wins; several *present* look-alikes make neither of them unique, and then only a
missing one is taken for the moved one. Of several missing ones it is the nearest, if one was missed nearby: what falls
from the hand, or is let go and topples, has not gone far. What fell from the hand lies near there or on the floor: a
look-alike that turns up on another table is another one (``may_have_fallen_to``). A published identifier gives way
afterwards in one case only: an older thing is missed, and this is its only look-alike, which turned up later where one
had looked before (``turned_up``).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from perception.objects.beliefs import agreement, share_agreement
from perception.objects.tracking.track import Track
from perception.vocabulary import is_of_one_size
from scene_graph.nodes import ObjectState


@dataclass(frozen=True, kw_only=True)
class IdentitySettings:
    """``tau_s``: mean time after which people have moved a thing. ``here``: chance that they put it where a look-alike
    is seen. ``odds``: needed to say it is the same one. ``near_m``: how far a thing goes that falls over or rolls;
    ``floor_m``: how high at most lies what lies on the floor.
    """

    tau_s: float = 900.0
    here: float = 0.15
    look_alike_known: float = 0.02
    look_alike_new: float = 0.25
    odds: float = 2.0
    likeness_min: float = 0.35
    furniture_reach_m: float = 1.5
    near_m: float = 1.0
    floor_m: float = 0.12


def likeness(a: Track, b: Track) -> float:
    """How far label, color and size agree, 0 to 1."""
    label = agreement(a.label.distribution, b.label.distribution)
    color = share_agreement(a.color.shares, b.color.shares)
    return label * color * size_agreement(a, b)


def same_thing_moved(
    sighting: Track, known: Iterable[Track], *, place_known: bool, settings: IdentitySettings
) -> Track | None:
    """The known thing that ``sighting`` is, or ``None`` if it is a new one.

    ``place_known``: whether one had looked at the place of the sighting before, and seen nothing there.
    """
    alike = [
        (likeness(sighting, track), track)
        for track in known
        if track.state is not ObjectState.HELD and _could_be(sighting, track, settings)
    ]
    alike = [(value, track) for value, track in alike if value >= settings.likeness_min]
    missing = [pair for pair in alike if pair[1].state is ObjectState.MISSING]
    if len(alike) > 1 and missing:
        alike = missing
    elif len(alike) > 1:
        return None
    if not alike:
        return None
    nearby = [pair for pair in missing if apart_m(sighting, pair[1]) < settings.near_m]
    if nearby:
        value, best = min(nearby, key=lambda pair: (apart_m(sighting, pair[1]), pair[1].number))
    else:
        value, best = max(alike, key=lambda pair: (pair[0], pair[1].last_seen_s, -pair[1].number))
    look_alike = settings.look_alike_known if place_known else settings.look_alike_new
    here = 1.0 if best.state is ObjectState.MISSING else settings.here
    left = departed(best, sighting.first_seen_s, settings)
    return best if left * here * value / look_alike >= settings.odds else None


def may_have_fallen_to(sighting: Track, track: Track, settings: IdentitySettings) -> bool:
    """Whether a sighting is where ``track`` may be, had it slipped from the hand: near there, or on a floor."""
    bottom_m = float(sighting.position[2]) - sighting.box.size_m[2] / 2.0
    return not track.fell or bottom_m < settings.floor_m or apart_m(sighting, track) < settings.near_m


def departed(track: Track, stamp_s: float, settings: IdentitySettings) -> float:
    """Probability that a thing has left the place it was last seen at."""
    age_s = max(stamp_s - track.last_seen_s, 0.0)
    return 1.0 - track.existence * float(np.exp(-age_s / settings.tau_s))


def _could_be(sighting: Track, track: Track, settings: IdentitySettings) -> bool:
    """Not seen at the same time, of the same kind; furniture is not carried far, and what is built in or connected not
    at all as long as nobody has seen its place empty.
    """
    if track.last_seen_s >= sighting.first_seen_s or track.is_furniture is not sighting.is_furniture:
        return False
    if track.is_furniture and is_of_one_size(track.label.best) and track.state is not ObjectState.MISSING:
        return False
    if not track.is_furniture:
        return may_have_fallen_to(sighting, track, settings)
    near = np.linalg.norm((track.position - sighting.position)[:2]) < settings.furniture_reach_m
    return track.room == sighting.room and bool(near)


def apart_m(one: Track, other: Track) -> float:
    """Distance of two things in one room; infinite for those in two."""
    return float(np.linalg.norm(one.position - other.position)) if one.room == other.room else np.inf


def size_agreement(one: Track, other: Track) -> float:
    """1 for equal sizes, falling with the ratio of sorted sides; two centimeters are never held against it."""
    sides = zip(sorted(one.box.size_m), sorted(other.box.size_m), strict=True)
    worst = max(max(abs(a - b) - 0.02, 0.0) / max(a, b, 1e-3) for a, b in sides)
    return float(np.exp(-0.5 * (worst / 0.2) ** 2))
