"""What a building is after the robot was switched off and on again."""

import json
from dataclasses import replace

import pytest

from scene_graph.checks.invariants import check
from scene_graph.edges import EdgeKey, EdgeType, HasIntentionEdge, IntentionAction, IntentionStatus
from scene_graph.edits import PutEdge, PutNode, RemoveNode
from scene_graph.long_term.keeping import rooms_to_keep, take_up
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.room_files import RoomFiles, StoredBuilding
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import CrossingStatus, ObjectState, RoomNode, RoomStatus


def restarted(snapshot, *, elapsed_s=0.0, now_s=0.0, rooms=None):
    """The building after a restart, and what was dropped."""
    rooms = rooms_to_keep(snapshot) if rooms is None else rooms
    taken = take_up(StoredBuilding(rooms=tuple(rooms), stamp_s=snapshot.stamp_s), now_s=now_s, elapsed_s=elapsed_s)
    return WorkingMemory(long_term=LongTermStore(taken.rooms)).building(), dict(taken.dropped)


def test_everything_is_there_again_but_the_robot_and_wishes(house):
    again, dropped = restarted(house, now_s=house.stamp_s)
    assert dropped == {}
    assert check(again) == ()
    expected = {node.id: node for node in house.nodes.values() if node.id not in ("robot", "root")}
    assert {node_id: again.node(node_id) for node_id in expected} == expected
    assert set(again.nodes) == set(house.nodes)
    lost = [edge for edge in house.edges.values() if edge.key not in again.edges]
    assert all("robot" in (edge.key.source, edge.key.target) for edge in lost)
    assert again.current_room is None


def test_what_was_seen_yesterday_says_so(house):
    again, _ = restarted(house, elapsed_s=86_400.0)
    for node_id in ("bottle_2", "person_1"):
        age_s = house.stamp_s - house.node(node_id).last_seen_s
        assert again.stamp_s - again.node(node_id).last_seen_s == pytest.approx(86_400.0 + age_s)
    age_s = house.stamp_s - house.parent("table_1").stamp_s
    assert again.stamp_s - again.parent("table_1").stamp_s == pytest.approx(86_400.0 + age_s)


def test_what_the_hand_held_is_missing_where_the_robot_was(memory):
    robot, bottle = memory.snapshot().robot, memory.snapshot().object("bottle_2")
    old = memory.snapshot().parent("bottle_2")
    with memory.edit("test", 11.0) as tx:
        tx.remove(old.key)
        tx.put(replace(bottle, state=ObjectState.HELD), replace(robot, holding="bottle_2"))
        tx.put(replace(old, source="robot"))
    again, _ = restarted(memory.snapshot())
    assert again.object("bottle_2").state is ObjectState.MISSING
    assert again.object("bottle_2").existence < 0.2
    assert again.room_of("bottle_2") == "room_1"
    assert again.position("bottle_2", "room_1") == pytest.approx(memory.snapshot().position("bottle_2", "room_1"))


def test_that_a_room_was_looked_around_in_is_remembered_and_what_was_only_wished_is_not(memory):
    look = HasIntentionEdge(
        source="robot",
        target="room_2",
        agent="objects",
        action=IntentionAction.LOOK,
        status=IntentionStatus.DONE,
        priority=20,
    )
    wish = replace(look, target="room_1", status=IntentionStatus.GRANTED)
    memory.commit([PutEdge(look), PutEdge(wish)], agent="test", stamp_s=11.0)
    again, _ = restarted(memory.snapshot())
    assert [edge.target for edge in again.intentions()] == ["room_2"]


def test_rooms_and_doors_still_being_measured_are_forgotten(memory):
    snapshot = memory.snapshot()
    measuring = replace(snapshot.room("room_2"), status=RoomStatus.TEMPORARY)
    suspected = replace(snapshot.door("door_1_1_0"), id="door_1_1_1_pre", provisional=True)
    hung = replace(snapshot.parent("door_1_1_0"), target=suspected.id)
    memory.commit([PutNode(measuring), PutNode(suspected), PutEdge(hung)], agent="test", stamp_s=11.0)
    again, dropped = restarted(memory.snapshot())
    assert dropped == {}
    assert [room.id for room in again.of_type(RoomNode)] == ["room_1"]
    assert suspected.id not in again


def test_a_door_to_a_room_that_was_lost_has_yet_to_be_crossed(house):
    again, dropped = restarted(house, rooms=rooms_to_keep(house)[:1])
    assert dropped == {}
    assert check(again) == ()
    door = again.door("door_1_1_0")
    assert (door.rooms, door.crossing) == (("room_1", None), CrossingStatus.UNCROSSED)


def test_a_room_that_says_it_holds_what_another_holds_is_left_out(house):
    kitchen, office = rooms_to_keep(house)
    doubled = replace(office, nodes=(*office.nodes, house.object("table_1")))
    again, dropped = restarted(house, rooms=(kitchen, doubled))
    assert dropped == {"room_2": "table_1 is also in another room"}
    assert check(again) == ()


def test_a_room_that_breaks_an_invariant_is_left_out(house):
    kitchen, office = rooms_to_keep(house)
    unhung = [edge for edge in office.edges if edge.key != EdgeKey(EdgeType.RT, "room_2", "bottle_10")]
    again, dropped = restarted(house, rooms=(kitchen, replace(office, edges=tuple(unhung))))
    assert "no parent frame" in dropped["room_2"]
    assert check(again) == ()
    assert "room_1" in again


def test_writing_leaves_the_memory_as_it_is(memory):
    memory.commit([RemoveNode("bottle_10")], agent="test", stamp_s=11.0)
    before = memory.snapshot()
    rooms_to_keep(before)
    assert memory.snapshot() is before


def test_ages_are_right_when_the_process_ended_between_a_room_and_the_building(house, tmp_path):
    """Killed at its first writing, a robot whose clock began at 2000 s leaves rooms beside an older building file."""
    seen_s = house.node("bottle_2").last_seen_s
    rooms = rooms_to_keep(house)
    RoomFiles(tmp_path, begun_s=1000.0).write(rooms, shared=(), stamp_s=900.0, saved_s=1900.0)
    older = (tmp_path / "building.json").read_bytes()
    RoomFiles(tmp_path, begun_s=2000.0).write(rooms, shared=(), stamp_s=seen_s + 5.0, saved_s=2000.0 + seen_s + 5.0)
    (tmp_path / "building.json").write_bytes(older)
    stored = RoomFiles(tmp_path).read()
    assert set(stored.strays) == {parts.room_id for parts in rooms}
    taken = take_up(stored, now_s=0.0, elapsed_s=2300.0 - stored.saved_s)
    ages_s = {node.id: -node.last_seen_s for parts in taken.rooms for node in parts.nodes if node.id == "bottle_2"}
    assert ages_s == {"bottle_2": pytest.approx(300.0 - seen_s)}


def test_a_lost_building_file_makes_nothing_seen_in_the_future(house, tmp_path):
    RoomFiles(tmp_path, begun_s=1000.0).write(rooms_to_keep(house), shared=(), stamp_s=900.0, saved_s=1900.0)
    (tmp_path / "building.json").write_text("{")
    taken = take_up(RoomFiles(tmp_path).read(), now_s=0.0, elapsed_s=0.0)
    assert max(node.last_seen_s for parts in taken.rooms for node in parts.nodes if hasattr(node, "last_seen_s")) < 0.0


def test_files_of_the_version_before_are_read_and_written_anew(house, tmp_path):
    RoomFiles(tmp_path).write(rooms_to_keep(house), shared=(), stamp_s=12.0, saved_s=34.0)
    for path in [tmp_path / "building.json", *(tmp_path / "rooms").iterdir()]:
        document = json.loads(path.read_text())
        news = ("held", "begun_s", *(("stamp_s", "saved_s") if path.parent.name == "rooms" else ()))
        older = {name: value for name, value in document.items() if name not in news}
        path.write_text(json.dumps(older | {"version": 1}))
    files = RoomFiles(tmp_path, begun_s=5.0)
    stored = files.read()
    assert (stored.broken, stored.strays, stored.held) == ((), {}, None)
    assert (stored.rooms, stored.stamp_s, stored.saved_s) == (rooms_to_keep(house), 12.0, 34.0)
    files.write(stored.rooms, shared=(), stamp_s=1.0, saved_s=6.0, held="cup_1")
    assert {json.loads(path.read_text())["version"] for path in tmp_path.rglob("*.json")} == {2}
    assert RoomFiles(tmp_path).read().held == "cup_1"
