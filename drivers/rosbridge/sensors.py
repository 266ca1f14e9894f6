"""What a robot behind rosbridge measures: messages as they come in, measurements as perception wants them."""

from __future__ import annotations

import asyncio
import logging
import math
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeVar

from drivers.rosbridge.clock import ClockSettings, RobotClock
from drivers.rosbridge.errors import BadMessage, FrameStale, FrameUnknown
from drivers.rosbridge.frames import FrameSettings, FrameTree
from drivers.rosbridge.messages import (  # fmt: skip
    BoolMessage,
    CameraInfoMessage,
    CompressedImageMessage,
    Header,
    Joints,
    JointStateMessage,
    LaserScanMessage,
    OdometryMessage,
    PointCloudMessage,
    TransformsMessage,
)
from drivers.rosbridge.profile import Camera, Lidar, Profile
from drivers.rosbridge.ranges import scan_of_cloud, scan_of_laser
from perception.errors import NoPicture, SensorSilent
from perception.pictures import depth_of, picture_of
from perception.ports import LidarScan, Odometry, RgbdFrame
from scene_graph.geometry.se3 import SE3

logger = logging.getLogger(__name__)

Raw = Mapping[str, Any]
T = TypeVar("T")
TF, TF_STATIC = "/tf", "/tf_static"


@dataclass(frozen=True, kw_only=True)
class SensorSettings:
    """How stamps of different sensors go together, with the clock and the frames that they are told by."""

    pair_s: float = 0.02
    """How far apart color and depth of one frame may be stamped: less than the time between two frames."""
    ahead_s: float = 0.2
    """How far a sensor's clock may be ahead of the odometry's: chosen."""
    clock: ClockSettings = field(default_factory=ClockSettings)
    frames: FrameSettings = field(default_factory=FrameSettings)


class Sensors:
    """Newest messages of all sensors. ``hear`` takes them in; the rest are the calls of the sensor port."""

    def __init__(
        self,
        profile: Profile,
        monotonic: Callable[[], float] = time.monotonic,
        *,
        settings: SensorSettings = SensorSettings(),
    ) -> None:
        """``monotonic``: our own clock, seconds since whenever."""
        self._settings = settings
        self.joints = Joints()
        self.bumped = False
        self.newest_odometry: Odometry | None = None
        self._profile, self._monotonic = profile, monotonic
        self._clock, self._frames = RobotClock(monotonic, settings=settings.clock), FrameTree(settings.frames)
        self._scan: Raw | None = None
        self._camera: dict[str, deque[Raw]] = {}
        self._info: Raw | None = None
        self._arrived_s: dict[str, float] = {}
        self._complaints: set[str] = set()
        for frame, mount in profile.mounts.items():
            self._frames.fix(profile.base_frame, frame, mount.transform)
        self._handlers = self._make_handlers()

    @property
    def now_s(self) -> float:
        """Robot time in seconds; zero until the robot has said where it is."""
        return self._clock.now_s

    @property
    def subscriptions(self) -> dict[str, str]:
        """Topic -> type of all that is wanted."""
        profile, camera = self._profile, self._profile.camera
        wanted = {
            profile.odometry: "nav_msgs/Odometry",
            profile.joints: "sensor_msgs/JointState",
            profile.lidar.topic: profile.lidar.type,
            TF: "tf2_msgs/TFMessage",
            TF_STATIC: "tf2_msgs/TFMessage",
        }
        if camera is not None:
            wanted |= dict.fromkeys((camera.color, camera.depth), "sensor_msgs/CompressedImage")
            wanted[camera.info] = "sensor_msgs/CameraInfo"
        if profile.bumper is not None:
            wanted[profile.bumper] = "std_msgs/Bool"
        return wanted

    @property
    def waiting_for(self) -> list[str]:
        """Topics without which the robot can do nothing, and on which nothing has come yet."""
        profile = self._profile
        heard = {
            profile.odometry: self.newest_odometry is not None,
            profile.joints: all(name in self.joints.position for name in profile.joint_names),
            profile.lidar.topic: self._scan is not None,
        }
        return [topic for topic, there in heard.items() if not there]

    def hear(self, topic: str, message: Raw) -> None:
        """Take in a message; one that cannot be meant is reported once, and left out."""
        handler = self._handlers.get(topic)
        if handler is None:
            return
        self._arrived_s[topic] = self._monotonic()
        try:
            handler(message)
        except (BadMessage, ValueError) as problem:
            self._complain(str(problem))

    def odometry(self) -> Odometry:
        """Newest odometry.

        Raises:
            SensorSilent: it is old, or none has come.
        """
        if self.newest_odometry is None:
            raise SensorSilent("odometry", math.inf)
        self._check_age("odometry", self._profile.odometry, self.newest_odometry.stamp_s)
        return self.newest_odometry

    async def scan(self) -> LidarScan:
        """Newest LiDAR revolution.

        Raises:
            SensorSilent: it is old, none has come, or it cannot be used.
        """
        lidar, raw = self._profile.lidar, _there(self._scan, "scan")
        stamp_s, mount = self._or_silent("scan", lambda: self._placed("scan", lidar.topic, raw))
        return await asyncio.to_thread(self._or_silent, "scan", lambda: _scan_of(lidar, raw, stamp_s, mount))

    async def frame(self) -> RgbdFrame:
        """Newest color and depth image.

        Raises:
            SensorSilent: it is old, none has come, or it cannot be used.
        """
        camera = self._profile.camera
        if camera is None:
            raise SensorSilent("frame", math.inf)
        color, depth = self._pair(camera)
        info = _there(self._info, "frame")
        stamp_s, mount = self._or_silent("frame", lambda: self._placed("frame", camera.color, color))
        messages = (color, depth, info)
        return await asyncio.to_thread(self._or_silent, "frame", lambda: _frame_of(camera, messages, stamp_s, mount))

    def check_joints(self) -> float:
        """When the newest joint state was measured, robot time in seconds.

        Raises:
            SensorSilent: it is old, or none has come.
        """
        if not all(name in self.joints.position for name in self._profile.joint_names):
            raise SensorSilent("joints", math.inf)
        self._check_age("joints", self._profile.joints, self.joints.stamp_s)
        return self.joints.stamp_s

    def _make_handlers(self) -> dict[str, Callable[[Raw], None]]:
        profile, camera = self._profile, self._profile.camera
        handlers: dict[str, Callable[[Raw], None]] = {
            profile.odometry: self._hear_odometry,
            profile.joints: self._hear_joints,
            profile.lidar.topic: self._hear_scan,
            TF: self._hear_transforms,
            TF_STATIC: self._hear_fixed,
        }
        if camera is not None:
            self._camera = {topic: deque(maxlen=8) for topic in (camera.color, camera.depth)}
            handlers |= {topic: kept.append for topic, kept in self._camera.items()}
            handlers[camera.info] = self._hear_info
        if profile.bumper is not None:
            handlers[profile.bumper] = self._hear_bumper
        return handlers

    def _hear_odometry(self, raw: Raw) -> None:
        message = OdometryMessage.read(self._profile.odometry, raw)
        base = self._profile.base_frame
        if message.child_frame_id.lstrip("/") not in {"", base}:
            about = f"{self._profile.odometry} is about frame '{message.child_frame_id}'"
            raise BadMessage(f"{about}, but the profile's base_frame is '{base}'")
        self._clock.hear(message.header.stamp)
        self.newest_odometry = message.odometry(self._clock.time_of(message.header.stamp))

    def _hear_joints(self, raw: Raw) -> None:
        message = JointStateMessage.read(self._profile.joints, raw)
        self.joints.take(message, min(self._clock.time_of(message.header.stamp), self.now_s))

    def _hear_transforms(self, raw: Raw) -> None:
        for one in TransformsMessage.read(TF, raw).transforms:
            self._frames.put(one.header.frame_id, one.child_frame_id, one.T_parent_child, one.header.stamp)

    def _hear_fixed(self, raw: Raw) -> None:
        for one in TransformsMessage.read(TF_STATIC, raw).transforms:
            self._frames.fix(one.header.frame_id, one.child_frame_id, one.T_parent_child)

    def _hear_scan(self, raw: Raw) -> None:
        self._scan = raw

    def _hear_info(self, raw: Raw) -> None:
        self._info = raw

    def _hear_bumper(self, raw: Raw) -> None:
        self.bumped = BoolMessage.read(self._profile.bumper or "", raw).data

    def _pair(self, camera: Camera) -> tuple[Raw, Raw]:
        """The newest color with its depth."""
        for color in reversed(self._camera[camera.color]):
            stamp_s = _stamp_of(color)
            for depth in reversed(self._camera[camera.depth]):
                if abs(_stamp_of(depth) - stamp_s) <= self._settings.pair_s:
                    return color, depth
        raise SensorSilent("frame", math.inf)

    def _or_silent(self, sensor: str, make: Callable[[], T]) -> T:
        """What ``make`` makes; a message that cannot be used is reported once, and its sensor is silent."""
        try:
            return make()
        except (BadMessage, FrameUnknown, FrameStale, NoPicture) as problem:
            self._complain(f"{sensor}: {problem}")
            raise SensorSilent(sensor, math.inf) from problem

    def _placed(self, sensor: str, topic: str, raw: Raw) -> tuple[float, SE3]:
        """When a message was measured, robot time, and where on the base its frame was then."""
        header = Header.read(topic, raw.get("header", {}))
        stamp_s = self._clock.time_of(header.stamp)
        self._check_age(sensor, topic, stamp_s)
        mount = self._frames.lookup(self._profile.base_frame, header.frame_id, header.stamp)
        return min(stamp_s, self.now_s), mount

    def _check_age(self, sensor: str, topic: str, stamp_s: float) -> None:
        """Complain of what has not arrived for a while, and of what did but is stamped by another clock.

        Raises:
            SensorSilent: in both cases.
        """
        quiet_s = self._monotonic() - self._arrived_s.get(topic, -math.inf)
        if quiet_s > self._profile.silent_after_s:
            raise SensorSilent(sensor, quiet_s)
        age_s = self.now_s - stamp_s
        if not -self._settings.ahead_s <= age_s <= self._profile.silent_after_s:
            behind = "behind" if age_s > 0 else "ahead of"
            self._complain(
                f"{topic} comes, but is stamped by a clock that is {behind} that of {self._profile.odometry}; are the "
                "clocks of the robot's computers set by one (chrony, NTP)?"
            )
            raise SensorSilent(sensor, abs(age_s))

    def _complain(self, problem: str) -> None:
        if problem not in self._complaints and len(self._complaints) < 100:
            self._complaints.add(problem)
            logger.warning("%s", problem)


def _scan_of(lidar: Lidar, raw: Raw, stamp_s: float, T_base_lidar: SE3) -> LidarScan:
    if lidar.type == "sensor_msgs/LaserScan":
        return scan_of_laser(LaserScanMessage.read(lidar.topic, raw), stamp_s, T_base_lidar)
    cloud = PointCloudMessage.read(lidar.topic, raw)
    return scan_of_cloud(cloud, stamp_s, T_base_lidar, azimuths=lidar.azimuths)


def _frame_of(camera: Camera, messages: tuple[Raw, Raw, Raw], stamp_s: float, T_base_camera: SE3) -> RgbdFrame:
    """``messages``: color, depth, and what the lens does."""
    color = CompressedImageMessage.read(camera.color, messages[0])
    depth = CompressedImageMessage.read(camera.depth, messages[1])
    intrinsics = CameraInfoMessage.read(camera.info, messages[2]).intrinsics
    rgb, depth_m = picture_of(color.data), depth_of(depth.data)
    sizes = {rgb.shape[:2], depth_m.shape, (intrinsics.height, intrinsics.width)}
    if len(sizes) > 1:
        raise BadMessage(
            f"{camera.color}, {camera.depth} and {camera.info} are not of one size (rows, columns): "
            f"{', '.join(map(str, sorted(sizes)))}; is depth registered to color?"
        )
    return RgbdFrame(stamp_s=stamp_s, rgb=rgb, depth_m=depth_m, intrinsics=intrinsics, T_base_camera=T_base_camera)


def _there(raw: Raw | None, sensor: str) -> Raw:
    if raw is None:
        raise SensorSilent(sensor, math.inf)
    return raw


def _stamp_of(raw: Raw) -> float:
    try:
        return Header.read("camera", raw.get("header", {})).stamp
    except BadMessage:
        return -math.inf
