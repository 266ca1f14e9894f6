"""What was tuned of moving the arm, of judging its way, and of choosing where to stand for it. Where nothing else is
said, a value was chosen by trying in the simulator; costs are in meters of way that the robot would rather drive.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from math import pi

from skills.ports import ArmTarget


@dataclass(frozen=True, kw_only=True)
class ArmSettings:
    """How the arm is moved and carried, and from when on it counts as there, stopped, or empty."""

    stowed: ArmTarget = field(default_factory=partial(ArmTarget, lift_m=0.75, extension_m=0.0, wrist_pitch_rad=-pi / 2))
    """How the empty arm travels: within the base's outline, below the camera, the hand pointing down."""
    carry_lift_m: float = 0.95
    """How high things are carried: over tables and counters."""
    highest_carry_m: float = 1.1
    """As high they stay if they are higher already."""
    carry_extension_m: float = 0.05
    """How far the arm is out then, with the hand pointing down."""
    lift_m: float = 0.12
    """By so much what was taken is raised at least."""
    off_board_m: float = 0.02
    """What is taken from below a board is raised by this before it is drawn out."""
    length_tolerance_m: float = 0.008
    """As near to a target lift and extension are there."""
    angle_tolerance_rad: float = 0.05
    """The same for the wrist."""
    moving_m: float = 0.004
    """By less than this, lift and extension together, the arm does not move."""
    turning_rad: float = 0.02
    """The same for both angles of the wrist."""
    stall_s: float = 0.8
    """An arm that has not moved for so long is stopped by something."""
    driveable_m: float = 0.1
    """An arm that is out no farther than this is within the base's outline."""
    extended_m: float = 0.05
    """An arm that is out farther than this is raised before it is drawn back."""
    empty_opening_m: float = 0.004
    """Fingers as near to each other hold nothing."""
    slip_s: float = 0.3
    """Fingers without contact for so long have lost what they held."""
    person_away_s: float = 20.0
    """Who was not seen for so long where the robot looks to reach is there no more."""
    hand_tolerance_m: float = 0.02
    """How far the pads may be from where they should be."""
    side_tolerance_m: float = 0.015
    """How far beside the arm's plane a thing may be for the narrowest opening, and ..."""
    side_from_m: float = 0.06
    """... from which opening on a quarter of what is more is added: the fingers then close on it all the same."""
    close_effort_n: float = 15.0
    """Force of the fingers: the body port's default."""
    shift_effort_n: float = 40.0
    """The same where one finger pushes a thing towards the other."""
    settle_s: float = 0.35
    """Fingers that have not moved for so long have closed."""
    still_m: float = 0.001
    """By less than this fingers do not move."""
    follow_mps: float = 0.01
    """How fast the hand follows a finger that touches alone."""
    follow_m: float = 0.03
    """How far it does at most."""
    give_up_s: float = 7.0
    """Fingers that have come to no rest by then hold nothing."""
    misjudged_m: float = 0.1
    """A height that is farther off than this is not that of a thing standing there."""
    let_go_m: float = 0.06
    """By so much the fingers open to let go: neighbors may stand close."""
    open_tolerance_m: float = 0.01
    """Fingers that lack no more than this are open."""
    stand_s: float = 0.6
    """So long a thing that was let go is given to come to rest."""
    stuck_s: float = 2.0
    """Fingers that have not opened by then press on the surface: they are relieved."""
    relief_m: float = 0.015
    """By so much the arm is raised for that."""
    touch_s: float = 2.0
    """A thing may lean on a finger after it was let go; after this long it is left so."""


@dataclass(frozen=True, kw_only=True)
class ReachSettings:
    """What it costs that something is on the way of the arm, and how near is near."""

    in_the_way_cost_m: float = 3.0
    """That the arm just touches a small thing."""
    met_cost_m: float = 12.0
    """That it goes straight through the middle of one."""
    barred_cost_m: float = 20.0
    """More than any other: the arm would meet furniture that is higher than the hand, or the end of a shelf."""
    sample_m: float = 0.06
    """How finely the arm's way is looked at."""
    surely_met_m: float = 0.06
    """So near to the middle of its way, the hand meets what is higher, however well that was measured."""
    at_target_m: float = 0.12
    """Nearer than this to the target, wall and seat are what the target is at."""
    along_m: float = 0.01
    """So much nearer to a back or an arm than the thing itself the hand may pass."""
    at_wall_m: float = 0.04
    """What comes so near to the line of a wall, between two samples, may be beyond it with the next."""
    held_margin_m: float = 0.06
    """So much lower than the hover over a spot what is held may reach."""
    person_clearance_m: float = 0.32
    """So far from the middle of a person the middle of the arm keeps."""
    beside_held_m: float = 0.02
    """Air beside what is carried past something."""
    least_air_m: float = 0.01
    """Without so much air above a small thing, what is carried over it meets it."""
    clearance_m: float = 0.04
    """Air between the finger tips, or what they hold, and what the hand passes over."""
    around_person_m: float = 0.1
    """What is hit so near to the outline of somebody who stands there is taken for them."""


@dataclass(frozen=True, kw_only=True)
class ApproachSettings:
    """Where to stand so that the arm reaches, and what places cost."""

    nearest_m: float = 0.40
    """Nearest that the base's axis comes to what is reached for."""
    radius_step_m: float = 0.05
    """Between the rings of places around it."""
    angles: int = 36
    """How many places are on a ring."""
    spare_m: float = 0.05
    """What the arm keeps of its reach."""
    best_m: float = 0.52
    """The best distance: the arm neither drawn in nor stretched."""
    easy_m: float = 0.70
    """Farther than this the arm is stretched only where no place is nearer."""
    radius_weight: float = 1.5
    """What a meter from the best distance costs."""
    stretch_cost_m: float = 2.0
    """What it costs that the arm is stretched."""
    ample_m: float = 0.6
    """More room than this around the base is no better ..."""
    clearance_weight: float = 1.0
    """... and what a meter less costs."""
    from_above_cost_m: float = 3.0
    """A tall thing that hangs from the hand is lifted onto nothing high: it is taken level from where that can be
    done.
    """
    stopped_cost_m: float = 5.0
    """What it costs to reach from a side from which the arm was stopped lately: others are tried first."""
    stopped_rad: float = 0.35
    """As near to that side it is the same."""
    failed_m: float = 0.25
    """As near to a place that could not be driven to none is tried."""
    tries: int = 3
    """So many places are driven to at most."""
    lifted_from_m: float = 0.04
    """What stands beside a thing, no nearer to the base than this, is not swept when the thing has been lifted."""
    aim_rad: float = 0.012
    """How well the base faces what is reached for: half a centimeter at arm's length; the fingers center what is
    between them.
    """
    position_m: float = 0.04
    """How near to its place the base must come, and so what a place may be missed by."""
