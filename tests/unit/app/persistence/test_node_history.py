"""What is kept of every node, fed with scenes written by hand."""

from __future__ import annotations

import pytest

from app.persistence.node_history import ENTRIES, HistorySettings, NodeHistory


def thing(at=(1.0, 2.0, 0.8), *, state="present", seen_s=0.0, room="room_1", name="", label="cup"):
    return {
        "type": "object",
        "label": label,
        "room": room,
        "position_m": list(at),
        "state": state,
        "last_seen_s": seen_s,
        "attributes": {"name": name},
    }


def on(support):
    return {"on": {"type": "relation", "label": "on", "source": "cup_1", "target": support, "probability": 0.9}}


def told(history, node="cup_1"):
    return [(entry["kind"], entry["before"], entry["after"]) for entry in history.document(node)["entries"]]


@pytest.fixture
def history():
    history = NodeHistory()
    history.note({"cup_1": thing()}, {}, 0.0)
    return history


def test_what_is_there_at_the_start_was_known_and_what_comes_later_is_found(history):
    history.note({"cup_1": thing(), "cup_2": thing()}, {}, 5.0)
    assert told(history) == [("known", None, [1.0, 2.0, 0.8])]
    assert told(history, "cup_2") == [("found", None, [1.0, 2.0, 0.8])]
    assert history.document("cup_2")["entries"][0]["stamp_s"] == 5.0
    assert history.document("cup_2")["since_s"] == 0.0


def test_better_knowledge_of_a_place_is_no_motion_but_many_small_steps_are(history):
    for step in range(1, 4):
        history.note({"cup_1": thing((1.0 + 0.04 * step, 2.0, 0.8))}, {}, step)
    assert told(history)[1:] == [("moved", [1.0, 2.0, 0.8], [1.12, 2.0, 0.8])]


def test_names_states_rooms_and_supports_are_kept_with_what_they_were(history):
    history.note({"cup_1": thing(name="mine")}, on("table_1"), 1.0)
    history.note({"cup_1": thing(name="mine", state="held")}, {}, 2.0)
    history.note({"cup_1": thing(name="mine", room="room_2")}, on("desk_1"), 3.0)
    assert told(history)[1:] == [
        ("place", None, "on table_1"),
        ("name", None, "mine"),
        ("place", "on table_1", None),
        ("state", "present", "held"),
        ("room", "room_1", "room_2"),
        ("place", None, "on desk_1"),
        ("state", "held", "present"),
    ]


def test_what_is_carried_moves_once_from_where_it_was_to_where_it_is_put(history):
    history.note({"cup_1": thing((4.0, 2.0, 1.0), state="held")}, {}, 1.0)
    history.note({"cup_1": thing((7.0, 2.0, 0.7))}, {}, 2.0)
    assert [entry for entry in told(history) if entry[0] == "moved"] == [("moved", [1.0, 2.0, 0.8], [7.0, 2.0, 0.7])]


def test_a_sight_after_a_long_time_is_noted_at_its_own_time(history):
    history.note({"cup_1": thing(seen_s=50.0)}, {}, 51.0)
    assert len(told(history)) == 1
    history.note({"cup_1": thing(seen_s=130.0)}, {}, 131.0)
    assert history.document("cup_1")["entries"][-1] == {
        "stamp_s": 130.0,
        "kind": "seen_again",
        "before": None,
        "after": None,
    }


def test_only_what_is_said_to_have_changed_is_looked_at_and_that_gives_the_same(history):
    history.note({"cup_1": thing(name="mine"), "cup_2": thing()}, on("table_1"), 1.0, changed={"cup_2"})
    assert len(told(history)) == 1
    history.note({"cup_1": thing(name="mine")}, on("table_1"), 2.0, changed={"cup_1", "cup_2", "wall_9_9"})
    assert told(history)[1:] == [("place", None, "on table_1"), ("name", None, "mine")]
    assert told(history, "cup_2")[-1] == ("gone", None, None)


def test_what_is_gone_is_remembered_and_may_be_found_again(history):
    history.note({}, {}, 1.0)
    history.note({}, {}, 2.0)
    assert told(history)[1:] == [("gone", None, None)]
    history.note({"cup_1": thing()}, {}, 3.0)
    assert told(history)[-1][0] == "found"


def test_of_one_node_the_newest_entries_stay_and_the_rest_is_counted(history):
    for step in range(200):
        history.note({"cup_1": thing(state="missing" if step % 2 else "present", name=str(step))}, {}, step)
    document = history.document("cup_1")
    assert len(document["entries"]) == ENTRIES
    assert document["dropped"] == 1 + 200 + 199 - ENTRIES
    assert document["entries"][-1]["after"] == "199"


def test_of_all_nodes_those_that_are_gone_are_forgotten_first():
    history = NodeHistory(settings=HistorySettings(nodes=3))
    for number in range(10):
        history.note({"cup_1": thing(), f"cup_{number + 2}": thing()}, {}, number)
    assert history.document("cup_1") is not None
    assert history.document("cup_11") is not None
    assert history.document("cup_2") is None


def test_walls_and_unknown_nodes_have_no_history_but_a_node_that_exists_has_an_empty_one(history):
    history.note({"wall_1_0": {"type": "wall"}}, {}, 1.0)
    assert history.document("wall_1_0") is None
    assert history.document("wall_1_0", exists=True)["entries"] == []


def test_what_was_kept_goes_on_by_the_clock_of_the_next_service(history):
    history.note({"cup_1": thing(name="mine", seen_s=9.0)}, on("table_1"), 10.0)
    later = NodeHistory(history.pasts().copied(-100.0))
    later.note({"cup_1": thing(name="mine", seen_s=-91.0)}, on("table_1"), 0.5)
    assert later.document("cup_1") == {
        "node": "cup_1",
        "since_s": -100.0,
        "entries": [{**entry, "stamp_s": entry["stamp_s"] - 100.0} for entry in history.document("cup_1")["entries"]],
        "dropped": 0,
    }


def test_a_service_that_starts_again_notes_what_is_no_longer_as_it_was_kept(history):
    history.note({"cup_1": thing(), "cup_2": thing()}, {}, 1.0)
    later = NodeHistory(history.pasts())
    later.note({"cup_1": thing((3.0, 2.0, 0.8)), "cup_3": thing()}, {}, 5.0, changed={"cup_1", "cup_3"})
    assert told(later)[-1] == ("moved", [1.0, 2.0, 0.8], [3.0, 2.0, 0.8])
    assert told(later, "cup_2")[-1] == ("gone", None, None)
    assert told(later, "cup_3")[-1] == ("known", None, [1.0, 2.0, 0.8])


def test_a_copy_is_not_touched_by_later_notes(history):
    copy = history.pasts()
    history.note({"cup_1": thing(name="mine")}, {}, 1.0)
    assert len(copy.nodes["cup_1"].entries) == 1
    assert copy.nodes["cup_1"].told["name"] is None
