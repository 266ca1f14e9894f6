import pytest

from scene_graph.errors import NodeNotFound, UnknownRoom
from scene_graph.nodes import NodeType, RobotNode, RootNode
from scene_graph.queries.queries import Near, NodeFilter, OrderBy, Related, next_id, select
from scene_graph.snapshot import Snapshot


def ids(house, **wanted):
    return [node.id for node in select(house, NodeFilter(**wanted)).nodes]


def test_an_empty_filter_selects_every_node_in_natural_order(house):
    assert set(ids(house)) == set(house.nodes)
    assert ids(house, types=(NodeType.OBJECT,)) == ["bottle_2", "bottle_10", "table_1"]
    assert ids(house, types=(NodeType.OBJECT,), descending=True) == ["table_1", "bottle_10", "bottle_2"]


@pytest.mark.parametrize(
    ("wanted", "found"),
    [
        ({"label": "Bottle"}, ["bottle_2", "bottle_10"]),
        ({"label": "flask"}, []),
        ({"color": "BLUE"}, ["bottle_2"]),
        ({"name": "ada"}, ["person_1"]),
        ({"categories": ("Fragile", "drink")}, ["bottle_2"]),
        ({"categories": ("drink", "tool")}, []),
        ({"state": "missing"}, ["bottle_10"]),
        ({"state": "open"}, ["door_1_1_0", "door_2_0_0"]),
        ({"state": "idle"}, ["robot"]),
        ({"types": (NodeType.OBJECT,), "room": "room_1"}, ["bottle_2", "table_1"]),
        ({"types": (NodeType.OBJECT, NodeType.PERSON), "room": "Office"}, ["bottle_10", "person_1"]),
        ({"related": Related(predicate="on", target="table_1")}, ["bottle_2"]),
        ({"related": Related(predicate="on")}, ["bottle_2"]),
        ({"related": Related(predicate="in", target="room_2")}, ["bottle_10", "person_1"]),
        ({"related": Related(predicate="beside", target="table_1")}, []),
        ({"types": (NodeType.OBJECT,), "max_age_s": 0.75}, ["bottle_2"]),
        ({"types": (NodeType.OBJECT,), "max_age_s": 1.0}, ["bottle_2", "table_1"]),
        ({"types": (NodeType.WALL,), "max_age_s": 8.9}, []),
        ({"types": (NodeType.WALL,), "max_age_s": 9.0}, ["wall_1_1", "wall_2_0"]),
        ({"types": (NodeType.OBJECT,), "near": Near(node="table_1", radius_m=0.6)}, ["bottle_2"]),
        ({"types": (NodeType.OBJECT,), "near": Near(point_m=(4.7, 0.0), radius_m=0.01)}, ["bottle_10"]),
        ({"types": (NodeType.OBJECT,), "near": Near(point_m=(4.7, 0.0, 0.0), radius_m=0.01)}, []),
        ({"types": (NodeType.AFFORDANCE,), "near": Near(node="door_2_0_0", radius_m=0.1)}, ["aff_cross_2_0_0"]),
    ],
)
def test_conditions_select(house, wanted, found):
    assert ids(house, **wanted) == found


@pytest.mark.parametrize(
    ("order", "found"),
    [
        (OrderBy.LABEL, ["bottle_2", "bottle_10", "table_1"]),
        (OrderBy.DISTANCE, ["table_1", "bottle_2", "bottle_10"]),
        (OrderBy.LAST_SEEN, ["bottle_10", "table_1", "bottle_2"]),
        (OrderBy.SIZE, ["bottle_2", "bottle_10", "table_1"]),
        (OrderBy.CONFIDENCE, ["bottle_2", "bottle_10", "table_1"]),
    ],
)
def test_results_are_ordered(house, order, found):
    assert ids(house, types=(NodeType.OBJECT,), order_by=order) == found


def test_descending_order_keeps_ties_in_natural_order(house):
    assert ids(house, types=(NodeType.OBJECT,), order_by=OrderBy.LABEL, descending=True) == [
        "table_1",
        "bottle_2",
        "bottle_10",
    ]


def test_nearness_orders_by_distance_from_what_is_named(house):
    wanted = {"types": (NodeType.OBJECT,), "order_by": OrderBy.DISTANCE}
    assert ids(house, near=Near(node="person_1"), **wanted) == ["bottle_10", "table_1", "bottle_2"]


def test_rooms_doors_and_walls_have_sizes(house):
    kinds = (NodeType.ROOM, NodeType.DOOR, NodeType.WALL, NodeType.PERSON)
    found = ids(house, types=kinds, order_by=OrderBy.SIZE, descending=True)
    assert found == ["room_1", "room_2", "wall_1_1", "wall_2_0", "door_2_0_0", "door_1_1_0", "person_1"]


def test_total_counts_what_limit_and_offset_leave_out(house):
    selection = select(house, NodeFilter(types=(NodeType.OBJECT,), limit=1, offset=1))
    assert ([node.id for node in selection.nodes], selection.total) == (["bottle_10"], 3)
    assert select(house, NodeFilter(types=(NodeType.OBJECT,), limit=0)).total == 3


def test_unknown_names_are_refused_and_known_ones_listed(house):
    with pytest.raises(UnknownRoom, match="no room 'attic'; rooms: room_1, kitchen, room_2, office"):
        select(house, NodeFilter(room="attic"))
    with pytest.raises(NodeNotFound):
        select(house, NodeFilter(near=Near(node="sofa_1")))
    with pytest.raises(NodeNotFound):
        select(house, NodeFilter(related=Related(target="sofa_1")))


def test_contradictory_filters_cannot_be_made():
    with pytest.raises(ValueError, match="either a node or a point"):
        Near()
    with pytest.raises(ValueError, match="not be negative"):
        NodeFilter(limit=-1)


def test_what_has_no_place_is_last_by_distance():
    lost = Snapshot.of([RootNode(), RobotNode()])
    assert ids(lost, order_by=OrderBy.DISTANCE) == ["robot", "root"]
    assert ids(lost, near=Near(node="robot", radius_m=1.0)) == []


def test_the_next_identifier_is_free(house):
    assert next_id(house, "bottle") == "bottle_1"
    assert next_id(house, "Table") == "table_2"
    assert next_id(house, "potted plant") == "potted_plant_1"
