"""Nothing is lost between working memory, long-term memory and disk, whatever the building."""

import json
import types
import typing
from dataclasses import fields
from enum import Enum
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from scene_graph.checks.invariants import check
from scene_graph.edges import ConnectsEdge, InEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.records import EDGE_CLASSES, edge_record, node_record, read_edge, read_node
from scene_graph.long_term.room_files import RoomFiles
from scene_graph.long_term.room_parts import cut_room
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import NODE_CLASSES, DoorNode, ObjectNode, RobotNode, RoomNode, RootNode
from scene_graph.snapshot import Snapshot

law = settings(max_examples=60)

finite = st.floats(allow_nan=False, allow_infinity=False)
small = st.floats(-1e3, 1e3)
quaternions = st.tuples(small, small, small, small).filter(lambda q: sum(x * x for x in q) > 1e-6)
poses = st.builds(SE3, quaternions, st.tuples(small, small, small))
covariances = st.lists(small, min_size=36, max_size=36).map(lambda numbers: np.reshape(numbers, (6, 6)))


def values_of(hint):
    """Any value of a field's type."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        return st.one_of([values_of(argument) for argument in arguments])
    if origin is tuple and arguments[-1] is ...:
        return st.lists(values_of(arguments[0]), max_size=3).map(tuple)
    if origin is tuple:
        return st.tuples(*map(values_of, arguments))
    if isinstance(hint, type) and issubclass(hint, Enum):
        return st.sampled_from(hint)
    known = {str: st.text(max_size=8), float: finite, bool: st.booleans(), int: st.integers(), SE3: poses}
    return {**known, type(None): st.none()}.get(hint, covariances)


def anything(cls):
    hints = typing.get_type_hints(cls)
    return st.builds(cls, **{field.name: values_of(hints[field.name]) for field in fields(cls)})


@law
@given(st.one_of([anything(cls) for cls in NODE_CLASSES.values()]))
def test_a_node_is_read_as_it_was_written(node):
    assert read_node(json.loads(json.dumps(node_record(node))), "node") == node


@law
@given(st.one_of([anything(cls) for cls in EDGE_CLASSES.values()]))
def test_an_edge_is_read_as_it_was_written_with_its_whole_transform_and_covariance(edge):
    assert read_edge(json.loads(json.dumps(edge_record(edge))), "edge") == edge


@st.composite
def buildings(draw):
    """Rooms in a row and more doors across, things that relate to things next door."""
    rooms = [f"room_{i}" for i in range(1, draw(st.integers(2, 5)) + 1)]
    nodes, edges = [RootNode(), RobotNode()], []
    edges.append(RtEdge(source=rooms[0], target="robot", T_source_target=SE3.identity()))
    edges.append(InEdge(source="robot", target=rooms[0]))
    for room in rooms:
        nodes.append(RoomNode(id=room))
        edges.append(RtEdge(source="root", target=room, T_source_target=draw(poses)))
    across = st.sets(st.tuples(st.sampled_from(rooms), st.sampled_from(rooms)), max_size=4)
    pairs = [*pairwise(rooms), *sorted(draw(across))]
    for k, (here, there) in enumerate(pairs):
        if here == there:
            continue
        ends = [f"door_{room.removeprefix('room_')}_0_{k}" for room in (here, there)]
        for door, pair in zip(ends, ((here, there), (there, here)), strict=True):
            nodes.append(DoorNode(id=door, rooms=pair, width_m=0.9))
            edges.append(RtEdge(source=pair[0], target=door, T_source_target=SE3.identity()))
            edges += [ConnectsEdge(source=door, target=room) for room in pair]
        edges.append(MatchEdge(source=min(ends), target=max(ends)))
    for i in range(draw(st.integers(0, 6))):
        nodes.append(ObjectNode(id=f"cup_{i}", label="cup"))
        room = draw(st.sampled_from(rooms))
        edges.append(RtEdge(source=room, target=f"cup_{i}", T_source_target=draw(poses)))
        edges.append(InEdge(source=f"cup_{i}", target=room))
        other = f"cup_{draw(st.integers(0, i))}"
        edges.append(RelationEdge(source=f"cup_{i}", target=other, predicate="beside", probability=0.5))
    return Snapshot.of(nodes, edges)


def same_graph(a, b):
    return dict(a.nodes) == dict(b.nodes) and dict(a.edges) == dict(b.edges)


@law
@given(st.data())
def test_rooms_come_and_go_in_any_order_and_the_building_stays_the_same(data):
    whole = data.draw(buildings())
    memory = WorkingMemory(whole, long_term=LongTermStore())
    rooms = [node.id for node in whole.of_type(RoomNode)]
    for _ in range(data.draw(st.integers(1, 8))):
        room = data.draw(st.sampled_from(rooms[1:]))
        if room in memory.unloaded:
            memory.load(room, agent="test", stamp_s=1.0)
        else:
            memory.unload(room, agent="test", stamp_s=1.0)
        assert check(memory.snapshot()) == ()
        assert same_graph(memory.building(), whole)
        assert all((room in memory.snapshot()) != (room in memory.unloaded) for room in rooms)
    memory.load(*rooms, agent="test", stamp_s=2.0)
    assert same_graph(memory.snapshot(), whole)


@law
@given(buildings())
def test_a_building_read_from_its_files_is_the_one_that_was_written(whole):
    rooms = [cut_room(whole, room.id) for room in whole.of_type(RoomNode)]
    with TemporaryDirectory() as folder:
        RoomFiles(Path(folder)).write(rooms, shared=(), stamp_s=12.5, saved_s=1e9)
        stored = RoomFiles(Path(folder)).read()
    assert stored.rooms == tuple(rooms)
    assert (stored.stamp_s, stored.saved_s, stored.broken) == (12.5, 1e9, ())
