"""A simulated robot behind rosbridge, for trying ``majordomo serve --robot rosbridge:robot.toml`` without a robot.

It speaks as much of the rosbridge protocol as a robot's driver needs, and names everything as ``robot.toml`` does.
The first line that it prints is its address.
"""

from __future__ import annotations

import argparse
import asyncio
import base64
import contextlib
import json
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from typing import Any

import cv2
import numpy as np
from websockets.asyncio.server import ServerConnection, serve
from websockets.exceptions import ConnectionClosed

from majordomo import SE3, ArmTarget, LidarScan, SensorSilent, SimulatedRobot, ray_directions_base

EPOCH_S = 1_700_000_000.0
"""What the robot's clock shows when the simulation begins."""
ARM = ("lift_joint", "extension_joint", "wrist_pitch_joint", "wrist_roll_joint")
HEAD = ("pan_joint", "tilt_joint")
FINGERS = ("left_finger_joint", "right_finger_joint")
TOUCH_N = 10.0
SEND_LIMIT_S = 5.0

Message = dict[str, Any]


class Rosbridge:
    """Plays rosbridge in front of one simulated robot.

    Attributes:
        commands: (topic or action, message) of all that was commanded, oldest first.
        lag_s: what the robot's clock is behind; to be changed by tests.
        silent: topics on which nothing is published; to be changed by tests.
    """

    def __init__(self, robot: SimulatedRobot) -> None:
        self.commands: list[tuple[str, Message]] = []
        self.lag_s = 0.0
        self.silent: set[str] = set()
        self._robot = robot
        self._subscribers: dict[ServerConnection, set[str]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    @contextlib.asynccontextmanager
    async def serving(self, port: int = 0) -> AsyncIterator[str]:
        """Serve on a port of this machine; gives the address."""
        async with serve(self._visit, "127.0.0.1", port, compression=None, close_timeout=1.0) as server:
            works = [
                self._publish_at(20.0, self._body),
                self._publish_at(10.0, self._cloud),
                self._publish_at(5.0, self._pictures),
            ]
            tasks = [asyncio.create_task(work) for work in works]
            try:
                yield f"ws://127.0.0.1:{server.sockets[0].getsockname()[1]}"
            finally:
                for task in tasks:
                    task.cancel()
                await asyncio.gather(*tasks, return_exceptions=True)

    async def hang_up(self) -> None:
        """Close all connections, as a network does."""
        for socket in list(self._subscribers):
            socket.transport.abort()
            await socket.wait_closed()

    async def _visit(self, socket: ServerConnection) -> None:
        self._subscribers[socket] = set()
        try:
            async for text in socket:
                await self._obey(socket, json.loads(text))
        except ConnectionClosed:
            pass
        finally:
            del self._subscribers[socket]

    async def _obey(self, socket: ServerConnection, request: Message) -> None:
        match request:
            case {"op": "subscribe", "topic": str(topic)}:
                self._subscribers[socket].add(topic)
                if topic == "/tf_static":
                    await self._tell(socket, topic, {"transforms": [await self._lidar_mount()]})
            case {"op": "unsubscribe", "topic": str(topic)}:
                self._subscribers[socket].discard(topic)
            case {"op": "publish", "topic": str(topic), "msg": dict(message)}:
                self.commands.append((topic, message))
                await self._move(topic, message)
            case {"op": "send_action_goal", "id": number, "action": str(action), "args": dict(goal)}:
                self.commands.append((action, goal))
                command = goal["command"]
                await self._robot.grip(command["position"], command["max_effort"])
                result = {"op": "action_result", "id": number, "action": action, "values": {}, "status": 4}
                await socket.send(json.dumps(result | {"result": True}))

    async def _move(self, topic: str, message: Message) -> None:
        if topic == "/cmd_vel":
            await self._robot.drive(message["linear"]["x"], message["angular"]["z"])
            return
        wanted = dict(zip(message["joint_names"], message["points"][-1]["positions"], strict=True))
        if topic.startswith("/arm_controller"):
            await self._robot.move_arm(ArmTarget(**dict(zip(_ARM_FIELDS, (wanted[name] for name in ARM), strict=True))))
        elif topic.startswith("/head_controller"):
            await self._robot.look(*(wanted[name] for name in HEAD))

    async def _publish_at(self, rate_hz: float, make: Callable[[], Awaitable[Mapping[str, Message]]]) -> None:
        while True:
            before_s = asyncio.get_running_loop().time()
            wanted = set().union(*self._subscribers.values()) - self.silent
            if wanted:
                with contextlib.suppress(SensorSilent):
                    for topic, message in (await make()).items():
                        if topic not in self.silent:
                            await self._publish(topic, message)
            await asyncio.sleep(max(0.0, before_s + 1.0 / rate_hz - asyncio.get_running_loop().time()))

    async def _publish(self, topic: str, message: Message) -> None:
        for socket, topics in list(self._subscribers.items()):
            if topic in topics:
                await self._tell(socket, topic, message)

    async def _tell(self, socket: ServerConnection, topic: str, message: Message) -> None:
        with contextlib.suppress(ConnectionClosed, TimeoutError):
            async with asyncio.timeout(SEND_LIMIT_S):
                await socket.send(json.dumps({"op": "publish", "topic": topic, "msg": message}))

    async def _body(self) -> dict[str, Message]:
        """Odometry, joints, bumper."""
        odometry, joints, state = await self._robot.odometry(), await self._robot.joints(), await self._robot.state()
        half = joints.gripper_opening_m / 2
        turn = SE3.from_xyz_yaw(0, 0, 0, odometry.yaw_rad)
        effort = [TOUCH_N if touches else 0.0 for touches in joints.finger_contacts]
        place = {"position": _vector(odometry.x_m, odometry.y_m, 0.0), "orientation": _quaternion(turn)}
        speed = {"linear": _vector(odometry.linear_mps, 0, 0), "angular": _vector(0, 0, odometry.angular_radps)}
        told: dict[str, Message] = {
            "/odom": {
                "header": self._header(odometry.stamp_s, "odom"),
                "child_frame_id": "base_link",
                "pose": {"pose": place},
                "twist": {"twist": speed},
            },
            "/joint_states": {
                "header": self._header(joints.stamp_s, ""),
                "name": [*ARM, *HEAD, *FINGERS],
                "position": [*(getattr(joints, name) for name in (*_ARM_FIELDS, "pan_rad", "tilt_rad")), half, half],
                "velocity": [],
                "effort": [0.0] * 6 + effort,
            },
            "/bumper": {"data": state.bumped},
        }
        return told

    async def _cloud(self) -> dict[str, Message]:
        """LiDAR, as an organized cloud in the sensor's frame."""
        scan = await self._robot.scan()
        points = np.zeros(scan.ranges_m.shape, dtype=[("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("ring", "<u2")])
        returned = np.where(np.isfinite(scan.ranges_m), scan.ranges_m, np.nan)
        xyz = _directions_lidar(scan) * returned[..., None]
        points["x"], points["y"], points["z"] = xyz[..., 0], xyz[..., 1], xyz[..., 2]
        points["ring"] = np.arange(len(scan.elevations_rad))[:, None]
        rows, columns = scan.ranges_m.shape
        fields = [
            {"name": name, "offset": offset, "datatype": kind, "count": 1}
            for name, offset, kind in (("x", 0, 7), ("y", 4, 7), ("z", 8, 7), ("ring", 12, 4))
        ]
        cloud = {
            "header": self._header(scan.stamp_s, "lidar_link"),
            "height": rows,
            "width": columns,
            "fields": fields,
            "is_bigendian": False,
            "point_step": points.itemsize,
            "row_step": points.itemsize * columns,
            "data": _base64(points.tobytes()),
            "is_dense": False,
        }
        return {"/lidar/points": cloud}

    async def _pictures(self) -> dict[str, Message]:
        """The camera's place, color, depth in millimeters, and its lens."""
        if not any("/camera/info" in topics for topics in self._subscribers.values()):
            return {}
        frame = await self._robot.frame()
        header = self._header(frame.stamp_s, "camera_optical_frame")
        lens = frame.intrinsics
        millimeters = np.clip(np.round(frame.depth_m * 1000.0), 0, 65535).astype(np.uint16)
        info = {"width": lens.width, "height": lens.height, "k": [lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1]}
        mount = self._transform(frame.stamp_s, "camera_optical_frame", frame.T_base_camera)
        color = cv2.cvtColor(frame.rgb, cv2.COLOR_RGB2BGR)
        return {
            "/tf": {"transforms": [mount]},
            "/camera/info": {"header": header, **info},
            "/camera/depth/compressed": {"header": header, "format": "16UC1; png", "data": _png(millimeters)},
            "/camera/color/compressed": {"header": header, "format": "rgb8; png", "data": _png(color)},
        }

    async def _lidar_mount(self) -> Message:
        scan = await self._robot.scan()
        return self._transform(0.0, "lidar_link", scan.T_base_lidar)

    def _transform(self, stamp_s: float, child: str, T_base_child: SE3) -> Message:
        place = {"translation": _vector(*T_base_child.translation_m), "rotation": _quaternion(T_base_child)}
        return {"header": self._header(stamp_s, "base_link"), "child_frame_id": child, "transform": place}

    def _header(self, stamp_s: float, frame: str) -> Message:
        whole_s, rest_s = divmod(EPOCH_S + stamp_s - self.lag_s, 1.0)
        return {"stamp": {"sec": int(whole_s), "nanosec": int(rest_s * 1e9)}, "frame_id": frame}


_ARM_FIELDS = ("lift_m", "extension_m", "wrist_pitch_rad", "wrist_roll_rad")


def _directions_lidar(scan: LidarScan) -> Any:
    """(rings, azimuths, 3) unit vectors of all rays in the sensor's frame."""
    return ray_directions_base(scan) @ scan.T_base_lidar.rotation()


def _vector(x: float, y: float, z: float) -> Message:
    return {"x": float(x), "y": float(y), "z": float(z)}


def _quaternion(transform: SE3) -> Message:
    return dict(zip("wxyz", map(float, transform.quat_wxyz), strict=True))


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")


def _png(picture: Any) -> str:
    return _base64(cv2.imencode(".png", picture, (cv2.IMWRITE_PNG_COMPRESSION, 1))[1].tobytes())


async def main() -> None:
    """Play until interrupted."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--house", default="flat")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--port", type=int, default=9090)
    options = parser.parse_args()
    robot = await SimulatedRobot.start(options.house, seed=options.seed, mode="real")
    try:
        async with Rosbridge(robot).serving(options.port) as address:
            print(address, flush=True)
            await asyncio.Event().wait()
    finally:
        await robot.close()


if __name__ == "__main__":
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(main())
