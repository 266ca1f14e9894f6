"""Whether a drive gets anywhere, told from the length of the way that is left."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from skills.navigation.settings import DriverSettings


@dataclass(kw_only=True)
class Advance:
    """What is left of a drive's way, and how often the way turned out to be another.

    A way around something is longer at first, and counts from there. But where of two ways each looks shut from its own
    end and open from the other's, a robot would go back and forth between them for ever: so many detours without ever
    coming nearer than before are none.

    Attributes:
        stamp_s: when the drive last came further.
        detours: how often the way grew since the goal was nearest.
    """

    stamp_s: float
    settings: DriverSettings = field(default_factory=DriverSettings)
    detours: int = 0
    _remaining_m: float = np.inf
    _nearest_m: float = np.inf

    def note(self, remaining_m: float, stamp_s: float, *, turning: bool) -> None:
        """Take in the length of the way left. ``turning``: the robot turns in place, which is no standstill."""
        if remaining_m < self._nearest_m - self.settings.step_m:
            self._nearest_m, self.detours = remaining_m, 0
        if remaining_m > self._remaining_m + self.settings.detour_m:
            self._remaining_m = remaining_m
            self.detours += 1
        elif remaining_m < self._remaining_m - self.settings.step_m:
            self.stamp_s, self._remaining_m = stamp_s, remaining_m
        if turning:
            self.stamp_s = stamp_s

    @property
    def astray(self) -> bool:
        """Whether the robot goes back and forth."""
        return self.detours > self.settings.most_detours
