"""A physics stage: the simulated robot moves, and the graph is told the truth, so that only the skills are measured.

Perception is played from the simulator's truth here and nowhere else.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import pi
from typing import Any

import numpy as np
from py_trees.common import Status

from perception.ports import LidarScan
from perception.sensing import scan_points_base
from scene_graph.edges import ConnectsEdge, EdgeType, InEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode, ObjectNode, ObjectState, PersonNode, RoomNode, RoomStatus, WallNode
from simulation.furnishing.catalog import CATEGORIES
from simulation.process.client import SimulatedRobot
from skills.action import RobotContext
from skills.registry import load_registry

ROOMS = {"room_1": ((0.0, 0.0), (3.0, 2.5)), "room_2": ((5.2, 0.0), (2.0, 2.5))}
"""Center and half extents in house coordinates; the frame of room_1 is the house's."""
SKILLS = load_registry([])


def two_rooms(furniture: list[dict], objects: list[dict], robot: Sequence[float], **more: Any) -> dict[str, Any]:
    """Two rooms with a door of 0.8 m between them."""
    rooms = [
        {"id": name, "label": name, "polygon": [[cx + sx * hx, cy + sy * hy] for sx, sy in CORNERS]}
        for name, ((cx, cy), (hx, hy)) in ROOMS.items()
    ]
    door = {"id": "d1", "rooms": ["room_1", "room_2"], "center": [3.1, 0.0], "width": 0.8}
    parts = {"rooms": rooms, "doors": [door], "furniture": furniture, "objects": objects, "robot": {"pose": robot}}
    return {"name": "stage", **parts, **more}


CORNERS = ((-1, -1), (1, -1), (1, 1), (-1, 1))


class Stage:
    """Ticks actions on the simulated robot; ``noise_m`` is added to the objects' positions that the graph is told."""

    def __init__(self, robot: SimulatedRobot, plan: dict[str, Any], *, noise_m: float = 0.0, seed: int = 0) -> None:
        self.robot, self.plan, self.noise_m = robot, plan, noise_m
        self.memory = WorkingMemory()
        self.now_s = 0.0
        self.context: RobotContext | None = None
        self.truth: dict[str, Any] = {}
        self.newest: LidarScan | None = None
        self.speak: Callable[[str], None] = lambda _: None
        self._rng = np.random.default_rng(seed)
        self._sizes = {item["id"]: _size(item) for item in (*plan["furniture"], *plan["objects"])}
        self._told_s = self._seen_s = -1.0

    async def begin(self) -> None:
        """Build the graph and a context."""
        self.truth = await self.robot.truth()
        with self.memory.edit("stage", 0.0) as tx:
            tx.remove(self.memory.snapshot().parent("robot").key)
            for name, ((x, y), (hx, hy)) in ROOMS.items():
                polygon = tuple((sx * hx, sy * hy) for sx, sy in CORNERS)
                tx.put(RoomNode(id=name, polygon_m=polygon, status=RoomStatus.PERMANENT))
                tx.put(RtEdge(source="root", target=name, T_source_target=SE3.from_xyz_yaw(x, y, 0.0, 0.0)))
            self._door(tx, "door_1_1_0", "wall_1_1", "room_1", "room_2", SE3.from_xyz_yaw(3.0, 0.0, 0.0, pi / 2))
            self._door(tx, "door_2_3_0", "wall_2_3", "room_2", "room_1", SE3.from_xyz_yaw(-2.0, 0.0, 0.0, -pi / 2))
            tx.put(MatchEdge(source="door_1_1_0", target="door_2_3_0"))
            tx.put(RtEdge(source="room_1", target="robot", T_source_target=SE3.identity()))
            tx.put(InEdge(source="robot", target="room_1"))
            for item in (*self.plan["furniture"], *self.plan["objects"]):
                self._thing(tx, item)
            for person in self.plan.get("people", []):
                self._put(tx, PersonNode(id=person["id"]), *person["pose"][:2], 0.0, person["pose"][2])
        await self._refresh()

    async def run(self, actions, limit_s: float = 200.0):
        """Tick the actions one after the other; the failure of the first that fails."""
        for action in actions:
            began_s = self.now_s
            while action.status is not Status.SUCCESS:
                await self._refresh()
                action.tick_once()
                await self.context.commands.flush(self.robot)
                self.now_s = await self.robot.advance(0.05)
                if action.status is Status.FAILURE:
                    self.speak(f"{self.now_s:6.1f} {action.name}: {action.failure}")
                    return action.failure
                assert self.now_s - began_s < limit_s, f"{action.name} goes on and on"
            self.speak(f"{self.now_s:6.1f} {action.name}: {self.now_s - began_s:.1f} s")
        return None

    async def carry_out(self, *steps: Sequence[str]):
        """Carry out (skill, arguments ...) one after the other; the first failure."""
        for skill, *args in steps:
            began_s = self.now_s
            failure = await self.run(SKILLS[skill].actions(self.context, args))
            failure = failure or SKILLS[skill].confirmed(self.memory.snapshot(), args, began_s)
            if failure is not None:
                return failure
        return None

    def where(self, object_id: str) -> dict[str, Any]:
        """The truth about an object."""
        return next(record for record in self.truth["objects"] if record["id"] == object_id)

    async def _refresh(self) -> None:
        body = await self.robot.state()
        self.now_s = body.stamp_s
        if self.context is None:
            limits, geometry = self.robot.limits, self.robot.geometry
            self.context = RobotContext(memory=self.memory, limits=limits, geometry=geometry, body=body)
        self.context.body, self.context.stamp_s = body, body.stamp_s
        if self.now_s - self._told_s > 0.099:
            self._told_s = self.now_s
            self.truth = await self.robot.truth()
            self._localize()
            self.newest = await self.robot.scan()
            self.context.obstacles_base = _obstacles(self.newest)
        if self.now_s - self._seen_s > 0.199:
            self._seen_s = self.now_s
            self._see()

    def _localize(self) -> None:
        x, y, yaw = self.truth["robot"]["pose"]
        snapshot = self.memory.snapshot()
        room = "room_2" if x > 3.2 else "room_1"
        (cx, cy), _ = ROOMS[room]
        with self.memory.edit("stage", self.now_s) as tx:
            old = snapshot.parent("robot")
            if old.source != room:
                tx.remove(old.key)
                tx.remove(InEdge(source="robot", target=old.source).key)
                tx.put(InEdge(source="robot", target=room))
            pose = SE3.from_xyz_yaw(x - cx, y - cy, 0.0, yaw)
            tx.put(RtEdge(source=room, target="robot", T_source_target=pose, stamp_s=self.now_s))

    def _see(self) -> None:
        """Objects in plain view are seen; the grip is felt. What the hand hides or holds is not moved."""
        snapshot = self.memory.snapshot()
        robot, body = snapshot.robot, self.context.body
        firm = all(body.finger_contacts) and body.gripper_opening_m > 0.003
        for record in self.truth["objects"]:
            node = snapshot.object(record["id"])
            if robot.holding is None and firm and robot.status == f"grasping {node.id}":
                self._take(node)
            elif robot.holding == node.id and not any(body.finger_contacts):
                self._sight(node, record, let_go=True)
            elif robot.holding != node.id and not (robot.status.startswith("grasping") and body.arm.extension_m > 0.1):
                self._sight(node, record, let_go=False)

    def _take(self, node: ObjectNode) -> None:
        snapshot = self.memory.snapshot()
        with self.memory.edit("stage", self.now_s) as tx:
            self._unhang(tx, snapshot, node.id)
            pose = snapshot.transform("robot", node.id)
            tx.put(RtEdge(source="robot", target=node.id, T_source_target=pose, stamp_s=self.now_s))
            tx.put(replace(node, state=ObjectState.HELD), replace(snapshot.robot, holding=node.id))

    def _sight(self, node: ObjectNode, record: dict[str, Any], *, let_go: bool) -> None:
        snapshot = self.memory.snapshot()
        with self.memory.edit("stage", self.now_s) as tx:
            yaw = snapshot.transform("root", node.id).yaw_rad
            self._unhang(tx, snapshot, node.id)
            seen = replace(node, state=ObjectState.PRESENT, last_seen_s=self.now_s, observations=node.observations + 1)
            position = np.array(record["position_m"]) + self._rng.normal(0.0, self.noise_m, 3)
            self._put(tx, seen, *position, yaw)
            if (carrier := record["on"] or record["in"]) is not None:
                tx.put(RelationEdge(source=node.id, target=carrier, predicate="on", probability=0.95))
            if let_go:
                tx.put(replace(snapshot.robot, holding=None))

    @staticmethod
    def _unhang(tx, snapshot, node_id: str) -> None:
        tx.remove(snapshot.parent(node_id).key)
        tx.remove(*[edge.key for edge in snapshot.relations(source=node_id)])
        tx.remove(*[edge.key for edge in snapshot.edges_from(node_id, EdgeType.IN)])

    def _thing(self, tx, item: dict[str, Any]) -> None:
        size, category = self._sizes[item["id"]], CATEGORIES[item["category"]]
        movable = item in self.plan["objects"]
        graspable = movable and min(size[:2]) < 0.1
        node = ObjectNode(
            id=item["id"],
            label=item["category"],
            size_m=size,
            graspable=graspable,
            support=category.support and not movable,
            back_rad=pi / 2 if item["category"] in ("chair", "sofa", "bed") else None,
            surfaces_m=tuple(sorted(share * size[2] for share in category.levels)) if len(category.levels) > 1 else (),
        )
        if movable:
            record = self.where(item["id"])
            self._put(tx, node, *record["position_m"], self._yaw_of(item))
            on = item.get("on") or record["on"]
            tx.put(RelationEdge(source=item["id"], target=on, predicate="on", probability=0.95)) if on else None
        else:
            x, y, yaw = item["pose"]
            self._put(tx, node, x, y, size[2] / 2, yaw)

    def _yaw_of(self, item: dict[str, Any]) -> float:
        """Things are put down along what carries them, if not as the plan says."""
        if "pose" in item:
            return float(item["pose"][3])
        return next((other["pose"][2] for other in self.plan["furniture"] if other["id"] == item.get("on")), 0.0)

    def _put(self, tx, node, x: float, y: float, z: float, yaw: float) -> None:
        room = "room_2" if x > 3.1 else "room_1"
        (cx, cy), _ = ROOMS[room]
        pose = SE3.from_xyz_yaw(x - cx, y - cy, z, yaw)
        tx.put(node, RtEdge(source=room, target=node.id, T_source_target=pose, stamp_s=self.now_s))
        tx.put(InEdge(source=node.id, target=room))

    @staticmethod
    def _door(tx, node_id: str, wall: str, room: str, other: str, pose: SE3) -> None:
        tx.put(WallNode(id=wall, parent_room=room, normal=(-1.0, 0.0), offset_m=-3.0, length_m=5.0))
        tx.put(RtEdge(source=room, target=wall, T_source_target=pose))
        tx.put(DoorNode(id=node_id, rooms=(room, other), width_m=0.8, provisional=False))
        tx.put(RtEdge(source=wall, target=node_id, T_source_target=SE3.identity()))
        tx.put(ConnectsEdge(source=node_id, target=room), ConnectsEdge(source=node_id, target=other))


def _size(item: dict[str, Any]) -> tuple[float, float, float]:
    return tuple(item.get("size") or CATEGORIES[item["category"]].size_m)


def _obstacles(scan):
    points = scan_points_base(scan)
    return points[(points[:, 2] > 0.06) & (points[:, 2] < 2.2)]
