"""By which lengths, times and chances the evidence is measured that tells one thing from another."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Scales:
    """What is chosen was chosen on the scenes of the tests and on missions in simulated houses."""

    gate_sigmas: float = 3.0
    """So far from its place a thing is at most from one frame to the next: 99 % of a normal distribution."""
    slack_m: float = 0.02
    """How far the middle of a thing of any size may seem to be shifted from frame to frame."""
    slack_share: float = 0.1
    """The same as a share of its narrower side."""
    part_slack_m: float = 0.04
    """The same, in addition, of what is seen in part: about half the width of what can be grasped."""
    furniture_margin_m: float = 0.1
    """How far outside the box of furniture a point of it may be: what was not seen yet, and the robot's own error."""
    thing_margin_m: float = 0.02
    """The same of a small thing: of its upper side, depth shows a little more."""
    size_noise_m: float = 0.02
    """Differences of a side that are never held against it: as much as depth is wrong on a small thing."""
    size_spread: float = 0.2
    """Standard deviation of the ratio of two measures of one side."""
    alike: float = 0.35
    """How far label, color and size of two must agree, 0 to 1, to speak of one kind of thing."""
    whole_share: float = 0.85
    """Of the points of a thing, so many make all of it: masks bleed by the rest."""
    tau_s: float = 900.0
    """Mean time after which people have moved a thing."""
    at_large: float = 0.15
    """Chance that a thing that may have left its place is right here; what is missed must be somewhere."""
    near_m: float = 1.0
    """How far a thing goes that falls over or rolls."""
    floor_m: float = 0.12
    """How high at most the bottom of that is which lies on the floor, or on something flat there."""
    reach_m: float = 1.5
    """How far furniture is pushed while nobody looks."""
    looked_s: float = 1.0
    """So long before, at least, one must have looked at a place to have seen nothing there."""
    carries: float = 0.2
    """Probability from which on a support carries what is seen; else it lies on the floor."""
    contact_sigma_m: float = 0.04
    """Standard deviation of the gap between a support and what stands on it."""
    rim_m: float = 0.02
    """How far over the rim of a support the middle of that may be."""
    usual_share: float = 0.4
    """By which share a piece of furniture differs at most from the usual length of its kind."""
    rest_share: float = 0.5
    """Of the usual length of a row's kind, so much is left of it at least when a piece in it is another."""
    longer: float = 1.4
    """So many times longer than a piece that stands by itself, another is a row and not that piece."""
    person_height_m: float = 2.5
    """What rises no higher over a table may be what stands on it; nobody does."""
    seat_height_m: float = 0.1
    """Who sits rises by more over the back of a seat."""

    def margin_m(self, *, furniture: bool) -> float:
        """How far outside the box of a known thing a point of it may be."""
        return self.furniture_margin_m if furniture else self.thing_margin_m
