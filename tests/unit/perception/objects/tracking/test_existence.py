"""What an unseen thing says about itself, and what it does not."""

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid, look_at, render, rgbd_frame
from perception.objects.furniture.surface import Box
from perception.objects.seeing.projection import View
from perception.objects.tracking.existence import (
    ExistenceSettings,
    Visibility,
    absence_evidence,
    detection_probability,
    surface_absent,
    visibility,
)
from scene_graph.geometry.se3 import SE3

TABLE = Solid(label="table", center=(0.0, 0.0, 0.375), size_m=(1.2, 0.8, 0.75))
BOTTLE = Solid(label="bottle", center=(-0.2, 0.0, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True)
PLATE = Solid(label="plate", center=(-0.2, 0.0, 0.76), size_m=(0.22, 0.22, 0.02), cylinder=True)
SETTINGS = ExistenceSettings()


def box_of(solid):
    return Box(np.array(solid.center), solid.size_m, solid.yaw_rad)


def evidence(solid, world, eye=(-1.4, 0.0, 1.4), target=(0.0, 0.0, 0.8), covariance=None):
    T = look_at(eye, target)
    frame = rgbd_frame(render(world, T), stamp_s=0.0, T_base_camera=T, random=np.random.default_rng(0))
    covariance = covariance if covariance is not None else np.zeros((6, 6))
    view = View.of(frame, room="r", T_room_base=SE3.identity(), pose_covariance=covariance)
    seen = visibility(box_of(solid), view, SETTINGS)
    return absence_evidence(seen, replaced=False, settings=SETTINGS)


def test_seeing_through_its_place_is_strong_evidence_of_absence():
    assert evidence(BOTTLE, [TABLE]) == -SETTINGS.through_limit


@pytest.mark.parametrize(("label", "height_m"), [("can", 0.12), ("cup", 0.1), ("box", 0.14)])
def test_from_near_and_above_the_rays_that_meet_the_top_close_behind_its_foot_do_not_speak_for_it(label, height_m):
    thing = Solid(label=label, center=(-0.2, 0.0, 0.75 + height_m / 2), size_m=(0.07, 0.07, height_m), cylinder=True)
    over = {"eye": (-0.95, 0.0, 1.4), "target": (-0.2, 0.0, 0.8)}
    assert evidence(thing, [TABLE], **over) < -0.8 * SETTINGS.through_limit
    assert evidence(thing, [TABLE, thing], **over) == 0.0


def test_a_miss_of_the_network_is_no_evidence_where_depth_shows_the_thing():
    assert evidence(BOTTLE, [TABLE, BOTTLE]) == 0.0


def test_what_is_hidden_out_of_view_or_too_far_gives_no_evidence():
    screen = Solid(label="box", center=(-0.7, 0.0, 1.0), size_m=(0.05, 0.8, 0.6))
    assert evidence(BOTTLE, [TABLE, screen]) == 0.0
    assert evidence(BOTTLE, [TABLE], target=(-3.0, 0.0, 0.8)) == 0.0
    assert evidence(BOTTLE, [TABLE], eye=(-4.9, 0.0, 1.4)) == 0.0


def test_the_robots_arm_before_the_lens_is_no_evidence():
    arm = Solid(label="arm", center=(-1.1, 0.0, 1.25), size_m=(0.3, 0.2, 0.1))
    assert evidence(BOTTLE, [TABLE, arm]) == 0.0


def test_a_flat_thing_loses_slowly_because_depth_cannot_tell():
    change = evidence(PLATE, [TABLE])
    assert -SETTINGS.miss_limit <= change < 0.0


def test_of_what_is_hidden_in_part_the_silence_of_the_network_says_nothing_and_a_look_through_it_still_does():
    """An apple behind a can, on a shelf: the network never named what showed of it, in frame after frame."""
    flat = Solid(label="plate", center=(-0.2, 0.0, 0.76), size_m=(0.12, 0.12, 0.02), cylinder=True)
    before = Solid(label="bottle", center=(-0.38, 0.06, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True)
    assert evidence(flat, [TABLE, flat]) < 0.0
    assert evidence(flat, [TABLE, flat, before]) == 0.0
    assert evidence(BOTTLE, [TABLE, before]) < -0.5 * SETTINGS.through_limit


def test_an_uncertain_pose_weakens_what_depth_tells():
    sharp = evidence(BOTTLE, [TABLE])
    vague = evidence(BOTTLE, [TABLE], covariance=np.diag([0.2**2] * 3 + [0.01] * 3))
    assert sharp < vague <= 0.0


def test_detection_gets_likelier_with_size_in_pixels_and_visible_share():
    small = Visibility(consistent=1.0, pixels=5.0)
    large = Visibility(consistent=1.0, pixels=30.0)
    half = Visibility(consistent=0.5, pixels=30.0)
    small, half, large = (detection_probability(v, SETTINGS) for v in (small, half, large))
    assert small < 0.1 < half < large <= SETTINGS.detect_max


def test_evidence_is_never_positive_and_never_beyond_its_limit():
    random = np.random.default_rng(3)
    for _ in range(300):
        through, consistent = random.dirichlet((1.0, 1.0, 1.0))[:2]
        seen = Visibility(
            through=through, consistent=consistent, pixels=random.uniform(1, 60), depth_tells=random.random() < 0.5
        )
        for replaced in (False, True):
            assert -SETTINGS.through_limit <= absence_evidence(seen, replaced=replaced, settings=SETTINGS) <= 0.0


@pytest.mark.parametrize(("world", "expected"), [([TABLE], 0.0), ([], 1.0)])
def test_furniture_is_gone_only_when_one_looks_through_where_it_stood(world, expected):
    T = look_at((-2.0, 0.0, 1.4), (0.0, 0.0, 0.5))
    frame = rgbd_frame(render(world, T), stamp_s=0.0, T_base_camera=T)
    view = View.of(frame, room="r", T_room_base=SE3.identity(), pose_covariance=np.zeros((6, 6)))
    ticks = np.linspace(-0.5, 0.5, 12)
    top = np.stack(np.meshgrid(ticks * 1.2, ticks * 0.8), axis=-1).reshape(-1, 2)
    points = np.column_stack((top, np.full(len(top), 0.75)))
    assert surface_absent(points, view, SETTINGS) == pytest.approx(expected, abs=0.35)
