"""What is no thing of its own, however often it is seen: a piece of somebody or of a thing, or what is in the hand; and
what is nobody: furniture, and what stands on it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.detection import Detection
from perception.objects.seeing.membership import Surroundings
from perception.objects.seeing.sight import Sight
from perception.objects.tracking.track import Track
from perception.vocabulary import category_of
from scene_graph.nodes import UNKNOWN_LABEL, ObjectState

_PERSON_M, _ABOVE_SEAT_M = 2.5, 0.1
_EDGE_M, _MOST = 0.02, 0.85
"""Such a share of the points of what is furniture is so near to it."""
_PART_EDGE_M = 0.02
"""So near to a small thing lies the middle of what is a part of it: of its upper side, depth shows a little more."""
_SIDE_M = 0.02
"""Thinner than this, in one direction of the floor, is what is just a side of a thing; the rest is the noise of depth.
"""
_NAMED = 0.6
"""From such a share on, the name that the network gives a detection counts."""
_BIT_SHARE = 0.6
"""Of the length of a thing: a bit of it is shorter."""
_ROW_EDGE_M = 0.1
"""The same where it is not yet known well how far the pieces of a row reach."""


@dataclass(frozen=True, kw_only=True)
class PieceSettings:
    """``hand_m``: within what distance of the hand nothing small is found: what the fingers hold or have just put down
    shows between them in pieces that look like many things. ``person_m``: within what distance of where somebody stands
    what has no name is a part of them, and so is furniture whose name is less likely than ``sure``: of legs alone the
    network makes the end of a desk or a narrow wardrobe.
    """

    hand_m: float = 0.25
    person_m: float = 0.3
    sure: float = 0.9


def has_no_name(track: Track) -> bool:
    """Whether nobody can say what it is."""
    return track.label.best == UNKNOWN_LABEL


def is_piece(
    track: Track, sight: Sight, matches: Mapping[int, Track], known: Sequence[Track], settings: PieceSettings
) -> bool:
    """Whether what has no name, or is furniture of a doubtful one, is none of the things: somebody, a part of a thing
    that is seen, or parts of several pieces of furniture in one.

    ``matches``: which thing each detection is, by its index; ``known``: things that have a node.
    """
    if track.is_furniture:
        doubtful = has_no_name(track) or track.label.confidence < settings.sure
        return doubtful and (is_of_somebody(track, sight, settings) or is_of_several(track, known))
    return has_no_name(track) and (is_of_somebody(track, sight, settings) or is_part(track, sight, matches))


def is_of_somebody(track: Track, sight: Sight, settings: PieceSettings) -> bool:
    """Whether it is where somebody stands: of furniture, the middle of what is seen, for its depth is a guess."""
    points = track.surface_points
    middle = np.median(points, axis=0) if len(points) else track.position
    x_m, y_m, _ = sight.surroundings.T_here_room[track.room].apply(middle).tolist()
    return bool((np.hypot(*(sight.persons - (x_m, y_m)).T) < settings.person_m).any())


def is_of_several(track: Track, known: Sequence[Track]) -> bool:
    """Whether furniture that was never seen as a whole is where several other pieces are, and not just one: of a row of
    them, the lower halves often are in one mask.
    """
    points = track.surface_points
    others = [t for t in known if t.is_furniture and t.room == track.room and t.state is ObjectState.PRESENT]
    if track.seen_whole or not len(points) or not others:
        return False
    return _share_out(np.array([other.box.contains(points, _ROW_EDGE_M) for other in others]))


def without_pieces(sight: Sight, tracks: Sequence[Track], settings: PieceSettings) -> tuple[Sight, set[int]]:
    """Without the small things that are looked at over the arm, bits of others, and what is several in one mask;
    numbers of the tracks that are in one.
    """
    told, in_one = list[Detection](), set[int]()
    for detection in sight.detections:
        if not category_of(detection.label, detection.shape.size_m).furniture:
            if is_under_arm(detection.shape.center, sight, settings) or _is_bit(detection, tracks, sight):
                continue
            if several := _seen_as_one(detection, tracks, sight):
                in_one |= {track.number for track in several}
                continue
        told.append(detection)
    return (replace(sight, detections=told) if len(told) < len(sight.detections) else sight), in_one


def _seen_as_one(detection: Detection, tracks: Sequence[Track], sight: Sight) -> list[Track]:
    """The small things that are known where something without a name is seen, if they are several: of a cup before a
    book, networks at times make one thing. Otherwise none.
    """
    if detection.label != UNKNOWN_LABEL:
        return []
    known = [track for track in tracks if _is_known_by_name(track)]
    within = [_within(detection, track, sight) for track in known]
    return [t for t, some in zip(known, within, strict=True) if some.any()] if _share_out(np.array(within)) else []


def lies_within(track: Track, known: Sequence[Track]) -> bool:
    """Whether the middle of a small thing is where another is that is known."""
    if track.is_furniture:
        return False
    others = [t for t in known if t is not track and t.room == track.room and _is_known_by_name(t)]
    return any(bool(other.box.contains(track.position[None], _PART_EDGE_M)[0]) for other in others)


def is_side(track: Track, known: Sequence[Track]) -> bool:
    """Whether a small thing is no more than a side of another that is known, whatever it is called: upright, as good as
    flat, and within the other or as good as: of the end of a book, networks make scissors.
    """
    if track.is_furniture or min(track.box.size_m[:2]) > _SIDE_M or track.box.size_m[2] <= min(track.box.size_m[:2]):
        return False
    others = [t for t in known if t is not track and t.room == track.room and _is_known_by_name(t)]
    half = np.array(track.box.size_m) / 2.0
    corners = track.box.place(half * np.array(tuple(product((-1.0, 1.0), repeat=3))))
    return any(bool(other.box.contains(corners, _PART_EDGE_M).all()) for other in others)


def _is_bit(detection: Detection, tracks: Sequence[Track], sight: Sight) -> bool:
    """Whether what nobody can name for sure is a bit of a small thing that is known, the rest of which is hidden: an
    end of a book that lies behind a cup. What is as long as the thing may be the whole of it, or have taken its place.
    """
    if detection.label != UNKNOWN_LABEL and dict(detection.distribution).get(detection.label, 0.0) >= _NAMED:
        return False
    long_m = max(detection.shape.size_m)
    return any(
        float(_within(detection, track, sight).mean()) > _MOST
        for track in tracks
        if _is_known_by_name(track) and long_m < _BIT_SHARE * max(track.box.size_m)
    )


def is_part(
    track: Track, sight: Sight, matches: Mapping[int, Track], center_px: tuple[float, float] | None = None
) -> bool:
    """Whether what has no name is a part of a small thing that is seen: it is within that, or as good as, or
    ``center_px``, where its middle is in the picture, is.
    """
    T_here_room = sight.surroundings.T_here_room
    for detection in sight.detections:
        other = matches.get(detection.index)
        if other is None or other is track or other.is_furniture or other.category.container or has_no_name(other):
            continue
        T_other_track = T_here_room[other.room].inverse() @ T_here_room[track.room]
        if bool(other.box.contains(T_other_track.apply(track.position)[None], _PART_EDGE_M)[0]):
            return True
        if center_px is not None and _shows(detection.mask, center_px):
            return True
    return False


def is_of_furniture(detection: Detection, tracks: Sequence[Track], surroundings: Surroundings) -> bool:
    """Whether what is taken for a person is a table or the like that is known, with what stands on it: nobody stands
    where that is, and before it or behind it there would be something of them; or a seat, with what stands on that:
    whoever sits there rises above it.
    """
    points = detection.cloud.points
    for track in tracks:
        known = track.node_id is not None and track.state is ObjectState.PRESENT and track.is_furniture
        category = track.category
        if not known or not category.support or track.room not in surroundings.T_here_room:
            continue
        T_here_room, size_m = surroundings.T_here_room[track.room], track.box.size_m
        x_m, y_m, _ = T_here_room.apply(track.position).tolist()
        yaw_rad = track.box.yaw_rad + T_here_room.yaw_rad
        height_m = size_m[2] + _ABOVE_SEAT_M if category.levels else _PERSON_M
        column = Box(np.array((x_m, y_m, height_m / 2.0)), (size_m[0], size_m[1], height_m), yaw_rad)
        if float(column.contains(points, _EDGE_M).mean()) > _MOST:
            return True
    return False


def is_at_hand(detection: Detection, sight: Sight, settings: PieceSettings) -> bool:
    """Whether a small thing seems to be where the fingers are."""
    if sight.hand is None:
        return False
    return float(np.linalg.norm(detection.shape.center - sight.hand)) < settings.hand_m


def is_under_arm(center: NDArray[np.float64], sight: Sight, settings: PieceSettings) -> bool:
    """Whether what has its middle there, (3,) in the frame of the view, is near the hand of an arm that is stretched
    out: the arm cuts it into pieces and hides what is beside it, so neither its looks nor its absence tell anything.
    """
    if sight.hand is None or not sight.reaching:
        return False
    return float(np.hypot(*(center - sight.hand)[:2])) < settings.hand_m


def _is_known_by_name(track: Track) -> bool:
    """Whether it is a small thing with a node and a name, and no other thing can be where it is; what the hand has just
    put down is not known to be there before it is seen.
    """
    known = track.node_id is not None and track.state is ObjectState.PRESENT and not has_no_name(track)
    return known and not track.awaited and not (track.is_furniture or track.category.container)


def _within(detection: Detection, track: Track, sight: Sight) -> NDArray[np.bool_]:
    """Which points of a detection, (N,), are where a thing is."""
    points = sight.surroundings.T_here_room[track.room].inverse().apply(detection.cloud.points)
    return track.box.contains(points, _PART_EDGE_M)


def _share_out(within: NDArray[np.bool_]) -> bool:
    """Whether most points are of one thing or another, and not just of one; ``within``: (things, points)."""
    return len(within) > 1 and float(within.any(axis=0).mean()) > _MOST >= float(within.mean(axis=1).max())


def _shows(mask: NDArray[np.bool_], pixel: tuple[float, float]) -> bool:
    """Whether a pixel (u, v) is of a mask."""
    u, v = (round(each) for each in pixel)
    return 0 <= v < mask.shape[0] and 0 <= u < mask.shape[1] and bool(mask[v, u])
