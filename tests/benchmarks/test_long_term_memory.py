"""What a robot pays, ten times a second, for knowing a large building: nothing that grows with it."""

from __future__ import annotations

import time
import timeit
import tracemalloc
from dataclasses import dataclass

import numpy as np
import pytest

from majordomo.perception.memory.working_set import WorkingSet
from majordomo.scene_graph.edges import ConnectsEdge, InEdge, MatchEdge, RelationEdge, RtEdge
from majordomo.scene_graph.edits import PutEdge
from majordomo.scene_graph.long_term.long_term_store import LongTermStore
from majordomo.scene_graph.memory import WorkingMemory
from majordomo.scene_graph.nodes import (
    CornerNode,
    CrossingStatus,
    DoorNode,
    ObjectNode,
    RobotNode,
    RoomNode,
    RoomStatus,
    RootNode,
    WallNode,
)
from majordomo.scene_graph.queries import NodeFilter, NodeType, select
from majordomo.scene_graph.se3 import SE3
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.scene_graph.topology import path_between

SQUARE = ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))
ROOMS = (10, 100, 1000)
WALLS, THINGS = 4, 19
GROWTH = 1.10


def hang(parent: str, child: str, x_m: float = 0.0) -> RtEdge:
    pose = SE3.from_xyz_yaw(x_m, 0.1, 0.0, 0.2)
    return RtEdge(source=parent, target=child, T_source_target=pose, covariance=np.eye(6) * 1e-4)


def corridor(count: int) -> Snapshot:
    """Rooms in a row, each of 30 nodes: itself, walls, corners, doors, things on a table. The robot is in the fifth."""
    nodes = [RootNode(), RobotNode()]
    edges = [hang("room_5", "robot"), InEdge(source="robot", target="room_5")]
    for i in range(1, count + 1):
        room = f"room_{i}"
        nodes.append(RoomNode(id=room, polygon_m=SQUARE, status=RoomStatus.PERMANENT))
        edges.append(hang("root", room, 4.2 * i))
        for k in range(WALLS):
            wall, corner = f"wall_{i}_{k}", f"corner_{i}_{k}"
            nodes += [WallNode(id=wall, parent_room=room, normal=(0.0, 1.0), offset_m=-2.0, length_m=4.0)]
            nodes += [CornerNode(id=corner)]
            edges += [hang(room, wall), hang(wall, corner)]
        for k in range(THINGS):
            thing = f"thing_{i}_{k}"
            nodes.append(ObjectNode(id=thing, label="cup", graspable=k > 0, support=k == 0))
            edges += [hang(room, thing), InEdge(source=thing, target=room)]
            if k:
                edges.append(RelationEdge(source=thing, target=f"thing_{i}_0", predicate="on", probability=0.9))
        for k, other in enumerate(n for n in (i - 1, i + 1) if 1 <= n <= count):
            door = DoorNode(
                id=f"door_{i}_{k}_0",
                rooms=(room, f"room_{other}"),
                width_m=0.9,
                provisional=False,
                crossing=CrossingStatus.CROSSED,
            )
            nodes.append(door)
            edges += [
                hang(f"wall_{i}_{k}", door.id),
                *(ConnectsEdge(source=door.id, target=r) for r in door.rooms if r),
            ]
    edges += [
        MatchEdge(source=min(ends), target=max(ends))
        for ends in ((f"door_{i}_{int(i > 1)}_0", f"door_{i + 1}_0_0") for i in range(1, count))
    ]
    return Snapshot.of(nodes, edges)


@dataclass(frozen=True, kw_only=True)
class Cost:
    """Of one pose update: time, as it is and if every room were loaded, and memory; of working memory: elements; and of
    looking at the whole building.
    """

    commit_us: float
    all_loaded_us: float
    commit_bytes: int
    elements: int
    building_ms: float
    query_ms: float
    path_ms: float
    working_set_us: float


def measured(count: int) -> Cost:
    building = corridor(count)
    memory = WorkingMemory(building, long_term=LongTermStore())
    working_set = WorkingSet("ltsm", memory)
    for stamp_s in (0.0, 10.0):
        working_set.update(stamp_s)
    memory.building()
    pose = building.parent("robot")

    def move(where: WorkingMemory = memory) -> None:
        where.commit([PutEdge(pose)], agent="energy_optimizer", stamp_s=1.0)

    plain = WorkingMemory(building)
    commit_s = min(timeit.repeat(move, number=20, repeat=60)) / 20
    all_loaded_s = min(timeit.repeat(lambda: move(plain), number=5, repeat=20)) / 5
    idle_s = min(timeit.repeat(lambda: working_set.update(11.0), number=20, repeat=30)) / 20
    tracemalloc.start()
    held = [memory.snapshot()]
    before, _ = tracemalloc.get_traced_memory()
    for _ in range(50):
        move()
        held.append(memory.snapshot())
    after, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    move()
    snapshot = memory.snapshot()
    return Cost(
        commit_us=1e6 * commit_s,
        all_loaded_us=1e6 * all_loaded_s,
        commit_bytes=(after - before) // 50,
        elements=len(snapshot.nodes) + len(snapshot.edges),
        building_ms=timed(memory.building),
        query_ms=timed(lambda: select(memory.building(), NodeFilter(types=(NodeType.OBJECT,), room="room_7"))),
        path_ms=timed(lambda: path_between(memory.building(), "robot", f"thing_{count}_3")),
        working_set_us=1e6 * idle_s,
    )


def timed(work: object) -> float:
    begin = time.perf_counter()
    work()  # type: ignore[operator]
    return 1e3 * (time.perf_counter() - begin)


@pytest.mark.benchmark
def test_a_pose_update_and_working_memory_are_flat_while_the_building_grows_from_10_to_1000_rooms(record_property):
    costs = {count: measured(count) for count in ROOMS}
    for count, cost in costs.items():
        record_property(f"{count} rooms", str(cost))
        print(
            f"{count:5d} rooms: commit {cost.commit_us:.0f} us, {cost.commit_bytes} bytes (if every room were loaded "
            f"{cost.all_loaded_us:.0f} us); working memory "
            f"{cost.elements} nodes and edges; its upkeep {cost.working_set_us:.0f} us; whole building "
            f"{cost.building_ms:.2f} ms, query {cost.query_ms:.1f} ms, path {cost.path_ms:.1f} ms"
        )
    small, *_, large = costs.values()
    assert large.elements == small.elements
    assert large.commit_us < GROWTH * small.commit_us
    assert large.commit_bytes < GROWTH * small.commit_bytes
    assert large.working_set_us < GROWTH * small.working_set_us + 20.0
