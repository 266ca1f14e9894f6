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
    """So much is drawn around a room: its doors' passages."""
    around_spots_m: float = 2.0
    """So much is drawn around start and goals where no room is known: room for a detour."""
    person_radius_m: float = 0.25
    """Of somebody who stands."""
    person_fresh_s: float = 5.0
    """Who was not seen for so long may have gone; what the LiDAR hits still counts."""
    flat_m: float = 0.03
    """Things lower than this (a rug) are driven over."""
    low_m: float = 0.3
    """What could be picked up stands on the floor if its bottom is lower than this, as nobody measures it well."""


@dataclass(frozen=True, kw_only=True)
class SurroundingsSettings:
    """Heights of what can be hit, how far to look, how long to remember, and over how many scans hits are averaged.

    ``blind_m``: nearer than this the mast's LiDAR looks over the floor. What it saw there last is remembered for
    ``fade_blind_s``, since it cannot be seen to be gone.
    """

    min_height_m: float = 0.04
    max_height_m: float = 1.80
    tall_m: float = 0.95
    max_range_m: float = 6.0
    body_radius_m: float = 0.20
    """Nearer is the body itself: less than its footprint."""
    arm_half_width_m: float = 0.12
    """So far aside of the arm's plane what is hit may be the hand, or what it holds."""
    beyond_hand_m: float = 0.15
    """The same ahead of the pads, once the arm is out by ..."""
    out_m: float = 0.08
    """... this."""
    blind_m: float = 0.95
    fade_low_s: float = 60.0
    fade_blind_s: float = 120.0
    fade_tall_s: float = 0.7
    min_hits: int = 2
    averaged: int = 5
    settled_s: float = 2.0
    patch_cells: int = 3
    """So many cells wide is a patch that is tall as a whole if a part of it is, with those around: a stride."""
    beside_m: float = 0.2
    """As near to something tall the floor is not judged: feet soon step on."""


@dataclass(frozen=True, kw_only=True)
class FloorReliefSettings:
    """``raised_m``: least height of what matters to the base. ``significance``: in standard errors of the mean.

    ``returns``: least number for a mean, ``most_returns``: after so many, new ones replace old. ``fade_s``: how long a
    spot is remembered. ``flattest_m``: least standard deviation assumed of a return's height.
    """

    raised_m: float = 0.015
    significance: float = 5.0
    returns: int = 8
    most_returns: int = 60
    fade_s: float = 300.0
    flattest_m: float = 0.005


@dataclass(frozen=True, kw_only=True)
class ObstacleSettings:
    """What the map of a room goes by."""

    map: MapSettings = field(default_factory=MapSettings)
    surroundings: SurroundingsSettings = field(default_factory=SurroundingsSettings)
    relief: FloorReliefSettings = field(default_factory=FloorReliefSettings)
