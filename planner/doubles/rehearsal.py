"""A rehearsal: a made-up flat without physics, whose skills succeed or fail as a script says. For tests of the planner.

The stage keeps its own truth of where things are. ``Stage.look`` plays perception: what stands near the robot is seen,
what should stand there and does not becomes missing, the rest of the graph keeps its belief.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from scene_graph.edges import ConnectsEdge, Edge, EdgeType, InEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import (
    ROBOT_ID,
    ROOT_ID,
    CrossingStatus,
    DoorNode,
    Node,
    ObjectNode,
    ObjectState,
    RobotNode,
    RoomNode,
    RoomStatus,
    RootNode,
    WallNode,
)
from scene_graph.snapshot import Snapshot
from skills.ports import NO_FLOOR, ArmGeometry, ArmTarget, BodyLimits, BodyState, FloorReturns

ROOMS = {"room_1": ("kitchen", 2.0), "room_2": ("office", 6.2)}
SUPPORTS = {"table_1": "room_1", "shelf_1": "room_1", "desk_1": "room_2"}
GRIPPER = "gripper"
STOWED = ArmTarget(lift_m=0.75, extension_m=0.0, wrist_pitch_rad=-1.57)
PERCEPTION = "rehearsal"


def rehearsal_graph() -> Snapshot:
    """A kitchen with a table and a shelf, an office with a desk, a door between; a blue bottle stands on the table."""
    square = ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))
    nodes: list[Node] = [RootNode(), RobotNode()]
    edges: list[Edge] = []
    for room, (label, x_m) in ROOMS.items():
        nodes.append(RoomNode(id=room, label=label, polygon_m=square, status=RoomStatus.PERMANENT))
        edges.append(_hang(ROOT_ID, room, x_m, 2.0, 0.0))
    for room, other, side in (("1", "2", 1.0), ("2", "1", -1.0)):
        wall = WallNode(
            id=f"wall_{room}_0", parent_room=f"room_{room}", normal=(-side, 0.0), offset_m=-2.0, length_m=4.0
        )
        rooms = (f"room_{room}", f"room_{other}")
        door = DoorNode(
            id=f"door_{room}_0_0", rooms=rooms, width_m=0.9, provisional=False, crossing=CrossingStatus.CROSSED
        )
        nodes += [wall, door]
        edges += [_hang(rooms[0], wall.id, 2.0 * side, 0.0, 0.0), _hang(wall.id, door.id, 0.0, 0.0, 0.0)]
        edges += [ConnectsEdge(source=door.id, target=room_id) for room_id in rooms]
    edges.append(MatchEdge(source="door_1_0_0", target="door_2_0_0"))
    for index, (support, room) in enumerate(SUPPORTS.items()):
        label = support.rpartition("_")[0]
        nodes.append(ObjectNode(id=support, label=label, size_m=(1.0, 0.6, 0.7), support=True))
        edges += [_hang(room, support, 1.0 - index, 1.5, 0.35), InEdge(source=support, target=room)]
    nodes.append(ObjectNode(id="bottle_1", label="bottle", color="blue", size_m=(0.06, 0.06, 0.2), graspable=True))
    edges += [_hang("room_1", "bottle_1", 1.0, 1.5, 0.8), InEdge(source="bottle_1", target="room_1")]
    edges.append(RelationEdge(source="bottle_1", target="table_1", predicate="on", probability=0.95))
    edges += [_hang("room_1", ROBOT_ID, 0.0, -1.0, 0.0), InEdge(source=ROBOT_ID, target="room_1")]
    return Snapshot.of(nodes, edges)


@dataclass(kw_only=True)
class Stage:
    """The truth of the rehearsal.

    ``places``: where each object that can be carried really is: a support, ``gripper``, or ``None`` when taken away.
    ``robot_at``: the support or room that the robot stands at. ``blind``: perception sees nothing.
    """

    memory: WorkingMemory
    places: dict[str, str | None] = field(default_factory=lambda: {"bottle_1": "table_1"})
    robot_at: str = "room_1"
    blind: bool = False

    def look(self, stamp_s: float) -> None:
        """One turn of perception."""
        snapshot = self.memory.snapshot()
        edits: list[Edit] = []
        if not self.blind:
            for object_id in sorted(self.places):
                edits += self._see(object_id, snapshot, stamp_s)
        self.memory.commit(edits, agent=PERCEPTION, stamp_s=stamp_s)

    def stand_at(self, node_id: str, stamp_s: float) -> None:
        """Put the robot, in truth and in belief, half a meter before a node."""
        self.robot_at = node_id
        snapshot = self.memory.snapshot()
        room = SUPPORTS.get(node_id, node_id)
        x_m, y_m, _ = snapshot.position(node_id, room)
        edits: list[Edit] = [RemoveEdge(edge.key) for edge in snapshot.edges_to(ROBOT_ID, EdgeType.RT)]
        edits += [RemoveEdge(edge.key) for edge in snapshot.edges_from(ROBOT_ID, EdgeType.IN)]
        edits += [PutEdge(_hang(room, ROBOT_ID, float(x_m), float(y_m) - 0.7, 0.0, stamp_s))]
        edits += [PutEdge(InEdge(source=ROBOT_ID, target=room))]
        self.memory.commit(edits, agent=PERCEPTION, stamp_s=stamp_s)

    def _see(self, object_id: str, snapshot: Snapshot, stamp_s: float) -> list[Edit]:
        node, place = snapshot.object(object_id), self.places[object_id]
        if place == GRIPPER:
            return self._hold(node, snapshot, stamp_s) if node.state is not ObjectState.HELD else []
        if place is not None and place == self.robot_at:
            return self._put(node, place, snapshot, stamp_s)
        believed = snapshot.support_of(object_id)
        if node.state is ObjectState.HELD:
            return self._put(replace(node, state=ObjectState.MISSING), self.robot_at, snapshot, node.last_seen_s)
        if believed == self.robot_at and node.state is ObjectState.PRESENT:
            return [PutNode(replace(node, state=ObjectState.MISSING, existence=0.1))]
        return []

    def _hold(self, node: ObjectNode, snapshot: Snapshot, stamp_s: float) -> list[Edit]:
        robot = snapshot.robot or RobotNode()
        edits = self._loosen(node.id, snapshot)
        edits += [PutNode(replace(node, state=ObjectState.HELD, last_seen_s=stamp_s))]
        edits += [PutNode(replace(robot, holding=node.id)), PutEdge(_hang(ROBOT_ID, node.id, 0.3, 0.0, 0.8, stamp_s))]
        return [*edits, PutEdge(InEdge(source=node.id, target=snapshot.current_room or "room_1"))]

    def _put(self, node: ObjectNode, place: str, snapshot: Snapshot, stamp_s: float) -> list[Edit]:
        robot, room = snapshot.robot or RobotNode(), SUPPORTS.get(place, place)
        state = ObjectState.PRESENT if node.state is ObjectState.HELD else node.state
        if self.places[node.id] == place:
            state = ObjectState.PRESENT
        x_m, y_m, z_m = snapshot.position(place, room)
        edits = self._loosen(node.id, snapshot)
        edits += [PutNode(replace(node, state=state, last_seen_s=stamp_s, observations=node.observations + 1))]
        if robot.holding == node.id:
            edits.append(PutNode(replace(robot, holding=None)))
        edits += [PutEdge(_hang(room, node.id, float(x_m), float(y_m), float(z_m) + 0.45, stamp_s))]
        edits += [PutEdge(InEdge(source=node.id, target=room))]
        if place in SUPPORTS:
            edits.append(PutEdge(RelationEdge(source=node.id, target=place, predicate="on", probability=0.95)))
        return edits

    def _loosen(self, object_id: str, snapshot: Snapshot) -> list[Edit]:
        edges = [*snapshot.edges_to(object_id, EdgeType.RT), *snapshot.edges_from(object_id)]
        return [RemoveEdge(edge.key) for edge in edges]


class StillBody:
    """A body port that notes what it is told. ``silent``: it does not answer."""

    limits = BodyLimits()
    geometry = ArmGeometry()

    def __init__(self) -> None:
        self.stopped = False
        self.silent = False
        self.drives: list[tuple[float, float]] = []
        self.arms: list[ArmTarget] = []

    @property
    def moving(self) -> bool:
        """Whether the last drive command was anything but standing still, and no stop has followed."""
        return bool(self.drives) and self.drives[-1] != (0.0, 0.0)

    async def state(self) -> BodyState:
        """As commanded."""
        self._answer()
        return BodyState(
            stamp_s=0.0,
            linear_mps=0.0,
            angular_radps=0.0,
            arm=STOWED,
            gripper_opening_m=0.1,
            finger_contacts=(False, False),
            pan_rad=0.0,
            tilt_rad=0.0,
            bumped=False,
            stopped=self.stopped,
            T_base_gripper=SE3.identity(),
        )

    async def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Note it."""
        self._answer()
        self.drives.append((linear_mps, angular_radps))

    async def look(self, pan_rad: float, tilt_rad: float) -> None:
        """Nothing moves."""
        del pan_rad, tilt_rad
        self._answer()

    async def move_arm(self, target: ArmTarget) -> None:
        """Note it."""
        self._answer()
        self.arms.append(target)

    async def grip(self, opening_m: float, effort_n: float = 15.0) -> None:
        """Nothing moves."""
        del opening_m, effort_n
        self._answer()

    def stop(self) -> None:
        """Latch: the base stands still."""
        self.stopped = True
        self.drives.append((0.0, 0.0))

    def release_stop(self) -> None:
        """Lift the latch."""
        self.stopped = False

    def points_base(self) -> NDArray[np.float64]:
        """No obstacles; the body serves as range source, too."""
        return np.zeros((0, 3))

    def floor_base(self) -> FloorReturns:
        """Nor anything low."""
        return NO_FLOOR

    def seen_base(self) -> NDArray[np.float64]:
        """Nor has it a camera."""
        return np.zeros((0, 3))

    def _answer(self) -> None:
        if self.silent:
            raise TimeoutError("the body does not answer")


def _hang(parent: str, child: str, x_m: float, y_m: float, z_m: float, stamp_s: float = 0.0) -> RtEdge:
    return RtEdge(source=parent, target=child, T_source_target=SE3.from_xyz_yaw(x_m, y_m, z_m, 0.0), stamp_s=stamp_s)
