"""By what numbers the robot is given away and kept going."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class ExecutorSettings:
    """Limits of arbiter, executor and exploration."""

    exploration_timeout_s: float = 180.0
    """How long one exploration intention may act. Chosen: across a large room and around what stands there."""
    doorway_m: float = 1.0
    """A robot this close to the door it crosses finishes crossing before anything but the stop. Chosen: the robot with
    its arm stands in the opening from there.
    """
    look_standoff_m: float = 0.8
    """From here the camera, 1.4 m above the floor, sees a table's top and what stands on it."""
