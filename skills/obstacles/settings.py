"""What was tuned of knowing what is in the way. Where nothing else is said, a value was chosen by trying in the
simulator, whose LiDAR is as noisy as real ones.
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class MapSettings:
    """What counts as an obstacle, by the graph and around a room."""

    skin_m: float = 0.08
    """Points as near to a wall that the graph knows are that wall, blurred by the ranges' noise (20 mm)."""
    wall_step_m: float = 0.05
    """How far apart the points are that stand for a wall."""
    door_depth_m: float = 0.5
    """So far a door's passage reaches to both sides of the wall, and ..."""
    door_middle_m: float = 0.1
    """... so far in the wall is its middle: half of how thick walls are."""
    beyond_m: float = 0.05
    """By less than this nobody is beyond a wall: so well outlines and poses are known."""
    around_room_m: float = 0.7
    """So much is drawn around a room."""
    around_spots_m: float = 2.0
    """So much is drawn around start and goals where no room is known: room for a detour."""
    person_radius_m: float = 0.25
    """Of somebody who stands."""
    person_fresh_s: float = 5.0
    """Who was not seen for so long may have gone; what the LiDAR hits still counts."""
    flat_m: float = 0.03
    """Things lower than this (a rug) are driven over."""
    low_m: float = 0.3
    """What could be picked up stands on the floor if its bottom is lower than this."""


@dataclass(frozen=True, kw_only=True)
class SurroundingsSettings:
    """What counts as hit, and how long it is remembered."""

    min_height_m: float = 0.04
    """Lower is the floor."""
    max_height_m: float = 1.80
    """Higher is over the robot."""
    tall_m: float = 0.95
    """What reaches higher is tall: always in view, and gone when it is not hit."""
    max_range_m: float = 6.0
    """Farther nothing is remembered."""
    body_radius_m: float = 0.20
    """Nearer is the body itself: less than its footprint."""
    arm_half_width_m: float = 0.12
    """So far aside of the arm's plane what is hit may be the hand, or what it holds."""
    beyond_hand_m: float = 0.15
    """The same ahead of the pads, once the arm is out by ..."""
    out_m: float = 0.08
    """... this."""
    blind_m: float = 0.95
    """Nearer the mast's LiDAR looks over the floor: what it saw there cannot be seen to be gone."""
    fade_low_s: float = 60.0
    """So long low things are remembered ..."""
    fade_blind_s: float = 120.0
    """... and so long where the LiDAR looks over them."""
    fade_tall_s: float = 0.7
    """So long tall ones are."""
    min_hits: int = 2
    """A cell that is new needs so many hits of one scan."""
    averaged: int = 5
    """Over so many scans the place of the hits is averaged."""
    settled_s: float = 2.0
    """What was hit so lately stays, though the floor was seen there."""
    patch_cells: int = 3
    """So many cells wide is a patch that is tall as a whole if a part of it is, with those around it."""
    beside_m: float = 0.2
    """As near to something tall the floor is not judged: feet soon step on."""


@dataclass(frozen=True, kw_only=True)
class FloorReliefSettings:
    """What rises from the floor, told from the noise of the ranges."""

    raised_m: float = 0.015
    """Least height of what matters to the base."""
    significance: float = 5.0
    """In standard errors of the mean."""
    returns: int = 8
    """Least number for a mean."""
    most_returns: int = 60
    """After so many, new ones replace old."""
    fade_s: float = 300.0
    """How long a spot is remembered."""
    flattest_m: float = 0.005
    """Least standard deviation assumed of a return's height."""


@dataclass(frozen=True, kw_only=True)
class ObstacleSettings:
    """What the map of a room goes by."""

    map: MapSettings = field(default_factory=MapSettings)
    surroundings: SurroundingsSettings = field(default_factory=SurroundingsSettings)
    relief: FloorReliefSettings = field(default_factory=FloorReliefSettings)
