"""By what numbers plans are made."""

from __future__ import annotations

from dataclasses import dataclass, field

from planner.goals import GoalSettings


@dataclass(frozen=True, kw_only=True)
class OrderSettings:
    """How much is tried to put goals in order whose order is open."""

    exact: int = 8
    """So many goals are ordered exactly; 2^n·n² steps. Chosen: milliseconds."""
    tries: int = 20_000
    """Orders of more goals that are tried at most. Chosen: a fraction of a second."""
    few: int = 24
    """So many orders are all tried by the search itself: legs do not tell what can be left on the way. Chosen: those of
    four goals.
    """


@dataclass(frozen=True, kw_only=True)
class ObjectSearchSettings:
    """In which order places are looked at for what is not in its place."""

    usual: float = 4.0
    """How many times likelier a thing is in a room where its kind usually lies than in any other. Chosen: no data."""
    last: float = 8.0
    """The same for the room where it was last known. Chosen: what is not in its place was mostly put down nearby."""
    like: float = 2.0
    """The same for a room in which something of that name is known to lie. Chosen: no data."""
    large_m2: float = 12.0
    """Area of a room of middling size, as of homes: twice as large, twice as likely."""
    look_s: float = 6.0
    """Expected time to look at a place, as the robot takes it in the simulator."""
    speed_mps: float = 0.4
    """Expected average speed of driving, turns and doors included, as in the simulator."""


@dataclass(frozen=True, kw_only=True)
class SkillPlanningSettings:
    """Everything that the making of plans is tuned by."""

    order: OrderSettings = field(default_factory=OrderSettings)
    object_search: ObjectSearchSettings = field(default_factory=ObjectSearchSettings)
    goals: GoalSettings = field(default_factory=GoalSettings)
    most_stops: int = 16
    """With more stops than these, only those of the goal in turn are considered for leaving something on the way.
    Chosen: so that plans of twenty things take seconds.
    """
    least_timeout_s: float = 90.0
    """A step may act as long as this in any case before it counts as stuck. Chosen: a door is waited for, and a grasp
    tried again.
    """
    timeout_factor: float = 4.0
    """And it may take this many times the expected time. Chosen: ways around what stands in the way."""
