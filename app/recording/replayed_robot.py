"""A robot that measures what was recorded, and moves as it did then."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from dataclasses import replace
from typing import TypeVar

from app.recording.errors import RecordingError
from app.recording.moment import Moment
from app.recording.playback import Playback
from app.recording.unmoved_body import UnmovedBody
from perception.errors import SensorSilent
from perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from skills.ports import BodyState

Measurement = TypeVar("Measurement")
_IDLE_S = 0.05
"""Wall time of a step once there is nothing more to play."""


class ReplayedRobot(UnmovedBody):
    """Sensors and body of a recording. What it is told to do it does not do.

    Its time is the recording's: ``advance`` goes to the next recorded moment, however far that is.

    Attributes:
        ended: set when no moment is left; time stands still from then on.
        problem: why the recording cannot be read on, if so.
    """

    def __init__(self, playback: Playback) -> None:
        super().__init__()
        self.ended = asyncio.Event()
        self.problem: RecordingError | None = None
        self._moments: Iterator[Moment] = playback.moments()
        self._newest: Moment | None = None
        self._odometry: Odometry | None = None
        self._scan: LidarScan | None = None
        self._joints: JointState | None = None
        self._frame: RgbdFrame | None = None

    @property
    def now_s(self) -> float:
        """Time of the newest moment, seconds."""
        return self._newest.now_s if self._newest is not None else 0.0

    @property
    def stopped(self) -> bool:
        """Whether somebody asked for a stop now or then."""
        return super().stopped or (self._newest is not None and self._newest.body.stopped)

    async def odometry(self) -> Odometry:
        """Newest odometry."""
        return _told(self._odometry, "odometry")

    async def scan(self) -> LidarScan:
        """Newest LiDAR revolution."""
        return _told(self._scan, "scan")

    async def frame(self) -> RgbdFrame:
        """Newest color and depth image."""
        return _told(self._frame, "frame")

    async def joints(self) -> JointState:
        """Newest joint and gripper state."""
        return _told(self._joints, "joints")

    async def state(self) -> BodyState:
        """The body as it was."""
        body = _told(self._newest, "body").body
        return replace(body, stopped=self.stopped)

    async def advance(self, duration_s: float) -> float:  # noqa: ARG002 - the recording has its own steps
        """Go to the next recorded moment; the new time in seconds."""
        moment = None if self.ended.is_set() else await asyncio.to_thread(self._next)
        if moment is None:
            self.ended.set()
            await asyncio.sleep(_IDLE_S)
            return self.now_s
        self._newest = moment
        self._odometry = moment.odometry or self._odometry
        self._scan = moment.scan or self._scan
        self._joints = moment.joints or self._joints
        self._frame = moment.frame or self._frame
        return moment.now_s

    def _next(self) -> Moment | None:
        try:
            return next(self._moments, None)
        except RecordingError as error:
            self.problem = error
            return None


def _told(measurement: Measurement | None, sensor: str) -> Measurement:
    """``measurement``.

    Raises:
        SensorSilent: nothing was recorded of it yet.
    """
    if measurement is None:
        raise SensorSilent(sensor, 0.0)
    return measurement
