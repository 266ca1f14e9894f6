"""Rooms seen from some places, and their outlines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from perception.geometry.planar import Pose2
from perception.lidar.slice import OutlineSlicer
from perception.rooms.outline.outline import (
    Outline,
    find_outline,
)
from perception.rooms.survey.measurement import Fit, RoomMeasurement
from perception.rooms.views.view import View
from unit.perception.lidar_house import Array, House, cast


def view_at(house: House, pose: Pose2, rng: np.random.Generator) -> View:
    return View.of(OutlineSlicer().cut(cast(house, pose, rng)), pose, pose)


def outline_from(house: House, *places: tuple[float, float], seed: int = 0, yaw_rad: float = 0.4) -> Outline:
    rng = np.random.default_rng(seed)
    outline = find_outline([view_at(house, Pose2(x, y, yaw_rad), rng) for x, y in places])
    assert outline is not None
    return outline


def corner_error_m(truth: Array, polygon: Array) -> float:
    assert len(truth) == len(polygon)
    return float(np.linalg.norm(truth[:, None] - polygon[None], axis=2).min(axis=1).max())


@dataclass(kw_only=True)
class Approach:
    """A measurement of a room along a straight way, with odometry that is one percent off, and the true first pose."""

    fit: Fit
    first: Pose2
    last: Pose2
    polygon: Array

    def error_m(self) -> float:
        T_house_frame = self.first @ self.fit.views[0].T_frame_base.inverse()
        return corner_error_m(self.polygon, T_house_frame.apply(self.fit.outline.polygon))


def approach(polygon: Array, start: tuple[float, float], end: tuple[float, float], seed: int) -> Approach:
    rng, slicer, measurement = np.random.default_rng(seed), OutlineSlicer(), RoomMeasurement()
    house, way = House(rooms={"a": polygon}), np.array(end) - np.array(start)
    steps = max(int(np.linalg.norm(way) / 0.05), 10)
    heading = float(np.arctan2(way[1], way[0]))
    poses = [Pose2(*(start + way * k / steps), heading + 0.3 * np.sin(k / 10)) for k in range(steps + 1)]
    scale, odometry = 1.0 + float(rng.choice([-0.01, 0.01])), Pose2.identity()
    for before, pose in zip([poses[0], *poses], poses, strict=False):
        moved = before.inverse() @ pose
        odometry = odometry @ Pose2(moved.x_m * scale, moved.y_m * scale, moved.yaw_rad * scale)
        measurement.add(slicer.cut(cast(house, pose, rng)), odometry, odometry)
    fit = measurement.solve()
    assert fit is not None
    return Approach(fit=fit, first=poses[0], last=poses[-1], polygon=polygon)
