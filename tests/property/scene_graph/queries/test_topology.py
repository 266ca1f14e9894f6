"""Shortest ways against an enumeration of all ways."""

from math import dist

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorNode, DoorState, RobotNode, RoomNode, RootNode
from scene_graph.queries.topology import Topology
from scene_graph.snapshot import Snapshot

meters = st.integers(-10, 10)
ROOMS = ("room_1", "room_2", "room_3", "room_4")


@st.composite
def buildings(draw):
    """Rooms, and doors as (two rooms, point in the map, closed)."""
    rooms = {room: (draw(meters), draw(meters)) for room in ROOMS}
    pair = st.lists(st.sampled_from(ROOMS), min_size=2, max_size=2, unique=True)
    doors = draw(st.lists(st.tuples(pair, st.tuples(meters, meters), st.booleans()), max_size=6))
    return rooms, doors


def graph_of(rooms, doors):
    nodes = [RootNode(), RobotNode(), *(RoomNode(id=room) for room in rooms)]
    edges = [RtEdge(source="root", target="robot", T_source_target=SE3.identity())]
    for room, (x, y) in rooms.items():
        edges.append(RtEdge(source="root", target=room, T_source_target=SE3.from_xyz_yaw(x, y, 0.0, 0.0)))
    for i, (pair, (x, y), closed) in enumerate(doors):
        state = DoorState.CLOSED if closed else DoorState.OPEN
        nodes.append(DoorNode(id=f"door_{i}", rooms=tuple(pair), width_m=0.9, state=state))
        x0, y0 = rooms[pair[0]]
        pose = SE3.from_xyz_yaw(x - x0, y - y0, 0.0, 0.0)
        edges.append(RtEdge(source=pair[0], target=f"door_{i}", T_source_target=pose))
    return Snapshot.of(nodes, edges)


def shortest(rooms, doors, here, goal, point, used=()):
    """By trying every sequence of distinct open doors."""
    best = dist(point, rooms[goal]) if here == goal else None
    for i, (pair, place, closed) in enumerate(doors):
        if i in used or closed or here not in pair:
            continue
        beyond = pair[1] if pair[0] == here else pair[0]
        rest = shortest(rooms, doors, beyond, goal, place, (*used, i))
        if rest is not None:
            best = min(dist(point, place) + rest, best) if best is not None else dist(point, place) + rest
    return best


@settings(max_examples=60)
@given(buildings())
def test_a_path_is_as_long_as_the_shortest_of_all_ways(building):
    rooms, doors = building
    topology = Topology.from_snapshot(graph_of(rooms, doors))
    for goal in ROOMS[1:]:
        expected = shortest(rooms, doors, "room_1", goal, rooms["room_1"])
        path = topology.path("room_1", goal)
        if expected is None:
            assert path is None
            continue
        assert path.length_m == pytest.approx(expected, abs=1e-9)
        assert (path.rooms[0], path.rooms[-1], len(path.doors)) == ("room_1", goal, len(path.rooms) - 1)
        for door, here, there in zip(path.doors, path.rooms, path.rooms[1:], strict=False):
            pair, _, closed = doors[int(door.removeprefix("door_"))]
            assert set(pair) == {here, there}
            assert not closed


@settings(max_examples=60)
@given(buildings())
def test_neighbors_are_mutual_and_share_a_door(building):
    rooms, doors = building
    topology = Topology.from_snapshot(graph_of(rooms, doors))
    for room in ROOMS:
        joined = {other for pair, _, _ in doors if room in pair for other in pair if other != room}
        assert set(topology.neighbors(room)) == joined
