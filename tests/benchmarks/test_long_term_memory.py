"""What a robot pays, ten times a second, for knowing a large building: nothing that grows with it."""

from __future__ import annotations

import time
import timeit
import tracemalloc
from dataclasses import dataclass

import pytest

from evaluations.mapping.known_building import known_building
from perception.memory.working_set import WorkingSet
from scene_graph.edits import PutEdge
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.memory import WorkingMemory
from scene_graph.queries.queries import NodeFilter, NodeType, select
from scene_graph.queries.topology import path_between

ROOMS = (10, 100, 1000)
GROWTH = 1.10


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
    building = known_building(count)
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
