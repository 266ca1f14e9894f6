"""The building on disk, and what a robot knows that starts from it."""

from dataclasses import replace

import pytest

from app.persistence.building import Remembering, building_folder
from perception.crossing import find_robot
from perception.geometry.planar import Pose2
from planner.mission.teaching import teach
from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.keeping import rooms_to_keep
from scene_graph.long_term.room_files import RoomFiles
from scene_graph.nodes import ObjectState, RoomNode
from unit.perception.memory.test_working_set import corridor

pytestmark = pytest.mark.anyio


@pytest.fixture
def anyio_backend():
    return "asyncio"


def begun(folder, wall_s=1000.0):
    """A robot that has mapped three rooms and written nothing yet."""
    RoomFiles(folder, begun_s=wall_s).write(rooms_to_keep(corridor(3)), shared=(), stamp_s=50.0, saved_s=wall_s)
    return Remembering(folder, wall_time=lambda: wall_s)


async def written(folder, wall_s=1000.0):
    remembering = begun(folder, wall_s)
    await remembering.step(0.0)
    return remembering


async def test_a_robot_that_remembers_does_not_know_where_in_the_building_it_is(tmp_path):
    await written(tmp_path)
    memory = Remembering(tmp_path, wall_time=lambda: 1060.0).memory
    assert [room.id for room in memory.building().of_type(RoomNode)] == ["room_1", "room_2", "room_3"]
    assert memory.snapshot().of_type(RoomNode) == ()
    robot = memory.snapshot().robot
    assert (robot.localized, memory.snapshot().current_room) == (False, None)
    assert memory.building().object("cup_1").last_seen_s == pytest.approx(-110.0)


async def test_with_nothing_to_remember_the_robot_starts_where_it_stands(tmp_path):
    memory = Remembering(tmp_path, wall_time=lambda: 0.0).memory
    assert memory.snapshot().robot.localized
    assert memory.unloaded == ()


async def test_what_a_person_teaches_is_written_before_it_is_acknowledged(tmp_path):
    remembering = await written(tmp_path)
    remembering.keep_taught(3.0)
    before = (tmp_path / "building.json").read_bytes()
    teach(remembering.memory, "room_2", label="library", name=None, stamp_s=4.0)
    assert (tmp_path / "building.json").read_bytes() == before
    remembering.keep_taught(4.0)
    assert Remembering(tmp_path, wall_time=lambda: 1001.0).memory.building().room("room_2").label == "library"


async def test_what_comes_into_the_hand_is_written_at_once_and_other_changes_now_and_then(tmp_path):
    remembering = await written(tmp_path)
    with remembering.memory.edit("relocalization", 1.0) as tx:
        find_robot(tx, "room_1", Pose2(0.0, 0.0, 0.0), 1.0)
    await remembering.step(1.0)
    assert Remembering(tmp_path, wall_time=lambda: 1001.0).held is None
    snapshot = remembering.memory.load("room_1", agent="test", stamp_s=2.0)
    with remembering.memory.edit("objects", 2.0) as tx:
        tx.remove(snapshot.parent("cup_1").key)
        tx.put(replace(snapshot.object("cup_1"), state=ObjectState.HELD), replace(snapshot.robot, holding="cup_1"))
        tx.put(RtEdge(source="robot", target="cup_1", T_source_target=SE3.identity()))
    await remembering.step(3.0)
    again = Remembering(tmp_path, wall_time=lambda: 1001.0)
    assert again.held == "cup_1"
    assert again.memory.building().object("cup_1").state is ObjectState.MISSING


async def test_beginning_anew_leaves_the_files_until_a_room_stands(tmp_path):
    await written(tmp_path)
    anew = Remembering(tmp_path, wall_time=lambda: 0.0, anew=True)
    assert anew.memory.unloaded == ()
    anew.write(1.0)
    assert len(list((tmp_path / "rooms").iterdir())) == 3


async def test_broken_files_are_reported_and_the_rest_is_remembered(tmp_path, caplog):
    await written(tmp_path)
    (tmp_path / "rooms" / "room_2.json").write_text("{")
    (tmp_path / "building.json").write_text("")
    memory = Remembering(tmp_path, wall_time=lambda: 0.0).memory
    assert memory.unloaded == ("room_1", "room_3")
    assert caplog.text.count("was set aside") == 2


def test_a_map_does_not_outlive_the_walls(tmp_path):
    flat, office = building_folder(tmp_path, "flat"), building_folder(tmp_path, "office")
    assert flat.parent == office.parent
    assert flat.name.startswith("flat-")
    assert flat != office


async def test_what_became_of_things_outlives_the_service(tmp_path):
    first = begun(tmp_path)
    first.history.note({"room_1": room()}, {}, 5.0)
    first.history.note({"room_1": room(name="den")}, {}, 6.0)
    await first.step(10.0)
    later = Remembering(tmp_path, wall_time=lambda: 1060.0).history.document("room_1")
    assert [(entry["kind"], entry["stamp_s"]) for entry in later["entries"]] == [("known", -65.0), ("name", -64.0)]


async def test_a_history_that_cannot_be_read_is_set_aside_and_begins_anew(tmp_path, caplog):
    first = begun(tmp_path)
    first.history.note({"room_1": room()}, {}, 5.0)
    await first.step(10.0)
    (tmp_path / "history.json").write_text('{"version": 7}')
    later = Remembering(tmp_path, wall_time=lambda: 1060.0)
    assert later.history.document("room_1") is None
    assert (tmp_path / "history.json.broken").read_text() == '{"version": 7}'
    assert "history.json" in caplog.text
    assert [node.id for node in later.memory.building().of_type(RoomNode)] == ["room_1", "room_2", "room_3"]


async def test_a_building_that_is_begun_anew_begins_a_history(tmp_path):
    first = begun(tmp_path)
    first.history.note({"room_1": room()}, {}, 5.0)
    await first.step(10.0)
    later = Remembering(tmp_path, wall_time=lambda: 1060.0, anew=True)
    assert later.history.document("room_1") is None


def room(name=None):
    return {"type": "room", "label": "kitchen", "position_m": [1.0, 2.0, 0.0], "attributes": {"name": name}}
