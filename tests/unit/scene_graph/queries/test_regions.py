"""Floors and wings: rooms grouped into regions."""

import json

import pytest

from scene_graph.checks.invariants import check
from scene_graph.documents.interchange import from_json, to_json
from scene_graph.edges import InEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.errors import InvariantBroken, SceneFormatError, UnknownRegion
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.keeping import rooms_to_keep, take_up
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.room_files import RoomFiles
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import NodeType, RegionNode
from scene_graph.queries.queries import NodeFilter, Related, select
from scene_graph.queries.topology import path_between


@pytest.fixture
def floors(memory):
    """The kitchen is on the ground floor, the office upstairs."""
    with memory.edit("person", 11.0) as tx:
        tx.put(RegionNode(id="region_1", label="ground floor"), RegionNode(id="region_2", label="upstairs"))
        tx.put(InEdge(source="room_1", target="region_1"), InEdge(source="room_2", target="region_2"))
    return memory


def ids(snapshot, **wanted):
    return [node.id for node in select(snapshot, NodeFilter(**wanted)).nodes]


def test_everything_in_a_room_is_in_its_region(floors):
    house = floors.snapshot()
    assert check(house) == ()
    for node_id in ("room_1", "wall_1_1", "door_1_1_0", "table_1", "robot", "region_1"):
        assert house.region_of(node_id) == "region_1"
    assert house.region_of("root") is None
    assert house.rooms_in("region_2") == ("room_2",)
    assert house.room_of("region_1") is None


@pytest.mark.parametrize("name", ["region_2", "Upstairs", "upstairs"])
def test_queries_filter_by_region(floors, name):
    assert ids(floors.snapshot(), region=name, types=(NodeType.OBJECT, NodeType.PERSON)) == ["bottle_10", "person_1"]
    assert ids(floors.snapshot(), region=name, types=(NodeType.ROOM, NodeType.REGION)) == ["region_2", "room_2"]


def test_rooms_are_related_to_their_region(floors):
    assert ids(floors.snapshot(), related=Related(predicate="in", target="region_1")) == ["room_1"]


def test_an_unknown_region_is_told_with_those_there_are(floors):
    with pytest.raises(UnknownRegion, match="no region 'attic'; regions: region_1, ground floor, region_2, upstairs"):
        select(floors.snapshot(), NodeFilter(region="attic"))


@pytest.mark.parametrize(
    ("elements", "message"),
    [
        ([InEdge(source="room_1", target="region_2")], "room_1 is in 2 regions: region_1, region_2"),
        ([InEdge(source="table_1", target="region_1")], "it may lead from object or person or robot to room"),
        ([InEdge(source="room_1", target="room_2")], "it may lead from room to region"),
        ([InEdge(source="region_1", target="region_2")], "leads from region to region"),
        ([RtEdge(source="root", target="region_1", T_source_target=SE3.identity())], "leads from root to region"),
    ],
)
def test_a_region_holds_rooms_and_a_room_is_in_one_at_most(floors, elements, message):
    with pytest.raises(InvariantBroken, match=message):
        floors.commit([PutEdge(edge) for edge in elements], agent="test", stamp_s=12.0)


def test_a_region_is_reached_in_its_nearest_room(floors):
    house = floors.snapshot()
    assert path_between(house, "robot", "region_2").rooms == ("room_1", "room_2")
    assert path_between(house, "region_1", "region_2").doors == ("door_1_1_0",)
    assert path_between(house, "robot", "region_1").rooms == ("room_1",)
    floors.commit([PutNode(RegionNode(id="region_3", label="attic"))], agent="test", stamp_s=12.0)
    assert path_between(floors.snapshot(), "robot", "region_3") is None


def test_a_scene_document_tells_regions_and_is_read_again(floors):
    document = to_json(floors.snapshot())
    region = next(node for node in document["nodes"] if node["id"] == "region_2")
    room = next(node for node in document["nodes"] if node["id"] == "room_2")
    assert (region["type"], region["label"], region["rooms"]) == ("region", "upstairs", ["room_2"])
    assert (region["position_m"], region["room"], room["region"]) == (room["position_m"], None, "region_2")
    again = from_json(json.loads(json.dumps(document)))
    assert to_json(again) == document


def test_a_document_written_by_hand_lists_the_rooms_of_a_region():
    rooms = [{"id": "hall", "type": "room"}, {"id": "attic", "type": "room"}]
    house = from_json({"nodes": [*rooms, {"id": "region_1", "type": "region", "rooms": ["hall"]}], "edges": []})
    assert house.rooms_in("region_1") == ("hall",)
    with pytest.raises(SceneFormatError, match="no room 'cellar'"):
        from_json({"nodes": [*rooms, {"id": "region_1", "type": "region", "rooms": ["cellar"]}], "edges": []})


def test_regions_outlive_unloading_and_restarts(floors, tmp_path):
    memory = WorkingMemory(floors.snapshot(), long_term=LongTermStore())
    memory.unload("room_2", agent="ltsm", stamp_s=12.0)
    assert memory.building().region_of("bottle_10") == "region_2"
    assert memory.snapshot().rooms_in("region_2") == ()
    building = memory.building()
    regions = building.of_type(RegionNode)
    RoomFiles(tmp_path).write(rooms_to_keep(building), shared=regions, stamp_s=12.0, saved_s=0.0)
    taken = take_up(RoomFiles(tmp_path).read(), now_s=0.0, elapsed_s=0.0)
    assert taken.shared == regions
    again = WorkingMemory(long_term=LongTermStore(taken.rooms))
    again.commit([PutNode(region) for region in taken.shared], agent="remembering", stamp_s=0.0)
    assert again.building().rooms_in("region_2") == ("room_2",)
