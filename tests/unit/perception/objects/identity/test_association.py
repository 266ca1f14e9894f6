"""Which detection is which thing."""

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.objects.doubles.raycast import Solid, look_at, render, rgbd_frame
from perception.objects.identity.association import assign, iou_matrix, label_image, warp_labels
from perception.objects.seeing.projection import View
from scene_graph.geometry.se3 import SE3

SOLIDS = [
    Solid(label="table", center=(0.0, 0.0, 0.375), size_m=(1.2, 0.8, 0.75)),
    Solid(label="bottle", center=(-0.3, 0.2, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True),
    Solid(label="box", center=(-0.2, -0.2, 0.85), size_m=(0.2, 0.2, 0.2)),
]


def cheapest(costs, limit):
    """Total cost of the best assignment, by trying all of them."""
    rows, columns = costs.shape
    if rows > columns:
        return cheapest(costs.T, limit)
    bounded = np.minimum(costs, limit)
    return min(sum(bounded[i, j] for i, j in enumerate(chosen)) for chosen in permutations(range(columns), rows))


@given(st.integers(1, 4), st.integers(1, 4), st.integers(0, 10_000))
def test_the_assignment_is_the_cheapest_of_all(rows, columns, seed):
    random = np.random.default_rng(seed)
    costs = random.uniform(0.0, 6.0, (rows, columns))
    costs[random.random((rows, columns)) < 0.3] = np.inf
    pairs = assign(3.5 - costs)
    assert len({i for i, _ in pairs}) == len({j for _, j in pairs}) == len(pairs)
    assert all(costs[i, j] < 3.5 for i, j in pairs)
    apart = min(rows, columns) - len(pairs)
    assert sum(costs[i, j] for i, j in pairs) + 3.5 * apart == pytest.approx(cheapest(costs, 3.5))


def test_nothing_is_assigned_when_there_is_nothing_to_assign():
    assert assign(np.zeros((0, 3))) == []
    assert assign(np.zeros((3, 0))) == []


def test_iou_agrees_with_counting_pixels():
    random = np.random.default_rng(1)
    before = [np.zeros((240, 320), dtype=bool) for _ in range(2)]
    before[0][20:100, 30:90] = True
    before[1][110:200, 100:220] = True
    after = [random.random((240, 320)) < 0.3, np.roll(before[0], 10, axis=1), before[1]]
    matrix = iou_matrix(label_image(before, (240, 320)), 2, after)
    for i, a in enumerate(before):
        for j, b in enumerate(after):
            small_a, small_b = a[::2, ::2], b[::2, ::2]
            assert matrix[i, j] == pytest.approx((small_a & small_b).sum() / (small_a | small_b).sum())
    assert matrix[1, 2] == 1.0


def views(T_first, T_second):
    renderings = [render(SOLIDS, T) for T in (T_first, T_second)]
    frames = [rgbd_frame(r, stamp_s=0.0, T_base_camera=T) for r, T in zip(renderings, (T_first, T_second), strict=True)]
    made = [View.of(f, room="r", T_room_base=SE3.identity(), pose_covariance=np.zeros((6, 6))) for f in frames]
    return renderings, made


def test_masks_moved_by_the_camera_motion_cover_the_masks_of_the_next_frame():
    first, second = look_at((-1.4, 0.0, 1.4), (0.0, 0.0, 0.75)), look_at((-1.3, 0.15, 1.4), (0.0, 0.1, 0.75))
    (before, after), (view, next_view) = views(first, second)
    labels = label_image([before.ids == k for k in range(3)], before.ids.shape)
    unmoved = iou_matrix(labels, 3, [after.ids == k for k in range(3)])
    moved = iou_matrix(warp_labels(labels, view, next_view), 3, [after.ids == k for k in range(3)])
    assert (np.diag(moved) > 0.75).all()
    assert moved[1, 1] > unmoved[1, 1] + 0.3


def test_a_camera_at_rest_leaves_masks_as_they_are():
    T = look_at((-1.4, 0.0, 1.4), (0.0, 0.0, 0.75))
    (before, _), (view, same) = views(T, T)
    labels = label_image([before.ids == k for k in range(3)], before.ids.shape)
    assert np.array_equal(warp_labels(labels, view, same), labels)


def test_what_leaves_the_image_leaves_the_labels():
    (before, _), (view, away) = views(
        look_at((-1.4, 0.0, 1.4), (0.0, 0.0, 0.75)), look_at((-1.4, 0.0, 1.4), (-4.0, 0.0, 0.75))
    )
    labels = label_image([before.ids == k for k in range(3)], before.ids.shape)
    assert not warp_labels(labels, view, away).any()
