"""A small furnished flat in the graph, and bodies that move in it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import pi

import pytest

from scene_graph.edges import ConnectsEdge, EdgeType, InEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import (
    CrossingStatus,
    DoorNode,
    DoorState,
    ObjectNode,
    ObjectState,
    PersonNode,
    RoomNode,
    RoomStatus,
    WallNode,
)
from skills.action import RobotContext
from skills.arm.kinematics import gripper_pose
from skills.doubles import BoxWorld, FakeBody, Rehearsal
from skills.geometry import Box2, Pose2
from skills.ports import BodyLimits, BodyState
from skills.registry import load_registry

SKILLS = load_registry([])
TABLES = (Box2(Pose2(1.0, 1.2), 1.2, 0.8), Box2(Pose2(-1.5, -1.5), 1.2, 0.8))


class Flat:
    """Builds a graph: room_1 (6 x 5) at the root, room_2 (4 x 5) to its east, a door between them at (3, 0)."""

    def __init__(self, *, door_state: DoorState = DoorState.OPEN, width_m: float = 0.9) -> None:
        self.memory = WorkingMemory()
        snapshot = self.memory.snapshot()
        with self.memory.edit("test", 0.0) as tx:
            for edge in (snapshot.parent("robot"),):
                tx.remove(edge.key)
            self._room(tx, "room_1", (3.0, 2.5), SE3.identity())
            self._room(tx, "room_2", (2.0, 2.5), SE3.from_xyz_yaw(5.2, 0.0, 0.0, 0.0))
            tx.put(RtEdge(source="room_1", target="robot", T_source_target=SE3.identity()))
            tx.put(InEdge(source="robot", target="room_1"))
            self._wall(tx, "wall_1_1", "room_1", SE3.from_xyz_yaw(3.0, 0.0, 0.0, pi / 2))
            self._wall(tx, "wall_2_3", "room_2", SE3.from_xyz_yaw(-2.0, 0.0, 0.0, -pi / 2))
            self._door(tx, "door_1_1_0", "wall_1_1", ("room_1", "room_2"), door_state, width_m)
            self._door(tx, "door_2_3_0", "wall_2_3", ("room_2", "room_1"), door_state, width_m)
            tx.put(MatchEdge(source="door_1_1_0", target="door_2_3_0"))

    def thing(
        self,
        node_id: str,
        at: tuple[float, float, float],
        size: tuple[float, float, float],
        *,
        yaw: float = 0.0,
        on: str | None = None,
        room: str = "room_1",
        **fields: object,
    ) -> Flat:
        """Put an object whose center is at ``at``."""
        label = node_id.rsplit("_", 1)[0].replace("_", " ")
        with self.memory.edit("test", 0.0) as tx:
            tx.put(ObjectNode(id=node_id, label=label, size_m=size, **fields))
            tx.put(RtEdge(source=room, target=node_id, T_source_target=SE3.from_xyz_yaw(*at, yaw)))
            tx.put(InEdge(source=node_id, target=room))
            if on is not None:
                tx.put(RelationEdge(source=node_id, target=on, predicate="on", probability=0.95))
        return self

    def table(self, node_id: str = "table_1", x: float = 1.0, y: float = 1.2, room: str = "room_1") -> Flat:
        """Put a table, 1.2 x 0.8 x 0.75 m."""
        return self.thing(node_id, (x, y, 0.375), (1.2, 0.8, 0.75), room=room, support=True)

    def bottle(self, node_id: str = "bottle_1", x: float = 1.0, y: float = 0.95, on: str = "table_1") -> Flat:
        """Put a bottle on a table."""
        return self.thing(node_id, (x, y, 0.87), (0.07, 0.07, 0.24), on=on, graspable=True)

    def person(self, x: float, y: float, room: str = "room_1", stamp_s: float = 0.0) -> Flat:
        """Put a person, seen at ``stamp_s``."""
        with self.memory.edit("test", stamp_s) as tx:
            tx.put(PersonNode(id="person_1", last_seen_s=stamp_s))
            tx.put(RtEdge(source=room, target="person_1", T_source_target=SE3.from_xyz_yaw(x, y, 0.0, 0.0)))
            tx.put(InEdge(source="person_1", target=room))
        return self

    def context(self, stamp_s: float = 0.0, **more: object) -> RobotContext:
        """What actions share, with a robot at rest."""
        body, limits = FakeBody(), BodyLimits()
        state = BodyState(
            stamp_s=stamp_s, linear_mps=0.0, angular_radps=0.0, arm=body.arm, gripper_opening_m=0.0,
            finger_contacts=(False, False), pan_rad=0.0, tilt_rad=0.0, bumped=False, stopped=False,
            T_base_gripper=gripper_pose(body.arm, body.geometry),
        )  # fmt: skip
        return RobotContext(
            memory=self.memory, limits=limits, geometry=body.geometry, body=state, stamp_s=stamp_s, **more
        )

    @staticmethod
    def _room(tx, node_id, half, pose) -> None:
        hx, hy = half
        polygon = ((-hx, -hy), (hx, -hy), (hx, hy), (-hx, hy))
        tx.put(RoomNode(id=node_id, polygon_m=polygon, status=RoomStatus.PERMANENT))
        tx.put(RtEdge(source="root", target=node_id, T_source_target=pose))

    @staticmethod
    def _wall(tx, node_id, room, pose) -> None:
        tx.put(WallNode(id=node_id, parent_room=room, normal=(-1.0, 0.0), offset_m=-3.0, length_m=5.0))
        tx.put(RtEdge(source=room, target=node_id, T_source_target=pose))

    @staticmethod
    def _door(tx, node_id, wall, rooms, state, width_m) -> None:
        door = DoorNode(
            id=node_id,
            rooms=rooms,
            width_m=width_m,
            state=state,
            provisional=False,
            crossing=CrossingStatus.CROSSED,
        )
        tx.put(door, RtEdge(source=wall, target=node_id, T_source_target=SE3.identity()))
        tx.put(ConnectsEdge(source=node_id, target=rooms[0]), ConnectsEdge(source=node_id, target=rooms[1]))


@pytest.fixture
def flat() -> Callable[..., Flat]:
    """Makes flats."""
    return Flat


@pytest.fixture
def anyio_backend() -> str:
    """Asyncio only."""
    return "asyncio"


class Onlooker:
    """Plays perception in a rehearsal: sees every object five times a second, and what the hand took or let go."""

    def __init__(self) -> None:
        self._seen_s = -1.0
        self.blind_to: set[str] = set()

    def __call__(self, rehearsal) -> None:
        body, memory = rehearsal.body, rehearsal.memory
        if body.stamp_s - self._seen_s < 0.2:
            return
        self._seen_s = body.stamp_s
        snapshot, context = memory.snapshot(), rehearsal.context
        robot, status = snapshot.robot, snapshot.robot.status
        with memory.edit("objects", body.stamp_s) as tx:
            for node in snapshot.of_type(ObjectNode):
                if node.id not in self.blind_to and node.state is ObjectState.PRESENT:
                    tx.put(replace(node, last_seen_s=body.stamp_s, observations=node.observations + 1))
        if robot.holding is None and status.startswith("grasping") and all(context.body.finger_contacts):
            self._take(rehearsal, status.split()[1])
        elif robot.holding is not None and not any(context.body.finger_contacts):
            self._leave(
                rehearsal,
                robot.holding,
                status.split()[-1] if status.startswith("releasing") else snapshot.current_room,
            )

    @staticmethod
    def _take(rehearsal, object_id) -> None:
        snapshot, body = rehearsal.memory.snapshot(), rehearsal.body
        with rehearsal.memory.edit("objects", body.stamp_s) as tx:
            tx.remove(snapshot.parent(object_id).key)
            for relation in snapshot.relations(source=object_id):
                tx.remove(relation.key)
            pose = snapshot.transform("robot", object_id)
            tx.put(RtEdge(source="robot", target=object_id, T_source_target=pose))
            tx.put(replace(snapshot.object(object_id), state=ObjectState.HELD))
            tx.put(replace(snapshot.robot, holding=object_id))

    @staticmethod
    def _leave(rehearsal, object_id, place) -> None:
        snapshot, body = rehearsal.memory.snapshot(), rehearsal.body
        room, node = snapshot.current_room, snapshot.object(object_id)
        hand = snapshot.transform(room, "robot") @ gripper_pose(body.arm, body.geometry)
        top = snapshot.position(place, room)[2] + snapshot.object(place).size_m[2] / 2 if place != room else 0.0
        pose = SE3.from_xyz_yaw(hand.x_m, hand.y_m, top + node.size_m[2] / 2, 0.0)
        with rehearsal.memory.edit("objects", body.stamp_s) as tx:
            tx.remove(snapshot.parent(object_id).key)
            tx.put(RtEdge(source=room, target=object_id, T_source_target=pose))
            tx.remove(*[edge.key for edge in snapshot.edges_from(object_id, EdgeType.IN)])
            tx.put(InEdge(source=object_id, target=room))
            if place != room:
                tx.put(RelationEdge(source=object_id, target=place, predicate="on", probability=0.9))
            tx.put(replace(node, state=ObjectState.PRESENT, last_seen_s=body.stamp_s))
            tx.put(replace(snapshot.robot, holding=None))


@pytest.fixture
def onlooker() -> Onlooker:
    """Plays perception."""
    return Onlooker()


def width_at_hand(rehearsal_memory, width_m: float = 0.07):
    """Says what is between the fingers: an object held, or one whose center is near the pads."""

    def between(body) -> float | None:
        snapshot = rehearsal_memory.snapshot()
        hand = gripper_pose(body.arm, body.geometry).translation_m
        for node in snapshot.of_type(ObjectNode):
            if node.graspable:
                x, y, z = snapshot.position(node.id, "robot")
                inside = abs(z - hand[2]) < node.size_m[2] / 2
                if node.state is ObjectState.HELD or (abs(x - hand[0]) < 0.02 and abs(y - hand[1]) < 0.02 and inside):
                    return width_m
        return None

    return between


@pytest.fixture
def fingers():
    """Makes functions that say what is between the fingers."""
    return width_at_hand


@pytest.fixture
def kitchen(flat, onlooker, fingers):
    """A rehearsal at a bottle on a table, with a second table."""

    def build(change=lambda built: built):
        built = change(flat().table().bottle().table("table_2", -1.5, -1.5))
        body = FakeBody(pose=Pose2(0.9, 0.35, 1.5), grasped_width_m=fingers(built.memory))
        world = BoxWorld(boxes=TABLES, heights_m=(0.3, 0.6))
        return Rehearsal(memory=built.memory, body=body, world=world, observe=onlooker)

    return build


@pytest.fixture
def carry_out():
    """Carries out skills one after the other in a rehearsal; the first failure, if any."""

    async def run(rehearsal, *steps):
        context = await rehearsal.prepare()
        for skill, *args in steps:
            began_s = rehearsal.body.stamp_s
            failure = await rehearsal.run(SKILLS[skill].actions(context, args), 900.0)
            failure = failure or SKILLS[skill].confirmed(rehearsal.memory.snapshot(), args, began_s)
            if failure is not None:
                return failure
        return None

    return run
