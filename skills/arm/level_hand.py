"""What a level hand meets on its way straight ahead to a thing: other things, and the furniture that carries it."""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.arm.hand import Hand, Size3
from skills.arm.roof import comes_from_above, is_covered, roof_over_m
from skills.furniture.furniture import Furniture
from skills.furniture.standing import stand_of
from skills.geometry import Points, Pose2


def prefers_level(snapshot: Snapshot, object_id: str, T_base_object: SE3, hand: Hand) -> bool:
    """Whether the hand should come level: something is over the object, unless that is so low that a level hand would
    close on its upper edge and there is room for one from above; or it is tall and nothing else is in the hand's way.
    """
    if roof_over_m(snapshot, object_id, hand) < inf:
        return not comes_from_above(snapshot, object_id, hand)
    tall = hand.is_tall(snapshot.object(object_id).size_m)
    return tall and not bars_level_hand(snapshot, object_id, T_base_object, hand)


def bars_level_hand(snapshot: Snapshot, object_id: str, T_base_object: SE3, hand: Hand) -> bool:
    """Whether another thing, or the back or an arm of the seat on which the object stands, reaches up into what a level
    hand sweeps from the base to a little beyond the object, or so nearly that nobody has measured it so well.
    """
    return bool(_is_barred(snapshot, object_id, *_bases(T_base_object), T_base_object.z_m, hand)[0])


def level_hand_barred(snapshot: Snapshot, object_id: str, frame: str, places: Points, hand: Hand) -> NDArray[np.bool_]:
    """The same for each of (N, 2) places in the frame of a room, from where the base faces the object; (N,)."""
    T_object_frame = snapshot.transform(object_id, frame)
    bases = Pose2.of(T_object_frame).apply(places)
    z_m = float(snapshot.position(object_id, frame)[2])
    return _is_barred(snapshot, object_id, bases, np.arctan2(-bases[:, 1], -bases[:, 0]), z_m, hand)


def _is_barred(
    snapshot: Snapshot, object_id: str, bases: Points, headings_rad: Points, z_m: float, hand: Hand
) -> NDArray[np.bool_]:
    """(N,): from ``bases`` (N, 2) that are so turned (N,), both in the frame of the object, ``z_m`` over the floor."""
    barred = _meets_support(snapshot, object_id, headings_rad, z_m, hand)
    judged = {object_id, *_harmless_below(snapshot, object_id, hand)}
    hand_low_m = hand.underside_m(snapshot.object(object_id).size_m, z_m) - hand.settings.level_air_m
    ahead = np.stack((np.cos(headings_rad), np.sin(headings_rad)), axis=-1)
    aside = np.stack((-ahead[:, 1], ahead[:, 0]), axis=-1)
    away_m = -(bases * ahead).sum(axis=1)
    for other in snapshot.of_type(ObjectNode):
        if other.id in judged or other.state is not ObjectState.PRESENT:
            continue
        if snapshot.room_of(other.id) != snapshot.room_of(object_id):
            continue
        T_object_other = snapshot.transform(object_id, other.id)
        x_m, y_m, over_m = T_object_other.translation_m
        if z_m + over_m + other.size_m[2] / 2 <= hand_low_m:
            continue
        from_base = np.array((x_m, y_m)) - bases
        along_m, across_m = (from_base * ahead).sum(axis=1), np.abs((from_base * aside).sum(axis=1))
        deep_m, wide_m = _half_extents_m(other.size_m, headings_rad - T_object_other.yaw_rad)
        swept = (along_m > 0.0) & (along_m < away_m + deep_m + hand.settings.beyond_m)
        barred |= (across_m < hand.geometry.hand_half_width_m + wide_m) & swept
    return barred


def _harmless_below(snapshot: Snapshot, object_id: str, hand: Hand) -> tuple[str, ...]:
    """What an object stands on, if nothing of that rises beside it, or only what is known to: what stands on furniture
    may have been measured as a part of it.
    """
    stand, room = stand_of(snapshot, object_id), snapshot.room_of(object_id)
    if stand is None or room is None or stand.furniture.walls_in:
        return ()
    known = bool(stand.furniture.obstacles) or not is_covered(snapshot, object_id, room, hand)
    return (stand.on,) if known else ()


def _half_extents_m(size_m: Size3, headings_rad: Points) -> tuple[Points, Points]:
    """How far a thing reaches from its middle along directions (N,) in its own frame, and across them: (N,) each.

    No farther than half its length: what is round is not seen as a square with corners.
    """
    half_x_m, half_y_m = size_m[0] / 2, size_m[1] / 2
    cosines, sines = np.abs(np.cos(headings_rad)), np.abs(np.sin(headings_rad))
    longest_m = max(half_x_m, half_y_m)
    along_m = np.minimum(half_x_m * cosines + half_y_m * sines, longest_m)
    return along_m, np.minimum(half_x_m * sines + half_y_m * cosines, longest_m)


def meets_support_level(snapshot: Snapshot, object_id: str, T_base_object: SE3, hand: Hand) -> bool:
    """Whether a level hand would meet the back or an arm of what an object stands on, on its way straight ahead from
    the edge to a little beyond the object; never where nobody knows of any.
    """
    return bool(_meets_support(snapshot, object_id, _bases(T_base_object)[1], T_base_object.z_m, hand)[0])


def _bases(T_base_object: SE3) -> tuple[Points, Points]:
    """Where the base is, (1, 2), and how it is turned, (1,), in the frame of the object."""
    T_object_base = T_base_object.inverse()
    return np.array([T_object_base.translation_m[:2]]), np.array([T_object_base.yaw_rad])


def _meets_support(
    snapshot: Snapshot, object_id: str, headings_rad: Points, z_m: float, hand: Hand
) -> NDArray[np.bool_]:
    """(N,): where the hand comes in those directions in the frame of the object, ``z_m`` over the floor."""
    stand = stand_of(snapshot, object_id)
    if stand is None:
        return np.zeros(len(headings_rad), np.bool_)
    T_object_support = snapshot.transform(object_id, stand.on)
    hand_low_m = hand.underside_m(snapshot.object(object_id).size_m, z_m) - hand.settings.level_air_m
    low_m = hand_low_m - z_m - float(T_object_support.z_m)
    return level_meets(stand.furniture, Pose2.of(T_object_support), np.zeros(2), headings_rad, low_m, hand)


def level_meets(
    furniture: Furniture, pose: Pose2, middle: Points, toward_rad: Points, low_m: float, hand: Hand
) -> NDArray[np.bool_]:
    """(N,) whether a level hand with its fingers about ``middle`` (2,) meets a back or an arm of furniture, for each of
    the directions ``toward_rad`` (N,) in which it comes; all in one frame, in which the furniture has that ``pose``.
    ``low_m``: height of what is lowest of the hand over the middle of the furniture.
    """
    if not furniture.obstacles:
        return np.zeros(len(toward_rad), np.bool_)
    settings, half_m = hand.settings, hand.geometry.hand_half_width_m
    along, across = np.meshgrid(
        np.arange(hand.tip_m + settings.level_air_m, -max(furniture.size_m[:2]), -settings.sweep_m),
        (-half_m, 0.0, half_m),
    )
    toward = np.stack((np.cos(toward_rad), np.sin(toward_rad)), axis=-1)[:, None]
    aside = np.stack((-toward[..., 1], toward[..., 0]), axis=-1)
    swept = pose.inverse_apply(
        (middle + along.ravel()[:, None] * toward + across.ravel()[:, None] * aside).reshape(-1, 2)
    )
    over = (np.abs(swept) < furniture.half_m).all(axis=1)
    return np.asarray((furniture.met(swept, low_m) & over).reshape(len(toward_rad), -1).any(axis=1))
