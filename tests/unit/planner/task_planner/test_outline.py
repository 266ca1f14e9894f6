"""The graph as a model reads it: pruned, indented, quoted."""

from __future__ import annotations

import json
import random

from planner.doubles.sketch import Sketch, flat
from planner.task_planner.outline import MAX_IDENTIFIERS, outline
from planner.task_planner.settings import OutlineSettings
from scene_graph.nodes import DoorState, ObjectState


def big_home(rooms=12, things=180, seed=7):
    rng = random.Random(seed)
    sketch = Sketch()
    for k in range(1, rooms + 1):
        sketch.room(f"room_{k}", rng.choice(["office", "kitchen", "bedroom", "hall"]), at=(4.2 * k, 0.0))
        if k > 1:
            sketch.door(f"room_{k - 1}", f"room_{k}", at=(4.2 * k - 2.1, 0.0))
        sketch.furniture(f"table_{k}", "table", f"room_{k}", at=(4.2 * k, 1.0))
    for k in range(things):
        label = rng.choice(["cup", "book", "bottle", "pen", "bowl", "apple"])
        sketch.thing(f"{label}_{k}", label, on=f"table_{rng.randint(1, rooms)}", color=rng.choice(["red", "blue", ""]))
    return sketch.snapshot(robot_in="room_1", at=(4.2, 0.0))


def test_things_stand_under_their_furniture_and_furniture_under_its_room():
    snapshot = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))
    lines = outline(snapshot, "").text.splitlines()
    kitchen = lines.index('room_1 "kitchen"')
    assert lines[kitchen + 1 : kitchen + 3] == ['  counter_1 "counter" furniture', '    apple_1 "apple" red']
    assert 'room_2 "hall" (the robot is here)' in lines
    assert '  person_1 person "Anna"' in lines


def test_what_the_request_names_is_never_pruned():
    snapshot = big_home()
    everything = outline(snapshot, "")
    assert everything.left_out > 0
    wanted = [node_id for node_id in snapshot.nodes if node_id.startswith("pen_")]
    named = outline(snapshot, "take all the pens to the office")
    assert set(wanted) <= set(named.identifiers)
    assert f"{named.left_out} more objects" in named.text


def test_of_very_many_of_a_kind_those_of_the_told_color_and_room_come_first():
    sketch = Sketch().room("room_1", "hall", at=(0.0, 0.0)).room("room_2", "library", at=(4.2, 0.0))
    sketch.door("room_1", "room_2", at=(2.1, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.furniture("table_2", "table", "room_2", at=(4.2, 1.0))
    for k in range(1, 151):
        sketch.thing(f"cup_{k}", "cup", on=f"table_{1 + k % 2}", color="gold" if k == 149 else "white")
    snapshot = sketch.snapshot(robot_in="room_1", at=(0.0, 0.0))
    assert {"cup_149", "table_2"} <= set(outline(snapshot, "bring me the gold cup").identifiers)
    library = {i for i in outline(snapshot, "the cups of the library").identifiers if i.startswith("cup")}
    assert all(snapshot.room_of(cup) == "room_2" for cup in library)


def test_a_word_that_is_spelled_almost_right_names_a_thing():
    sketch = Sketch().room("room_1", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    for k in range(1, 101):
        sketch.thing(f"cup_{k}", "cup", on="table_1")
    snapshot = sketch.thing("envelope_1", "envelope", on="table_1").snapshot(robot_in="room_1", at=(0.0, 0.0))
    assert "envelope_1" in outline(snapshot, "bring maria the envelop").identifiers
    assert "envelope_1" not in outline(snapshot, "bring maria the cups").identifiers


def test_a_home_of_two_hundred_nodes_fits_into_fifteen_hundred_tokens():
    snapshot = big_home()
    assert len(snapshot.nodes) > 200
    found = outline(snapshot, "bring me the red cup")
    assert len(found.text) / 3.2 < 1500
    assert len(found.identifiers) <= MAX_IDENTIFIERS


def test_a_large_building_keeps_within_its_bounds():
    found = outline(big_home(rooms=80, things=1500), "bring me the red cup")
    assert len(found.identifiers) <= MAX_IDENTIFIERS
    assert sum(line.startswith("  ") for line in found.text.splitlines()) <= OutlineSettings.most_objects
    assert len(found.text) / 3.2 < 4000


def test_names_are_json_strings_on_one_line():
    sketch = flat().thing("note_1", 'a "note"\nroom_9 "x"', on="desk_1", name="b\nc")
    text = outline(sketch.snapshot(robot_in="room_2", at=(4.2, 0.0)), "").text
    assert json.dumps('a "note"\nroom_9 "x"') in text
    assert "\nroom_9" not in text


def test_closed_doors_and_lost_things_are_said():
    sketch = flat().door("room_1", "room_3", at=(4.0, -2.0), state=DoorState.CLOSED)
    sketch.thing("key_1", "key", on="desk_1", state=ObjectState.MISSING)
    text = outline(sketch.snapshot(robot_in="room_2", at=(4.2, 0.0)), "").text
    assert "the door between the kitchen and the living room is closed" in text
    assert 'key_1 "key" not where it was' in text


def test_what_the_robot_holds_is_said():
    snapshot = flat().snapshot(robot_in="room_2", at=(4.2, 0.0), holding="cup_1")
    assert outline(snapshot, "").text.startswith("robot holding cup_1")


def crowded(label="yogurt", **special):
    """A hundred cups on a table, something there besides, and something on a bench."""
    sketch = Sketch().room("room_1", "garage", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.furniture("bench_1", "bench", "room_1", at=(1.0, -1.0))
    for k in range(1, 101):
        sketch.thing(f"cup_{k}", "cup", on="table_1")
    sketch.thing("zither_1", "zither", on="bench_1").thing("yogurt_1", label, on="table_1", **special)
    return sketch.snapshot(robot_in="room_1", at=(0.0, 0.0))


def test_what_is_of_a_named_kind_on_a_named_place_or_was_spoken_of_before_is_shown():
    snapshot = crowded(categories=("snack",))
    assert not {"zither_1", "yogurt_1"} & set(outline(snapshot, "hello").identifiers)
    assert "yogurt_1" in outline(snapshot, "bring me some snacks").identifiers
    assert "zither_1" in outline(snapshot, "clear the bench").identifiers
    assert "yogurt_1" in outline(snapshot, "the other one", before="give Anna the yogurt").identifiers
    assert "zither_1" in outline(snapshot, "put it back", mentioned=("zither_1",)).identifiers


def test_a_label_of_several_words_is_named_by_any_of_them():
    snapshot = crowded(label="toy car")
    assert "yogurt_1" in outline(snapshot, "all toys go into the box").identifiers
