"""The metric layout shows rooms with their walls shifted; the graph keeps them as they were measured."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from scene_graph.checks.invariants import check
from scene_graph.documents.interchange import from_json, to_json
from scene_graph.edges import EdgeKey, EdgeType
from scene_graph.errors import InvariantBroken
from scene_graph.long_term.records import edge_record, read_edge
from scene_graph.queries.laid_out import inward_normals, laid_out, shifted_polygon

RECTANGLE = np.array([[-3.0, -2.0], [3.0, -2.0], [3.0, 2.0], [-3.0, 2.0]])
SLANTED = np.array([[0.0, 0.0], [4.0, -1.0], [6.0, 2.0], [2.0, 5.0], [-1.0, 3.0]])
EAST_M = 0.05
"""How far the layout takes the east wall of the kitchen into the room."""

shifts = st.lists(st.floats(-0.1, 0.1), min_size=5, max_size=5)


@pytest.fixture
def shifted(memory):
    place = memory.snapshot().parent("room_1")
    with memory.edit("layout", 11.0) as tx:
        tx.put(replace(place, wall_shifts_m=(0.0, EAST_M, 0.0, 0.0)))
    return memory.snapshot()


def by_id(document):
    return {node["id"]: node for node in document["nodes"]}


@given(shifts)
def test_every_wall_goes_along_its_normal_by_its_shift_and_none_turns(shift_m):
    moved = shifted_polygon(SLANTED, np.array(shift_m))
    normals = inward_normals(SLANTED)
    assert inward_normals(moved) == pytest.approx(normals)
    assert ((moved - SLANTED) * normals).sum(axis=1) == pytest.approx(np.array(shift_m), abs=1e-9)


def test_a_wall_shifted_inward_makes_a_rectangle_smaller():
    assert np.ptp(shifted_polygon(RECTANGLE, np.array([0.0, 0.5, 0.0, 0.0])), axis=0) == pytest.approx([5.5, 4.0])


def test_a_corner_between_walls_that_go_almost_straight_on_does_not_run_away():
    bent = np.array([[0.0, 0.0], [2.0, -0.01], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]])
    moved = shifted_polygon(bent, np.array([0.02, -0.02, 0.0, 0.0, 0.0]))
    assert np.abs(moved - bent).max() < 0.03


def test_in_the_map_a_shifted_wall_takes_its_corners_and_doors_along(house, shifted):
    measured, shown = by_id(to_json(house)), by_id(to_json(shifted))
    before, after = np.array(measured["room_1"]["polygon_m"]), np.array(shown["room_1"]["polygon_m"])
    assert after - before == pytest.approx(np.array([[0, 0], [-EAST_M, 0], [-EAST_M, 0], [0, 0]]), abs=1e-6)
    for node_id, part in (("wall_1_1", 1.0), ("corner_1_1", 1.0), ("door_1_1_0", 0.5)):
        moved = np.array(shown[node_id]["position_m"]) - measured[node_id]["position_m"]
        assert moved == pytest.approx([-EAST_M * part, 0.0, 0.0], abs=1e-6)
    assert shown["wall_1_1"]["offset_m"] == pytest.approx(-2.0 + EAST_M)
    assert shown["wall_1_1"]["length_m"] == pytest.approx(4.0)
    for same in ("room_2", "wall_2_0", "table_1", "robot"):
        assert shown[same] == measured[same]


def test_a_door_keeps_its_station_when_its_wall_s_ends_move(memory):
    place = memory.snapshot().parent("room_1")
    before = memory.snapshot().position("door_1_1_0", "root")
    with memory.edit("layout", 11.0) as tx:
        tx.put(replace(place, wall_shifts_m=(0.3, 0.0, 0.0, 0.0)))
    after = laid_out(memory.snapshot())
    assert after.position("door_1_1_0", "root") == pytest.approx(before)
    assert after.wall("wall_1_1").length_m == pytest.approx(3.7)
    assert after.position("corner_1_1", "room_1") == pytest.approx([2.0, -1.7, 0.0])
    assert check(after) == ()


def test_the_graph_and_its_room_frames_keep_what_was_measured(house, shifted):
    assert to_json(shifted, frame="room")["nodes"] == to_json(house, frame="room")["nodes"]
    assert shifted.room("room_1") == house.room("room_1")


def test_where_nothing_is_shifted_the_layout_is_the_graph_itself(house):
    assert laid_out(house) is house


def test_shifts_that_do_not_belong_to_the_outline_or_turn_walls_around_are_left_alone(memory):
    for wrong in ((0.1,), (0.0, 3.0, 0.0, 3.0)):
        with memory.edit("layout", 11.0) as tx:
            tx.put(replace(memory.snapshot().parent("room_1"), wall_shifts_m=wrong))
        assert laid_out(memory.snapshot()) is memory.snapshot()


def test_reading_a_document_of_a_shifted_building_gives_the_room_as_shown(shifted):
    document = to_json(shifted)
    again = from_json(json.loads(json.dumps(document)))
    assert to_json(again) == document
    assert again.parent("room_1").wall_shifts_m == ()


def test_shifts_are_stored_without_loss_and_must_be_finite(memory, shifted):
    edge = shifted.edge(EdgeKey(EdgeType.RT, "root", "room_1"))
    assert read_edge(json.loads(json.dumps(edge_record(edge))), "edge") == edge
    assert "wall_shifts_m" not in edge_record(shifted.parent("room_2"))
    with pytest.raises(InvariantBroken), memory.edit("layout", 12.0) as tx:
        tx.put(replace(edge, wall_shifts_m=(float("nan"),) * 4))


def test_a_door_is_where_the_side_that_was_measured_better_has_it(memory):
    edge = memory.snapshot().parent("door_1_1_0")
    along = edge.T_source_target.translation_m + np.array([0.2, 0.0, 0.0])
    vague, sharp = np.eye(6) * 0.03**2, np.eye(6) * 0.01**2
    with memory.edit("door", 11.0) as tx:
        tx.put(replace(edge, T_source_target=type(edge.T_source_target)((1, 0, 0, 0), along), covariance=vague))
        tx.put(replace(memory.snapshot().parent("door_2_0_0"), covariance=sharp))
    snapshot = memory.snapshot()
    first, second = (snapshot.position(door_id, "root") for door_id in ("door_1_1_0", "door_2_0_0"))
    shown = by_id(to_json(snapshot))["door_1_1_0"]["position_m"]
    assert shown[1] == pytest.approx(first[1] + 0.9 * (second[1] - first[1]), abs=1e-5)
    assert shown[0] == pytest.approx((first[0] + second[0]) / 2.0, abs=1e-5)
