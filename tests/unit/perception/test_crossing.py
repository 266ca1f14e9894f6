"""Doors as dual objects, the layout of rooms, recognition, and the life cycle tree."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.geometry.planar import Pose2, diagonal_covariance, wrap
from perception.geometry.walls import Walls
from perception.lifecycle import LifeCycle, Verdict
from perception.localization.room_model import RoomModel
from perception.memory.dual_doors import back_to_back, place_in, same_door
from perception.memory.layout_optimization import Passage, PlacedRoom, lay_out
from perception.memory.loop_closure import overlap
from unit.perception.lidar_house import rectangle

angles = st.floats(-3.1, 3.1)
thicknesses = st.floats(0.05, 0.4)
SHARP = diagonal_covariance(0.005, 0.01, 0.002)


def room(room_id: str, width: float, depth: float) -> RoomModel:
    polygon = rectangle(width, depth, x=-width / 2, y=-depth / 2)
    return RoomModel(room_id=room_id, polygon=polygon, walls=Walls.of_polygon(polygon))


@given(thicknesses)
def test_the_two_faces_of_a_door_see_each_other_the_same_way(thickness_m: float) -> None:
    there_and_back = back_to_back(thickness_m) @ back_to_back(thickness_m)
    assert there_and_back.distance_m(Pose2.identity()) < 1e-9
    assert abs(wrap(there_and_back.yaw_rad)) < 1e-9


@given(thicknesses, st.floats(-1.0, 1.0), st.integers(0, 3))
def test_the_far_side_of_a_door_is_placed_in_the_wall_that_faces_it(thickness: float, along: float, wall: int) -> None:
    far = room("room_2", 4.0, 3.0)
    start, end = far.polygon[wall], far.polygon[(wall + 1) % 4]
    yaw = float(np.arctan2(*(end - start)[::-1]))
    middle = (start + end) / 2.0
    T_far_other = Pose2(float(middle[0]), float(middle[1]), yaw) @ Pose2(along, 0.0, 0.0)
    seen = place_in(far, T_far_other @ back_to_back(thickness))
    assert seen is not None
    assert seen.wall == wall
    assert seen.thickness_m == pytest.approx(thickness)
    assert seen.station_m == pytest.approx(along + np.linalg.norm(end - start) / 2.0)


def test_a_door_whose_back_is_nowhere_near_the_room_has_no_place_in_it() -> None:
    assert place_in(room("room_2", 4.0, 3.0), Pose2(0.0, 0.0, 0.0)) is None
    assert place_in(room("room_2", 4.0, 3.0), Pose2(9.0, 0.0, np.pi / 2)) is None


@given(angles, st.floats(-5, 5), st.floats(-5, 5), thicknesses)
def test_two_sides_of_one_gap_are_recognized_in_any_frame(yaw: float, x: float, y: float, thickness: float) -> None:
    first = Pose2(x, y, yaw)
    second = first @ back_to_back(thickness)
    assert same_door(first, second, (0.9, 0.93))
    assert same_door(second, first, (0.9, 0.93))
    assert not same_door(first, second, (0.9, 1.3))
    assert not same_door(first, first @ Pose2(0.5, 0.0, 0.0) @ back_to_back(thickness), (0.9, 0.9))
    assert not same_door(first, first @ Pose2(0.0, thickness, 0.0), (0.9, 0.9))


def square_of_rooms(error: Pose2) -> tuple[dict[str, Pose2], list[Passage]]:
    """Four rooms of 4 m in a square, each joined with the next by a door in the middle of a wall; the last is off."""
    rooms = {"room_1": (0.0, 0.0), "room_2": (4.2, 0.0), "room_3": (4.2, 4.2), "room_4": (0.0, 4.2)}
    truth = {name: Pose2(x, y, 0.0) for name, (x, y) in rooms.items()}
    names = list(truth)
    passages = []
    for first, second in zip(names, [*names[1:], names[0]], strict=True):
        offset = truth[second].position_m - truth[first].position_m
        direction = float(np.arctan2(offset[1], offset[0]))
        T_first_door = Pose2(0.0, 0.0, direction) @ Pose2(2.0, 0.0, np.pi / 2)
        T_second_other = Pose2(0.0, 0.0, direction + np.pi) @ Pose2(2.0, 0.0, np.pi / 2)
        between = back_to_back(0.2) @ (error if second == "room_1" else Pose2.identity())
        passages.append(
            Passage(
                first=first,
                second=second,
                T_first_door=T_first_door,
                T_second_other=T_second_other,
                T_door_other=between,
                covariance=SHARP,
            )
        )
    return truth, passages


ORIGIN = PlacedRoom(T_root_room=Pose2.identity(), covariance=diagonal_covariance(1e-3, 1e-3, 1e-3))


def test_rooms_are_laid_out_exactly_when_all_doors_agree() -> None:
    truth, passages = square_of_rooms(Pose2.identity())
    guesses = {name: pose @ Pose2(0.1, -0.1, 0.05) for name, pose in truth.items()}
    placed = lay_out("room_1", ORIGIN, guesses, passages)
    assert all(placed[name].T_root_room.distance_m(pose) < 1e-4 for name, pose in truth.items())


def test_what_does_not_fit_in_a_loop_is_shared_by_its_doors() -> None:
    truth, passages = square_of_rooms(Pose2(0.02, 0.0, 0.0))
    placed = lay_out("room_1", ORIGIN, truth, passages)
    misfits = [
        (placed[one.first].T_root_room @ one.T_first_second).distance_m(placed[one.second].T_root_room)
        for one in passages
    ]
    assert all(0.001 < misfit < 0.013 for misfit in misfits)
    open_chain = lay_out("room_1", ORIGIN, truth, passages[:-1])
    assert max(open_chain[name].T_root_room.distance_m(pose) for name, pose in truth.items()) < 1e-6


def test_uncertainty_grows_from_door_to_door() -> None:
    truth, passages = square_of_rooms(Pose2.identity())
    placed = lay_out("room_1", ORIGIN, truth, passages[:-1])
    spread = [float(np.trace(placed[name].covariance)) for name in truth]
    assert spread == sorted(spread)


def test_overlap_is_one_for_the_same_place_and_zero_for_neighbors() -> None:
    here = room("room_1", 4.0, 3.0)
    assert overlap(here, here.polygon) == 1.0
    assert overlap(here, here.polygon + np.array([4.2, 0.0])) == 0.0
    assert 0.2 < overlap(here, here.polygon + np.array([2.0, 0.0])) < 0.5


def answers(**verdicts: Verdict) -> LifeCycle:
    stages = {name: (lambda verdict=verdict: verdict) for name, verdict in verdicts.items()}
    return LifeCycle("test", **stages)  # type: ignore[arg-type]


@pytest.mark.parametrize("initialize", list(Verdict))
def test_only_what_is_unexplained_is_initialized_and_the_rest_is_always_asked(initialize: Verdict) -> None:
    explained = answers(explain=Verdict.DONE, initialize=initialize, maintain=Verdict.DONE, affordances=Verdict.DONE)
    explained.tick()
    assert explained.asked == ("explain", "maintain", "affordances")
    surprised = answers(explain=Verdict.NO, initialize=initialize, maintain=Verdict.NO, affordances=Verdict.BUSY)
    for _ in range(2):
        surprised.tick()
        assert surprised.asked == ("explain", "initialize", "maintain", "affordances")
