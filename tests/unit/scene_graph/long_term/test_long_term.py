import json
import re
from dataclasses import replace

import pytest

from scene_graph.checks.invariants import check
from scene_graph.edges import EdgeKey, EdgeType, HasIntentionEdge, IntentionAction, RtEdge
from scene_graph.edits import PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.errors import InvariantBroken, RoomInUse, RoomNotStored
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import next_id
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.room_files import RoomFiles
from scene_graph.long_term.room_parts import cut_room
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import CrossingStatus, DoorNode, ObjectNode, RoomNode
from scene_graph.queries.topology import Topology, path_between

RT_ROOM_2 = EdgeKey(EdgeType.RT, "root", "room_2")
MATCH = EdgeKey(EdgeType.MATCH, "door_1_1_0", "door_2_0_0")


@pytest.fixture
def paged(house):
    """The house with its office unloaded; the robot is in the kitchen."""
    memory = WorkingMemory(house, long_term=LongTermStore())
    memory.building()
    memory.unload("room_2", agent="ltsm", stamp_s=11.0)
    return memory


def elements(snapshot):
    return {**snapshot.nodes, **snapshot.edges}


def commit(memory, *edits):
    return memory.commit(edits, agent="test", stamp_s=12.0)


def test_an_unloaded_room_takes_everything_in_it_along(paged, house):
    gone = {node for node in house.nodes if node not in paged.snapshot()}
    assert gone == {"room_2", "wall_2_0", "door_2_0_0", "aff_cross_2_0_0", "bottle_10", "person_1"}
    assert check(paged.snapshot()) == ()
    assert paged.unloaded == ("room_2",)


def test_a_door_of_a_loaded_room_goes_on_to_say_where_it_leads(paged):
    assert paged.snapshot().door("door_1_1_0").rooms == ("room_1", "room_2")
    assert MATCH not in paged.snapshot().edges


def test_the_building_is_complete_at_any_time(paged, house):
    assert elements(paged.building()) == elements(house)
    assert paged.building().revision == paged.snapshot().revision
    assert paged.building() is paged.building()
    paged.load("bottle_10", agent="ltsm", stamp_s=12.0)
    assert elements(paged.snapshot()) == elements(house)
    assert elements(paged.building()) == elements(house)


def test_ways_lead_through_unloaded_rooms(paged, house):
    assert path_between(paged.building(), "robot", "bottle_10") == path_between(house, "robot", "bottle_10")
    assert Topology.from_snapshot(paged.building()).neighbors("room_1") == ("room_2",)


def test_edits_of_what_is_loaded_show_in_the_building(paged):
    table = paged.snapshot().object("table_1")
    commit(paged, PutNode(replace(table, name="Fred")), RemoveNode("bottle_2"))
    assert paged.building().object("table_1").name == "Fred"
    assert "bottle_2" not in paged.building()
    assert EdgeKey(EdgeType.RELATION, "bottle_2", "bottle_10", "in") not in paged.building().edges


def test_what_is_torn_off_by_an_edit_does_not_come_back_with_the_room(paged):
    commit(paged, RemoveNode("bottle_2"))
    paged.load("room_2", agent="ltsm", stamp_s=12.0)
    assert check(paged.snapshot()) == ()
    assert elements(paged.snapshot()) == elements(paged.building())


def test_an_edit_brings_back_the_room_that_it_writes_to(paged):
    bottle, before = paged.building().object("bottle_10"), paged.snapshot().revision
    after = commit(paged, PutNode(replace(bottle, name="mine")))
    assert after.revision == before + 2
    assert paged.unloaded == ()
    assert paged.snapshot().object("bottle_10").name == "mine"
    assert MATCH in paged.snapshot().edges


def test_an_edge_to_an_unloaded_node_brings_its_room_back(paged):
    look = HasIntentionEdge(source="robot", target="person_1", agent="t", action=IntentionAction.LOOK, priority=1)
    commit(paged, PutEdge(look))
    assert "person_1" in paged.snapshot()
    assert paged.building().intentions() == paged.snapshot().intentions()


@pytest.mark.parametrize("edit", [RemoveNode("bottle_10"), RemoveEdge(EdgeKey(EdgeType.IN, "person_1", "room_2"))])
def test_what_is_removed_from_an_unloaded_room_is_gone_from_both(paged, house, edit):
    commit(paged, edit)
    assert paged.unloaded == ()
    plain = WorkingMemory(house)
    commit(plain, edit)
    assert elements(paged.building()) == elements(paged.snapshot()) == elements(plain.snapshot())


def test_a_thing_seen_elsewhere_moves_once_its_room_is_back(paged):
    bottle = paged.building().object("bottle_10")
    here = RtEdge(source="room_1", target="bottle_10", T_source_target=SE3.identity())
    with pytest.raises(InvariantBroken, match="2 parent frames"):
        commit(paged, PutNode(bottle), PutEdge(here))
    old = paged.snapshot().parent("bottle_10")
    commit(paged, RemoveEdge(old.key), PutEdge(here))
    assert elements(paged.snapshot()) == elements(paged.building())


def test_the_place_of_an_unloaded_room_is_written_without_loading_it(paged):
    moved = replace(paged.building().edge(RT_ROOM_2), T_source_target=SE3.from_xyz_yaw(9.0, 0.0, 0.0, 0.0))
    commit(paged, PutEdge(moved))
    assert paged.unloaded == ("room_2",)
    assert paged.building().edge(RT_ROOM_2) == moved
    assert paged.load("room_2", agent="ltsm", stamp_s=13.0).edge(RT_ROOM_2) == moved


def test_a_rejected_edit_changes_nothing_in_the_building(paged, house):
    bottle = paged.building().object("bottle_10")
    with pytest.raises(InvariantBroken, match="existence"):
        commit(paged, PutNode(replace(bottle, existence=2.0)))
    with pytest.raises(InvariantBroken, match="not finite"):
        commit(paged, PutEdge(replace(paged.building().edge(RT_ROOM_2), stamp_s=float("nan"))))
    assert elements(paged.building()) == elements(house)


def test_new_identifiers_keep_clear_of_unloaded_ones(paged):
    assert next_id(paged.snapshot(), "room") == "room_3"
    assert next_id(paged.snapshot(), "person") == "person_2"


def test_a_room_in_use_stays(paged):
    with pytest.raises(RoomInUse, match="robot is in it"):
        paged.unload("room_1", agent="ltsm", stamp_s=12.0)
    nook = RtEdge(source="room_2", target="room_3", T_source_target=SE3.identity())
    commit(paged, PutNode(RoomNode(id="room_3")), PutEdge(nook))
    with pytest.raises(RoomInUse, match="room_3"):
        paged.unload("room_2", agent="ltsm", stamp_s=12.0)


def test_subscribers_are_told_what_came_and_went(house):
    memory = WorkingMemory(house, long_term=LongTermStore())
    with memory.subscribe() as subscription:
        memory.unload("room_2", agent="ltsm", stamp_s=11.0)
        memory.load("person_1", agent="ltsm", stamp_s=12.0)
        unloaded, loaded = subscription.poll()
    assert (unloaded.unloaded, unloaded.loaded) == (("room_2",), ())
    assert (loaded.unloaded, loaded.loaded) == ((), ("room_2",))
    assert set(unloaded.removed_nodes) == {node.id for node in loaded.put_nodes}


def test_a_memory_without_long_term_memory_keeps_everything(house):
    memory = WorkingMemory(house)
    assert memory.unload("room_2", agent="ltsm", stamp_s=1.0) is memory.snapshot() is memory.building()
    assert memory.load("room_2", agent="ltsm", stamp_s=1.0) is memory.snapshot()


def test_rooms_with_something_left_to_explore_are_told(house):
    store = LongTermStore([cut_room(house, "room_1"), cut_room(house, "room_2")])
    assert store.unfinished == ()
    parts = cut_room(house, "room_2")
    doors = [replace(n, crossing=CrossingStatus.UNCROSSED) if isinstance(n, DoorNode) else n for n in parts.nodes]
    store = LongTermStore([replace(parts, nodes=tuple(doors))])
    assert store.unfinished == ("room_2",)
    store.load("room_2")
    assert store.unfinished == ()


def test_a_thing_is_only_there_once(house):
    store = LongTermStore([cut_room(house, "room_2")])
    assert store.get("bottle_10") == house.object("bottle_10")
    assert store.room_of("bottle_10") == "room_2"
    store.load("room_2")
    assert (len(store), list(store.edges())) == (0, [])
    with pytest.raises(RoomNotStored, match="there are none"):
        store.load("room_2")


def write(folder, house):
    files = RoomFiles(folder)
    files.write([cut_room(house, room) for room in ("room_1", "room_2")], shared=(), stamp_s=1.0, saved_s=2.0)
    return files


@pytest.mark.parametrize(
    ("damage", "reason"),
    [
        (lambda text: text[: len(text) // 2], "delimiter|Unterminated|Expecting"),
        (lambda text: text.replace('"version":2', '"version":99'), "version: 99, and this program reads"),
        (lambda text: text.replace('"width_m"', '"wide"'), r"nodes\[\d+\].wide: no such field"),
        (lambda text: text.replace('"quat_wxyz":[1.0', '"quat_wxyz":["?"'), r"edges\[\d+\]"),
        (lambda _: "[]", "not an object"),
    ],
)
def test_a_broken_file_is_set_aside_and_the_rest_is_read(tmp_path, house, damage, reason, caplog):
    write(tmp_path, house)
    path = tmp_path / "rooms" / "room_1.json"
    path.write_text(damage(path.read_text()))
    stored = RoomFiles(tmp_path).read()
    assert [parts.room_id for parts in stored.rooms] == ["room_2"]
    ((aside, problem),) = stored.broken
    assert aside.name == "room_1.json.broken"
    assert aside.exists()
    assert not path.exists()
    assert "set aside" in caplog.text
    assert re.search(reason, problem)
    (tmp_path / "rooms" / "room_1.json").write_text("{")
    assert RoomFiles(tmp_path).read().broken[0][0].name == "room_1.json.2.broken"
    assert aside.exists()


def test_a_file_is_only_written_when_its_room_has_changed(tmp_path, house):
    files = write(tmp_path, house)
    rooms = [cut_room(house, room) for room in ("room_1", "room_2")]
    assert files.write(rooms, shared=(), stamp_s=3.0, saved_s=4.0) == 0
    changed = replace(rooms[0], nodes=tuple(replace(node, confidence=0.5) for node in rooms[0].nodes))
    assert files.write([changed], shared=(), stamp_s=3.0, saved_s=4.0) == 1
    assert [path.name for path in (tmp_path / "rooms").iterdir()] == ["room_1.json"]
    assert json.loads((tmp_path / "building.json").read_text())["stamp_s"] == 3.0


def test_a_folder_that_is_not_there_holds_no_building(tmp_path):
    stored = RoomFiles(tmp_path / "none").read()
    assert (stored.rooms, stored.broken) == ((), ())


def test_the_topology_is_computed_once_until_a_door_or_room_changes(memory):
    first = Topology.from_snapshot(memory.snapshot())
    cup = RtEdge(source="room_1", target="cup_1", T_source_target=SE3.identity())
    commit(memory, PutNode(ObjectNode(id="cup_1", label="cup")), PutEdge(cup))
    commit(memory, PutEdge(replace(memory.snapshot().parent("robot"), stamp_s=3.0)))
    assert Topology.from_snapshot(memory.snapshot()) is first
    door = memory.snapshot().parent("door_1_1_0")
    commit(memory, PutEdge(replace(door, T_source_target=SE3.from_xyz_yaw(0.5, 0.0, 0.0, 0.0))))
    assert Topology.from_snapshot(memory.snapshot()) is not first
