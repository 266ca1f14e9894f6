"""What the hand can take hold of and where it fits: its dimensions with the margins that are kept to them."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi, sin

from skills.furniture.furniture import Surface
from skills.ports import ArmGeometry, BodyLimits

Size3 = tuple[float, float, float]
DOWN_RAD = -pi / 2
"""Pitch of a hand that points down."""


@dataclass(frozen=True, kw_only=True)
class HandSettings:
    """How things are taken hold of, and how much room the hand is given. Where nothing else is said, a value was chosen
    by trying in the simulator with its camera's noise.
    """

    span_spare_m: float = 0.002
    """What the fingers open wider than the widest thing: what is seen of one is rather more than there is between them,
    a handle, an edge.
    """
    doubtful_width_m: float = 0.17
    """What looks wider than the fingers span, but not more than this, may be narrower when it is seen from near: from
    one side, nobody sees how deep a thing is.
    """
    opening_margin_m: float = 0.05
    """How much wider than a thing the fingers open."""
    narrow_margin_m: float = 0.03
    """The same where neighbors stand close."""
    tip_air_m: float = 0.008
    """Between the finger tips and what a thing stands on, unless that thing is flat."""
    flat_share: float = 0.25
    """How much of a flat thing's height the fingers may leave below them: held by no more than its upper half a phone
    slipped.
    """
    bite_m: float = 0.045
    """How far below a thing's top the pads' center goes, at most: what the fingers hold without the palm touching."""
    hover_m: float = 0.08
    """How far over a thing's top the pads are while the arm extends."""
    level_clearance_m: float = 0.06
    """The pads of a level hand stay so high over what a thing stands on."""
    level_standoff_m: float = 0.06
    """How far before a thing a level hand is, before it comes straight in."""
    level_share: float = 0.5
    """At this share of its height a level hand takes a thing: at its middle."""
    level_bite_m: float = 0.005
    """The middle of the fingers of a level hand is at least so far below a thing's top."""
    level_air_m: float = 0.015
    """Between the top of a thing and a level hand that passes over it, as both are measured."""
    over_air_m: float = 0.01
    """Between the finger tips and a thing over which they come in below a board."""
    tall_m: float = 0.16
    """What is as high, and ..."""
    tall_ratio: float = 2.0
    """... so many times as high as wide, swings when it is held at its top, and is held around its middle."""
    square_share: float = 0.15
    """What is wider than deep by no more than this share is taken from where the wrist turns less."""
    highest_m: float = 1.15
    """On what is higher than this above the floor, the arm puts nothing."""
    lowest_m: float = 0.15
    """Nor on a top lower than this."""
    lowest_board_m: float = 0.28
    """Nor on a board below another lower than this: what the hand holds passes over the base on its way in."""
    headroom_m: float = 0.03
    """Spared over the hand, and under what it holds while it comes in between boards, together."""
    beside_m: float = 0.015
    """Air between what moves in between boards and what stands there."""
    finger_air_m: float = 0.008
    """Between a finger and what it comes down beside."""
    turn_rad: float = 22.0 * pi / 180.0
    """The arm comes in between boards at most so far from straight."""
    before_m: float = 0.05
    """So near before boards a hand counts as being among them."""
    neighbor_air_m: float = 0.01
    """Around a finger from above, and what neighbors may be larger than believed."""
    thicker_m: float = 0.01
    """What back and arms of a seat may be thicker than believed: that is known of the kind only."""
    sweep_m: float = 0.03
    """How finely the hand's way over furniture is looked at."""
    beyond_m: float = 0.05
    """So far beyond a thing a level hand sweeps what stands there."""
    nameless_m: float = 0.35
    """What is smaller and has no name does not bar the way: the hand may have to push it, as what can be grasped."""
    stand_m: float = 0.4
    """So far before a shelf the middle of the base is, at least."""
    unknown_size_m: Size3 = (0.1, 0.1, 0.2)
    """Taken for the extent of what is held where nobody knows it."""
    unknown_grip: float = 0.6
    """At which share of its height it is held then."""
    roof_m: tuple[float, float] = (0.05, 0.6)
    """What is between these heights over a thing's top is over it."""


@dataclass(frozen=True, kw_only=True)
class Hand:
    """The robot's hand, as its description has it, with the margins that are kept. Sizes are (x, y, z) extents."""

    geometry: ArmGeometry = field(default_factory=ArmGeometry)
    limits: BodyLimits = field(default_factory=BodyLimits)
    settings: HandSettings = HandSettings()

    @property
    def span_m(self) -> float:
        """How wide a thing may be that is taken between the fingers."""
        return self.limits.gripper_opening_m[1] - self.settings.span_spare_m

    @property
    def tip_m(self) -> float:
        """From the pads' center to the finger tips, and a little air."""
        return self.geometry.pads_to_tips_m + self.settings.tip_air_m

    @property
    def highest_pads_m(self) -> float:
        """How high over the floor the lift brings the pads of a hand that points down."""
        return self.limits.lift_m[1] - self.geometry.hand_length_m

    def is_tall(self, size_m: Size3) -> bool:
        """Whether a thing is held better around its middle than at its top."""
        return size_m[2] >= max(self.settings.tall_m, self.settings.tall_ratio * max(size_m[:2]))

    def is_low(self, size_m: Size3) -> bool:
        """Whether the fingers of a level hand, as low as it goes, are above the middle of a thing."""
        return self.settings.level_clearance_m - size_m[2] / 2 > self.geometry.finger_half_height_m

    def level_pads_m(self, size_m: Size3, center_z_m: float) -> float:
        """Height of the pads' center when a level hand closes on a thing."""
        above_m = max(self.settings.level_clearance_m, self.settings.level_share * size_m[2])
        return center_z_m - size_m[2] / 2 + above_m

    def pads_from_above_m(self, size_m: Size3, center_z_m: float) -> float:
        """Height of the pads' center when a hand from above closes on a thing."""
        bottom_m, top_m = center_z_m - size_m[2] / 2, center_z_m + size_m[2] / 2
        lowest_m = min(self.tip_m, self.geometry.pads_to_tips_m + self.settings.flat_share * size_m[2])
        return max(bottom_m + lowest_m, top_m - min(self.settings.bite_m, size_m[2] / 2))

    def hover_m(self, size_m: Size3, center_z_m: float, roof_m: float) -> float:
        """Height of the pads over a thing before a hand from above comes down; ``roof_m``: as high as they may be."""
        return center_z_m + min(size_m[2] / 2 + self.settings.hover_m, roof_m)

    def underside_m(self, size_m: Size3, center_z_m: float) -> float:
        """Height that the lowest part of hand or arm keeps over on its way to a thing: what is lower is no obstacle to
        it.
        """
        if self.is_tall(size_m):
            middle_m = center_z_m + (self.settings.level_share - 0.5) * size_m[2]
            return middle_m - self.settings.level_clearance_m / 2
        return center_z_m + size_m[2] / 2 + self.settings.hover_m - self.tip_m

    def highest_underside_m(self, size_m: Size3) -> float:
        """How high over the floor the lift brings the lowest part of a hand that points down and of a thing that it
        took so.
        """
        hangs_m = self.pads_from_above_m(size_m, 0.0) + size_m[2] / 2
        return self.highest_pads_m - max(hangs_m, self.tip_m)

    def has_room_above(self, size_m: Size3, roof_m: float) -> bool:
        """Whether a hand that points down gets in over a thing."""
        return roof_m >= size_m[2] / 2 + self.tip_m + self.settings.over_air_m

    def headroom_m(self, height_m: float, above_bottom_m: float, pitch_rad: float) -> float:
        """How much must be free over a surface for a hand to come in with a thing so high that it holds there, and
        so.
        """
        arm_m = above_bottom_m + max(-sin(pitch_rad), 0.0) * self.geometry.hand_length_m + self.geometry.arm_half_m
        return max(height_m, arm_m) + self.settings.headroom_m

    def usual_headroom_m(self, size_m: Size3) -> float:
        """The same for a thing that is held as such things are mostly."""
        if self.is_tall(size_m):
            return self.headroom_m(size_m[2], self.settings.level_share * size_m[2], 0.0)
        above_bottom_m = max(size_m[2] - self.settings.bite_m, size_m[2] / 2, self.tip_m)
        return self.headroom_m(size_m[2], above_bottom_m, DOWN_RAD)

    def reaches(self, surface: Surface, center_m: float) -> bool:
        """Whether the arm gets down to a surface of furniture whose middle is so high above the floor."""
        height_m = center_m + surface.height_m
        lowest_m = self.settings.lowest_board_m if surface.is_covered else self.settings.lowest_m
        return lowest_m <= height_m <= self.settings.highest_m

    def finger_spare_m(self, size_m: Size3, opening_m: float) -> float:
        """How far beside its middle fingers that are so far apart can take a thing, however it is turned."""
        return max((opening_m - max(size_m[:2])) / 2 - self.settings.finger_air_m, 0.0)
