"""Rooms' poses and sizes found together: what does not fit in a loop of doors goes where it may have come from."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.geometry.planar import Pose2, diagonal_covariance
from perception.memory.dual_doors import back_to_back
from perception.memory.layout_optimization import Passage, PlacedRoom, Wall, door_error, lay_out

HALF_M, THICKNESS_M = 2.0, 0.2
EXACT = PlacedRoom(T_root_room=Pose2.identity(), covariance=diagonal_covariance(1e-3, 1e-3, 1e-3))
AT_DOOR = diagonal_covariance(0.006, 0.012, 0.0026)
SHARP_M = 0.002
EAST, NORTH, WEST, SOUTH = range(4)


@dataclass(kw_only=True)
class Grid:
    """Square rooms in rows and columns, a door in every wall between two; wall 0 lies east, and so on to the left.

    ``wrong_m``: how far out of place each wall was measured, positive into the room.
    """

    rows: int
    columns: int
    wrong_m: dict[Wall, float] = field(default_factory=dict)
    stations_m: dict[Wall, float] = field(default_factory=dict)

    def name(self, row: int, column: int) -> str:
        return f"room_{row * self.columns + column + 1}"

    @property
    def truth(self) -> dict[str, Pose2]:
        step_m = 2.0 * HALF_M + THICKNESS_M
        cells = [(row, column) for row in range(self.rows) for column in range(self.columns)]
        return {self.name(row, column): Pose2(step_m * column, step_m * row, 0.0) for row, column in cells}

    @property
    def passages(self) -> list[Passage]:
        found = []
        for row in range(self.rows):
            for column in range(self.columns):
                here = self.name(row, column)
                if column + 1 < self.columns:
                    found.append(self.passage(here, EAST, self.name(row, column + 1), WEST))
                if row + 1 < self.rows:
                    found.append(self.passage(here, NORTH, self.name(row + 1, column), SOUTH))
        return found

    def passage(self, first: str, wall: int, second: str, other: int) -> Passage:
        return Passage(
            first=first,
            second=second,
            T_first_door=self.face(first, wall),
            T_second_other=self.face(second, other),
            T_door_other=back_to_back(THICKNESS_M),
            covariance=AT_DOOR,
            first_wall=wall,
            second_wall=other,
        )

    def face(self, room: str, wall: int) -> Pose2:
        outward = HALF_M - self.wrong_m.get((room, wall), 0.0)
        station_m = self.stations_m.get((room, wall), 0.0)
        return Pose2(0.0, 0.0, wall * np.pi / 2.0) @ Pose2(outward, station_m, np.pi / 2.0)

    @property
    def walls(self) -> list[Wall]:
        return [wall for passage in self.passages for wall in passage.walls()]


def misfits_mm(placed: dict[str, PlacedRoom], passages: list[Passage]) -> list[float]:
    """How far the two faces of each door are from being opposite each other at the wall's thickness."""
    found = []
    for one in passages:
        first, second = placed[one.first], placed[one.second]
        first_m, second_m = first.wall_shifts_m.get(one.first_wall, 0.0), second.wall_shifts_m.get(one.second_wall, 0.0)
        T_root_door = first.T_root_room @ one.T_first_door @ Pose2(0.0, first_m, 0.0)
        T_root_other = second.T_root_room @ one.T_second_other @ Pose2(0.0, second_m, 0.0)
        found.append(1e3 * (T_root_door @ one.T_door_other).distance_m(T_root_other))
    return found


def off_mm(placed: dict[str, PlacedRoom], truth: dict[str, Pose2]) -> float:
    return 1e3 * max(placed[room].T_root_room.distance_m(pose) for room, pose in truth.items())


def all_shifts_mm(placed: dict[str, PlacedRoom]) -> list[float]:
    return [1e3 * abs(shift_m) for room in placed.values() for shift_m in room.wall_shifts_m.values()]


def test_a_wall_that_is_too_far_out_and_poorly_known_takes_the_correction_and_the_poses_none() -> None:
    grid = Grid(rows=2, columns=2, wrong_m={("room_1", EAST): -0.06})
    rigid = lay_out("room_1", EXACT, grid.truth, grid.passages)
    stds = dict.fromkeys(grid.walls, SHARP_M) | {("room_1", EAST): 0.2}
    placed = lay_out("room_1", EXACT, grid.truth, grid.passages, stds)
    assert placed["room_1"].wall_shifts_m[EAST] == pytest.approx(0.06, abs=0.002)
    assert sorted(all_shifts_mm(placed))[-2] < 0.1
    assert off_mm(placed, grid.truth) < 2.0 < 20.0 < off_mm(rigid, grid.truth)
    assert max(misfits_mm(placed, grid.passages)) < 1.0 < 10.0 < max(misfits_mm(rigid, grid.passages))


def test_walls_that_are_known_equally_well_share_the_correction_with_the_poses() -> None:
    grid = Grid(rows=2, columns=2, wrong_m={("room_1", EAST): -0.02})
    placed = lay_out("room_1", EXACT, grid.truth, grid.passages, dict.fromkeys(grid.walls, 0.01))
    across = [("room_1", EAST), ("room_2", WEST), ("room_3", EAST), ("room_4", WEST)]
    shifts_mm = [1e3 * placed[room].wall_shifts_m[wall] for room, wall in across]
    assert np.abs(shifts_mm) == pytest.approx(np.abs(shifts_mm).mean(), rel=0.05)
    assert shifts_mm[0] > 1.0 > -1.0 > shifts_mm[2]
    rigid = lay_out("room_1", EXACT, grid.truth, grid.passages)
    assert sum(misfits_mm(placed, grid.passages)) < sum(misfits_mm(rigid, grid.passages))


def test_a_correction_is_shared_as_the_variances_are() -> None:
    """The optimum of a linear problem, by hand: each part of a loop takes its variance's share of what is off."""
    grid = Grid(rows=1, columns=2, wrong_m={("room_1", EAST): -0.01})
    apart = Passage(
        first="room_1",
        second="room_2",
        T_first_door=Pose2.identity(),
        T_second_other=Pose2.identity(),
        T_door_other=grid.truth["room_2"],
        covariance=diagonal_covariance(0.006, 0.012, 1e-5),
    )
    stds = {("room_1", EAST): 0.008, ("room_2", WEST): 0.004}
    placed = lay_out("room_1", EXACT, grid.truth, [*grid.passages, apart], stds)
    total = 0.008**2 + 0.004**2 + 0.012**2 + 0.006**2
    assert placed["room_1"].wall_shifts_m[EAST] == pytest.approx(0.01 * 0.008**2 / total, rel=0.01)
    assert placed["room_2"].wall_shifts_m[WEST] == pytest.approx(0.01 * 0.004**2 / total, rel=0.01)


def test_a_building_without_loops_is_laid_out_as_if_walls_were_rigid() -> None:
    grid = Grid(rows=1, columns=6, wrong_m={("room_2", EAST): -0.06}, stations_m={("room_4", WEST): 0.03})
    rigid = lay_out("room_1", EXACT, grid.truth, grid.passages)
    placed = lay_out("room_1", EXACT, grid.truth, grid.passages, dict.fromkeys(grid.walls, 0.05))
    assert all_shifts_mm(placed) == []
    for room, place in rigid.items():
        assert placed[room].T_root_room == place.T_root_room
        assert np.array_equal(placed[room].covariance, place.covariance)


def test_rooms_at_a_dead_end_keep_their_size_when_a_loop_closes_elsewhere() -> None:
    grid = Grid(rows=2, columns=2, wrong_m={("room_1", EAST): -0.03})
    tail = Grid(rows=1, columns=9, wrong_m={("room_8", WEST): -0.03})
    passages = [*grid.passages, tail.passage("room_2", EAST, "room_8", WEST)]
    guesses = grid.truth | {"room_8": Pose2(8.4, 0.0, 0.0)}
    walls = [wall for passage in passages for wall in passage.walls()]
    placed = lay_out("room_1", EXACT, guesses, passages, dict.fromkeys(walls, 0.01))
    assert EAST not in placed["room_2"].wall_shifts_m
    assert placed["room_8"].wall_shifts_m == {}
    assert misfits_mm(placed, passages)[-1] < 1e-3


def test_the_first_room_stays_and_only_its_walls_shift() -> None:
    start = PlacedRoom(T_root_room=Pose2(1.0, -2.0, 0.7), covariance=EXACT.covariance)
    grid = Grid(rows=2, columns=2, wrong_m={("room_1", EAST): -0.06})
    guesses = {room: start.T_root_room @ pose for room, pose in grid.truth.items()}
    placed = lay_out("room_1", start, guesses, grid.passages, dict.fromkeys(grid.walls, 0.02))
    assert placed["room_1"].T_root_room.distance_m(start.T_root_room) < 1e-9
    assert placed["room_1"].T_root_room.yaw_rad == pytest.approx(0.7, abs=1e-9)
    assert placed["room_1"].wall_shifts_m[EAST] > 0.005


def test_laying_out_again_from_what_came_out_changes_nothing() -> None:
    grid = Grid(rows=2, columns=3, wrong_m={("room_1", EAST): -0.06, ("room_5", SOUTH): 0.02})
    stds = dict.fromkeys(grid.walls, 0.01)
    first = lay_out("room_1", EXACT, grid.truth, grid.passages, stds)
    placed = first
    for _ in range(5):
        guesses = {room: place.T_root_room for room, place in placed.items()}
        placed = lay_out("room_1", EXACT, guesses, grid.passages, stds)
    assert off_mm(placed, {room: place.T_root_room for room, place in first.items()}) < 1e-3
    assert all_shifts_mm(placed) == pytest.approx(all_shifts_mm(first), abs=1e-3)


def test_a_door_that_was_mistaken_pulls_less_than_its_error_says() -> None:
    """Huber: forty standard deviations at one door do not spoil the walls of the others."""
    grid = Grid(rows=2, columns=3, stations_m={("room_2", NORTH): 0.3})
    placed = lay_out("room_1", EXACT, grid.truth, grid.passages, dict.fromkeys(grid.walls, SHARP_M))
    assert max(all_shifts_mm(placed)) < 2.0


poses = st.builds(Pose2, st.floats(-5, 5), st.floats(-5, 5), st.floats(-3, 3))


@given(poses, poses, st.floats(-0.1, 0.1), st.floats(-0.1, 0.1))
def test_derivatives_at_a_door_are_those_of_finite_differences(
    one: Pose2, two: Pose2, wall: float, other: float
) -> None:
    passage = Grid(rows=1, columns=2, stations_m={("room_1", EAST): 0.4}).passages[0]
    first, second = one, one @ Pose2(4.2, 0.1, 0.05) @ Pose2(0.1 * two.x_m, 0.1 * two.y_m, 0.1 * two.yaw_rad)
    _, derivatives = door_error(passage, first, second, (wall, other))
    step = 1e-6

    def error(moves: np.ndarray) -> np.ndarray:
        shifts = (wall + moves[6], other + moves[7])
        return door_error(passage, first @ Pose2(*moves[:3]), second @ Pose2(*moves[3:6]), shifts)[0]

    for column, expected in enumerate(np.hstack(derivatives).T):
        move = np.zeros(8)
        move[column] = step
        assert (error(move) - error(-move)) / (2.0 * step) == pytest.approx(expected, abs=1e-5)


@pytest.mark.slow
def test_a_thousand_rooms_full_of_loops_are_laid_out_in_seconds() -> None:
    rng = np.random.default_rng(7)
    empty = Grid(rows=25, columns=40)
    stds = dict.fromkeys(empty.walls, 0.005)
    grid = Grid(rows=25, columns=40, wrong_m={wall: float(rng.normal(0.0, std)) for wall, std in stds.items()})
    guesses = {room: pose @ Pose2(*rng.normal(0.0, 0.02, 3)) for room, pose in grid.truth.items()}
    guesses["room_1"] = Pose2.identity()
    started_s = time.process_time()
    placed = lay_out("room_1", EXACT, guesses, grid.passages, stds)
    assert time.process_time() - started_s < 30.0
    assert len(placed) == 1000
    wrong = np.array([grid.wrong_m[wall] for wall in empty.walls])
    left = np.array([grid.wrong_m[room, wall] + placed[room].wall_shifts_m[wall] for room, wall in empty.walls])
    assert np.std(left) < np.std(wrong)
