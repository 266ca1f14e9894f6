"""What was tuned of looking."""

from __future__ import annotations

from dataclasses import dataclass

Row = tuple[float, int]
"""Tilt of the camera and number of views all around."""


@dataclass(frozen=True, kw_only=True)
class LookSettings:
    """How the camera is pointed, for how long, and what is expected of that. Where nothing else is said, a value was
    chosen by trying in the simulator, whose camera sees 60 degrees across at 5 Hz.
    """

    settled_rad: float = 0.02
    """As near to where it should point a camera is there."""
    drift_rad: float = 0.06
    """By less than this it is not pointed anew: the noise of the pose estimate."""
    dwell_s: float = 0.5
    """Long enough for two still frames."""
    rows: tuple[Row, ...] = ((-0.38, 8), (0.15, 8), (-0.98, 6))
    """A look around, first with the tilt at which the robot drives: above that are the tops of wardrobes and shelves,
    and what hangs on walls; below it the floor from 0.4 m before the camera's foot on, and low furniture there. The
    nearer to straight down, the more of the surroundings is in a picture.
    """
    picture_m: float = 0.9
    """So much of a thing, side by side, is in a picture taken from an arm's length."""
    top: float = 0.3
    """Where to look at a thing, as share of its height from its middle."""
    high: tuple[float, float] = (0.17, -0.25)
    """The same, one below the other, where it is as high as the eye."""
    eye_level_m: float = 0.2
    """So much lower than the camera that is."""
    noticeable: float = 0.02
    """By so much the probability falls that a thing is there while one looks and does not find it."""
    moved_m: float = 0.15
    """Farther than this from where it was planned to be a thing was moved."""
    glances_rad: tuple[tuple[float, float], ...] = ((0.0, 0.0), (0.12, 0.0), (-0.12, 0.0), (0.0, -0.1))
    """Pan and tilt that are added in turn while one waits to see a thing."""
    glance_s: float = 2.0
    """For how long each."""
    past_edge_m: float = 0.05
    """Air that a thing within reach has to the base."""
