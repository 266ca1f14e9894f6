"""What generated houses are like; chosen, so that a robot of 0.3 m radius gets everywhere."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class LayoutSettings:
    """How rooms lie. Lengths between inner faces."""

    longest_m: float = 9.0
    """No room but a corridor is longer."""
    longest_corridor_m: float = 30.0
    slimmest: float = 3.2
    """No room is so many times as long as it is wide."""
    tries: int = 4
    """To split a piece of ground so that all rooms fit."""
    candidates: int = 8
    """Plans by the same dice of which the best is taken."""
    most_draws: int = 80
    """Dice are thrown at most so often for them."""


@dataclass(frozen=True, kw_only=True)
class CarvingSettings:
    """How rooms become other than rectangles."""

    arm_m: float = 1.4
    """An arm of a room is at least this wide."""
    side_m: float = 0.4
    """Every side of a room is at least this long."""
    open_m: float = 1.5
    """A recess in the facade is open to the air for at least this far."""
    tries: int = 60


@dataclass(frozen=True, kw_only=True)
class DoorwaySettings:
    """Doors of 80 to 120 cm, as they are sold, and openings up to 180 cm; millimeters."""

    frame_mm: int = 100
    """Between a door and the corners of both rooms, at least."""
    narrowest_mm: int = 800
    widest_mm: int = 1200
    widest_opening_mm: int = 1800
    between_doors_mm: int = 400
    porch_mm: int = 1500
    """So far nothing is built before a front door."""
    tries: int = 20


@dataclass(frozen=True, kw_only=True)
class PlanSettings:
    """A floor plan."""

    layout: LayoutSettings = field(default_factory=LayoutSettings)
    carving: CarvingSettings = field(default_factory=CarvingSettings)
    doorways: DoorwaySettings = field(default_factory=DoorwaySettings)


@dataclass(frozen=True, kw_only=True)
class FloorSettings:
    """What of a floor must stay free."""

    cell_m: float = 0.05
    """Side of the grid's cells."""
    robot_m: float = 0.35
    """Half of the width that a way needs: the robot's 0.30 m and a little."""
    door_free_m: float = 0.9
    door_side_m: float = 0.1
    """Before a door, so far into the room and beside its gap."""
    in_front_m: float = 0.5
    """A robot that comes through a door stands so far before it."""
    start_free_m: float = 0.5
    """Around where the robot starts."""
    least_left: float = 0.4
    """Share of the passable floor that furniture leaves."""


@dataclass(frozen=True, kw_only=True)
class FurnishingSettings:
    """How furniture stands, and what is on it."""

    floor: FloorSettings = field(default_factory=FloorSettings)
    gaps_m: tuple[float, float] = (0.02, 0.06)
    """Between a wall and what stands at it."""
    tries: int = 12
    """For each piece of furniture."""
    area_of_a_thing_m2: float = 0.1
    """Of a top: so much for each thing on it."""
    most_things: int = 2


@dataclass(frozen=True, kw_only=True)
class GenerationSettings:
    """A generated house."""

    plan: PlanSettings = field(default_factory=PlanSettings)
    furnishing: FurnishingSettings = field(default_factory=FurnishingSettings)
    farthest_m: float = 20.0
    """The house lies so far from the origin of its coordinates, so that nobody takes that for a place in it."""


@dataclass(frozen=True, kw_only=True)
class StockingSettings:
    """How a generated house is filled."""

    other_furniture: float = 0.25
    """Share of furniture that gives way to another kind of its size."""
    most_on_one: int = 7
    most_on_floor: int = 3
    usual_color: float = 0.5
    """Share of what has its usual color."""
    margin_m: float = 0.02
    """Between two things, and to the edge."""
    visitor_free_m: float = 0.35
    """Around who stands there."""
    robot_free_m: float = 0.4
    person_free_m: float = 0.6
    """So far around the middle of the robot, as it starts, nothing lies, and nobody stands."""
