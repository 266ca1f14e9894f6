"""A building of any number of rooms, made up in memory, to measure what knowing it costs."""

from __future__ import annotations

import numpy as np

from scene_graph.edges import ConnectsEdge, Edge, InEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import (
    CornerNode,
    CrossingStatus,
    DoorNode,
    Node,
    ObjectNode,
    RobotNode,
    RoomNode,
    RoomStatus,
    RootNode,
    WallNode,
)
from scene_graph.snapshot import Snapshot

_SQUARE = ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))
_WALLS, _THINGS = 4, 19


def _hang(parent: str, child: str, x_m: float = 0.0) -> RtEdge:
    pose = SE3.from_xyz_yaw(x_m, 0.1, 0.0, 0.2)
    return RtEdge(source=parent, target=child, T_source_target=pose, covariance=np.eye(6) * 1e-4)


def known_building(rooms: int) -> Snapshot:
    """Rooms in a row, each of 30 nodes: itself, walls, corners, doors, things on a table. The robot is in the fifth."""
    nodes: list[Node] = [RootNode(), RobotNode()]
    edges: list[Edge] = [_hang("room_5", "robot"), InEdge(source="robot", target="room_5")]
    for i in range(1, rooms + 1):
        room = f"room_{i}"
        nodes.append(RoomNode(id=room, polygon_m=_SQUARE, status=RoomStatus.PERMANENT))
        edges.append(_hang("root", room, 4.2 * i))
        for k in range(_WALLS):
            wall, corner = f"wall_{i}_{k}", f"corner_{i}_{k}"
            nodes += [WallNode(id=wall, parent_room=room, normal=(0.0, 1.0), offset_m=-2.0, length_m=4.0)]
            nodes += [CornerNode(id=corner)]
            edges += [_hang(room, wall), _hang(wall, corner)]
        for k in range(_THINGS):
            thing = f"thing_{i}_{k}"
            nodes.append(ObjectNode(id=thing, label="cup", graspable=k > 0, support=k == 0))
            edges += [_hang(room, thing), InEdge(source=thing, target=room)]
            if k:
                edges.append(RelationEdge(source=thing, target=f"thing_{i}_0", predicate="on", probability=0.9))
        for k, other in enumerate(n for n in (i - 1, i + 1) if 1 <= n <= rooms):
            door = DoorNode(
                id=f"door_{i}_{k}_0",
                rooms=(room, f"room_{other}"),
                width_m=0.9,
                provisional=False,
                crossing=CrossingStatus.CROSSED,
            )
            nodes.append(door)
            edges += [
                _hang(f"wall_{i}_{k}", door.id),
                *(ConnectsEdge(source=door.id, target=r) for r in door.rooms if r),
            ]
    edges += [
        MatchEdge(source=min(ends), target=max(ends))
        for ends in ((f"door_{i}_{int(i > 1)}_0", f"door_{i + 1}_0_0") for i in range(1, rooms))
    ]
    return Snapshot.of(nodes, edges)
