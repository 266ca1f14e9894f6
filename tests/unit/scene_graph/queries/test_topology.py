from dataclasses import replace

import pytest

from scene_graph.edges import RtEdge
from scene_graph.errors import NodeNotFound, UnknownRoom
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorState, RoomNode
from scene_graph.queries.doors import physical_doors
from scene_graph.queries.topology import Topology, path_between


def put(memory, *elements):
    with memory.edit("test", 20.0) as tx:
        tx.put(*elements)
    return memory.snapshot()


def close(memory, door_id, state=DoorState.CLOSED):
    return put(memory, replace(memory.snapshot().door(door_id), state=state))


def test_matched_door_nodes_are_one_physical_door(house):
    (door,) = physical_doors(house)
    assert door.id == "door_1_1_0"
    assert door.rooms == ("room_1", "room_2")
    assert door.side("room_2").id == "door_2_0_0"


def test_the_latest_word_about_a_door_counts(memory):
    assert physical_doors(close(memory, "door_2_0_0"))[0].state is DoorState.CLOSED
    assert physical_doors(close(memory, "door_1_1_0", DoorState.OPEN))[0].state is DoorState.OPEN
    assert physical_doors(close(memory, "door_2_0_0", DoorState.UNKNOWN))[0].state is DoorState.OPEN


def test_a_path_leads_through_the_door_from_center_to_center(house):
    path = Topology.from_snapshot(house).path("room_1", "room_2")
    assert path.rooms == ("room_1", "room_2")
    assert path.doors == ("door_1_1_0",)
    assert path.length_m == pytest.approx(2 * 5**0.5)


def test_the_way_back_names_the_door_of_the_room_that_it_leaves(house):
    assert Topology.from_snapshot(house).path("room_2", "room_1").doors == ("door_2_0_0",)


def test_a_path_to_where_one_is_needs_no_door(house):
    path = Topology.from_snapshot(house).path("room_1", "room_1")
    assert (path.rooms, path.doors, path.length_m) == (("room_1",), (), 0.0)


def test_closed_doors_bar_the_way_unless_told_otherwise(memory):
    topology = Topology.from_snapshot(close(memory, "door_2_0_0"))
    assert topology.path("room_1", "room_2") is None
    assert topology.path("room_1", "room_2", only_open=False).doors == ("door_1_1_0",)
    assert topology.neighbors("room_1") == ("room_2",)
    assert topology.neighbors("room_1", only_open=True) == ()


@pytest.mark.parametrize("door", ["door_1_1_0", "door_2_0_0"])
def test_a_door_is_avoided_under_either_of_its_names(house, door):
    assert Topology.from_snapshot(house).path("room_1", "room_2", avoid_doors={door}) is None


def test_unknown_rooms_are_refused(house):
    with pytest.raises(UnknownRoom, match="no room 'room_3'; rooms: room_1, room_2"):
        Topology.from_snapshot(house).path("room_1", "room_3")


def test_a_room_without_doors_has_no_neighbors_and_no_paths(memory):
    attic = RtEdge(source="root", target="room_3", T_source_target=SE3.identity())
    topology = Topology.from_snapshot(put(memory, RoomNode(id="room_3"), attic))
    assert topology.neighbors("room_3") == ()
    assert topology.path("room_1", "room_3") is None


def test_paths_between_nodes_are_measured_from_the_nodes(house):
    path = path_between(house, "robot", "person_1")
    assert path.rooms == ("room_1", "room_2")
    # robot (-0.5, 0) to the door (2, 1) in room_1; the door (1, 2) to person_1 (1, 0) in room_2
    assert path.length_m == pytest.approx((2.5**2 + 1.0) ** 0.5 + 2.0)
    assert path_between(house, "robot", "table_1").length_m == pytest.approx((1.5**2 + 1.0) ** 0.5)
    assert path_between(house, "room_1", "aff_cross_2_0_0").rooms == ("room_1", "room_2")


def test_there_is_no_path_to_what_is_nowhere(house):
    assert path_between(house, "robot", "root") is None
    with pytest.raises(NodeNotFound):
        path_between(house, "robot", "nobody")
