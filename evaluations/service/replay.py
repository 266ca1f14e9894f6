"""A drive through a known building, recorded beside the simulator and played back from memory without it.

LiDAR is recorded at 10 Hz and the camera at 15 Hz of simulated time; played at twice the pace they are 20 Hz and 30 Hz.
"""

from __future__ import annotations

import asyncio
import time
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from app.recording.unmoved_body import UnmovedBody
from app.runtime import Runtime
from app.scheduler import Agent
from evaluations.mapping.exploration import service_in_lockstep, until_explored
from evaluations.mapping.patrol import Patrol
from perception.errors import SensorSilent
from perception.ports import Intrinsics, JointState, LidarScan, Odometry, RgbdFrame
from scene_graph.geometry.se3 import SE3
from scene_graph.snapshot import Snapshot
from simulation.houses.house_file import load_house
from skills.ports import ArmTarget, BodyState

LIDAR_HZ, CAMERA_HZ = 10.0, 15.0
"""Of simulated time."""
_TICK_S = 1.0 / 30.0
"""Both sensors' periods are whole multiples of it."""
_MM_PER_M = 1000.0


@dataclass(frozen=True, kw_only=True, eq=False)
class CompactFrame:
    """An RGB-D frame whose depth is whole millimeters, (H, W) uint16: half the size, and as good as the sensor."""

    stamp_s: float
    rgb: NDArray[np.uint8]
    depth_mm: NDArray[np.uint16]
    intrinsics: Intrinsics
    T_base_camera: SE3

    @classmethod
    def of(cls, frame: RgbdFrame) -> CompactFrame:
        """``frame``, rounded."""
        return cls(
            stamp_s=frame.stamp_s,
            rgb=frame.rgb,
            depth_mm=np.rint(frame.depth_m * _MM_PER_M).astype(np.uint16),
            intrinsics=frame.intrinsics,
            T_base_camera=frame.T_base_camera,
        )

    def frame(self) -> RgbdFrame:
        """The frame as the camera gave it."""
        return RgbdFrame(
            stamp_s=self.stamp_s,
            rgb=self.rgb,
            depth_m=self.depth_mm * np.float32(1.0 / _MM_PER_M),
            intrinsics=self.intrinsics,
            T_base_camera=self.T_base_camera,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Recording:
    """A drive: the graph at its start, and what the sensors said, oldest first; body and LiDAR speak together."""

    building: Snapshot
    odometry: Sequence[Odometry]
    scans: Sequence[LidarScan]
    joints: Sequence[JointState]
    frames: Sequence[CompactFrame]


async def record(house: str, seconds: float) -> Recording:
    """Explore ``house``, then drive from room to room for ``seconds`` of simulated time and keep what is measured."""
    made: list[_Tape] = []

    def witnesses(runtime: Runtime) -> Sequence[Agent]:
        made.append(_Tape())
        return [_Recorder(runtime, made[0]), _FrameRecorder(runtime, made[0])]

    loaded = load_house(house)
    async with service_in_lockstep(loaded, 0, witnesses=witnesses, tick_s=_TICK_S) as runtime:
        await until_explored(runtime, loaded)
        tape, begin_s, building = made[0], runtime.now_s, runtime.memory.building()
        tape.running = True
        while runtime.now_s < begin_s + seconds:
            await runtime.wait_for_change()
        return Recording(
            building=building, odometry=tape.odometry, scans=tape.scans, joints=tape.joints, frames=tape.frames
        )


@dataclass(kw_only=True)
class _Tape:
    """What has been measured while it was ``running``."""

    running: bool = False
    odometry: list[Odometry] = field(default_factory=list)
    scans: list[LidarScan] = field(default_factory=list)
    joints: list[JointState] = field(default_factory=list)
    frames: list[CompactFrame] = field(default_factory=list)


class _Recorder:
    """Wanders, and keeps what body and LiDAR measure."""

    name = "evaluation"
    period_s = 1.0 / LIDAR_HZ

    def __init__(self, runtime: Runtime, tape: _Tape) -> None:
        self._runtime, self._tape = runtime, tape
        self._patrol = Patrol(self.name, runtime.memory)

    async def step(self, stamp_s: float) -> None:
        if not self._tape.running:
            return
        robot = self._runtime.require_robot()
        self._tape.odometry.append(await robot.odometry())
        self._tape.scans.append(await robot.scan())
        self._tape.joints.append(await robot.joints())
        self._patrol.step(stamp_s)


class _FrameRecorder:
    """Keeps what the camera sees, once body and LiDAR have begun."""

    name = "evaluation_camera"
    period_s = 1.0 / CAMERA_HZ

    def __init__(self, runtime: Runtime, tape: _Tape) -> None:
        self._runtime, self._tape = runtime, tape

    async def step(self, stamp_s: float) -> None:  # noqa: ARG002 - every agent takes the time
        if self._tape.scans:
            frame = await self._runtime.require_robot().frame()
            self._tape.frames.append(CompactFrame.of(frame))


class RecordedRobot(UnmovedBody):
    """A robot that measures what was recorded, at ``speed`` times the pace of the recording, and moves as it did then.

    What it is told to do it does not do. Its time begins when it is first asked for. Each camera frame is given once:
    who asks early waits for the next.
    """

    def __init__(self, recording: Recording, *, speed: float) -> None:
        super().__init__()
        self.speed = speed
        self._recording = recording
        self._scan_stamps_s = [scan.stamp_s for scan in recording.scans]
        self._frame_stamps_s = [frame.stamp_s for frame in recording.frames]
        self._started: float | None = None
        self._frames_given = 0

    @property
    def now_s(self) -> float:
        """Time of the recording, seconds."""
        if self._started is None:
            self._started = time.monotonic()
        return self._scan_stamps_s[0] + self.speed * (time.monotonic() - self._started)

    async def odometry(self) -> Odometry:
        """Newest odometry."""
        return self._recording.odometry[self._newest]

    async def scan(self) -> LidarScan:
        """Newest LiDAR revolution."""
        return self._recording.scans[self._newest]

    async def joints(self) -> JointState:
        """Newest joint and gripper state."""
        return self._recording.joints[self._newest]

    async def frame(self) -> RgbdFrame:
        """Newest frame, or the next one if that was given.

        Raises:
            SensorSilent: the recording has come to its end.
        """
        newest = bisect_right(self._frame_stamps_s, self.now_s)
        due = max(newest, self._frames_given + 1)
        if due > len(self._frame_stamps_s):
            raise SensorSilent("frame", 0.0)
        await asyncio.sleep(max(0.0, (self._frame_stamps_s[due - 1] - self.now_s) / self.speed))
        self._frames_given = due
        return self._recording.frames[due - 1].frame()

    async def state(self) -> BodyState:
        """The body as it was measured."""
        odometry, joints = await self.odometry(), await self.joints()
        return BodyState(
            stamp_s=joints.stamp_s,
            linear_mps=odometry.linear_mps,
            angular_radps=odometry.angular_radps,
            arm=ArmTarget(
                lift_m=joints.lift_m,
                extension_m=joints.extension_m,
                wrist_pitch_rad=joints.wrist_pitch_rad,
                wrist_roll_rad=joints.wrist_roll_rad,
            ),
            gripper_opening_m=joints.gripper_opening_m,
            finger_contacts=joints.finger_contacts,
            pan_rad=joints.pan_rad,
            tilt_rad=joints.tilt_rad,
            bumped=False,
            stopped=self.stopped,
            T_base_gripper=joints.T_base_gripper,
        )

    async def advance(self, duration_s: float) -> float:
        """Wait, since a recording follows the wall clock; the new time in seconds."""
        until_s = self.now_s + duration_s
        await asyncio.sleep((until_s - self.now_s) / self.speed)
        return self.now_s

    @property
    def _newest(self) -> int:
        return max(0, bisect_right(self._scan_stamps_s, self.now_s) - 1)
