"""What was tuned of finding a spot, getting there with what is held, and putting it down. Where nothing else is said, a
value was chosen by trying in the simulator; costs are in meters of way that the robot would rather drive.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class SpotSettings:
    """Where things may stand: on furniture, with a person, on the floor."""

    edge_m: float = 0.04
    """A thing keeps so far from an edge: that is known to the centimeter only."""
    gap_m: float = 0.03
    """Between the object and its neighbors; what a finger needs to open between them."""
    step_m: float = 0.04
    """How far apart spots are looked for."""
    fine_step_m: float = 0.01
    """The same where none is free so: a gap between things need not lie on the coarse steps."""
    ample_m: float = 0.10
    """More room than this around a thing is no better."""
    back_air_m: float = 0.03
    """Between a thing and the back of a seat: nearer, what is brought over the seat meets the back, which is higher."""
    strip_m: float = 0.48
    """How far in from an edge the arm reaches: 0.80 m from the axis less the base and its clearance."""
    ways: int = 4
    """In so many ways a thing is laid at most: turned anyhow or so that it fits, in coarse or fine steps."""
    handover_m: float = 1.8
    """Something is within a person's reach when it is at most this far from where they stand."""
    handover_spare_m: float = 0.3
    """By so much nearer it is put."""
    floor_radii_m: tuple[float, ...] = (0.55, 0.75, 0.95)
    """How far from a person, or from the robot, it is put on the floor."""
    floor_angles: int = 24
    """In how many directions."""
    floor_gap_m: float = 0.10
    """Air around a thing on the floor."""
    doorway_m: float = 0.6
    """So far from a doorway nothing is put on the floor."""
    blocked_m: float = 0.12
    """What stopped the arm may be so large."""


@dataclass(frozen=True, kw_only=True)
class PutDownSettings:
    """How what is held is brought to a spot and lowered, and how a spot is chosen among those that are free."""

    inspect_s: float = 1.2
    """So long a spot is looked at from near: several pictures."""
    above_rim_m: float = 0.04
    """So high over the rim of a container things are dropped."""
    spare_lift_m: float = 0.02
    """A surface may turn out to be so much higher when it is seen from near."""
    steep_rad: float = 0.1
    """A hand that is off the vertical by less points down, and one that is off the horizontal by less is level."""
    release_m: float = -0.004
    """So far over the height at which the object should stand the arm stops: below it, so that it does stand."""
    hover_m: float = 0.10
    """So far over a spot what is held is brought before it is lowered."""
    touch_m: float = 0.04
    """What stops the arm no higher over the spot than this, and ..."""
    out_m: float = 0.02
    """... no farther from it, is the surface."""
    slow_m: float = 0.04
    """The last centimeters are lowered step by step, which is slow."""
    step_m: float = 0.01
    """The length of a step."""
    in_m: float = 0.03
    """So high over a board, at most, what is held comes in."""
    seen_from_m: float = 0.42
    """Nearer to the base's axis what is seen may be the hand, drawn in, and what it holds."""
    own_m: float = 0.1
    """So near to what is held, or to the hand, it is the robot itself that is seen."""
    deep_m: float = 0.015
    """What reaches less far into the way counts for nothing: it is a little off, as everything that is measured."""
    over_m: float = 0.03
    """What is seen lower over the surface than this is the surface."""
    hand_height_m: float = 0.15
    """How high over the pads the hand and the arm behind it reach."""
    arm_half_width_m: float = 0.05
    """Half of how wide they are, at most, where nothing wider is held."""
    least_points: int = 15
    """Fewer points of the camera are noise."""
    slack_rad: float = 0.15
    """What the drive to a place may be off, seen from the spot."""
    slack_m: float = 0.06
    """The same in distance."""
    most_spots: int = 40
    """So many spots are compared at most: it takes a moment for each."""
    tight_m: float = 0.10
    """Less air than this around a spot costs something ..."""
    tight_weight: float = 3.0
    """... for each meter that is lacking."""
    looked_at_m: float = 0.1
    """So near to the chosen spot is where the robot looks; its hand may hide it."""
    barring_cost_m: float = 1.0
    """For each thing that could no longer be taken from the board if something stood before it."""


@dataclass(frozen=True, kw_only=True)
class PlaceSettings:
    """What PLACE goes by."""

    spots: SpotSettings = SpotSettings()
    put_down: PutDownSettings = PutDownSettings()
