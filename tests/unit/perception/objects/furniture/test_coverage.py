"""How much of a support a few pictures have shown."""

from math import atan2, pi

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid, look_at, render, rgbd_frame
from perception.objects.furniture.coverage import Coverage, CoverageSettings, SeenSurface
from perception.objects.furniture.surface import Box
from perception.objects.seeing.projection import View
from scene_graph.geometry.se3 import SE3

EYE_M = 1.4
FINE = CoverageSettings().pixels_per_m2


def picture(solids, eye, target):
    T_room_camera = look_at((*eye, EYE_M), target)
    rendering = render(solids, T_room_camera)
    frame = rgbd_frame(rendering, stamp_s=0.0, T_base_camera=T_room_camera, random=np.random.default_rng(1))
    return View.of(frame, room="room_1", T_room_base=SE3.identity(), pose_covariance=np.zeros((6, 6)))


def coverage_of(box, solids, *eyes, target=None, inside=False):
    coverage = Coverage(CoverageSettings(frames=1))
    for eye in eyes:
        coverage.add(
            box,
            SeenSurface.of(picture(solids, eye, target or tuple(box.center)), CoverageSettings(pixels_per_m2=FINE)),
            inside=inside,
        )
    return coverage


def part(label, center, size_m):
    return Solid(label=label, center=center, size_m=size_m)


CHAIR = Box(np.array((0.0, 0.0, 0.42)), (0.5, 0.48, 0.84), 0.0)
CHAIR_PARTS = [
    part("chair", (0.0, 0.0, 0.42), (0.5, 0.48, 0.05)),
    part("chair", (0.0, -0.22, 0.63), (0.5, 0.04, 0.42)),
]
SINK = Box(np.array((0.0, 0.0, 0.44)), (0.6, 0.5, 0.88), 0.0)
SINK_PARTS = [
    part("sink", (0.0, 0.0, 0.34), (0.6, 0.5, 0.68)),
    *(part("sink", (sign * 0.285, 0.0, 0.44), (0.03, 0.5, 0.88)) for sign in (1.0, -1.0)),
    *(part("sink", (0.0, sign * 0.235, 0.44), (0.6, 0.03, 0.88)) for sign in (1.0, -1.0)),
]
TABLE = Box(np.array((0.0, 0.0, 0.375)), (1.2, 0.8, 0.75), 0.0)
TABLE_PARTS = [part("table", (0.0, 0.0, 0.375), (1.2, 0.8, 0.75))]


def test_a_seat_is_seen_from_the_front_and_not_through_its_backrest():
    behind = coverage_of(CHAIR, CHAIR_PARTS, (0.0, -1.0))
    assert behind.share < 0.5
    assert behind.hidden_side_rad(CHAIR) == pytest.approx(pi / 2.0, abs=0.3)
    assert coverage_of(CHAIR, CHAIR_PARTS, (0.0, 1.0)).share > 0.85


def test_the_bottom_of_a_basin_is_seen_from_over_its_rim_and_not_from_afar():
    far, near = ((0.0, -1.4), (0.0, -0.7))
    shares = [coverage_of(SINK, SINK_PARTS, eye, inside=True).share for eye in (far, near)]
    assert shares[0] < shares[1] - 0.2
    assert coverage_of(SINK, SINK_PARTS, near, (0.0, 0.7), inside=True).share > shares[1]


def test_what_is_too_far_for_the_smallest_things_is_not_seen():
    far_edge = picture(TABLE_PARTS, (-2.6, 0.0), (0.0, 0.0, 0.75))
    assert len(SeenSurface.of(far_edge, CoverageSettings(pixels_per_m2=FINE / 10.0)).points) > 0
    assert coverage_of(TABLE, TABLE_PARTS, (-2.6, 0.0)).share == 0.0
    assert coverage_of(TABLE, TABLE_PARTS, (0.0, -1.0), target=(0.0, 0.0, 0.75)).share > 0.85


def test_the_side_of_what_was_not_seen_is_in_the_frame_of_the_support():
    turned = Box(np.array((0.0, 0.0, 0.375)), (2.4, 0.6, 0.75), 0.5)
    floor_high = [part("table", (0.0, 0.0, 0.0), (8.0, 8.0, 2.0 * 0.75))]
    one_end = turned.place(np.array([[-0.8, 0.0, 0.375]]))[0]
    before_it = turned.place(np.array([[-0.8, -0.9, 0.0]]))[0, :2]
    coverage = coverage_of(turned, floor_high, tuple(before_it), target=tuple(one_end))
    assert 0.2 < coverage.share < 0.8
    assert abs(coverage.hidden_side_rad(turned)) < pi / 3.0, "the other end, along its own x"


def test_pixels_by_area_are_those_that_a_flat_thing_gets():
    size_m, distance = (0.1, 0.1, 0.01), 1.0
    thing = part("phone", (0.0, 0.0, 0.755), size_m)
    view = picture([*TABLE_PARTS, thing], (-distance, 0.0), (0.0, 0.0, 0.75))
    rendering = render([*TABLE_PARTS, thing], view.T_room_camera)
    shown = np.count_nonzero(rendering.ids == 1) / (size_m[0] * size_m[1])
    assert atan2(EYE_M - 0.76, distance) > 0.5
    seen = {share: SeenSurface.of(view, CoverageSettings(pixels_per_m2=share * shown)).points for share in (0.8, 1.25)}
    there = {share: np.linalg.norm(points - (0.0, 0.0, 0.76), axis=1) < 0.02 for share, points in seen.items()}
    assert np.count_nonzero(there[0.8]) > 5
    assert not there[1.25].any()
