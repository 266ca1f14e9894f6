"""Pointing the camera: at a place, or once around."""

from __future__ import annotations

from math import atan2, ceil, hypot, pi

import numpy as np
from py_trees.common import Status

from scene_graph.nodes import Point3
from skills.action import Action, RobotContext
from skills.anchor import Anchor, AnchorSource, resolved
from skills.failures import FailureCode
from skills.geometry import wrap_rad
from skills.looking.settings import LookSettings, Row
from skills.navigation.pose import planar_pose, robot_frame
from skills.navigation.pursuit import turn_rate


class LookAt(Action):
    """Points the camera at a place, turning the base when the pan does not suffice, and keeps still for ``dwell_s``."""

    timeout_s = 15.0

    def __init__(
        self, context: RobotContext, target: str, where: AnchorSource, *, dwell_s: float | None = None
    ) -> None:
        super().__init__(f"look at {target}", context)
        self._where, self._dwell_s = where, context.settings.looking.dwell_s if dwell_s is None else dwell_s
        self._gaze = Gaze(context)
        self._settled_s: float | None = None

    def begin(self) -> None:
        """Not settled yet."""
        self._settled_s = None

    def step(self) -> Status:
        """Aim, settle, dwell."""
        anchor = resolved(self._where)
        if anchor.node_id not in self.context.snapshot:
            return self.fail(FailureCode.OBJECT_GONE, f"{anchor.node_id} is no longer on my map.")
        pan, tilt = aim(self.context, anchor)
        if not self._gaze.at(pan, tilt):
            self._settled_s = None
            return Status.RUNNING
        if self._settled_s is None:
            self._settled_s = self.context.stamp_s
        return Status.SUCCESS if self.context.stamp_s - self._settled_s >= self._dwell_s else Status.RUNNING


class SweepCamera(Action):
    """Looks once around in overlapping views, standing still in each long enough to be seen twice."""

    timeout_s = 90.0

    def __init__(self, context: RobotContext, *, rows: tuple[Row, ...] | None = None) -> None:
        super().__init__("look around", context)
        self._settings = context.settings.looking
        self._rows = self._settings.rows if rows is None else rows
        self._gaze = Gaze(context)
        self._todo: list[tuple[float, float]] = []
        self._settled_s: float | None = None

    def begin(self) -> None:
        """List the headings, from one end of the pan to the other and back for the next tilt."""
        self.context.announce("looking around")
        yaw = self._yaw()
        self._todo, self._settled_s = [], None
        for number, (tilt, views) in enumerate(self._rows):
            pans = np.linspace(-pi, pi, views, endpoint=False) + pi / views
            self._todo += [(yaw + float(pan), tilt) for pan in (pans if number % 2 == 0 else pans[::-1])]

    def step(self) -> Status:
        """Aim at the next heading, settle, dwell."""
        if not self._todo:
            self.context.commands.look = (0.0, self._settings.rows[0][0])
            return Status.SUCCESS
        heading, tilt = self._todo[0]
        if not self._gaze.at(wrap_rad(heading - self._yaw()), tilt):
            self._settled_s = None
            return Status.RUNNING
        if self._settled_s is None:
            self._settled_s = self.context.stamp_s
        if self.context.stamp_s - self._settled_s >= self._settings.dwell_s:
            self._todo.pop(0)
            self._settled_s = None
        return Status.RUNNING

    def _yaw(self) -> float:
        return planar_pose(self.context, robot_frame(self.context.snapshot)).yaw_rad


def aim(context: RobotContext, anchor: Anchor) -> tuple[float, float]:
    """Pan and tilt that center ``anchor`` in the image (radians; pan to the left, tilt up positive); unlimited."""
    x_m, y_m, z_m = anchor.in_base(context)
    before_m, over_m = x_m - context.geometry.camera_x_m, z_m - context.geometry.camera_height_m
    return atan2(y_m, before_m), atan2(over_m, max(hypot(before_m, y_m), 1e-3))


def gaze_points(size_m: Point3, camera_height_m: float, settings: LookSettings) -> list[Point3]:
    """Where to point the camera, from an arm's length, to see all of a thing of this size: points in its own frame.

    A top is seen in pictures side by side, what is as high as the camera also in one below the other.
    """
    x_m, y_m, z_m = size_m
    count = max(1, ceil(max(x_m, y_m) / settings.picture_m))
    aside = [max(x_m, y_m) * ((number + 0.5) / count - 0.5) for number in range(count)]
    heights = settings.high if z_m > camera_height_m - settings.eye_level_m else (settings.top,)
    return [(a, 0.0, h * z_m) if x_m >= y_m else (0.0, a, h * z_m) for h in heights for a in aside]


class Gaze:
    """Points the camera and holds it still: the pose estimate's noise does not move it, a real change does."""

    def __init__(self, context: RobotContext) -> None:
        self._context, self._settings = context, context.settings.looking
        self._held: tuple[float, float] | None = None

    def at(self, pan_rad: float, tilt_rad: float) -> bool:
        """Command the camera, and the base when the pan is out of range; true once everything stands still."""
        limits, body = self._context.limits, self._context.body
        (pan_low, pan_high), (tilt_low, tilt_high) = limits.pan_rad, limits.tilt_rad
        pan, tilt = min(max(pan_rad, pan_low), pan_high), min(max(tilt_rad, tilt_low), tilt_high)
        if self._held is None or max(abs(self._held[0] - pan), abs(self._held[1] - tilt)) > self._settings.drift_rad:
            self._held = (pan, tilt)
        self._context.commands.look = self._held
        if abs(pan_rad - pan) > self._settings.settled_rad:
            self._context.commands.drive = (0.0, turn_rate(pan_rad - pan, limits))
            return False
        self._context.commands.drive = (0.0, 0.0)
        still = abs(body.angular_radps) < 0.03 and abs(body.linear_mps) < 0.02
        aimed = max(abs(body.pan_rad - self._held[0]), abs(body.tilt_rad - self._held[1])) < self._settings.settled_rad
        return still and aimed
