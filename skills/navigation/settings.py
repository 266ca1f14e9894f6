"""What was tuned of driving. Where nothing else is said, a value was chosen by trying in the simulator, whose LiDAR is
as noisy as real ones; costs are in meters of way that the robot would rather drive.
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True, kw_only=True)
class RouteSettings:
    """What keeps ways off obstacles."""

    comfort_m: float = 0.25
    """Cells with less clearance than the radius plus this cost more ..."""
    comfort_weight: float = 3.0
    """... by up to so many times, so that ways keep off obstacles where they can."""
    escape_m: float = 0.6
    """So far around a start that is too close to something the robot may look for a way off."""


@dataclass(frozen=True, kw_only=True)
class SafetySettings:
    """The last check before a velocity is sent."""

    reaction_s: float = 0.30
    """So long passes from a scan until the base begins to brake."""
    shares: tuple[float, ...] = (1.0, 0.75, 0.5, 0.3, 0.15)
    """Of the wanted velocity, tried in turn."""
    steps: int = 8
    """At so many moments of its stopping way the base is looked at."""
    retreat_mps: float = 0.08
    """How fast it backs away from what is too close."""
    far_m: float = 2.0
    """What is farther away cannot be reached before the next tick."""
    closer_m: float = 0.002
    """By so much the base may come closer to what is too close already."""


@dataclass(frozen=True, kw_only=True)
class PlanSettings:
    """Choosing one of several goals, again and again."""

    same_goal_m: float = 0.08
    """As near to the last goal it is the same."""
    keep_goal_m: float = 0.3
    """Credit of the goal chosen last, so that two equal goals do not take turns."""
    squeeze_m: float = 0.02
    """So much closer, and slowly, the base passes what leaves no other way: the body is less wide than planned."""


@dataclass(frozen=True, kw_only=True)
class GoalSettings:
    """Places from which something is come near to or looked at."""

    spacing_m: float = 0.15
    """How far apart they are."""
    near_m: tuple[float, ...] = (0.0, 0.1, 0.2, 0.35)
    """How much farther than wanted they may be."""
    far_m: tuple[float, ...] = (0.6, 0.9, 1.3)
    """The same for a look at what cannot be come near to."""
    last_resort_m: float = 20.0
    """As how many meters of way it counts to look from so far."""
    hidden_m: float = 30.0
    """As how many meters of way it counts that all of what one looks at hides behind something."""
    other_side_m: float = 6.0
    """So much way is made to look at a thing from the side that is wanted and not from the opposite one."""
    person_size_m: float = 0.4
    """How wide a person is, to keep off."""


@dataclass(frozen=True, kw_only=True)
class DriverSettings:
    """Tolerances and patience of one drive."""

    position_m: float = 0.05
    """As near to a goal the base is there."""
    yaw_rad: float = 0.03
    """The same for its heading."""
    passed_rad: float = 1.2
    """A goal that is farther aside than this, and not twice as far off, was passed."""
    replan_s: float = 1.0
    """So old a plan is made anew."""
    retry_s: float = 0.5
    """The same where there is none, or the base is off it."""
    stray_m: float = 0.35
    """Farther off the path than this the base is off it."""
    patience_s: float = 8.0
    """So long somebody in the way is given to move on."""
    no_way_s: float = 4.0
    """So long there may be no way."""
    step_m: float = 0.04
    """By so much the way left must get shorter to count."""
    detour_m: float = 0.3
    """By so much more it is another way."""
    most_detours: int = 3
    """More than so many without coming nearer are none."""
    person_near_m: float = 0.7
    """As near to what blocks the way is the person who does."""


@dataclass(frozen=True, kw_only=True)
class PursuitSettings:
    """How a path is followed; shares are of the body's limits."""

    cruise: float = 0.85
    """Of the speed, where there is room."""
    creep_mps: float = 0.10
    """Speed where there is none."""
    brake: float = 0.5
    """Of the deceleration, towards the goal."""
    turn: float = 0.8
    """Of the angular velocity."""
    look_ahead_m: tuple[float, float] = (0.25, 0.50)
    """How far along the path the point is that is driven to, when slow and when fast."""
    clearance_m: tuple[float, float] = (0.30, 0.60)
    """Between these distances from the nearest obstacle the speed is scaled."""
    turn_in_place_rad: float = 0.7
    """Farther off its heading than this the base turns in place, until it is off by no more than ..."""
    aligned_rad: float = 0.15
    """... this."""


@dataclass(frozen=True, kw_only=True)
class NavigationSettings:
    """What driving goes by. ``prediction_s``: so long an estimate of the pose is carried forward by the speed."""

    routes: RouteSettings = field(default_factory=RouteSettings)
    safety: SafetySettings = field(default_factory=SafetySettings)
    plan: PlanSettings = field(default_factory=PlanSettings)
    goals: GoalSettings = field(default_factory=GoalSettings)
    driver: DriverSettings = field(default_factory=DriverSettings)
    pursuit: PursuitSettings = field(default_factory=PursuitSettings)
    prediction_s: float = 0.25
    carry_share: float = 0.6
    """Share of the body's speed limits that is used with something in the hand."""
    carry_step_mps: float = 0.015
    """With something in the hand, how far a command may exceed the measured speed: what is held swings less."""
    carry_step_radps: float = 0.04
    """The same for turning."""
