"""Furniture that is seen from several sides, or in rows."""

from dataclasses import replace

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid
from perception.objects.doubles.scripted import ScriptedRoom
from scene_graph.nodes import ObjectNode
from unit.perception.objects.story import TABLE, Story


def test_a_cupboard_first_seen_from_two_sides_is_one_cupboard():
    fridge = Solid(label="fridge", center=(0.0, 0.0, 0.9), size_m=(0.65, 0.65, 1.8), color=(220.0, 220.0, 220.0))
    story = Story([fridge], eye=(-2.2, 0.0), target=(0.0, 0.0, 0.9))
    story.run(5)
    story.room.eye = (0.0, 2.2)
    story.run(5)
    story.room.eye = (1.6, -1.6)
    graph = story.run(6)
    assert [n.id for n in graph.of_type(ObjectNode)] == ["fridge_1"]
    assert np.linalg.norm(graph.position("fridge_1", "room_1")[:2]) < 0.05


def test_a_fragment_that_became_a_node_is_taken_back_into_the_older_node():
    table = replace(TABLE, size_m=(2.4, 0.8, 0.75))
    screen = Solid(label="wall", center=(-0.5, -1.2, 0.6), size_m=(0.6, 0.05, 1.2))
    story = Story([table, screen], eye=(-1.2, -2.6), target=(0.9, 0.0, 0.6))
    story.run(4)
    story.room.target = (-1.2, 0.0, 0.6)
    story.run(4)
    story.room.solids = [table]
    story.room.eye, story.room.target = (0.0, -2.8), (0.0, 0.0, 0.6)
    graph = story.run(6)
    assert [n.label for n in graph.of_type(ObjectNode)] == ["table"]
    assert graph.object("table_1").size_m[0] == pytest.approx(2.4, abs=0.15)


class TakesRowForOne(ScriptedRoom):
    """A network to which a counter and the stove in its row are one counter."""

    async def infer(self, frame):
        scene = await super().infer(frame)
        masks = [instance.mask for instance in scene.instances]
        row = replace(
            scene.instances[0],
            label="counter",
            label_distribution=(("counter", 0.97),),
            mask=np.logical_or.reduce(masks),
        )
        return replace(scene, instances=(row,))


@pytest.mark.parametrize("kind", ["stove", "fridge"])
def test_an_appliance_in_a_row_of_counters_stays_itself_when_they_are_seen_as_one(kind):
    height_m = 0.9 if kind == "stove" else 1.8
    counter = Solid(label="counter", center=(-0.7, 2.6, 0.45), size_m=(1.4, 0.6, 0.9), color=(130.0, 130.0, 130.0))
    beside = Solid(label=kind, center=(0.35, 2.6, height_m / 2), size_m=(0.6, 0.6, height_m), color=(60.0, 60.0, 60.0))
    story = Story([counter, beside], eye=(-0.2, 0.2), target=(-0.2, 2.5, 0.6))
    story.run(15)
    story.room = TakesRowForOne([counter, beside], eye=(1.2, 0.4), target=(0.0, 2.5, 0.6))
    story.agent._model = story.room
    graph = story.run(40)
    lengths_m = {node.label: max(node.size_m[:2]) for node in graph.of_type(ObjectNode)}
    assert lengths_m == {"counter": pytest.approx(1.4, abs=0.15), kind: pytest.approx(0.6, abs=0.1)}


def test_an_appliance_in_a_row_that_seemed_to_be_one_is_found_from_near():
    counter = Solid(label="counter", center=(-0.7, 2.6, 0.45), size_m=(1.4, 0.6, 0.9), color=(130.0, 130.0, 130.0))
    stove = Solid(label="stove", center=(0.35, 2.6, 0.45), size_m=(0.6, 0.6, 0.9), color=(60.0, 60.0, 60.0))
    story = Story([counter, stove], eye=(-0.2, 0.2), target=(-0.2, 2.5, 0.6))
    story.room = TakesRowForOne([counter, stove], eye=(-0.2, 0.2), target=(-0.2, 2.5, 0.6))
    story.agent._model = story.room
    assert [node.label for node in story.run(15).of_type(ObjectNode)] == ["counter"]
    story.room = ScriptedRoom([counter, stove], eye=(0.35, 1.5), target=(0.35, 2.6, 0.9))
    story.agent._model = story.room
    graph = story.run(12)
    assert sorted(node.label for node in graph.of_type(ObjectNode)) == ["counter", "stove"]
    story.room = ScriptedRoom([counter, stove], eye=(-0.2, 0.2), target=(-0.2, 2.5, 0.6))
    story.agent._model = story.room
    graph = story.run(60)
    lengths_m = {node.label: max(node.size_m[:2]) for node in graph.of_type(ObjectNode)}
    assert lengths_m == {"counter": pytest.approx(1.4, abs=0.15), "stove": pytest.approx(0.6, abs=0.1)}
