"""Outlines in competition: the one that explains the views of the whole survey wins, whatever came first or last."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from perception.geometry.planar import Pose2
from perception.lidar.slice import OutlineSlicer
from perception.localization.robot_pose import RobotPose
from perception.rooms.survey.hypotheses import OutlineHypotheses
from perception.rooms.survey.measurement import Fit, RoomMeasurement
from perception.rooms.survey.survey import Survey
from perception.rooms.views.view import View
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
    assert not hypotheses.decided


def test_evidence_has_decided_once_one_outline_explains_the_views_far_better() -> None:
    right, views = survey_of(l_shape())
    hypotheses = OutlineHypotheses()
    hypotheses.add(right)
    hypotheses.weigh(views)
    assert hypotheses.decided
    hypotheses.add(believed(right, rectangle(6.0, 2.5)))
    hypotheses.weigh(views)
    assert hypotheses.decided


def test_outlines_that_explain_the_views_as_well_as_each_other_are_both_kept_until_more_is_seen() -> None:
    right, views = survey_of(rectangle(6.0, 2.5))
    hypotheses = OutlineHypotheses()
    hypotheses.add(right)
    hypotheses.add(
        believed(right, np.array([[0, 0], [6, 0], [6, 2.5], [3.1, 2.5], [3.0, 2.5], [0, 2.5]], dtype=np.float64))
    )
    hypotheses.weigh(views)
    assert len(hypotheses.particles) == 2
    assert not hypotheses.decided


def surveyed(polygon: Array) -> Survey:
    """A survey of a room from its inside, solved as often as the room concept would."""
    rng, house, survey, slicer = np.random.default_rng(0), House(rooms={"a": polygon}), Survey(), OutlineSlicer()
    for step in range(14):
        pose = Pose2(1.0 + 0.3 * step, 1.2, 0.05)
        survey.add(
            slicer.cut(cast(house, pose, rng)),
            RobotPose(parent="root", T_parent_base=pose, T_odom_base=pose, covariance=np.eye(3) * 1e-6),
        )
        if step >= 3:
            survey.solve(0.5 * step)
    return survey


def test_a_survey_suffices_once_its_fits_agree_and_nothing_else_is_as_likely() -> None:
    survey = surveyed(rectangle(6.0, 2.5))
    assert survey.sufficient
    assert survey.fit is not None
    survey.hypotheses.add(
        believed(survey.fit, np.array([[0, 0], [6, 0], [6, 2.5], [3.1, 2.5], [3.0, 2.5], [0, 2.5]], dtype=np.float64))
    )
    survey.solve(99.0)
    assert not survey.sufficient


def test_a_survey_ends_with_the_outline_that_all_its_views_speak_for_not_with_the_newest() -> None:
    survey = surveyed(l_shape())
    right = survey.fit
    assert right is not None
    survey.fit = believed(right, rectangle(6.0, 2.5))
    survey.hypotheses.add(survey.fit)
    survey.decide()
    assert survey.fit is not None
    assert survey.fit.outline.polygon.shape == right.outline.polygon.shape
