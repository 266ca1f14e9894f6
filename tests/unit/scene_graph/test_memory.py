import asyncio
import sys
import threading

import pytest

from scene_graph.diff import apply
from scene_graph.edges import EdgeKey, EdgeType, InEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.errors import InvariantBroken, RevisionConflict, SubscriptionClosed, ViolationKind
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import NODE_CLASSES, ObjectNode, RobotNode, RoomNode, RootNode
from scene_graph.snapshot import ABSENT, Snapshot


def battery(level):
    return PutNode(RobotNode(battery=level))


def test_memory_starts_with_the_robot_on_the_root():
    snapshot = WorkingMemory().snapshot()
    assert set(snapshot.nodes) == {"root", "robot"}
    assert snapshot.parent("robot").source == "root"
    assert snapshot.revision == 0


def test_memory_refuses_to_start_from_a_broken_graph():
    with pytest.raises(InvariantBroken, match="there must always be a robot"):
        WorkingMemory(Snapshot.of([RootNode()]))


def test_revisions_count_by_one_and_stamps_never_go_back():
    memory = WorkingMemory()
    assert memory.commit([battery(0.9)], agent="a", stamp_s=5.0).revision == 1
    later = memory.commit([battery(0.8)], agent="a", stamp_s=4.0)
    assert (later.revision, later.stamp_s) == (2, 5.0)


def test_committing_nothing_makes_no_revision():
    memory = WorkingMemory()
    subscription = memory.subscribe()
    assert memory.commit([], agent="a", stamp_s=1.0) is memory.snapshot()
    assert memory.snapshot().revision == 0
    assert subscription.poll() == []


def test_a_transaction_that_raises_commits_nothing(memory, house):
    with pytest.raises(KeyError), memory.edit("a", 1.0) as tx:  # noqa: PT012 -- the block is what is tested
        tx.remove("person_1")
        raise KeyError
    assert memory.snapshot() is house


def test_a_transaction_carries_the_snapshots_before_and_after(memory, house):
    with memory.edit("a", 1.0) as tx:
        assert tx.snapshot is house
        tx.put(RobotNode(battery=0.1))
    assert tx.snapshot is memory.snapshot()


def test_what_was_expected_must_still_be_so(memory, house):
    table = house.revision_of("table_1")
    memory.commit([PutNode(ObjectNode(id="table_1", label="desk"))], agent="a", stamp_s=1.0)
    before = memory.snapshot()
    key = EdgeKey(EdgeType.IN, "robot", "room_1")
    with pytest.raises(RevisionConflict) as caught:
        memory.commit([battery(0.0)], agent="b", stamp_s=2.0, expected={"table_1": table, key: table, "cup_1": ABSENT})
    assert [conflict.subject for conflict in caught.value.conflicts] == ["table_1"]
    assert memory.snapshot() is before


def test_a_transaction_can_expect_what_it_read(memory):
    memory.commit([battery(0.5)], agent="a", stamp_s=1.0)
    tx = memory.edit("b", 2.0)
    tx.expect("robot")
    memory.commit([battery(0.4)], agent="a", stamp_s=1.0)
    with pytest.raises(RevisionConflict, match="robot is at revision 3, not 2"), tx:
        tx.put(RobotNode(battery=0.9))


def test_removing_a_node_removes_its_edges(memory):
    memory.commit([RemoveNode("person_1")], agent="a", stamp_s=1.0)
    assert all("person_1" not in (edge.source, edge.target) for edge in memory.snapshot().edges.values())


def test_removing_twice_within_a_transaction_is_removing_once(memory, house):
    edges = [RemoveEdge(edge.key) for edge in house.edges_at("person_1")]
    memory.commit([*edges, RemoveNode("person_1"), *edges, RemoveNode("person_1")], agent="a", stamp_s=1.0)
    assert "person_1" not in memory.snapshot()


def test_removing_what_never_was_is_refused(memory):
    with pytest.raises(InvariantBroken, match="cannot remove node 'ghost_1': there is none") as caught:
        memory.commit([RemoveNode("ghost_1")], agent="a", stamp_s=1.0)
    assert caught.value.violations[0].kind is ViolationKind.UNKNOWN_ELEMENT
    with pytest.raises(InvariantBroken, match="cannot remove edge in robot -> room_2"):
        memory.commit([RemoveEdge(EdgeKey(EdgeType.IN, "robot", "room_2"))], agent="a", stamp_s=1.0)


def test_edits_take_effect_in_order(memory):
    edge = InEdge(source="robot", target="room_2")
    edits = [PutEdge(edge), RemoveEdge(edge.key), RemoveNode("person_1"), PutNode(RobotNode(battery=0.2)), battery(0.3)]
    after = memory.commit(edits, agent="a", stamp_s=1.0)
    assert edge.key not in after.edges
    assert after.robot.battery == 0.3


def test_concurrent_writers_lose_no_edit():
    memory = WorkingMemory()
    writers, each = 6, 40
    start = threading.Barrier(writers)

    def write(writer):
        start.wait(timeout=10.0)
        for i in range(each):
            with memory.edit(f"writer_{writer}", float(i)) as tx:
                room = RoomNode(id=f"room_{writer * each + i}")
                tx.put(room, RtEdge(source="root", target=room.id, T_source_target=SE3.identity()))

    subscription = memory.subscribe(capacity=1000)
    replica = memory.snapshot()
    threads = [threading.Thread(target=write, args=(writer,)) for writer in range(writers)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60.0)
    assert memory.snapshot().revision == writers * each
    assert len(memory.snapshot().of_type(RoomNode)) == writers * each
    for delta in subscription.poll():
        replica = apply(delta, replica)
    assert replica == memory.snapshot()


def test_readers_in_other_threads_never_disturb_a_writer():
    memory = WorkingMemory()
    written = threading.Event()
    failures = []

    def read():
        while not written.is_set():
            snapshot = memory.snapshot()
            if len(snapshot.of_type(RoomNode)) != len(snapshot.children("root")) - 1:
                failures.append(snapshot.revision)
            for cls in NODE_CLASSES.values():
                snapshot.of_type(cls)

    readers = [threading.Thread(target=read) for _ in range(3)]
    interval_s = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    try:
        for reader in readers:
            reader.start()
        for i in range(200):
            with memory.edit("a", 0.0) as tx:
                room = RoomNode(id=f"room_{i}")
                tx.put(room, RtEdge(source="root", target=room.id, T_source_target=SE3.identity()))
    finally:
        written.set()
        sys.setswitchinterval(interval_s)
        for reader in readers:
            reader.join(timeout=60.0)
    assert failures == []
    assert memory.snapshot().revision == 200


def test_optimistic_counters_of_concurrent_writers_add_up():
    memory = WorkingMemory()

    def count(times):
        done = 0
        while done < times:
            snapshot = memory.snapshot()
            level = round(snapshot.robot.battery - 0.01, 2)
            try:
                memory.commit(
                    [battery(level)], agent="a", stamp_s=0.0, expected={"robot": snapshot.revision_of("robot")}
                )
            except RevisionConflict:
                continue
            done += 1

    threads = [threading.Thread(target=count, args=(20,)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60.0)
    assert memory.snapshot().robot.battery == pytest.approx(0.2)


def test_a_subscriber_gets_one_delta_a_commit():
    memory = WorkingMemory()
    subscription = memory.subscribe()
    memory.commit([battery(0.9)], agent="a", stamp_s=1.0)
    memory.commit([battery(0.8)], agent="b", stamp_s=2.0)
    first, second = subscription.poll()
    assert (first.agent, first.base_revision, first.revision) == ("a", 0, 1)
    assert second.put_nodes == (RobotNode(battery=0.8),)
    assert subscription.poll() == []
    assert not subscription.lagged


def test_a_lagging_subscriber_is_told_once_and_recovers_from_a_fresh_snapshot():
    memory = WorkingMemory()
    subscription = memory.subscribe(capacity=3)
    for i in range(8):
        memory.commit([battery(i / 10)], agent="a", stamp_s=float(i))
    assert subscription.lagged
    assert not subscription.lagged
    replica = memory.snapshot()
    memory.commit([battery(1.0)], agent="a", stamp_s=9.0)
    for delta in subscription.poll():
        replica = apply(delta, replica) if delta.revision > replica.revision else replica
    assert replica == memory.snapshot()


def test_a_waiting_reader_is_woken_by_a_commit_in_another_thread():
    memory = WorkingMemory()

    async def read():
        subscription = memory.subscribe()
        waiting = asyncio.ensure_future(subscription.next())
        await asyncio.to_thread(memory.commit, [battery(0.5)], agent="a", stamp_s=1.0)
        return await asyncio.wait_for(waiting, timeout=10.0)

    assert asyncio.run(read()).revision == 1


def test_a_reader_who_gives_up_waiting_loses_no_delta():
    memory = WorkingMemory()

    async def read():
        subscription = memory.subscribe()
        with pytest.raises(TimeoutError):
            await asyncio.wait_for(subscription.next(), timeout=0.001)
        memory.commit([battery(0.5)], agent="a", stamp_s=1.0)
        return await subscription.next()

    assert asyncio.run(read()).revision == 1


def test_closing_ends_the_wait_and_the_subscription():
    memory = WorkingMemory()

    async def read():
        subscription = memory.subscribe()
        waiting = asyncio.ensure_future(subscription.next())
        await asyncio.sleep(0)
        subscription.close()
        with pytest.raises(SubscriptionClosed):
            await asyncio.wait_for(waiting, timeout=10.0)
        memory.commit([battery(0.5)], agent="a", stamp_s=1.0)
        return subscription

    subscription = asyncio.run(read())
    assert subscription.closed
    assert subscription.poll() == []


def test_a_subscription_without_room_is_refused():
    with pytest.raises(ValueError, match="capacity must be at least 1"):
        WorkingMemory().subscribe(capacity=0)


def test_a_subscription_closes_with_its_block():
    with WorkingMemory().subscribe() as subscription:
        assert not subscription.closed
    assert subscription.closed
