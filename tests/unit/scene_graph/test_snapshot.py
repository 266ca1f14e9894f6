import pickle

import numpy as np
import pytest

from scene_graph.edges import EdgeKey, EdgeType, IntentionStatus, RtEdge
from scene_graph.errors import EdgeNotFound, FramesNotConnected, NodeNotFound, WrongNodeType
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode, RoomNode, RootNode, WallNode
from scene_graph.queries.poses import MapPoses, layout
from scene_graph.snapshot import ABSENT, Snapshot


def test_nodes_of_a_type_come_in_natural_order(house):
    assert [node.id for node in house.of_type(ObjectNode)] == ["bottle_2", "bottle_10", "table_1"]


def test_nodes_of_a_type_are_computed_once(house):
    assert house.of_type(RoomNode) is house.of_type(RoomNode)


def test_an_unknown_node_is_answered_with_what_is_known(house):
    with pytest.raises(NodeNotFound) as caught:
        house.object("bottle_3")
    assert caught.value.available == ("bottle_2", "bottle_10", "table_1")
    assert "bottle_2" in str(caught.value)
    assert house.get("bottle_3") is None
    assert "bottle_3" not in house


def test_asking_for_the_wrong_type_says_what_it_is(house):
    with pytest.raises(WrongNodeType, match="'table_1' is of type object, not room; of that type: room_1, room_2"):
        house.room("table_1")


@pytest.mark.parametrize(
    ("lookup", "node_id"),
    [
        ("room", "room_2"),
        ("wall", "wall_1_1"),
        ("corner", "corner_1_1"),
        ("door", "door_2_0_0"),
        ("object", "table_1"),
        ("person", "person_1"),
        ("affordance", "aff_cross_2_0_0"),
    ],
)
def test_typed_lookups_find_their_nodes(house, lookup, node_id):
    assert getattr(house, lookup)(node_id).id == node_id


def test_an_unknown_edge_is_answered_with_the_edges_of_its_source(house):
    key = EdgeKey(EdgeType.RELATION, "bottle_2", "table_1", "under")
    with pytest.raises(EdgeNotFound, match=r"no edge relation bottle_2 -under-> table_1; .*bottle_2 -on-> table_1"):
        house.edge(key)
    assert house.edge(key._replace(label="on")).probability == 0.9


def test_edges_are_found_from_both_ends(house):
    assert {edge.target for edge in house.edges_from("bottle_2", EdgeType.RELATION)} == {"table_1", "bottle_10"}
    assert [edge.source for edge in house.edges_to("table_1", EdgeType.RELATION)] == ["bottle_2"]
    assert {edge.key.type for edge in house.edges_from("robot")} == {EdgeType.IN, EdgeType.HAS_INTENTION}
    assert house.edges_from("nobody") == ()


def test_children_and_parents_are_two_views_of_the_same_edges(house):
    assert house.parent("root") is None
    for node_id in house.nodes:
        for child in house.children(node_id):
            assert house.parent(child).source == node_id


def test_a_door_seen_from_both_rooms_is_in_one_place(house):
    assert np.allclose(house.position("door_1_1_0", "root"), (2.5, 1.0, 0.0))
    assert np.allclose(house.position("door_2_0_0", "root"), (2.7, 1.0, 0.0))


def test_positions_are_read_in_any_frame(house):
    assert np.allclose(house.position("bottle_2", "table_1"), (0.0, 0.2, 0.475))
    assert np.allclose(house.transform("robot", "room_1").translation_m, (0.5, 0.0, 0.0))


def test_frames_that_hang_from_nothing_common_are_named(house):
    with pytest.raises(FramesNotConnected) as caught:
        house.transform("root", "aff_cross_2_0_0")
    assert caught.value.source_chain == ("aff_cross_2_0_0",)
    with pytest.raises(NodeNotFound):
        house.transform("root", "nobody")


def test_a_graph_whose_frames_form_a_circle_is_read_without_end():
    identity = SE3.identity()
    broken = Snapshot.of(
        [RootNode(), RoomNode(id="a"), RoomNode(id="b")],
        [
            RtEdge(source="a", target="b", T_source_target=identity),
            RtEdge(source="b", target="a", T_source_target=identity),
        ],
    )
    with pytest.raises(FramesNotConnected):
        broken.transform("root", "a")
    assert MapPoses(broken).pose("a") is None
    assert layout(broken) == {}


@pytest.mark.parametrize(
    ("node_id", "room"),
    [
        ("room_2", "room_2"),
        ("bottle_10", "room_2"),
        ("corner_1_1", "room_1"),
        ("door_2_0_0", "room_2"),
        ("aff_cross_2_0_0", "room_2"),
        ("robot", "room_1"),
        ("root", None),
    ],
)
def test_every_node_knows_its_room(house, node_id, room):
    assert house.room_of(node_id) == room


def test_the_current_room_is_that_of_the_robot(house):
    assert house.current_room == "room_1"
    assert Snapshot.of([RootNode()]).current_room is None


def test_intentions_are_filtered_by_status(house):
    assert [edge.agent for edge in house.intentions()] == ["objects"]
    assert house.intentions(IntentionStatus.GRANTED) == ()


def test_relations_are_filtered_by_any_of_their_parts(house):
    assert len(house.relations()) == 2
    assert [edge.target for edge in house.relations(predicate="on")] == ["table_1"]
    assert [edge.predicate for edge in house.relations(target="bottle_10")] == ["in"]
    assert [edge.predicate for edge in house.relations("bottle_2", None, "table_1")] == ["on"]


def test_the_support_is_the_most_probable_one(house):
    assert house.support_of("bottle_2") == "table_1"
    assert house.support_of("table_1") is None


def test_revisions_tell_what_was_written_last(memory, house):
    after = memory.edit("test", 11.0)
    with after as tx:
        tx.put(ObjectNode(id="table_1", label="desk"))
    assert after.snapshot.revision_of("table_1") == house.revision + 1
    assert after.snapshot.revision_of("bottle_2") == house.revision
    assert after.snapshot.revision_of("nobody") == ABSENT
    assert after.snapshot.revision_of(EdgeKey(EdgeType.IN, "nobody", "room_1")) == ABSENT


def test_a_commit_shares_what_it_does_not_touch(memory, house):
    walls = house.of_type(WallNode)
    with memory.edit("test", 11.0) as tx:
        tx.put(ObjectNode(id="table_1", label="desk"))
    after = memory.snapshot()
    assert house.object("table_1").label == "table"
    assert after.nodes["bottle_2"] is house.nodes["bottle_2"]
    assert after.edges is house.edges
    assert after.of_type(WallNode) is walls


def test_a_snapshot_cannot_be_written(house):
    with pytest.raises(TypeError):
        house.nodes["x"] = RootNode()
    with pytest.raises(TypeError):
        house.edges[EdgeKey(EdgeType.IN, "a", "b")] = None
    with pytest.raises(ValueError, match="read-only"):
        house.position("bottle_2", "root")[0] = 1.0
    with pytest.raises(AttributeError, match="immutable"):
        house.transform("root", "robot").translation_m = (0, 0, 0)


def test_a_snapshot_travels_between_processes(house):
    assert pickle.loads(pickle.dumps(house)) == house


def test_layout_lists_the_rooms_in_the_map(house):
    assert list(layout(house)) == ["room_1", "room_2"]
    assert layout(house)["room_2"].x_m == 4.7
