"""A scripted robot in an analytic room: sensors, network and localization without noise or physics, for tests.

The robot stands where the script puts it; its pose in the graph is exact unless the script says otherwise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import lru_cache

import numpy as np
from numpy.random import Generator

from perception.objects.doubles.raycast import Rendering, Solid, look_at, panoptic_scene, render, rgbd_frame
from perception.objects.errors import InferenceFailed
from perception.panoptic import PanopticScene, Triplet
from perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from perception.sensing import SensorBuffer
from scene_graph.edges import EdgeKey, EdgeType, InEdge, RtEdge
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, ROOT_ID, Point2, Point3, RobotNode, RoomNode, RoomStatus

CAMERA_HEIGHT_M = 1.4


@dataclass
class ScriptedRoom:
    """What is there, where the robot stands in ``room_1`` and what it looks at; change the fields as the story goes on.

    ``blind``: indices of solids that the network overlooks. ``failing``: the network gives no answer. ``silent``: no
    new frames. ``label_noise``: share of instances that get a wrong label.
    """

    solids: list[Solid]
    eye: Point2 = (-1.2, 0.0)
    target: Point3 = (0.0, 0.0, 0.75)
    random: Generator = field(default_factory=lambda: np.random.default_rng(7))
    blind: Sequence[int] = ()
    failing: bool = False
    silent: bool = False
    depthless: bool = False
    label_noise: float = 0.0
    relations: tuple[Triplet, ...] = ()
    joints: JointState | None = None
    rendering: Rendering | None = None

    @property
    def T_room_base(self) -> SE3:
        """The robot's pose: at ``eye``, facing ``target``."""
        yaw_rad = float(np.arctan2(self.target[1] - self.eye[1], self.target[0] - self.eye[0]))
        return SE3.from_xyz_yaw(*self.eye, 0.0, yaw_rad)

    def frame(self, stamp_s: float) -> RgbdFrame:
        """The camera's image now."""
        T_room_camera = look_at((*self.eye, CAMERA_HEIGHT_M), self.target)
        self.rendering = _rendered(tuple(self.solids), self.eye, self.target)
        frame = rgbd_frame(
            self.rendering,
            stamp_s=stamp_s,
            T_base_camera=self.T_room_base.inverse() @ T_room_camera,
            random=self.random,
        )
        return replace(frame, depth_m=np.full_like(frame.depth_m, np.nan)) if self.depthless else frame

    async def infer(self, frame: RgbdFrame) -> PanopticScene:
        """The network's answer, as good as the script allows."""
        if self.failing:
            raise InferenceFailed("scripted", frame.stamp_s)
        if self.rendering is None:
            raise InferenceFailed("nothing was rendered yet", frame.stamp_s)
        scene = panoptic_scene(self.rendering, self.solids, stamp_s=frame.stamp_s, blind=self.blind)
        instances = tuple(
            replace(i, label="toaster", label_distribution=(("toaster", 0.9),))
            if self.random.random() < self.label_noise
            else i
            for i in scene.instances
        )
        return PanopticScene(stamp_s=frame.stamp_s, instances=instances, relations=self.relations)

    def fill(self, buffer: SensorBuffer, stamp_s: float) -> None:
        """Put the newest measurements where agents look for them."""
        base = self.T_room_base
        buffer.add_odometry(
            Odometry(
                stamp_s=stamp_s, x_m=base.x_m, y_m=base.y_m, yaw_rad=base.yaw_rad, linear_mps=0.0, angular_radps=0.0
            )
        )
        if self.joints is not None:
            buffer.add_joints(replace(self.joints, stamp_s=stamp_s))
        if not self.silent:
            buffer.frame = self.frame(stamp_s)

    def locate(self, memory: WorkingMemory, stamp_s: float, error: SE3 | None = None, std_rad: float = 0.0063) -> None:
        """Write the robot's pose in ``room_1`` into the graph, as localization does; ``error`` is right-multiplied,
        ``std_rad`` what localization says of the heading then.
        """
        edge = RtEdge(
            source="room_1",
            target=ROBOT_ID,
            T_source_target=self.T_room_base @ (error or SE3.identity()),
            covariance=np.diag((1e-4, 1e-4, 1e-8, 1e-8, 1e-8, std_rad**2)) if error is not None else np.zeros((6, 6)),
            stamp_s=stamp_s,
        )
        memory.commit([PutEdge(edge)], agent="energy_optimizer", stamp_s=stamp_s)


@lru_cache(maxsize=4)
def _rendered(solids: tuple[Solid, ...], eye: Point2, target: Point3) -> Rendering:
    """What a camera there sees; while nothing moves, it is the same picture."""
    return render(solids, look_at((*eye, CAMERA_HEIGHT_M), target))


class NoSensors:
    """A port that is never asked: scripted tests fill the buffer themselves."""

    async def odometry(self) -> Odometry:
        """Not available."""
        raise NotImplementedError

    async def scan(self) -> LidarScan:
        """Not available."""
        raise NotImplementedError

    async def frame(self) -> RgbdFrame:
        """Not available."""
        raise NotImplementedError

    async def joints(self) -> JointState:
        """Not available."""
        raise NotImplementedError


def furnished_memory(rooms: int = 1, half_m: float = 3.0) -> WorkingMemory:
    """Working memory with square permanent rooms in a row along x and the robot in ``room_1``."""
    memory = WorkingMemory()
    corners = ((-half_m, -half_m), (half_m, -half_m), (half_m, half_m), (-half_m, half_m))
    edits: list[Edit] = []
    for number in range(1, rooms + 1):
        room = RoomNode(id=f"room_{number}", polygon_m=corners, status=RoomStatus.PERMANENT)
        T_root_room = SE3.from_xyz_yaw((number - 1) * (2.0 * half_m + 0.2), 0.0, 0.0, 0.0)
        edits += [PutNode(room), PutEdge(RtEdge(source=ROOT_ID, target=room.id, T_source_target=T_root_room))]
    edits += [
        RemoveEdge(EdgeKey(EdgeType.RT, ROOT_ID, ROBOT_ID)),
        PutEdge(RtEdge(source="room_1", target=ROBOT_ID, T_source_target=SE3.identity())),
        PutEdge(InEdge(source=ROBOT_ID, target="room_1")),
    ]
    memory.commit(edits, agent="room_concept", stamp_s=0.0)
    return memory


def say(memory: WorkingMemory, status: str, stamp_s: float) -> None:
    """Let the skills announce what the robot does."""
    robot = memory.snapshot().typed(ROBOT_ID, RobotNode)
    memory.commit([PutNode(replace(robot, status=status))], agent="robot_body", stamp_s=stamp_s)
