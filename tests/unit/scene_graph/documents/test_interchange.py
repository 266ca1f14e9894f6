import json
import math

import numpy as np
import pytest

from scene_graph.checks.invariants import check
from scene_graph.documents.interchange import from_json, to_json
from scene_graph.edges import EdgeType
from scene_graph.errors import SceneFormatError, UnknownLayer
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import CrossingStatus, DoorState, ObjectState
from scene_graph.queries.topology import Topology


def by_id(document):
    return {node["id"]: node for node in document["nodes"]}


def kitchen(**more):
    """A hand-written document."""
    document = {
        "nodes": [
            {"id": "room_1", "type": "room", "label": "kitchen", "polygon_m": [[0, 0], [4, 0], [4, 3], [0, 3]]},
            {"id": "table_1", "type": "object", "position_m": [1, 1, 0.4], "size_m": [1, 1, 0.8]},
            {"id": "cup_1", "type": "object", "attributes": {"color": "red"}, "size_m": [0.1, 0.1, 0.1]},
        ],
        "edges": [{"source": "cup_1", "target": "table_1", "type": "on"}],
    }
    return {**document, **more}


def test_every_node_carries_the_promised_fields(house):
    document = to_json(house)
    assert set(document) == {"revision", "stamp_s", "nodes", "edges"}
    assert (document["revision"], document["stamp_s"]) == (house.revision, 10.0)
    for node in document["nodes"]:
        assert {"id", "type", "label", "room", "position_m", "confidence"} <= set(node)
        assert len(node["position_m"]) == 3
    for edge in document["edges"]:
        assert {"source", "target", "type", "label", "probability"} <= set(edge)
    assert json.loads(json.dumps(document)) == document


def test_objects_carry_their_attributes_and_uncertainty(house):
    bottle = by_id(to_json(house))["bottle_2"]
    assert bottle["attributes"] == {"color": "blue", "accents": [], "categories": ["drink", "fragile"], "name": ""}
    assert bottle["label_distribution"] == [["bottle", 0.9], ["vase", 0.1]]
    assert bottle["position_m"] == [1.5, 1.2, 0.85]
    assert bottle["position_std_m"] == [0.01, 0.01, 0.01]
    assert (bottle["state"], bottle["graspable"], bottle["support"]) == ("present", True, False)
    assert bottle["last_seen_s"] == 9.5


def test_in_the_map_rooms_lie_where_the_layout_puts_them(house):
    office = by_id(to_json(house))["room_2"]
    assert np.allclose(office["polygon_m"], [[6.7, -2], [6.7, 2], [2.7, 2], [2.7, -2]])
    assert office["yaw_rad"] == pytest.approx(math.pi / 2, abs=1e-6)
    assert office["status"] == "permanent"


def test_in_the_map_a_physical_door_is_one_node(house):
    document = to_json(house)
    doors = [node for node in document["nodes"] if node["type"] == "door"]
    assert [door["id"] for door in doors] == ["door_1_1_0"]
    assert doors[0]["rooms"] == ["room_1", "room_2"]
    assert (doors[0]["state"], doors[0]["crossing"], doors[0]["provisional"]) == ("open", "crossed", False)
    ends = [(edge["type"], edge["source"], edge["target"]) for edge in document["edges"]]
    assert all("door_2_0_0" not in end for end in ends)
    assert len(ends) == len(set(ends))
    assert ("has", "door_1_1_0", "aff_cross_2_0_0") in ends
    assert [end for end in ends if end[0] == "rt" and end[2] == "door_1_1_0"] == [("rt", "wall_1_1", "door_1_1_0")]
    assert not [end for end in ends if end[0] == "match"]
    assert by_id(document)["aff_cross_2_0_0"]["target"] == "door_1_1_0"


def test_in_room_frames_everything_is_as_the_graph_has_it(house):
    document = to_json(house, frame="room")
    nodes = by_id(document)
    assert nodes["door_2_0_0"]["position_m"] == [1.0, 2.0, 0.0]
    assert nodes["person_1"]["position_m"] == [1.0, 0.0, 0.0]
    assert nodes["room_2"]["position_m"] == [0.0, 0.0, 0.0]
    assert nodes["room_2"]["polygon_m"][0] == [-2.0, -2.0]
    assert len(document["edges"]) == len(house.edges)


def test_in_the_map_a_door_is_in_the_middle_of_its_wall(house):
    faces = [house.position(node_id, "root") for node_id in ("door_1_1_0", "door_2_0_0")]
    assert np.allclose(by_id(to_json(house))["door_1_1_0"]["position_m"], np.mean(faces, axis=0), atol=1e-5)


def test_layers_choose_node_types_and_the_edges_among_them(house):
    document = to_json(house, layers=["object", "rooms"], stamp_s=99.0)
    assert {node["type"] for node in document["nodes"]} == {"object", "room"}
    assert {edge["type"] for edge in document["edges"]} == {"rt", "in", "relation"}
    assert document["stamp_s"] == 99.0
    with pytest.raises(UnknownLayer, match="no layer 'ceiling'; layers: root, room"):
        to_json(house, layers=["ceiling"])


def test_writing_what_was_read_changes_nothing(house):
    document = to_json(house)
    again = from_json(json.loads(json.dumps(document)))
    assert to_json(again) == document
    assert check(again) == ()
    WorkingMemory(again)


def test_reading_keeps_frames_and_beliefs(house):
    again = from_json(to_json(house))
    for node_id in ("bottle_2", "person_1", "robot", "corner_1_1"):
        assert np.allclose(again.position(node_id, "room_2"), house.position(node_id, "room_2"), atol=1e-5)
    assert again.object("bottle_2") == house.object("bottle_2")
    assert again.support_of("bottle_2") == "table_1"
    assert again.current_room == "room_1"
    assert np.allclose(again.parent("bottle_2").covariance, house.parent("bottle_2").covariance)
    assert Topology.from_snapshot(again).path("room_1", "room_2").doors == ("door_1_1_0",)


def test_a_hand_written_document_is_filled_in():
    graph = from_json(kitchen())
    assert set(graph.nodes) == {"root", "robot", "room_1", "table_1", "cup_1"}
    cup, table = graph.object("cup_1"), graph.object("table_1")
    assert (cup.label, cup.color, cup.graspable, cup.support) == ("cup", "red", True, False)
    assert (table.graspable, table.support, table.state) == (False, True, ObjectState.PRESENT)
    assert np.allclose(graph.position("cup_1", "root"), (1.0, 1.0, 0.85))
    assert np.allclose(graph.position("table_1", "room_1"), (-1.0, -0.5, 0.4))
    assert graph.room("room_1").polygon_m[0] == (-2.0, -1.5)
    assert graph.room_of("cup_1") == graph.room_of("table_1") == "room_1"
    assert graph.parent("robot").source == graph.current_room == "room_1"
    assert graph.support_of("cup_1") == "table_1"
    assert graph.relations()[0].probability == 1.0
    assert to_json(from_json(to_json(graph))) == to_json(graph)


def test_doors_are_filled_in_from_their_rooms():
    nodes = [
        {"id": "room_1", "type": "room"},
        {"id": "room_2", "type": "room", "position_m": [4, 0]},
        {"id": "door_1", "type": "door", "rooms": ["room_1", "room_2"], "position_m": [2, 0, 0]},
        {"id": "door_2", "type": "door", "rooms": ["room_2", None], "state": "closed"},
        {"id": "door_3", "type": "door"},
    ]
    graph = from_json({"nodes": nodes, "edges": [{"source": "door_3", "target": "room_2", "type": "connects"}]})
    assert graph.door("door_1").crossing is CrossingStatus.CROSSED
    assert graph.door("door_2").crossing is CrossingStatus.UNCROSSED
    assert graph.door("door_2").state is DoorState.CLOSED
    assert graph.door("door_3").rooms == ("room_2", None)
    assert {edge.target for edge in graph.edges_from("door_1", EdgeType.CONNECTS)} == {"room_1", "room_2"}
    assert Topology.from_snapshot(graph).path("room_1", "room_2").length_m == pytest.approx(4.0)


def test_a_held_object_hangs_from_the_robot():
    document = kitchen(edges=[])
    document["nodes"].append({"id": "robot", "type": "robot", "position_m": [2, 1, 0], "holding": "cup_1"})
    graph = from_json(document)
    assert graph.object("cup_1").state is ObjectState.HELD
    assert graph.parent("cup_1").source == "robot"
    assert graph.current_room == "room_1"
    assert from_json(to_json(graph)).robot.holding == "cup_1"


def test_affordances_and_intentions_are_read():
    document = kitchen()
    document["nodes"].append({"id": "aff_visit_1", "type": "affordance", "target": "room_1"})
    document["edges"].append(
        {
            "source": "robot",
            "target": "room_1",
            "type": "has_intention",
            "label": "objects",
            "action": "look",
            "priority": 20,
        }
    )
    document["edges"].append({"source": "cup_1", "target": "room_1", "type": "in"})
    document["edges"].append(
        {"source": "table_1", "target": "cup_1", "type": "relation", "label": "under", "probability": 0.5}
    )
    graph = from_json(document)
    assert graph.edges_to("aff_visit_1", EdgeType.HAS)[0].source == "room_1"
    assert graph.intentions()[0].priority == 20
    assert len(graph.relations()) == 2


def change(path, value):
    """The hand-written document with one field changed."""
    document = kitchen()
    *parents, last = path
    spot = document
    for key in parents:
        spot = spot[key]
    spot[last] = value
    return document


@pytest.mark.parametrize(
    ("path", "value", "named", "why"),
    [
        (("nodes",), "many", "nodes", "valid array"),
        (("revision",), -1, "revision", "greater than or equal to 0"),
        (("nodes", 0, "type"), "attic", "nodes[0].type", "does not match"),
        (("nodes", 0, "id"), "my room", "nodes[0].id", "not an identifier"),
        (("nodes", 0, "id"), None, "nodes[0].id", "valid string"),
        (("nodes", 0, "polygon_m"), [[0, 0], [1, "x"]], "nodes[0].polygon_m[1][1]", "valid number"),
        (("nodes", 0, "height_m"), -1, "nodes[0].height_m", "greater than or equal to 0"),
        (("nodes", 1, "position_m"), [1], "nodes[1].position_m[1]", "required"),
        (("nodes", 1, "position_m"), [1, 2, math.nan], "nodes[1].position_m[2]", "finite"),
        (("nodes", 1, "room"), "attic", "nodes[1].room", "no room 'attic'; rooms: room_1"),
        (("nodes", 1, "id"), "cup_1", "nodes[2].id", "also the id of nodes[1]"),
        (("nodes", 2, "attributes"), {"color": 3}, "nodes[2].attributes.color", "valid string"),
        (("nodes", 2, "existence"), 1.2, "nodes[2].existence", "less than or equal to 1"),
        (("nodes", 2, "state"), "gone", "nodes[2].state", "'present', 'held' or 'missing'"),
        (("nodes", 0), {"id": "d", "type": "door"}, "nodes[0].rooms", "at least one room"),
        (("nodes", 0), {"id": "d", "type": "door", "rooms": ["x"]}, "nodes[0].rooms", "no room 'x'; rooms: none"),
        (("nodes", 0), {"id": "w", "type": "wall"}, "nodes[0].room", "a wall needs a room"),
        (("edges", 0, "target"), "shelf_1", "edges[0].target", "no node 'shelf_1'"),
        (("edges", 0, "type"), "loves", "edges[0].type", "no edge type 'loves'"),
        (("edges", 0, "type"), "relation", "edges[0].label", "needs its predicate"),
        (("edges", 0, "type"), "match", "edges[0]", "may lead from door to door"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named_with_its_path(path, value, named, why):
    with pytest.raises(SceneFormatError) as caught:
        from_json(change(path, value))
    assert caught.value.path == named
    assert why in caught.value.problem


def test_contradictions_are_named_with_the_node():
    document = kitchen(edges=[])
    document["nodes"].append({"id": "robot", "type": "robot", "holding": "table_1"})
    document["nodes"][2]["state"] = "held"
    with pytest.raises(SceneFormatError, match=r"all three or none must say that it is held") as caught:
        from_json(document)
    assert caught.value.path in {"nodes[1]", "nodes[2]"}


def test_what_is_no_json_is_refused():
    with pytest.raises(SceneFormatError, match=r"\$: not a JSON document"):
        from_json({"nodes": [object()]})
    with pytest.raises(SceneFormatError, match="nodes: Field required"):
        from_json({})


def test_where_the_back_of_a_seat_is_is_told_and_read_and_may_be_left_out():
    document = kitchen()
    assert from_json(document).object("table_1").back_rad is None
    document["nodes"][1] |= {"back_rad": 1.5708, "back_m": 0.19}
    told = to_json(from_json(document))
    assert (by_id(told)["table_1"]["back_rad"], by_id(told)["table_1"]["back_m"]) == (1.5708, 0.19)
    table = from_json(told).object("table_1")
    assert (table.back_rad, table.back_m) == (1.5708, 0.19)


def test_the_boards_of_a_shelf_are_told_and_read_and_may_be_left_out():
    document = kitchen()
    assert from_json(document).object("table_1").surfaces_m == ()
    document["nodes"][1]["surfaces_m"] = [0.6, 0.3]
    told = to_json(from_json(document))
    assert by_id(told)["table_1"]["surfaces_m"] == [0.3, 0.6]
    assert from_json(told).object("table_1").surfaces_m == (0.3, 0.6)
    document["nodes"][1]["surfaces_m"] = [-0.1]
    with pytest.raises(SceneFormatError, match="surfaces_m"):
        from_json(document)
