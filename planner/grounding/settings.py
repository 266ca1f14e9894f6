"""By what numbers words are matched to things."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class GroundingSettings:
    """Limits of words such as *next to*, *big* and *between*."""

    next_to_m: float = 0.6
    """*Next to* means closer than this, between extents, if anything is. Chosen: within reach of who stands there."""
    loosely_next_to_m: float = 1.5
    """Else closer than this, as goals of being *near* something have it."""
    clearly_bigger: float = 1.2
    """*Big* fits what has more than this many times the volume of the next. Chosen: less is not seen at a glance."""
    beside_m: float = 1.5
    """Farther apart than this, nothing is said to be *left of* or *behind* something. Chosen: across a table."""
    aside_m: float = 0.05
    """What is less than this to one side is not *left of* anything. Chosen: about the error of an object's place."""
    between_m: float = 0.3
    """*Between* allows this distance from the straight line. Chosen: things on one table."""
    between_share: float = 0.25
    """On longer lines it allows this share of their length. Chosen: pieces of furniture across a room."""
    likely: float = 0.3
    """Probability from which a thing without a name may be meant by a name, where nothing of that name is known.
    Chosen: what is asked about or looked at from near before anything is done with it may be less likely than not.
    """
