"""Where a small thing is and how large, from many sides."""

from dataclasses import replace

import numpy as np
import pytest

from perception.objects.furniture.surface import Box
from perception.objects.seeing.shape import Shape
from perception.objects.tracking.center import CenterBelief, CenterSettings
from scene_graph.geometry.se3 import SE3


def measured(belief, width_m, *, side, frames, x_m=0.0):
    shape = Shape(
        center=np.array((x_m, 0.0, 0.8)), size_m=(width_m, width_m, 0.12), yaw_rad=0.0, oriented=False,
        covariance=np.eye(3) * 1e-4, complete=True,
    )  # fmt: skip
    for _ in range(frames):
        belief.observe(shape, SE3.identity(), np.eye(3) * 1e-6, side)


@pytest.mark.parametrize(("x_m", "width_m"), [(0.0, 0.066), (0.5, 0.15)])
def test_a_can_does_not_grow_though_from_one_side_it_is_long_taken_for_one_with_its_neighbor(x_m, width_m):
    belief = CenterBelief(
        Box(np.array((0.0, 0.0, 0.8)), (0.066, 0.066, 0.12), 0.0), np.eye(3) * 1e-4, settings=CenterSettings(),
        random=np.random.default_rng(0),
    )  # fmt: skip
    for side in range(3):
        measured(belief, 0.066, side=side, frames=15)
    measured(belief, 0.15, side=3, frames=60, x_m=x_m)
    assert belief.box.size_m[0] == pytest.approx(width_m), "only what was pushed may lie otherwise than it stood"


@pytest.mark.parametrize(
    ("middle_z_m", "high_m", "center_z_m"),
    [
        (0.65, 0.08, 0.57),  # the upper third shows over the fingers
        (0.46, 0.02, 0.57),  # its foot shows below them
        (0.75, 0.08, 0.67),  # somebody has put something below it meanwhile
    ],
)
def test_what_hides_a_part_of_a_bottle_does_not_shift_it_but_what_lifts_it_does(middle_z_m, high_m, center_z_m):
    whole = Shape(
        center=np.array((0.7, 0.0, 0.57)), size_m=(0.07, 0.07, 0.24), yaw_rad=0.0, oriented=False,
        covariance=np.eye(3) * 6e-5, complete=True,
    )  # fmt: skip
    part = replace(
        whole, center=np.array((0.7, 0.0, middle_z_m)), size_m=(0.04, 0.04, high_m), covariance=np.eye(3) * 4e-4,
        complete=False,
    )  # fmt: skip
    belief = CenterBelief(
        Box(whole.center, whole.size_m, 0.0), whole.covariance, settings=CenterSettings(),
        random=np.random.default_rng(0),
    )  # fmt: skip
    for shape in [whole] * 10 + [part] * 20:
        belief.observe(shape, SE3.identity(), np.eye(3) * 1e-6)
    assert belief.box.center[2] == pytest.approx(center_z_m, abs=0.015)
    assert belief.box.size_m == pytest.approx(whole.size_m, abs=0.001)
