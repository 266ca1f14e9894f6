"""The building on disk, and what a robot knows that starts from it."""

import pytest

from majordomo.app.remembering import Remembering, building_folder
from majordomo.scene_graph.long_term.long_term_store import LongTermStore
from majordomo.scene_graph.memory import WorkingMemory
from majordomo.scene_graph.nodes import RoomNode
from unit.perception.test_working_set import corridor

pytestmark = pytest.mark.anyio


@pytest.fixture
def anyio_backend():
    return "asyncio"


async def written(folder, wall_s=1000.0):
    remembering = Remembering(folder, wall_time=lambda: wall_s)
    remembering.memory = WorkingMemory(corridor(3), long_term=LongTermStore())
    await remembering.step(50.0)
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
