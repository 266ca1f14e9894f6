"""Heights of boards, from depth images of an analytic shelf."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid, look_at, render, rgbd_frame
from perception.objects.furniture.levels import LevelMemory, level_surfaces
from perception.objects.furniture.surface import Box
from perception.objects.seeing.projection import View
from perception.objects.tracking.track import Track, TrackSettings
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode

SIZE_M = (0.9, 0.35, 1.6)
BOARDS_M = (0.4, 0.8, 1.2)
BOX = Box(np.array((0.0, 0.0, 0.8)), SIZE_M, 0.0)


def shelf(boards_m=BOARDS_M):
    """Boards between two sides, before a back; its front toward -y."""
    tops = (*boards_m, SIZE_M[2])
    boards = [Solid(label="shelf", center=(0.0, 0.0, h - 0.0125), size_m=(0.85, 0.34, 0.025)) for h in tops]
    sides = [Solid(label="shelf", center=(s * 0.4375, 0.0, 0.8), size_m=(0.025, 0.35, 1.6)) for s in (-1, 1)]
    return [*boards, *sides, Solid(label="shelf", center=(0.0, 0.17, 0.8), size_m=(0.85, 0.01, 1.6))]


def seen(eye, solids, *, random, of="shelf", T_room_view=None):
    """The mask of what is called ``of``, and the view, from an eye at the camera's height."""
    T_room_camera = look_at((*eye, 1.4), (0.0, 0.0, 0.7))
    rendering = render(solids, T_room_camera)
    frame = rgbd_frame(rendering, stamp_s=1.0, T_base_camera=T_room_camera, random=random)
    view = View.of(frame, room="room_1", T_room_base=SE3.identity(), pose_covariance=np.zeros((6, 6)))
    mine = [k for k, solid in enumerate(solids) if solid.label == of]
    return np.isin(rendering.ids, mine), view


EYES = [(0.0, -1.2), (0.6, -1.4), (-0.8, -1.8), (0.0, -2.2)]


def memory_of(solids, eyes=EYES, seed=0):
    random = np.random.default_rng(seed)
    memory = LevelMemory()
    for eye in eyes:
        memory.observe(*seen(eye, solids, random=random), SE3.identity(), BOX)
    return memory


def test_the_boards_of_a_shelf_are_measured_to_a_few_millimeters():
    assert memory_of(shelf()).heights_m == pytest.approx(BOARDS_M, abs=0.005)


def test_boards_at_other_heights_are_found_where_they_are():
    assert memory_of(shelf((0.3, 0.62, 1.1))).heights_m == pytest.approx((0.3, 0.62, 1.1), abs=0.005)


def test_a_closed_front_has_no_boards():
    front = Solid(label="shelf", center=(0.0, 0.0, 0.8), size_m=SIZE_M)
    assert memory_of([front]).heights_m == ()


def test_what_was_seen_once_or_twice_is_not_believed_yet():
    assert memory_of(shelf(), EYES[:2]).heights_m == ()


def test_the_tops_of_things_that_the_mask_takes_in_are_no_boards():
    books = [Solid(label="shelf", center=(-0.2, -0.05, 0.9), size_m=(0.15, 0.2, 0.2))]
    assert memory_of([*shelf(), *books]).heights_m == pytest.approx(BOARDS_M, abs=0.005)


def test_a_shelf_seen_from_another_room_is_measured_in_its_own():
    random = np.random.default_rng(1)
    mask, view = seen(EYES[0], shelf(), random=random)
    T_room_view = SE3.from_xyz_yaw(3.0, -1.0, 0.0, pi / 2)
    box = Box(T_room_view.apply(BOX.center), SIZE_M, pi / 2)
    found = [level.height_m for level in level_surfaces(mask, view, T_room_view, box)]
    assert found == pytest.approx(BOARDS_M, abs=0.008)


def test_boards_that_were_known_before_a_restart_are_known_after_it():
    node = ObjectNode(id="shelf_1", label="shelf", size_m=SIZE_M, surfaces_m=BOARDS_M, observations=20)
    track = Track(1, "room_1", settings=TrackSettings(), random=np.random.default_rng(0))
    track.adopt(node, SE3.from_xyz_yaw(1.0, 2.0, 0.8, 0.3), np.eye(3) * 1e-4)
    assert track.surfaces_m == pytest.approx(BOARDS_M)
    track.change_room("room_2", SE3.from_xyz_yaw(3.0, 0.0, 0.0, 1.0))
    assert track.surfaces_m == pytest.approx(BOARDS_M)
    track.put_at("room_2", np.array((1.0, 1.0, 1.0)), 0.05)
    assert track.surfaces_m == pytest.approx(BOARDS_M)
