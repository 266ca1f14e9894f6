"""A building that the robot knows already: the graph of a house as its map would be, with errors of its own."""

from __future__ import annotations

import numpy as np

from perception.crossing import move_robot
from perception.doors.insertion import hang, wall_id_of
from perception.doors.posts import MeasuredGap
from perception.geometry.planar import Pose2
from perception.geometry.walls import Walls
from perception.memory.dual_doors import root_pose
from perception.memory.joining import join
from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import Transaction, WorkingMemory
from scene_graph.nodes import ROOT_ID, CrossingStatus, DoorNode, RoomNode, RoomStatus, WallNode
from unit.perception.lidar_house import Array, House


def room_ids(house: House) -> dict[str, str]:
    """Name in the house -> identifier in the graph."""
    return {name: f"room_{number}" for number, name in enumerate(house.rooms, start=1)}


def frame_of(polygon: Array, number: int) -> Pose2:
    """Where the frame of a room lies in the house: in its middle, turned by an angle of its own."""
    x, y = polygon.mean(axis=0).tolist()
    return Pose2(x, y, 0.4 * number)


def known_house(house: House, *, but: tuple[str, ...] = (), error_m: float = 0.0, seed: int = 0) -> WorkingMemory:
    """The graph of ``house`` without the rooms in ``but``; corners are off by up to ``error_m`` along each axis."""
    memory, rng = WorkingMemory(), np.random.default_rng(seed)
    with memory.edit("test", 0.0) as tx:
        for number, (name, polygon) in enumerate(house.rooms.items(), start=1):
            if name not in but:
                low, high = polygon.min(axis=0), polygon.max(axis=0)
                scale = 1.0 + rng.uniform(-2.0, 2.0, 2) * error_m / (high - low)
                _put_room(tx, house, name, number, (polygon - low) * scale + low)
    with memory.edit("test", 0.0) as tx:
        _join_doors(tx)
    return memory


def _put_room(tx: Transaction, house: House, name: str, number: int, polygon: Array) -> None:
    frame = frame_of(house.rooms[name], number)
    room_id, local = f"room_{number}", frame.inverse().apply(polygon)
    tx.put(RoomNode(id=room_id, polygon_m=tuple(map(tuple, local.tolist())), status=RoomStatus.PERMANENT))
    tx.put(RtEdge(source=ROOT_ID, target=room_id, T_source_target=frame.to_se3()))
    walls = Walls.of_polygon(local)
    for k, length_m in enumerate(walls.length_m.tolist()):
        middle = walls.start[k] + walls.along[k] * length_m / 2.0
        yaw_rad = float(np.arctan2(*walls.along[k][::-1]))
        wall_id = wall_id_of(room_id, k)
        normal = (float(walls.normal[k][0]), float(walls.normal[k][1]))
        offset_m = float(walls.offset_m[k])
        tx.put(WallNode(id=wall_id, parent_room=room_id, normal=normal, offset_m=offset_m, length_m=length_m))
        T_room_wall = SE3.from_xyz_yaw(float(middle[0]), float(middle[1]), 0.0, yaw_rad)
        tx.put(RtEdge(source=room_id, target=wall_id, T_source_target=T_room_wall))
        _put_doors(tx, house, (name, number), k, walls, frame)


def _put_doors(tx: Transaction, house: House, room: tuple[str, int], k: int, walls: Walls, frame: Pose2) -> None:
    name, number = room
    length_m, found = float(walls.length_m[k]), 0
    for door in house.doors:
        offset = frame.inverse().apply(np.array(door.center)) - walls.start[k]
        station_m, depth_m = float(offset @ walls.along[k]), -float(offset @ walls.normal[k])
        if name in door.rooms and -0.02 <= depth_m <= house.wall_thickness and 0.0 < station_m < length_m:
            door_id = f"door_{number}_{k}_{found}"
            found += 1
            gap = MeasuredGap(center_m=station_m, width_m=door.width, std_m=0.005, posts=2)
            tx.put(
                DoorNode(
                    id=door_id,
                    rooms=(f"room_{number}", None),
                    width_m=door.width,
                    provisional=False,
                    crossing=CrossingStatus.CROSSED,
                ),
                hang(door_id, wall_id_of(f"room_{number}", k), length_m, gap, 0.0),
            )


def _join_doors(tx: Transaction) -> None:
    doors = tx.snapshot.of_type(DoorNode)
    places = {door.id: Pose2.from_se3(tx.snapshot.transform(ROOT_ID, door.id)) for door in doors}
    for first in doors:
        for second in doors:
            near = places[first.id].distance_m(places[second.id]) < 0.5
            if first.id < second.id and first.rooms[0] != second.rooms[0] and near:
                T_near_far = root_pose(tx.snapshot, first.rooms[0]).inverse() @ root_pose(tx.snapshot, second.rooms[0])
                join(tx, first, second, T_near_far)


def put_robot(memory: WorkingMemory, house: House, name: str, T_house_base: Pose2, stamp_s: float = 0.0) -> None:
    """The robot believes to be in a room, at a place given in the house."""
    number = list(house.rooms).index(name) + 1
    with memory.edit("test", stamp_s) as tx:
        move_robot(tx, f"room_{number}", frame_of(house.rooms[name], number).inverse() @ T_house_base, stamp_s)
