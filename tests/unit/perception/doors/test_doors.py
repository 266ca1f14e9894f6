"""Gaps in walls: what is a door, where exactly, and whether it is open (Concepts, algorithm 2)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
import pytest

from perception.doors.room_evidence import RoomEvidence, Span
from perception.geometry.planar import Pose2
from scene_graph.nodes import DoorState
from unit.perception.lidar_house import Array, Box, Door, House, cast, rectangle

ROOM = rectangle(4.0, 3.0)
RIGHT_WALL, TOP_WALL = 1, 2


def two_rooms(thickness_m: float = 0.2, *, width: float = 0.9, center_m: float = 1.3, **more: object) -> House:
    return House(
        rooms={"a": ROOM, "b": rectangle(5.0, 3.0, x=4.0 + thickness_m)},
        doors=[Door(rooms=("a", "b"), center=(4.0 + thickness_m / 2, center_m), width=width)],
        wall_thickness=thickness_m,
        **more,  # type: ignore[arg-type]
    )


def evidence_from(house: House, poses: Iterable[Pose2], seed: int = 0, pose_error_m: float = 0.004) -> RoomEvidence:
    rng, evidence = np.random.default_rng(seed), RoomEvidence(ROOM)
    for pose in poses:
        error = rng.normal(0.0, pose_error_m, 2)
        believed = Pose2(pose.x_m + error[0], pose.y_m + error[1], pose.yaw_rad + rng.normal(0.0, 0.0008))
        evidence.add(cast(house, pose, rng), believed)
    return evidence


def way_to_the_door() -> list[Pose2]:
    return [Pose2(1.0 + 0.07 * k, 1.0 + 0.01 * k, 0.3 + 0.02 * k) for k in range(30)]


@pytest.mark.parametrize("thickness_m", [0.05, 0.2, 0.4])
@pytest.mark.parametrize("width", [0.7, 0.9, 1.2])
@pytest.mark.parametrize("seed", range(2))
def test_a_door_is_measured_within_eight_millimeters(thickness_m: float, width: float, seed: int) -> None:
    evidence = evidence_from(two_rooms(thickness_m, width=width), way_to_the_door(), seed)
    gaps = [(wall, gap) for wall in range(4) for gap in evidence.gaps(wall)]
    assert [wall for wall, _ in gaps] == [RIGHT_WALL]
    measured = evidence.measure(*gaps[0])
    assert measured.posts == 2
    assert measured.center_m == pytest.approx(1.3, abs=0.008)
    assert measured.width_m == pytest.approx(width, abs=0.008)


def test_a_post_close_to_a_corner_is_not_drawn_to_what_is_behind_the_door() -> None:
    evidence = evidence_from(
        two_rooms(0.05, width=0.84, center_m=0.59), [Pose2(3.0, 0.7 + 0.01 * k, 0.0) for k in range(20)]
    )
    measured = evidence.measure(RIGHT_WALL, evidence.gaps(RIGHT_WALL)[0])
    assert measured.width_m == pytest.approx(0.84, abs=0.012)


@pytest.mark.parametrize("x_m", [3.0, 3.25, 3.5, 3.65])
def test_posts_that_count_as_measured_are_where_they_are_however_the_door_was_glanced_at(x_m: float) -> None:
    house, told = two_rooms(0.19, width=1.06, center_m=1.3), 0
    for y_m in np.arange(0.3, 2.8, 0.1):
        evidence = evidence_from(house, [Pose2(x_m, float(y_m), 0.5)] * 6, pose_error_m=0.0)
        for gap in evidence.gaps(RIGHT_WALL):
            measured = evidence.measure(RIGHT_WALL, gap)
            if measured.posts == 2:
                told += 1
                assert measured.center_m == pytest.approx(1.3, abs=0.015)
                assert measured.width_m == pytest.approx(1.06, abs=0.02)
    assert told > 0


@pytest.mark.parametrize("covered_m", [0.3, 0.45, 0.7])
@pytest.mark.parametrize("thickness_m", [0.2, 0.3])
def test_a_door_half_hidden_by_furniture_right_behind_it_is_as_wide_as_it_is(
    thickness_m: float, covered_m: float
) -> None:
    box = Box(center=(4.14 + thickness_m, 1.3 + 0.65 - covered_m / 2 + 0.1), size=(0.2, covered_m + 0.2, 1.9))
    evidence = evidence_from(two_rooms(thickness_m, width=1.3, boxes=[box]), way_to_the_door())
    measured = evidence.measure(RIGHT_WALL, evidence.gaps(RIGHT_WALL)[0])
    assert measured.posts == 2
    assert measured.center_m == pytest.approx(1.3, abs=0.008)
    assert measured.width_m == pytest.approx(1.3, abs=0.008)


@pytest.mark.parametrize("x_m", [3.2, 3.3])
def test_a_reveal_that_is_only_seen_aslant_is_not_taken_for_the_wall_beside_the_door(x_m: float) -> None:
    box = Box(center=(4.34, 2.135), size=(0.2, 0.65, 1.9))
    house = two_rooms(0.2, width=1.32, center_m=1.6, boxes=[box])
    evidence = evidence_from(house, [Pose2(x_m + 0.002 * k, 0.25 + 0.02 * k, 0.3) for k in range(25)])
    measured = evidence.measure(RIGHT_WALL, evidence.gaps(RIGHT_WALL)[0])
    assert measured.posts == 2
    assert measured.width_m == pytest.approx(1.32, abs=0.01)


def test_two_doors_in_one_wall_are_two() -> None:
    house = two_rooms(0.2, width=0.7, center_m=0.7)
    house.doors.append(replace(house.doors[0], center=(4.1, 2.2)))
    evidence = evidence_from(house, way_to_the_door())
    assert len(evidence.gaps(RIGHT_WALL)) == 2


def test_furniture_in_front_of_a_wall_is_no_door() -> None:
    boxes = [Box(center=(3.6, 2.4), size=(0.5, 0.8, 1.9)), Box(center=(1.5, 0.4), size=(0.9, 0.5, 0.8))]
    evidence = evidence_from(House(rooms={"a": ROOM}, boxes=boxes), way_to_the_door())
    assert [gap for wall in range(4) for gap in evidence.gaps(wall)] == []
    assert [gap for wall in range(4) for gap in evidence.unseen(wall)] == []


class Window(House):
    """The door is walled up to breast height: one can see through, but not walk."""

    def faces(self) -> Array:
        faces = super().faces()
        door = self.doors[0]
        sill = [4.0, door.center[1] - door.width / 2, 4.0, door.center[1] + door.width / 2, 0.0, 0.9]
        return np.vstack([faces, sill])


def test_a_window_with_a_sill_is_no_door() -> None:
    house = two_rooms()
    window = Window(rooms=house.rooms, doors=house.doors)
    assert evidence_from(window, way_to_the_door()).gaps(RIGHT_WALL) == []


def test_a_stretch_of_wall_that_was_never_seen_could_hide_a_door_until_it_was_checked() -> None:
    boxes = [Box(center=(2.2, 1.2), size=(0.3, 1.6, 1.95))]
    evidence = evidence_from(House(rooms={"a": ROOM}, boxes=boxes), [Pose2(1.0, 1.2, 0.0)] * 5)
    hidden = evidence.unseen(RIGHT_WALL)
    assert len(hidden) == 1
    evidence.checked.append((RIGHT_WALL, hidden[0].center_m))
    assert evidence.unseen(RIGHT_WALL) == []


def test_behind_the_robot_s_own_mast_no_door_appears() -> None:
    rng, evidence = np.random.default_rng(0), RoomEvidence(ROOM)
    for k in range(10):
        pose = Pose2(3.1, 1.0 + 0.05 * k, np.pi)
        scan = cast(House(rooms={"a": ROOM}), pose, rng)
        hidden = (scan.elevations_rad[:, None] < -0.6) & (np.abs(scan.azimuths_rad) > np.pi - 0.7)
        evidence.add(replace(scan, ranges_m=np.where(hidden, np.float32(np.inf), scan.ranges_m)), pose)
    assert evidence.gaps(RIGHT_WALL) == []


@pytest.mark.parametrize("thickness_m", [0.1, 0.4])
def test_a_panel_in_the_gap_is_seen_and_so_is_its_opening(thickness_m: float) -> None:
    open_house = two_rooms(thickness_m)
    closed_house = replace(open_house, doors=[replace(open_house.doors[0], open=False)])
    span, rng, pose = Span(center_m=1.3, width_m=0.9), np.random.default_rng(0), Pose2(2.5, 1.4, 0.2)
    evidence = evidence_from(open_house, way_to_the_door())
    assert evidence.looks_open(RIGHT_WALL, span) is True
    evidence.add(cast(closed_house, pose, rng), pose)
    assert evidence.looks_open(RIGHT_WALL, span) is False
    evidence.add(cast(open_house, pose, rng), pose)
    assert evidence.looks_open(RIGHT_WALL, span) is True


@pytest.mark.parametrize("thickness_m", [0.05, 0.1, 0.19, 0.4])
@pytest.mark.parametrize("width", [0.7, 0.9, 1.2])
@pytest.mark.parametrize("seed", range(2))
def test_a_door_that_was_closed_from_the_first_is_told_from_wall_by_its_recessed_leaf(
    thickness_m: float, width: float, seed: int
) -> None:
    house = two_rooms(thickness_m, width=width)
    house.doors[0] = replace(house.doors[0], open=False)
    evidence = evidence_from(house, way_to_the_door(), seed)
    found = [(wall, gap) for wall in range(4) for gap in (*evidence.gaps(wall), *evidence.recesses(wall))]
    assert [(wall, gap.state) for wall, gap in found] == [(RIGHT_WALL, DoorState.CLOSED)]
    measured = evidence.measure(*found[0])
    assert measured.center_m == pytest.approx(1.3, abs=0.02)
    assert measured.width_m == pytest.approx(width, abs=0.03)


def test_a_closed_door_that_opens_is_an_open_door_where_it_was() -> None:
    open_house = two_rooms()
    closed_house = replace(open_house, doors=[replace(open_house.doors[0], open=False)])
    evidence, rng = evidence_from(closed_house, way_to_the_door()), np.random.default_rng(1)
    for pose in [*way_to_the_door(), *reversed(way_to_the_door())] * 2:
        evidence.add(cast(open_house, pose, rng), pose)
    assert [gap.center_m for gap in evidence.gaps(RIGHT_WALL)] == [pytest.approx(1.3, abs=0.05)]
    assert evidence.recesses(RIGHT_WALL) == []


class Niche(House):
    """The closed door's recess goes up to the ceiling."""

    def faces(self) -> Array:
        faces = super().faces()
        faces[:, 5] = np.where(faces[:, 5] == self.doors[0].height, self.height, faces[:, 5])
        return np.asarray(faces[faces[:, 4] == 0.0])


def test_a_niche_as_high_as_the_wall_is_no_closed_door() -> None:
    house = two_rooms()
    niche = Niche(rooms=house.rooms, doors=[replace(house.doors[0], open=False)])
    assert evidence_from(niche, way_to_the_door()).recesses(RIGHT_WALL) == []


@pytest.mark.parametrize("sigma_m", [0.02, 0.05])
@pytest.mark.parametrize("seed", range(4))
def test_plain_walls_with_furniture_before_them_have_no_closed_doors(sigma_m: float, seed: int) -> None:
    boxes = [Box(center=(3.7, 2.4), size=(0.5, 0.8, 1.9)), Box(center=(1.5, 0.3), size=(0.9, 0.5, 0.8))]
    house, rng, evidence = House(rooms={"a": ROOM}, boxes=boxes), np.random.default_rng(seed), RoomEvidence(ROOM)
    for pose in way_to_the_door():
        error = rng.normal(0.0, 0.006, 2)
        evidence.add(cast(house, pose, rng, sigma_m=sigma_m), pose @ Pose2(error[0], error[1], rng.normal(0.0, 0.001)))
    assert [gap for wall in range(4) for gap in evidence.recesses(wall)] == []


def test_a_door_out_of_sight_is_neither_open_nor_closed() -> None:
    evidence = evidence_from(two_rooms(), [Pose2(3.7, 2.8, 0.0)])
    assert evidence.looks_open(RIGHT_WALL, Span(center_m=1.3, width_m=0.9)) is None
