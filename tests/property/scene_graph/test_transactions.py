"""Laws of working memory under random transactions, sound and unsound."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scene_graph.checks.draft import Draft
from scene_graph.checks.invariants import check, check_draft
from scene_graph.diff import apply, diff
from scene_graph.edges import (
    ConnectsEdge,
    EdgeKey,
    EdgeType,
    HasEdge,
    HasIntentionEdge,
    InEdge,
    IntentionAction,
    MatchEdge,
    RelationEdge,
    RtEdge,
)
from scene_graph.edits import PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.errors import DeltaMismatch, InvariantBroken
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.room_parts import keeps_in_use
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import (
    NODE_CLASSES,
    AffordanceKind,
    AffordanceNode,
    CornerNode,
    DoorNode,
    ObjectNode,
    ObjectState,
    PersonNode,
    RobotNode,
    RoomNode,
    WallNode,
    node_type,
)
from scene_graph.snapshot import Snapshot

law = settings(max_examples=100)

ROOMS, OBJECTS, DOORS = ("room_1", "room_2"), ("cup_1", "cup_2"), ("door_1_0_0", "door_2_0_0")
IDS = (*ROOMS, *OBJECTS, *DOORS, "wall_1_0", "person_1", "aff_cross_1_0_0", "robot", "root", "ghost_1")
probabilities = st.sampled_from([0.0, 0.5, 1.0, 1.0, 1.0, 1.5, math.nan])
poses = st.builds(SE3.from_xyz_yaw, st.floats(-9, 9), st.floats(-9, 9), st.just(0.0), st.floats(-3, 3))
covariances = st.sampled_from(
    [np.zeros((6, 6)), np.eye(6) * 0.01, np.eye(6) * 0.02, -np.eye(6), np.triu(np.ones((6, 6)))]
)
ids = st.sampled_from(IDS)

nodes = st.one_of(
    st.builds(RoomNode, id=st.sampled_from((*ROOMS, *OBJECTS)), label_probability=probabilities),
    st.builds(
        ObjectNode,
        id=st.sampled_from((*OBJECTS, "robot")),
        label=st.just("cup"),
        existence=probabilities,
        state=st.sampled_from(ObjectState),
        size_m=st.sampled_from([(0.1, 0.1, 0.1), (-1.0, 0.1, 0.1)]),
    ),
    st.builds(
        WallNode,
        id=st.just("wall_1_0"),
        parent_room=st.just("room_1"),
        normal=st.just((0.0, 1.0)),
        offset_m=st.just(0.0),
        length_m=st.floats(-1.0, 4.0),
    ),
    st.builds(CornerNode, id=st.sampled_from(["corner_1_0", "bad id"])),
    st.builds(
        DoorNode,
        id=st.sampled_from(DOORS),
        width_m=st.just(0.9),
        rooms=st.sampled_from([("room_1", None), ("room_2", "room_1")]),
    ),
    st.builds(PersonNode, id=st.just("person_1"), confidence=probabilities),
    st.builds(RobotNode, holding=st.sampled_from([None, *OBJECTS]), battery=probabilities),
    st.builds(
        AffordanceNode, id=st.just("aff_cross_1_0_0"), kind=st.just(AffordanceKind.CROSS), target=st.just(DOORS[0])
    ),
)
edges = st.one_of(
    st.builds(RtEdge, source=ids, target=ids, T_source_target=poses, covariance=covariances),
    st.builds(InEdge, source=ids, target=st.sampled_from(ROOMS)),
    st.builds(
        RelationEdge, source=ids, target=ids, predicate=st.sampled_from(["on", "beside"]), probability=probabilities
    ),
    st.builds(ConnectsEdge, source=st.sampled_from(DOORS), target=st.sampled_from(ROOMS)),
    st.builds(MatchEdge, source=st.sampled_from(DOORS), target=st.sampled_from(DOORS)),
    st.builds(HasEdge, source=ids, target=st.just("aff_cross_1_0_0")),
    st.builds(
        HasIntentionEdge,
        source=st.just("robot"),
        target=ids,
        agent=st.sampled_from(["a", "b"]),
        action=st.sampled_from(IntentionAction),
        priority=st.integers(0, 100),
    ),
)
single_edits = st.one_of(
    nodes.map(PutNode),
    edges.map(PutEdge),
    ids.map(RemoveNode),
    edges.map(lambda edge: RemoveEdge(edge.key)),
)


def hung(node, parent, *more):
    pose = RtEdge(source=parent, target=node.id, T_source_target=SE3.identity())
    return [PutNode(node), PutEdge(pose), *map(PutEdge, more)]


def rehung(object_id, old, new, state, holding):
    return [
        RemoveEdge(EdgeKey(EdgeType.RT, old, object_id)),
        *hung(ObjectNode(id=object_id, label="cup", state=state), new),
        PutNode(RobotNode(holding=holding)),
    ]


sound_steps = st.sampled_from(
    [
        hung(RoomNode(id="room_1"), "root"),
        hung(RoomNode(id="room_2"), "root"),
        hung(WallNode(id="wall_1_0", parent_room="room_1", normal=(0.0, 1.0), offset_m=0.0, length_m=2.0), "room_1"),
        hung(DoorNode(id=DOORS[0], rooms=("room_1", None), width_m=0.9), "wall_1_0"),
        hung(DoorNode(id=DOORS[1], rooms=("room_2", "room_1"), width_m=0.9), "room_2"),
        hung(ObjectNode(id="cup_1", label="cup"), "room_1", InEdge(source="cup_1", target="room_1")),
        hung(ObjectNode(id="cup_2", label="cup"), "room_2"),
        hung(PersonNode(id="person_1"), "room_2", InEdge(source="person_1", target="room_2")),
        rehung("cup_1", "room_1", "robot", ObjectState.HELD, "cup_1"),
        rehung("cup_1", "robot", "room_1", ObjectState.PRESENT, None),
        rehung("cup_2", "room_2", "robot", ObjectState.HELD, "cup_2"),
    ]
)
transactions = st.lists(
    st.one_of(sound_steps, sound_steps, st.lists(single_edits, min_size=1, max_size=3)), min_size=1, max_size=14
)


def play(memory, transaction, stamp_s=0.0):
    """Whether the transaction was accepted."""
    try:
        memory.commit(transaction, agent="test", stamp_s=stamp_s)
    except InvariantBroken:
        return False
    return True


@law
@given(transactions)
def test_no_sequence_of_transactions_breaks_an_invariant(sequence):
    memory = WorkingMemory()
    for transaction in sequence:
        play(memory, transaction)
        assert check(memory.snapshot()) == ()


@law
@given(transactions)
def test_checking_what_was_touched_finds_exactly_what_a_full_check_finds(sequence):
    memory = WorkingMemory()
    for transaction in sequence:
        draft = Draft(memory.snapshot(), transaction)
        after = draft.result(revision=1, stamp_s=0.0)
        assert check_draft(draft, after) == tuple(sorted((*draft.violations, *check(after))))
        play(memory, transaction)


@law
@given(transactions)
def test_a_rejected_transaction_changes_nothing_and_is_not_published(sequence):
    memory = WorkingMemory()
    subscription = memory.subscribe()
    for transaction in sequence:
        before = memory.snapshot()
        changed = play(memory, transaction) and not Draft(before, transaction).is_empty
        assert memory.snapshot().revision == before.revision + changed
        assert len(subscription.poll()) == changed
        assert changed or memory.snapshot() is before


@law
@given(transactions, st.data())
def test_what_is_unloaded_makes_no_difference_to_what_is_known(sequence, data):
    plain, paged = WorkingMemory(), WorkingMemory(long_term=LongTermStore())
    for transaction in sequence:
        paged.building()
        assert play(plain, transaction) == play(paged, transaction)
        known, expected = paged.building(), plain.snapshot()
        assert dict(known.nodes) == dict(expected.nodes)
        assert dict(known.edges) == dict(expected.edges)
        assert check(paged.snapshot()) == ()
        rooms = [room.id for room in paged.snapshot().of_type(RoomNode) if not keeps_in_use(paged.snapshot(), room.id)]
        if rooms and data.draw(st.booleans()):
            paged.unload(data.draw(st.sampled_from(rooms)), agent="test", stamp_s=0.0)


@law
@given(transactions)
def test_applying_a_difference_gives_the_other_snapshot(sequence):
    memory = WorkingMemory()
    seen = [memory.snapshot()]
    for i, transaction in enumerate(sequence):
        play(memory, transaction, stamp_s=float(i))
        seen.append(memory.snapshot())
    for a in (seen[0], seen[len(seen) // 2], seen[-1]):
        for b in (seen[0], seen[-1]):
            assert apply(diff(a, b), a) == b
    if seen[-1].revision != seen[0].revision:
        with pytest.raises(DeltaMismatch):
            apply(diff(seen[0], seen[-1]), seen[-1])


@law
@given(transactions)
def test_published_deltas_replay_the_memory(sequence):
    memory = WorkingMemory()
    replica, subscription = memory.snapshot(), memory.subscribe()
    for transaction in sequence:
        play(memory, transaction)
    for delta in subscription.poll():
        replica = apply(delta, replica)
    assert replica == memory.snapshot()


@law
@given(transactions)
def test_the_indexes_of_an_evolved_snapshot_are_those_of_one_built_at_once(sequence):
    memory = WorkingMemory()
    for transaction in sequence:
        for cls in NODE_CLASSES.values():  # fills the caches that the next commit must not keep wrongly
            memory.snapshot().of_type(cls)
        play(memory, transaction)
    evolved = memory.snapshot()
    built = Snapshot.of(evolved.nodes.values(), evolved.edges.values(), revision=evolved.revision)
    assert evolved == built
    for kind, cls in NODE_CLASSES.items():
        assert evolved.of_type(cls) == built.of_type(cls)
        assert {node.id for node in evolved.of_type(cls)} == {
            i for i, n in evolved.nodes.items() if node_type(n) is kind
        }
    for node_id in IDS:
        assert set(evolved.edges_from(node_id)) == {e for e in evolved.edges.values() if e.source == node_id}
        assert set(evolved.edges_to(node_id)) == {e for e in evolved.edges.values() if e.target == node_id}


@law
@given(transactions)
def test_every_element_knows_the_revision_that_wrote_it(sequence):
    memory = WorkingMemory()
    written = {}
    for transaction in sequence:
        if play(memory, transaction):
            snapshot = memory.snapshot()
            draft = Draft(Snapshot.of((), ()), [edit for edit in transaction if isinstance(edit, PutNode | PutEdge)])
            written.update(dict.fromkeys((*draft.put_nodes, *draft.put_edges), snapshot.revision))
    snapshot = memory.snapshot()
    for element in (*snapshot.nodes, *snapshot.edges):
        assert snapshot.revision_of(element) == written.get(element, 0)
