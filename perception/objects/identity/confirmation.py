"""What a stable new sighting is: a further part of known furniture, a known thing that moved, or something new."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from perception.objects.beliefs import agreement, share_agreement
from perception.objects.identity.identity import (
    IdentitySettings,
    apart_m,
    likeness,
    may_have_fallen_to,
    same_thing_moved,
    size_agreement,
)
from perception.objects.tracking.relations import support_probability
from perception.objects.tracking.track import Track
from perception.vocabulary import carries_things, category_of, is_of_one_size
from scene_graph.nodes import UNKNOWN_LABEL, ObjectState

Array = NDArray[np.float64]
Places = Mapping[int, tuple[str, Array]]
"""Track number -> room and position (3,) from which a thing was taken into the hand."""
_SAME_PLACE_M = 0.12
_SAME_COLOR = 0.4
_SAME_LOOK, _SAME_NAME, _SAME_BODY = 0.6, 0.1, 0.85
"""Of what slipped, or seems to be another thing in the same place: how well color and size agree with what is there,
and how far the names may differ; from where on the name of what slipped does not matter.
"""
_SAME_SPOT = 0.4
"""Of the width of the narrower of two things: nearer to each other, their middles are those of one."""
_BOX_MARGIN_M = 0.1
_UNSEEN_S = 0.3
_SAME_SPACE = 0.5
_WITHIN = 0.9
_SURE = 0.9
_LONGER = 1.4
_LIKE_USUAL, _REST = 0.4, 0.5
"""Shares of the usual length: by how much that of a thing differs at most, and what is left of another at least."""


def known_as(
    sighting: Track,
    known: Sequence[Track],
    *,
    taken_from: Places,
    looked_before: Mapping[str, float],
    settings: IdentitySettings,
) -> Track | None:
    """The known thing that a sighting is, if any.

    ``looked_before``: when each room and support was first inspected, by node.
    """
    put_here = next((track for track in known if _was_put_here(sighting, track)), None)
    if put_here is not None:
        return put_here
    fell_here = [t for t in known if _fell_here(sighting, t, settings) or _lies_near(sighting, t, settings)]
    if fell_here:
        return min(fell_here, key=lambda track: apart_m(sighting, track))
    for track in known:
        in_its_place = _in_its_place(sighting, track, settings)
        if in_its_place or is_fragment(sighting, track) or _never_taken(sighting, track, taken_from, settings):
            return track
    place_known = _looked_there_before(sighting, known, looked_before)
    return same_thing_moved(sighting, known, place_known=place_known, settings=settings)


def turned_up(
    missing: Track, known: Sequence[Track], *, looked_before: Mapping[str, float], settings: IdentitySettings
) -> Track | None:
    """The other thing that a missing one is: a look-alike in its very place, or what it was moved to become: seen at
    its new place before it was missed at the old.

    Elsewhere, only a look-alike that turned up after the missing one was last seen, where one had looked before and
    seen nothing; and only if there is no second one like it, be it known for long: where such things come in numbers,
    one that nobody had noticed, behind another, is likelier than one that was moved. Never what the hand itself has put
    there.
    """
    alike = [
        track
        for track in known
        if track.state is ObjectState.PRESENT
        and track.is_furniture is missing.is_furniture
        and _is_like(track, missing, settings)
    ]
    in_its_spot = next((track for track in alike if _stands_in(track, missing) and not track.carried), None)
    if in_its_spot is not None or len(alike) != 1:
        return in_its_spot
    (only,) = alike
    later = only.first_seen_s > missing.last_seen_s and may_have_fallen_to(only, missing, settings)
    if not later or only.carried or not _looked_there_before(only, known, looked_before):
        return None
    return only


def _in_its_place(sighting: Track, track: Track, settings: IdentitySettings) -> bool:
    """Whether a sighting stands where a like thing is said to be, or was missed, that is no longer seen: two cannot be
    in one place.
    """
    small = not sighting.is_furniture and not track.is_furniture
    unseen = track.state is not ObjectState.HELD and track.last_seen_s < sighting.last_seen_s - _UNSEEN_S
    if not (small and unseen and track.room == sighting.room):
        return False
    return _is_like(sighting, track, settings) and _touch(sighting, track)


def _was_put_here(sighting: Track, track: Track) -> bool:
    """Whether a small sighting of much the same color is where the hand has just put something that was not seen since:
    half hidden by the hand, it may look like anything.
    """
    if not track.awaited or sighting.is_furniture or track.room != sighting.room:
        return False
    return _touch(sighting, track) and share_agreement(sighting.color.shares, track.color.shares) >= _SAME_COLOR


def _fell_here(sighting: Track, track: Track, settings: IdentitySettings) -> bool:
    """Whether a small sighting of the same size and color lies near where a thing has just slipped from the hand: what
    lies otherwise than it stood may well be called otherwise, and what is just as large, whatever it is called.
    """
    if not track.fell or sighting.is_furniture or track.last_seen_s >= sighting.first_seen_s:
        return False
    near = apart_m(sighting, track) <= settings.near_m
    return near and (_looks_the_same(sighting, track) or _body_agreement(sighting, track) >= _SAME_BODY)


def _lies_near(sighting: Track, missing: Track, settings: IdentitySettings) -> bool:
    """Whether a small sighting, as large and of the same color, lies near where a thing is missed, or below: of what
    has toppled or was knocked down, nobody may be able to say what it is. It may have a name only where the hand had
    just closed on the thing: else it is likelier another.
    """
    if missing.state is not ObjectState.MISSING or missing.is_furniture or sighting.is_furniture:
        return False
    if sighting.room != missing.room or missing.last_seen_s >= sighting.first_seen_s:
        return False
    if sighting.label.best != UNKNOWN_LABEL and not missing.touched:
        return False
    away_m = float(np.hypot(*(sighting.position - missing.position)[:2]))
    alike = _SAME_LOOK if sighting.label.best == UNKNOWN_LABEL else _SAME_BODY
    return away_m <= settings.near_m and _body_agreement(sighting, missing) >= alike


def _is_like(sighting: Track, track: Track, settings: IdentitySettings) -> bool:
    """Whether both may be one by name, color and size; in the very same place the name may differ: half hidden, or from
    another side, a yellow book looks like a banana. What is missed may lie near without a name.
    """
    if likeness(sighting, track) >= settings.likeness_min:
        return True
    small = not sighting.is_furniture and not track.is_furniture
    in_place = small and sighting.room == track.room and _touch(sighting, track)
    return (in_place and _looks_the_same(sighting, track)) or _lies_near(sighting, track, settings)


def _looks_the_same(sighting: Track, track: Track) -> bool:
    """Whether color and size agree well, and the names are not out of the question."""
    label = agreement(sighting.label.distribution, track.label.distribution)
    return _body_agreement(sighting, track) >= _SAME_LOOK and label >= _SAME_NAME


def _body_agreement(sighting: Track, track: Track) -> float:
    """How well color and size agree, 0 to 1."""
    return share_agreement(sighting.color.shares, track.color.shares) * size_agreement(sighting, track)


def _touch(one: Track, other: Track) -> bool:
    apart_m = np.abs(one.position - other.position)
    return bool(np.all(apart_m < (np.asarray(one.box.size_m) + np.asarray(other.box.size_m)) / 2))


def _stands_in(one: Track, other: Track) -> bool:
    """Whether two known things are said to be so much in one place that there can be only one."""
    away_m = float(np.hypot(*(one.position - other.position)[:2]))
    narrow_m = min(*one.box.size_m[:2], *other.box.size_m[:2])
    return one.room == other.room and _touch(one, other) and away_m < _SAME_SPOT * narrow_m


def _looked_there_before(sighting: Track, known: Sequence[Track], looked_before: Mapping[str, float]) -> bool:
    place = _place_of(sighting, known) or sighting.room
    return looked_before.get(place, np.inf) < sighting.first_seen_s - 1.0


def undecided(sighting: Track, known: Sequence[Track], settings: IdentitySettings) -> bool:
    """Whether a look-alike is just being missed at its place: a few more frames will tell whether it has moved here."""
    return any(
        track.state is ObjectState.PRESENT
        and track.misses > 0
        and track.last_seen_s < sighting.first_seen_s
        and likeness(sighting, track) >= settings.likeness_min
        for track in known
    )


def is_fragment(sighting: Track, track: Track) -> bool:
    """Whether new furniture is a part of known furniture: of the same kind, it lies within its box; of another, both
    fill the same space, or it lies within and was never seen as a whole or has no name to rely on: from near, a part of
    a toilet may look like a bin, and the side of a desk like a shelf, whereas a chair pushed under a table shows
    itself, and so does a stove in a row of counters.
    """
    if not (sighting.is_furniture and track.is_furniture and track.room == sighting.room):
        return False
    if track.state is not ObjectState.PRESENT:
        return False
    inside = _share_inside(sighting, track)
    if track.label.best == sighting.label.best:
        return inside > 0.3
    if inside > _WITHIN and (not sighting.seen_whole or _is_doubtful(sighting)):
        return not _is_built_in(sighting, track)
    return inside > _SAME_SPACE and _share_inside(track, sighting) > _SAME_SPACE


def _is_doubtful(track: Track) -> bool:
    """Whether it has no name to rely on."""
    return track.label.best == UNKNOWN_LABEL or track.label.confidence < _SURE


def _is_built_in(sighting: Track, track: Track) -> bool:
    """Whether new furniture surely stands in a row with known furniture that was taken for longer than it is."""
    return sighting.label.confidence >= _SURE and _may_be_built_in(sighting, track)


def may_prove_built_in(sighting: Track, track: Track) -> bool:
    """Whether further frames may show that what seems to be a part of known furniture is a piece of its own."""
    both = sighting.is_furniture and track.is_furniture and track.state is ObjectState.PRESENT
    return both and sighting.label.best != track.label.best and _may_be_built_in(sighting, track)


def _may_be_built_in(sighting: Track, track: Track) -> bool:
    """Whether new furniture is of a kind of one size everywhere and of that size, and known furniture without it is
    still as long as its kind may be.
    """
    if not is_of_one_size(sighting.label.best):
        return False
    usual_m, rest_m = _usual_m(sighting), _long_m(track) - _long_m(sighting)
    return abs(_long_m(sighting) - usual_m) < _LIKE_USUAL * usual_m and rest_m >= _REST * _usual_m(track)


def _long_m(track: Track) -> float:
    return max(track.box.size_m[:2])


def _usual_m(track: Track) -> float:
    return max(category_of(track.label.best).size_m[:2])


def is_double(one: Track, other: Track) -> bool:
    """Whether two known pieces of furniture are one that was first seen from two sides, or under two names: of the same
    kind, most of one lies in the other; of two kinds, as a chair pushed under a table, only if it is so both ways, or
    nobody can say what lies within what is known well. No piece that is known well to stand by itself is taken for a
    part of a longer one.
    """
    if not (one.is_furniture and other.is_furniture and one.room == other.room):
        return False
    alike = one.label.best == other.label.best
    longer, shorter = sorted((one, other), key=_long_m, reverse=True)
    if not alike and shorter.stands_by_itself and _long_m(longer) > _LONGER * _long_m(shorter):
        return False
    away_m = float(np.hypot(*(one.position - other.position)[:2]))
    reach_m = sum(float(np.hypot(*track.box.size_m[:2])) / 2.0 for track in (one, other))
    if away_m > reach_m + _BOX_MARGIN_M:
        return False
    if not alike and _is_doubtful(shorter) and not _is_doubtful(longer) and _share_inside(shorter, longer) > _WITHIN:
        return True
    shares = _share_inside(one, other), _share_inside(other, one)
    return (max(shares) if alike else min(shares)) > _SAME_SPACE


def _share_inside(part: Track, whole: Track) -> float:
    points = part.surface_points
    return float(whole.box.contains(points, _BOX_MARGIN_M).mean()) if len(points) else 0.0


def _never_taken(sighting: Track, track: Track, taken_from: Places, settings: IdentitySettings) -> bool:
    """Whether a thing said to be in the hand is seen where it was before: the grasp was a phantom."""
    if track.state is not ObjectState.HELD or track.number not in taken_from:
        return False
    room, position = taken_from[track.number]
    near = float(np.linalg.norm(position - sighting.position)) < _SAME_PLACE_M
    return room == sighting.room and near and likeness(sighting, track) >= settings.likeness_min


def _place_of(sighting: Track, known: Sequence[Track]) -> str | None:
    """The node of what carries the sighting, ``None`` for one on the floor."""
    carriers = [t for t in known if t.room == sighting.room and carries_things(t.label.best, t.box.size_m)]
    chances = [(support_probability(sighting.box, t.box, t.category, sigma_m=0.04, rim_m=0.02)[1], t) for t in carriers]
    best = max(chances, key=lambda pair: (pair[0], -pair[1].number), default=None)
    return best[1].node_id if best is not None and best[0] > 0.2 else None
