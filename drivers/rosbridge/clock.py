"""The robot's time: it follows the stamps of the odometry, begins with us, and never goes back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class ClockSettings:
    """How far a robot's clock is followed; chosen, several times as long as odometry takes."""

    carry_s: float = 0.5
    """How far time goes on by our own clock while no odometry comes."""
    back_s: float = 1.0
    forth_s: float = 2.0
    """From which jump of the stamps on, against our own clock, the robot's clock was set."""


class RobotClock:
    """Maps ROS stamps into the robot's time, seconds since the first one.

    The robot's clock need not be ours, nor as fast: that of a simulator that cannot keep up is slower. Between two
    messages time goes on by our clock. When the robot's clock is set, forward or back, time goes on from where it was.
    Only one topic sets the clock, the odometry: a sensor whose computer has another time must not move everybody's.
    """

    def __init__(self, monotonic: Callable[[], float], *, settings: ClockSettings = ClockSettings()) -> None:
        """``monotonic``: our own clock, seconds since whenever."""
        self._monotonic, self._settings = monotonic, settings
        self._origin_s: float | None = None
        self._stamp_s, self._arrived_s, self._told_s = 0.0, 0.0, 0.0

    @property
    def now_s(self) -> float:
        """Robot time in seconds; zero until the first stamp."""
        if self._origin_s is not None:
            carried_s = min(self._monotonic() - self._arrived_s, self._settings.carry_s)
            self._told_s = max(self._told_s, self._stamp_s - self._origin_s + carried_s)
        return self._told_s

    def hear(self, ros_stamp_s: float) -> None:
        """Learn from a message, as it arrives, what time it is on the robot."""
        arrived_s = self._monotonic()
        ahead_s = (ros_stamp_s - self._stamp_s) - (arrived_s - self._arrived_s)
        back_s, forth_s = self._settings.back_s, self._settings.forth_s
        if self._origin_s is None or ros_stamp_s < self._stamp_s - back_s or ahead_s > forth_s:
            self._origin_s = ros_stamp_s - self.now_s
        elif ros_stamp_s < self._stamp_s:
            return
        self._stamp_s, self._arrived_s = ros_stamp_s, arrived_s

    def time_of(self, ros_stamp_s: float) -> float:
        """Robot time of a ROS stamp, seconds; ``-inf`` before any message has set the clock."""
        return ros_stamp_s - self._origin_s if self._origin_s is not None else float("-inf")
