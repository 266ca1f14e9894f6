"""How to take hold of a thing: low ones from above, tall ones around the middle with the hand level. Base frame.

A tall thing taken at its top swings from the fingers, and a bottle has its neck there; the hand taken level holds the
body.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, inf, pi, sin

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.arm.kinematics import arm_target
from skills.errors import Unreachable
from skills.furniture.boards import HAND_HALF_WIDTH_M, board_under, boards_of, headroom_m
from skills.furniture.containers import is_open_container
from skills.furniture.seats import is_seat, rims
from skills.geometry import Points, Pose2, wrap_rad
from skills.ports import ArmGeometry, ArmTarget, BodyLimits

Size3 = tuple[float, float, float]
Met = Callable[[float, float], int]
"""How many of the two fingers and of the two halves of the palm would come down on something: by the direction in
which the fingers close, base frame, and how far their pads are from the middle.
"""


def none_met(direction_rad: float, pad_m: float) -> int:
    """Nothing stands beside the object, or nothing is known of it."""
    del direction_rad, pad_m
    return 0


DOWN_RAD = -pi / 2
MAX_WIDTH_M = 0.118
"""The fingers open to 0.12 m. What is seen of a thing is rather more than there is between them: a handle, an edge."""
DOUBTFUL_WIDTH_M = 0.17
"""What looks wider than the fingers span, but not more than this, may be narrower when it is seen from near: from one
side, nobody sees how deep a thing is.
"""
OPENING_MARGIN_M, NARROW_MARGIN_M = 0.05, 0.03
"""How much wider than a thing the fingers open, and how much where neighbors stand close."""
TIP_M = 0.028
"""From the pads' center to the finger tips, and a little air: the pads stay this high above what the object stands on,
unless that is flat.
"""
FINGER_TIP_M, FLAT_SHARE = 0.02, 0.25
"""From the pads' center to the finger tips alone, and how much of a flat thing's height they may leave below them: held
by no more than its upper half it slips.
"""
PAD_DEPTH_M = 0.045
"""How far below an object's top the pads' center goes, at most: what the fingers can hold without the palm touching."""
FINGER_M = 0.012
"""How thick a finger is."""
HOVER_M = 0.08
LEVEL_CLEARANCE_M = 0.06
LEVEL_STANDOFF_M = 0.06
LEVEL_AIR_M = 0.015
"""Between the top of a thing and a level hand that passes over it, as both are measured."""
LEVEL_SHARE = 0.5
PALM_HALF_HEIGHT_M, FINGER_HALF_HEIGHT_M, LEVEL_BITE_M = 0.02, 0.015, 0.005
"""Half of how high palm and fingers of a level hand are, and how far at least below a thing's top their middle is."""
TIP_AIR_M = 0.01
"""Between the finger tips and a thing over which they come in below a board."""
SWEEP_M = 0.03
"""How finely the hand's way over a seat is looked at."""
TALL_M, TALL_RATIO = 0.16, 2.0
SQUARE_SHARE = 0.15


@dataclass(frozen=True, kw_only=True)
class Grasp:
    """One way to take an object: wrist angles, finger opening, height of the pads, and how to come there.

    ``pads_z_m``: pads' center when closing. ``hover_z_m``: pads' center while the arm extends over the object.
    ``back_off_m``: how much shorter the arm is before the last straight move (level grasps).
    """

    pitch_rad: float
    roll_rad: float
    opening_m: float
    pads_z_m: float
    hover_z_m: float
    back_off_m: float = 0.0

    def approach(
        self, x_m: float, geometry: ArmGeometry, limits: BodyLimits, *, clear_over_m: float = 0.0
    ) -> tuple[ArmTarget, ...]:
        """Arm targets in order: raised and retracted, in front of or above, and at the object ``x_m`` ahead.

        From above, the finger tips stay over ``clear_over_m`` until they are over the object, as far as the lift goes.

        Raises:
            Unreachable: a joint would leave its limits on the way.
        """
        final = arm_target(x_m, self.pads_z_m, self.pitch_rad, self.roll_rad, geometry, limits)
        before = arm_target(x_m - self.back_off_m, self.hover_z_m, self.pitch_rad, self.roll_rad, geometry, limits)
        higher_m = 0.0 if self.is_level else clear_over_m + TIP_M - self.hover_z_m
        over = replace(before, lift_m=min(before.lift_m + max(higher_m, 0.0), limits.lift_m[1]))
        raised = replace(over, extension_m=limits.extension_m[0])
        return (raised, before, final) if over == before else (raised, over, before, final)

    @property
    def is_level(self) -> bool:
        """Whether the hand comes from the side instead of from above."""
        return self.pitch_rad > DOWN_RAD / 2


def choose_grasp(
    size_m: Size3,
    T_base_object: SE3,
    *,
    level_first: bool,
    geometry: ArmGeometry,
    limits: BodyLimits,
    met: Met = none_met,
    roof_m: float = inf,
    level_too: bool = True,
) -> Grasp:
    """The first grasp that the arm can carry out at the object's present height and distance; ``met``: from above, the
    fingers close from where fewer of them come down on something; ``roof_m``: as ``roof_over_m`` gives it;
    ``level_too``: whether a level hand gets there at all.

    Raises:
        Unreachable: none can be; the error is that of the preferred grasp.
    """
    first: Unreachable | None = None
    roof_m = min(roof_m, highest_pads_m(geometry, limits) - float(T_base_object.z_m))
    options = grasp_options(size_m, T_base_object, level_first=level_first, limits=limits, met=met, roof_m=roof_m)
    for grasp in options:
        if grasp.is_level and not level_too:
            continue
        try:
            grasp.approach(float(T_base_object.x_m), geometry, limits)
        except Unreachable as error:
            first = first or error
        else:
            return grasp
    raise first or _no_way(size_m, T_base_object)


def can_grasp(
    size_m: Size3, T_base_object: SE3, *, geometry: ArmGeometry, limits: BodyLimits, level_too: bool = True
) -> bool:
    """Whether the arm can take an object that is so before it, in any way, or in any but level."""
    try:
        choose_grasp(size_m, T_base_object, level_first=False, geometry=geometry, limits=limits, level_too=level_too)
    except Unreachable:
        return False
    return True


def can_grasp_level(size_m: Size3, T_base_object: SE3, geometry: ArmGeometry, limits: BodyLimits) -> bool:
    """Whether the arm can take an object that is so before it with a level hand."""
    try:
        return choose_grasp(size_m, T_base_object, level_first=True, geometry=geometry, limits=limits).is_level
    except Unreachable:
        return False


def grasp_options(
    size_m: Size3,
    T_base_object: SE3,
    *,
    level_first: bool,
    limits: BodyLimits,
    met: Met = none_met,
    roof_m: float = inf,
) -> tuple[Grasp, ...]:
    """Grasps in order of preference; none for what is too wide for the fingers, or too low for a level hand where there
    is no room for one from above.
    """
    above, level = _from_above(size_m, T_base_object, limits, met, roof_m), _level(size_m, T_base_object, limits)
    options = (level, above) if level_first else (above, level)
    return tuple(option for option in options if option is not None)


def prefers_level(snapshot: Snapshot, object_id: str, T_base_object: SE3) -> bool:
    """Whether the hand should come level: something is over the object, unless that is so low that a level hand would
    close on its upper edge and there is room for one from above; or it is tall and nothing else is in the hand's way.
    """
    size_m = snapshot.object(object_id).size_m
    if roof_over_m(snapshot, object_id) < inf:
        return not comes_from_above(snapshot, object_id)
    return is_tall(size_m) and not bars_level_hand(snapshot, object_id, T_base_object)


def comes_from_above(snapshot: Snapshot, object_id: str) -> bool:
    """Whether a thing below a board is so low that a level hand would close on its upper edge, while there is room over
    it for a hand that points down.
    """
    size_m = snapshot.object(object_id).size_m
    return _is_low(size_m) and _has_room_above(size_m, roof_over_m(snapshot, object_id))


def roof_over_m(snapshot: Snapshot, object_id: str) -> float:
    """How high over the middle of a thing the pads of a hand that points down may be, so that the arm behind it stays
    below what is over the thing: infinite where nothing is, minus infinity where nobody knows how low that reaches.
    """
    room = snapshot.room_of(object_id)
    if room is None or not is_covered(snapshot, object_id, room):
        return inf
    board = board_under(snapshot, object_id)
    if board is None or not board.is_covered:
        return -inf
    hand_m = headroom_m(0.0, 0.0, DOWN_RAD, ArmGeometry())
    return board.free_m - snapshot.object(object_id).size_m[2] / 2 - hand_m


def is_tall(size_m: Size3) -> bool:
    """Whether a thing is held better around its middle than at its top."""
    return size_m[2] >= max(TALL_M, TALL_RATIO * max(size_m[:2]))


def underside_m(size_m: Size3, center_z_m: float) -> float:
    """Height that the lowest part of hand or arm keeps over on its way to a thing: what is lower is no obstacle to
    it.
    """
    if is_tall(size_m):
        return center_z_m + (LEVEL_SHARE - 0.5) * size_m[2] - LEVEL_CLEARANCE_M / 2
    return center_z_m + size_m[2] / 2 + HOVER_M - TIP_M


def underside_below_board_m(snapshot: Snapshot, object_id: str, center_z_m: float) -> float:
    """Height of the lowest part of the hand on its way in to a thing below a board, with a little air; in the frame of
    the height of the thing's middle.
    """
    size_m = snapshot.object(object_id).size_m
    if comes_from_above(snapshot, object_id):
        hover_m = center_z_m + min(size_m[2] / 2 + HOVER_M, roof_over_m(snapshot, object_id))
        return hover_m - TIP_M - LEVEL_AIR_M
    return _level_pads_m(size_m, center_z_m) - PALM_HALF_HEIGHT_M - LEVEL_AIR_M


def _level_pads_m(size_m: Size3, center_z_m: float) -> float:
    return center_z_m - size_m[2] / 2 + max(LEVEL_CLEARANCE_M, LEVEL_SHARE * size_m[2])


def pads_from_above_m(size_m: Size3, center_z_m: float) -> float:
    """Height of the pads' center when a hand from above closes on a thing."""
    bottom_m, top_m = center_z_m - size_m[2] / 2, center_z_m + size_m[2] / 2
    lowest_m = min(TIP_M, FINGER_TIP_M + FLAT_SHARE * size_m[2])
    return max(bottom_m + lowest_m, top_m - min(PAD_DEPTH_M, size_m[2] / 2))


def highest_underside_from_above_m(size_m: Size3, geometry: ArmGeometry, limits: BodyLimits) -> float:
    """How high over the floor the lift brings the lowest part of a hand that points down and of a thing that it took
    so.
    """
    hangs_m = pads_from_above_m(size_m, 0.0) + size_m[2] / 2
    return highest_pads_m(geometry, limits) - max(hangs_m, TIP_M)


def highest_pads_m(geometry: ArmGeometry, limits: BodyLimits) -> float:
    """How high over the floor the lift brings the pads of a hand that points down."""
    return limits.lift_m[1] - geometry.hand_length_m


def _is_low(size_m: Size3) -> bool:
    """Whether the fingers of a level hand, as low as it goes, are above the middle of a thing."""
    return LEVEL_CLEARANCE_M - size_m[2] / 2 > FINGER_HALF_HEIGHT_M


def _has_room_above(size_m: Size3, roof_m: float) -> bool:
    """Whether a hand that points down gets in over a thing."""
    return roof_m >= size_m[2] / 2 + TIP_M + TIP_AIR_M


def bars_level_hand(snapshot: Snapshot, object_id: str, T_base_object: SE3) -> bool:
    """Whether another thing, or the back or an arm of the seat on which the object stands, reaches up into what a level
    hand sweeps from the base to a little beyond the object, or so nearly that nobody has measured it so well.
    """
    return bool(_is_barred(snapshot, object_id, *_bases(T_base_object), T_base_object.z_m)[0])


def level_hand_barred(snapshot: Snapshot, object_id: str, frame: str, places: Points) -> NDArray[np.bool_]:
    """The same for each of (N, 2) places in the frame of a room, from where the base faces the object; (N,)."""
    T_object_frame = snapshot.transform(object_id, frame)
    bases = Pose2.of(T_object_frame).apply(places)
    z_m = float(snapshot.position(object_id, frame)[2])
    return _is_barred(snapshot, object_id, bases, np.arctan2(-bases[:, 1], -bases[:, 0]), z_m)


def _is_barred(
    snapshot: Snapshot, object_id: str, bases: Points, headings_rad: Points, z_m: float
) -> NDArray[np.bool_]:
    """(N,): from ``bases`` (N, 2) that are so turned (N,), both in the frame of the object, ``z_m`` over the floor."""
    barred = _meets_seat(snapshot, object_id, headings_rad, z_m)
    judged = {object_id, *_harmless_below(snapshot, object_id)}
    hand_low_m = underside_m(snapshot.object(object_id).size_m, z_m) - LEVEL_AIR_M
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
        barred |= (across_m < HAND_HALF_WIDTH_M + wide_m) & (along_m > 0.0) & (along_m < away_m + deep_m + 0.05)
    return barred


def _harmless_below(snapshot: Snapshot, object_id: str) -> tuple[str, ...]:
    """What an object stands on, if nothing of that rises beside it, or only the back and arms of a seat, of which it is
    known where they are: what stands on furniture may have been measured as a part of it.
    """
    support, room = snapshot.get(snapshot.support_of(object_id) or ""), snapshot.room_of(object_id)
    if not isinstance(support, ObjectNode) or room is None or is_open_container(support.label):
        return ()
    known = bool(rims(support)) if is_seat(support.label) else not is_covered(snapshot, object_id, room)
    return (support.id,) if known else ()


def _half_extents_m(size_m: Size3, headings_rad: Points) -> tuple[Points, Points]:
    """How far a thing reaches from its middle along directions (N,) in its own frame, and across them: (N,) each.

    No farther than half its length: what is round is not seen as a square with corners.
    """
    half_x_m, half_y_m = size_m[0] / 2, size_m[1] / 2
    cosines, sines = np.abs(np.cos(headings_rad)), np.abs(np.sin(headings_rad))
    longest_m = max(half_x_m, half_y_m)
    along_m = np.minimum(half_x_m * cosines + half_y_m * sines, longest_m)
    return along_m, np.minimum(half_x_m * sines + half_y_m * cosines, longest_m)


def meets_seat_level(snapshot: Snapshot, object_id: str, T_base_object: SE3) -> bool:
    """Whether a level hand would meet the back or an arm of the seat on which an object stands, on its way straight
    ahead from the seat's edge to a little beyond the object; never of what stands on anything else, nor of a seat whose
    back and arms nobody knows.
    """
    return bool(_meets_seat(snapshot, object_id, _bases(T_base_object)[1], T_base_object.z_m)[0])


def _bases(T_base_object: SE3) -> tuple[Points, Points]:
    """Where the base is, (1, 2), and how it is turned, (1,), in the frame of the object."""
    T_object_base = T_base_object.inverse()
    return np.array([T_object_base.translation_m[:2]]), np.array([T_object_base.yaw_rad])


def _meets_seat(snapshot: Snapshot, object_id: str, headings_rad: Points, z_m: float) -> NDArray[np.bool_]:
    """(N,): where the hand comes in those directions in the frame of the object, ``z_m`` over the floor."""
    seat = _seat_under(snapshot, object_id)
    if seat is None:
        return np.zeros(len(headings_rad), np.bool_)
    T_object_seat = snapshot.transform(object_id, seat.id)
    hand_low_m = underside_m(snapshot.object(object_id).size_m, z_m) - LEVEL_AIR_M
    pose, seat_z_m = Pose2.of(T_object_seat), z_m + float(T_object_seat.z_m)
    return level_meets_rims(seat, pose, seat_z_m, np.zeros(2), headings_rad, hand_low_m)


def level_meets_rims(
    seat: ObjectNode, pose: Pose2, seat_z_m: float, middle: Points, toward_rad: Points, low_m: float
) -> NDArray[np.bool_]:
    """(N,) whether a level hand with its fingers about ``middle`` (2,) meets the back or an arm of a seat, for each of
    the directions ``toward_rad`` (N,) in which it comes; all in one frame, in which the seat has that ``pose`` and its
    middle is ``seat_z_m`` high. ``low_m``: height of what is lowest of the hand.
    """
    along, across = np.meshgrid(
        np.arange(TIP_M + LEVEL_AIR_M, -max(seat.size_m[:2]), -SWEEP_M), (-HAND_HALF_WIDTH_M, 0.0, HAND_HALF_WIDTH_M)
    )
    toward = np.stack((np.cos(toward_rad), np.sin(toward_rad)), axis=-1)[:, None]
    aside = np.stack((-toward[..., 1], toward[..., 0]), axis=-1)
    hand = pose.inverse_apply(
        (middle + along.ravel()[:, None] * toward + across.ravel()[:, None] * aside).reshape(-1, 2)
    )
    over = (np.abs(hand) < np.array(seat.size_m[:2]) / 2).all(axis=1)
    met = np.zeros(len(hand), np.bool_)
    for rim in rims(seat):
        if seat_z_m + rim.top_m > low_m:
            met |= rim.covers(hand, 0.0) & over
    return np.asarray(met.reshape(len(toward_rad), -1).any(axis=1))


def _seat_under(snapshot: Snapshot, object_id: str) -> ObjectNode | None:
    """The seat on which an object stands, if it is known where its back is, or what its arms are."""
    support = snapshot.get(snapshot.support_of(object_id) or "")
    return support if isinstance(support, ObjectNode) and is_seat(support.label) and rims(support) else None


def is_covered(snapshot: Snapshot, object_id: str, room: str) -> bool:
    """Whether something reaches over the object: another thing's extent, or a board of it, is above its center, within
    half a meter.

    Arms and back of a seat do not: over the seat itself there is nothing.
    """
    node, support = snapshot.object(object_id), snapshot.support_of(object_id)
    top_m = float(snapshot.position(object_id, room)[2]) + node.size_m[2] / 2
    for other in snapshot.of_type(ObjectNode):
        if other.id == object_id or other.state is not ObjectState.PRESENT or snapshot.room_of(other.id) != room:
            continue
        if other.id == support and is_seat(other.label):
            continue
        x_m, y_m, _ = snapshot.transform(other.id, object_id).translation_m
        center_m = float(snapshot.position(other.id, room)[2])
        heights = (center_m + other.size_m[2] / 2, *(center_m + board.height_m for board in boards_of(other)))
        over = abs(x_m) < other.size_m[0] / 2 and abs(y_m) < other.size_m[1] / 2
        if over and any(top_m + 0.05 < height_m < top_m + 0.6 for height_m in heights):
            return True
    return False


def _from_above(size_m: Size3, pose: SE3, limits: BodyLimits, met: Met, roof_m: float) -> Grasp | None:
    side = _closing_side(size_m, pose.yaw_rad, limits, met)
    if side is None or not _has_room_above(size_m, roof_m):
        return None
    opening_m, roll_rad = side
    return Grasp(
        pitch_rad=max(DOWN_RAD, limits.wrist_pitch_rad[0]),
        roll_rad=roll_rad,
        opening_m=opening_m,
        pads_z_m=pads_from_above_m(size_m, pose.z_m),
        hover_z_m=pose.z_m + min(size_m[2] / 2 + HOVER_M, roof_m),
    )


def _level(size_m: Size3, pose: SE3, limits: BodyLimits) -> Grasp | None:
    yaw = pose.yaw_rad
    width_m = abs(size_m[0] * sin(yaw)) + abs(size_m[1] * cos(yaw))
    if width_m > MAX_WIDTH_M:
        return None
    pads_z_m = _level_pads_m(size_m, pose.z_m)
    if pads_z_m > pose.z_m + size_m[2] / 2 - LEVEL_BITE_M:
        return None
    depth_m = abs(size_m[0] * cos(yaw)) + abs(size_m[1] * sin(yaw))
    return Grasp(
        pitch_rad=0.0,
        roll_rad=0.0,
        opening_m=_opening_m(width_m, limits),
        pads_z_m=pads_z_m,
        hover_z_m=pads_z_m,
        back_off_m=LEVEL_STANDOFF_M + depth_m / 2,
    )


def _closing_side(size_m: Size3, yaw_rad: float, limits: BodyLimits, met: Met) -> tuple[float, float] | None:
    """Opening of the fingers and wrist roll for a grasp from above; ``None`` when neither side fits.

    Closing along direction a (from the base's x) needs roll = pi/2 - a, modulo a half turn. The side at which less of
    the hand meets something is taken, with the fingers wide open if that is no worse than less far; of two alike the
    narrow one; for something about as wide as deep, the one that turns the wrist less.
    """
    wide, narrow = max(size_m[:2]), min(size_m[:2])
    square = wide - narrow <= SQUARE_SHARE * wide
    sides = []
    for width_m, direction in ((size_m[0], yaw_rad), (size_m[1], yaw_rad + pi / 2)):
        roll = wrap_rad(2 * (pi / 2 - direction)) / 2
        for margin_m in (OPENING_MARGIN_M, NARROW_MARGIN_M) if width_m <= MAX_WIDTH_M else ():
            opening_m = _opening_m(width_m, limits, margin_m)
            cost = (met(direction, opening_m / 2), -margin_m, 0.0 if square else width_m, abs(roll))
            sides.append((cost, opening_m, roll))
    if not sides:
        return None
    _, opening_m, roll_rad = min(sides)
    return opening_m, roll_rad


def _opening_m(width_m: float, limits: BodyLimits, margin_m: float = OPENING_MARGIN_M) -> float:
    return min(width_m + margin_m, limits.gripper_opening_m[1])


def _no_way(size_m: Size3, pose: SE3) -> Unreachable:
    why = f"it is {min(size_m[:2]):.3f} m wide, the fingers span {MAX_WIDTH_M:.3f} m"
    if min(size_m[:2]) <= MAX_WIDTH_M:
        why = "there is no room for the hand over it, and it is too low or too wide to be taken from the side"
    return Unreachable(pose.x_m, pose.z_m, DOWN_RAD, why)
