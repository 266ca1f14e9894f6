"""What is a thing of its own where another is."""

from dataclasses import replace

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid
from perception.objects.doubles.scripted import ScriptedRoom
from scene_graph.nodes import ObjectNode, ObjectState
from unit.perception.objects.story import BLUE_BOTTLE, TABLE, Story


def test_what_had_no_name_is_gone_once_it_is_seen_as_a_piece_of_a_thing():
    yellow = {"color": (200.0, 180.0, 30.0)}
    corner = Solid(label="unknown", center=(-0.24, 0.0, 0.78), size_m=(0.1, 0.16, 0.06), **yellow)
    rest = Solid(label="book", center=(-0.09, 0.0, 0.78), size_m=(0.2, 0.16, 0.06), **yellow)
    whole = Solid(label="book", center=(-0.14, 0.0, 0.78), size_m=(0.3, 0.16, 0.06), **yellow)
    story = Story([TABLE, corner, rest])
    assert story.run(12).object("unknown_1").state is ObjectState.PRESENT
    story.room.solids = [TABLE, whole]
    graph = story.run(10)
    assert graph.object("unknown_1").state is ObjectState.MISSING
    assert graph.object("book_1").state is ObjectState.PRESENT


@pytest.mark.parametrize(("high_m", "nodes"), [(0.016, 2), (0.1, 3)])
def test_what_has_no_name_is_no_thing_on_a_thing_unless_it_stands_out_from_it(high_m, nodes):
    book = Solid(label="book", center=(-0.14, 0.0, 0.78), size_m=(0.3, 0.16, 0.06), color=(200.0, 180.0, 30.0))
    patch = Solid(label="unknown", center=(-0.14, 0.0, 0.81 + high_m / 2), size_m=(0.1, 0.1, high_m))
    graph = Story([TABLE, book, patch]).run(20)
    assert len(graph.of_type(ObjectNode)) == nodes


@pytest.mark.parametrize(
    ("on_book", "confidence", "places", "found"),
    [(True, 0.95, 1, False), (True, 0.95, 2, True), (False, 0.95, 1, True)],
)
def test_what_has_a_name_is_a_thing_on_a_thing_once_that_is_beyond_doubt_from_two_places(
    on_book, confidence, places, found
):
    book = Solid(label="book", center=(-0.14, 0.0, 0.78), size_m=(0.3, 0.16, 0.06), color=(200.0, 180.0, 30.0))
    center = (-0.14, 0.0, 0.82) if on_book else (0.3, 0.0, 0.76)
    patch = Solid(label="scissors", center=center, size_m=(0.14, 0.08, 0.02), confidence=confidence)
    story = Story([TABLE, book])
    story.run(8)
    story.room.solids.append(patch)
    graph = story.run(8)
    if places > 1:
        story.room.eye = (0.0, -1.3)
        graph = story.run(8)
    assert ("scissors" in [n.label for n in graph.of_type(ObjectNode)]) is found


YELLOW_BOOK = Solid(label="book", center=(-0.14, 0.0, 0.78), size_m=(0.3, 0.16, 0.06), color=(200.0, 180.0, 30.0))


BOOK_END = Solid(label="banana", center=(-0.14, 0.0, 0.82), size_m=(0.14, 0.05, 0.03), confidence=0.95)


def test_what_was_seen_where_a_thing_was_is_not_there_when_that_is_gone():
    story = Story([TABLE, YELLOW_BOOK])
    story.run(8)
    story.room.solids = [TABLE, YELLOW_BOOK, BOOK_END]
    story.run(10)
    story.room.solids = [TABLE]
    graph = story.run(20)
    assert graph.object("book_1").state is ObjectState.MISSING
    assert {node.label for node in graph.of_type(ObjectNode)} == {"book", "table"}


@pytest.mark.parametrize(("places", "state"), [(1, ObjectState.MISSING), (2, ObjectState.PRESENT)])
def test_what_is_missed_is_not_seen_again_in_another_thing_unless_that_is_beyond_doubt(places, state):
    story = Story([TABLE, YELLOW_BOOK, replace(BOOK_END, center=(0.3, 0.0, 0.765))])
    story.run(10)
    story.room.solids = [TABLE, YELLOW_BOOK]
    assert story.run(20).object("banana_1").state is ObjectState.MISSING
    story.room.solids = [TABLE, YELLOW_BOOK, BOOK_END]
    graph = story.run(8)
    if places > 1:
        story.room.eye = (0.0, -1.3)
        graph = story.run(8)
    assert graph.object("banana_1").state is state


@pytest.mark.parametrize(("deep_m", "found"), [(0.012, False), (0.06, True)])
def test_what_is_thin_and_upright_at_the_end_of_a_thing_is_its_side_whatever_it_is_called(deep_m, found):
    book = Solid(label="book", center=(-0.1, 0.0, 0.768), size_m=(0.2, 0.09, 0.036), color=(200.0, 180.0, 30.0))
    end = Solid(label="scissors", center=(-0.2 - deep_m / 2, 0.0, 0.768), size_m=(deep_m, 0.08, 0.036), confidence=0.95)
    story = Story([TABLE, book], eye=(-1.3, 0.3))
    story.run(8)
    story.room.solids.append(end)
    story.run(8)
    story.room.eye = (-1.2, -0.5)
    graph = story.run(8)
    assert ("scissors" in [n.label for n in graph.of_type(ObjectNode)]) is found


def test_what_stays_doubtful_from_one_place_is_a_node_once_it_was_seen_from_another():
    blob = Solid(label="apple", center=(0.1, 0.0, 0.8), size_m=(0.09, 0.09, 0.09), confidence=0.21)
    story = Story([TABLE, blob])
    assert [n.label for n in story.run(20).of_type(ObjectNode)] == ["table"]
    story.room.eye = (0.0, -1.3)
    assert [n.id for n in story.run(8).of_type(ObjectNode)] == ["apple_1", "table_1"]


class SeesDouble(ScriptedRoom):
    """A network that finds a bottle, and its lower part once more."""

    async def infer(self, frame):
        scene = await super().infer(frame)
        whole = next(i for i in scene.instances if i.label == "bottle")
        rows = np.nonzero(whole.mask.any(axis=1))[0]
        lower = whole.mask.copy()
        lower[: rows[len(rows) // 2]] = False
        return replace(scene, instances=(*scene.instances, replace(whole, mask=lower)))


def test_a_bottle_whose_lower_part_the_network_finds_once_more_is_one_bottle():
    story = Story([TABLE, BLUE_BOTTLE])
    story.run(8)
    story.room = SeesDouble([TABLE, BLUE_BOTTLE])
    story.agent._model = story.room
    graph = story.run(8)
    assert [n.id for n in graph.of_type(ObjectNode) if n.label == "bottle"] == ["bottle_1"]
