"""What was tuned of going somewhere: how long that takes, what counts as being there, and crossing doors. Where nothing
else is said, a value was chosen by trying in the simulator.
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class NearnessSettings:
    """How near the robot must be to something to be at it, from the base's axis."""

    object_m: float = 0.85
    """To the extent of a piece of furniture."""
    graspable_m: float = 1.05
    """To that of a thing to be grasped: the arm's span."""
    person_m: float = 1.50
    """To the middle of a person."""
    door_m: float = 1.50
    """To the middle of a door."""


@dataclass(frozen=True, kw_only=True)
class LaneSettings:
    """Which straight ways through a gap are tried."""

    wall_m: float = 0.2
    """How thick a wall is taken to be."""
    beyond_m: float = 0.9
    """So far beyond the wall a crossing ends: the base stands free in the far room."""
    front_m: float = 0.7
    """So far before the wall it begins."""
    most_aslant_rad: float = 0.79
    """Lanes are at most so far from straight."""
    steps: tuple[tuple[float, float], ...] = ((0.03, 0.26), (0.015, 0.065))
    """How far apart the lanes that are tried are, aside in meters and in bearing: close to each other only at last."""
    same_m: float = 0.02
    """Lanes as near to each other ..."""
    same_rad: float = 0.02
    """... and as parallel are the same to a robot."""


@dataclass(frozen=True, kw_only=True)
class CrossingSettings:
    """Where to stand before a door, how to drive through, and when to give up."""

    lanes: LaneSettings = field(default_factory=LaneSettings)
    other_fronts_m: tuple[float, ...] = (0.8, 0.6, 0.95, 0.5, 0.42)
    """From how far before it a door may be crossed too, when something stands there, and ..."""
    aside_m: tuple[float, ...] = (0.0, 0.08, -0.08)
    """... from how far aside."""
    thresholds_m: tuple[float, ...] = (0.3, 0.15)
    """From where it may be, at last, when something lies where a robot lines up: in the gap, reached from beside."""
    position_m: float = 0.04
    """How well the base lines up."""
    speed_mps: float = 0.30
    """In the gap."""
    squeeze_mps: float = 0.12
    """No more than a crawl, where nothing but the bare body fits."""
    look_ahead_m: float = 0.35
    """Along the axis."""
    turn_in_place_rad: float = 0.5
    """Farther off than this the base turns first."""
    closed_s: float = 1.5
    """So long a panel must be seen."""
    patience_s: float = 8.0
    """So long anything else is given to move away."""
    panel_share: float = 0.8
    """Of the gap's width, what a closed door fills at least."""
    panel_bin_m: float = 0.05
    """In strips so wide that is measured."""
    panel_heights: tuple[float, float] = (0.5, 0.95)
    """Between these shares of a door's height a panel shows, but no crate, and no lintel."""
    person_m: float = 0.4
    """So far around the middle of somebody reaches what the LiDAR sees of them, from near and while they walk."""
    lane_spare_m: float = 0.03
    """Air beside the body in a lane."""
    tries: int = 3
    """So often another lane is tried."""


@dataclass(frozen=True, kw_only=True)
class GotoSettings:
    """What GOTO goes by."""

    near: NearnessSettings = field(default_factory=NearnessSettings)
    crossing: CrossingSettings = field(default_factory=CrossingSettings)
    speed_mps: float = 0.35
    """For what a way takes: turns and slow stretches included."""
    settle_s: float = 6.0
    """For lining up and looking."""
    unknown_way_m: float = 10.0
    """Assumed where the way is not known."""
    person_standoff_m: float = 0.65
    """How near to a person the robot stands."""
    standoff_m: float = 0.9
    """How near to a door."""
    least_standoff_m: float = 0.42
    """Nearest that the base's axis comes to a footprint: the planning radius and what drawing on the grid takes."""
    through_m: float = 0.5
    """So far beyond the wall a known room is entered: out of the gap, and no detour to what stands beside it."""
    doors_from_m: tuple[float, ...] = (0.8, 0.6, 1.2, 0.45)
    """From how far a door may be looked at where it cannot be from the wanted distance, and ..."""
    doors_aside_deg: tuple[float, ...] = (0.0, 25.0, -25.0, 45.0, -45.0)
    """... from which sides, when something stands before it."""
    look_s: float = 1.2
    """So long a thing is looked at: several pictures."""
