"""A document read and written again is the same document, for random houses."""

import json

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from scene_graph.checks.invariants import check
from scene_graph.documents.interchange import from_json, to_json
from scene_graph.edges import ConnectsEdge, InEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorNode, DoorState, ObjectNode, RobotNode, RoomNode, RootNode
from scene_graph.queries.doors import physical_doors
from scene_graph.queries.poses import MapPoses
from scene_graph.snapshot import Snapshot

law = settings(max_examples=60)

meters = st.floats(-100.0, 100.0)
poses = st.builds(SE3.from_xyz_yaw, meters, meters, st.floats(0.0, 2.0), st.floats(-3.2, 3.2))
probabilities = st.floats(0.0, 1.0)
polygons = st.lists(st.tuples(meters, meters), max_size=5).map(tuple)
deviations = st.tuples(*[st.floats(0.0, 1.0)] * 3)


@st.composite
def houses(draw):
    rooms = [f"room_{i}" for i in range(1, draw(st.integers(1, 3)) + 1)]
    nodes = [RootNode(), RobotNode(battery=draw(probabilities))]
    edges = [RtEdge(source=draw(st.sampled_from(["root", *rooms])), target="robot", T_source_target=draw(poses))]
    for room in rooms:
        nodes.append(RoomNode(id=room, label=draw(st.text(max_size=3)), polygon_m=draw(polygons)))
        edges.append(RtEdge(source="root", target=room, T_source_target=draw(poses)))
    for i in range(draw(st.integers(0, 3))):
        object_id, room = f"cup_{i}", draw(st.sampled_from(rooms))
        size = draw(st.tuples(*[st.floats(0.0, 2.0)] * 3))
        surfaces = tuple(sorted(draw(st.lists(st.floats(0.0, 2.0), max_size=3))))
        cup = ObjectNode(id=object_id, label="cup", existence=draw(probabilities), size_m=size, surfaces_m=surfaces)
        nodes.append(cup)
        covariance = np.diag([*np.square(draw(deviations)), 0.0, 0.0, 0.0])
        edges.append(RtEdge(source=room, target=object_id, T_source_target=draw(poses), covariance=covariance))
        edges.append(InEdge(source=object_id, target=room))
        other = f"cup_{draw(st.integers(0, i))}"
        edges.append(RelationEdge(source=object_id, target=other, predicate="beside", probability=draw(probabilities)))
    if len(rooms) > 1:
        for here, there in ((rooms[0], rooms[1]), (rooms[1], rooms[0])):
            door = f"door_{here.removeprefix('room_')}_0_0"
            nodes.append(DoorNode(id=door, rooms=(here, there), width_m=0.9, state=draw(st.sampled_from(DoorState))))
            edges.append(RtEdge(source=here, target=door, T_source_target=draw(poses)))
            edges += [ConnectsEdge(source=door, target=here), ConnectsEdge(source=door, target=there)]
        edges.append(MatchEdge(source="door_1_0_0", target="door_2_0_0"))
    return Snapshot.of(nodes, edges, revision=draw(st.integers(0, 99)), stamp_s=draw(st.floats(0.0, 1e6)))


@law
@given(houses())
def test_writing_what_was_read_gives_the_same_document(house):
    assert check(house) == ()
    document = to_json(house)
    again = from_json(json.loads(json.dumps(document)))
    assert to_json(again) == document


@law
@given(houses())
def test_everything_stays_where_it_was_and_a_door_is_in_the_middle_of_its_wall(house):
    again = from_json(to_json(house))
    before, after = MapPoses(house), MapPoses(again)
    doors = {door.id: door for door in physical_doors(house)}
    for node_id in again.nodes:
        faces = [before.pose(face.id).translation_m for face in doors[node_id].members] if node_id in doors else []
        expected = SE3(before.pose(node_id).quat_wxyz, np.mean(faces, axis=0)) if faces else before.pose(node_id)
        assert after.pose(node_id).is_close(expected, 1e-5)
        assert again.room_of(node_id) == house.room_of(node_id)


@law
@given(houses())
def test_room_frames_list_all_nodes_and_edges(house):
    document = to_json(house, frame="room")
    assert len(document["nodes"]) == len(house.nodes)
    assert len(document["edges"]) == len(house.edges)
