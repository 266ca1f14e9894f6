"""How to take hold of a thing: low ones from above, tall ones around the middle with the hand level. Base frame.

A tall thing taken at its top swings from the fingers, and a bottle has its neck there; the hand taken level holds the
body.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import cos, inf, pi, sin

from scene_graph.geometry.se3 import SE3
from skills.arm.hand import DOWN_RAD, Hand, Size3
from skills.arm.kinematics import arm_target
from skills.errors import Unreachable
from skills.geometry import wrap_rad
from skills.ports import ArmTarget

Met = Callable[[float, float], int]
"""How many of the two fingers and of the two halves of the palm would come down on something: by the direction in
which the fingers close, base frame, and how far their pads are from the middle.
"""


def none_met(direction_rad: float, pad_m: float) -> int:
    """Nothing stands beside the object, or nothing is known of it."""
    del direction_rad, pad_m
    return 0


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

    def approach(self, x_m: float, hand: Hand, *, clear_over_m: float = 0.0) -> tuple[ArmTarget, ...]:
        """Arm targets in order: raised and retracted, in front of or above, and at the object ``x_m`` ahead.

        From above, the finger tips stay over ``clear_over_m`` until they are over the object, as far as the lift goes.

        Raises:
            Unreachable: a joint would leave its limits on the way.
        """
        robot, wrist = (hand.geometry, hand.limits), (self.pitch_rad, self.roll_rad)
        final = arm_target(x_m, self.pads_z_m, *wrist, *robot)
        before = arm_target(x_m - self.back_off_m, self.hover_z_m, *wrist, *robot)
        higher_m = 0.0 if self.is_level else clear_over_m + hand.tip_m - self.hover_z_m
        over = replace(before, lift_m=min(before.lift_m + max(higher_m, 0.0), hand.limits.lift_m[1]))
        raised = replace(over, extension_m=hand.limits.extension_m[0])
        return (raised, before, final) if over == before else (raised, over, before, final)

    @property
    def is_level(self) -> bool:
        """Whether the hand comes from the side instead of from above."""
        return self.pitch_rad > DOWN_RAD / 2


def choose_grasp(
    size_m: Size3,
    T_base_object: SE3,
    hand: Hand,
    *,
    level_first: bool,
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
    roof_m = min(roof_m, hand.highest_pads_m - float(T_base_object.z_m))
    for grasp in grasp_options(size_m, T_base_object, hand, level_first=level_first, met=met, roof_m=roof_m):
        if grasp.is_level and not level_too:
            continue
        try:
            grasp.approach(float(T_base_object.x_m), hand)
        except Unreachable as error:
            first = first or error
        else:
            return grasp
    raise first or _no_way(size_m, T_base_object, hand)


def can_grasp(size_m: Size3, T_base_object: SE3, hand: Hand, *, level_too: bool = True) -> bool:
    """Whether the arm can take an object that is so before it, in any way, or in any but level."""
    try:
        choose_grasp(size_m, T_base_object, hand, level_first=False, level_too=level_too)
    except Unreachable:
        return False
    return True


def can_grasp_level(size_m: Size3, T_base_object: SE3, hand: Hand) -> bool:
    """Whether the arm can take an object that is so before it with a level hand."""
    try:
        return choose_grasp(size_m, T_base_object, hand, level_first=True).is_level
    except Unreachable:
        return False


def grasp_options(
    size_m: Size3,
    T_base_object: SE3,
    hand: Hand,
    *,
    level_first: bool,
    met: Met = none_met,
    roof_m: float = inf,
) -> tuple[Grasp, ...]:
    """Grasps in order of preference; none for what is too wide for the fingers, or too low for a level hand where there
    is no room for one from above.
    """
    above, level = _from_above(size_m, T_base_object, hand, met, roof_m), _level(size_m, T_base_object, hand)
    options = (level, above) if level_first else (above, level)
    return tuple(option for option in options if option is not None)


def _from_above(size_m: Size3, pose: SE3, hand: Hand, met: Met, roof_m: float) -> Grasp | None:
    side = _closing_side(size_m, pose.yaw_rad, hand, met)
    if side is None or not hand.has_room_above(size_m, roof_m):
        return None
    opening_m, roll_rad = side
    return Grasp(
        pitch_rad=max(DOWN_RAD, hand.limits.wrist_pitch_rad[0]),
        roll_rad=roll_rad,
        opening_m=opening_m,
        pads_z_m=hand.pads_from_above_m(size_m, pose.z_m),
        hover_z_m=hand.hover_m(size_m, pose.z_m, roof_m),
    )


def _level(size_m: Size3, pose: SE3, hand: Hand) -> Grasp | None:
    yaw = pose.yaw_rad
    width_m = abs(size_m[0] * sin(yaw)) + abs(size_m[1] * cos(yaw))
    if width_m > hand.span_m:
        return None
    pads_z_m = hand.level_pads_m(size_m, pose.z_m)
    if pads_z_m > pose.z_m + size_m[2] / 2 - hand.settings.level_bite_m:
        return None
    depth_m = abs(size_m[0] * cos(yaw)) + abs(size_m[1] * sin(yaw))
    return Grasp(
        pitch_rad=0.0,
        roll_rad=0.0,
        opening_m=_opening_m(width_m, hand, hand.settings.opening_margin_m),
        pads_z_m=pads_z_m,
        hover_z_m=pads_z_m,
        back_off_m=hand.settings.level_standoff_m + depth_m / 2,
    )


def _closing_side(size_m: Size3, yaw_rad: float, hand: Hand, met: Met) -> tuple[float, float] | None:
    """Opening of the fingers and wrist roll for a grasp from above; ``None`` when neither side fits.

    Closing along direction a (from the base's x) needs roll = pi/2 - a, modulo a half turn. The side at which less of
    the hand meets something is taken, with the fingers wide open if that is no worse than less far; of two alike the
    narrow one; for something about as wide as deep, the one that turns the wrist less.
    """
    wide, narrow, settings = max(size_m[:2]), min(size_m[:2]), hand.settings
    square = wide - narrow <= settings.square_share * wide
    margins_m = (settings.opening_margin_m, settings.narrow_margin_m)
    sides = []
    for width_m, direction in ((size_m[0], yaw_rad), (size_m[1], yaw_rad + pi / 2)):
        roll = wrap_rad(2 * (pi / 2 - direction)) / 2
        for margin_m in margins_m if width_m <= hand.span_m else ():
            opening_m = _opening_m(width_m, hand, margin_m)
            cost = (met(direction, opening_m / 2), -margin_m, 0.0 if square else width_m, abs(roll))
            sides.append((cost, opening_m, roll))
    if not sides:
        return None
    _, opening_m, roll_rad = min(sides)
    return opening_m, roll_rad


def _opening_m(width_m: float, hand: Hand, margin_m: float) -> float:
    return min(width_m + margin_m, hand.limits.gripper_opening_m[1])


def _no_way(size_m: Size3, pose: SE3, hand: Hand) -> Unreachable:
    why = f"it is {min(size_m[:2]):.3f} m wide, the fingers span {hand.span_m:.3f} m"
    if min(size_m[:2]) <= hand.span_m:
        why = "there is no room for the hand over it, and it is too low or too wide to be taken from the side"
    return Unreachable(pose.x_m, pose.z_m, DOWN_RAD, why)
