"""Outlines in competition: the one that explains the views of the whole survey wins, whatever came first or last."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from majordomo.perception.localization.planar import Pose2
from majordomo.perception.rooms.hypotheses import OutlineHypotheses
from majordomo.perception.rooms.measurement import Fit, RoomMeasurement
from majordomo.perception.rooms.slice import OutlineSlicer
from majordomo.perception.rooms.views import View
from unit.perception.lidar_house import Array, House, cast, l_shape, rectangle


def survey_of(polygon: Array) -> tuple[Fit, list[View]]:
    """A drive through the room, solved: the fit is in the frame of its first view."""
    rng, house, measurement = np.random.default_rng(0), House(rooms={"a": polygon}), RoomMeasurement()
    for x_m in np.arange(1.0, 4.6, 0.3):
        pose = Pose2(float(x_m), 1.2, 0.05)
        measurement.add(OutlineSlicer().cut(cast(house, pose, rng)), pose, pose)
    fit = measurement.solve()
    assert fit is not None
    return fit, list(measurement.views)


def believed(fit: Fit, polygon: Array) -> Fit:
    """The same views with another outline, given in the house."""
    shape = Pose2(1.0, 1.2, 0.05).inverse().apply(polygon)
    count = len(polygon)
    outline = replace(
        fit.outline,
        polygon=shape,
        support=np.ones(count),
        gap_m=np.zeros(count),
        gap_center=shape,
        offset_std_m=np.full(count, 0.002),
    )
    return replace(fit, outline=outline)


@pytest.mark.parametrize("order", [(0, 1), (1, 0)], ids=["right one first", "wrong one first"])
def test_the_outline_that_explains_the_views_wins(order: tuple[int, int]) -> None:
    right, views = survey_of(l_shape())
    candidates = [right, believed(right, rectangle(6.0, 2.5))]
    hypotheses = OutlineHypotheses()
    for index in order:
        hypotheses.add(candidates[index])
    hypotheses.weigh(views)
    assert hypotheses.best is right
    assert hypotheses.particles[0].weight > 0.8


def test_weights_sum_to_one_and_outlines_that_are_alike_are_one() -> None:
    right, views = survey_of(l_shape())
    hypotheses = OutlineHypotheses()
    for _ in range(3):
        hypotheses.add(believed(right, l_shape() + 0.01))
        hypotheses.add(believed(right, l_shape() * 1.03))
        hypotheses.weigh(views)
    assert sum(one.weight for one in hypotheses.particles) == pytest.approx(1.0, abs=0.01)
    assert len(hypotheses.particles) <= 2


def test_two_outlines_that_explain_the_views_equally_well_leave_it_undecided() -> None:
    right, views = survey_of(rectangle(6.0, 2.5))
    one = believed(right, rectangle(6.0, 2.5))
    other = believed(right, np.array([[0, 0], [6, 0], [6, 2.5], [3.1, 2.5], [3.0, 2.5], [0, 2.5]], dtype=np.float64))
    hypotheses = OutlineHypotheses()
    hypotheses.add(one)
    hypotheses.add(other)
    hypotheses.weigh(views)
    assert len(hypotheses.particles) == 2
    assert hypotheses.particles[0].weight < 0.8


def test_without_any_outline_there_is_no_best() -> None:
    hypotheses = OutlineHypotheses()
    hypotheses.weigh(survey_of(rectangle(5.0, 3.0))[1])
    assert hypotheses.best is None
