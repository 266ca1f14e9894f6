"""Local adjustment: which walls of a standing room are not quite where they are believed to be, told from many views.

That a wall is off, or that the robot's pose is, looks the same in one scan. Views from several places are therefore
solved together: one shift per wall along its normal and a small correction of each view's pose. What remains open is
where the outline as a whole lies in the room's frame. There the walls' own covariances decide, and that as few walls as
possible are off (Huber's cost): of three parallel walls the odd one moves; of two alike, both by half, so that the
frame stays in the middle; and when all seem shifted in the same way it is the pose that was, and none moves. Limit:
furniture that reaches the ceiling and hides four fifths of a wall from all sides is taken for the wall.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.lidar.slice import OutlineScan
from perception.localization.robot_pose import RobotPose
from perception.localization.room_model import RoomModel
from perception.rooms.maintenance.wall_sightings import ShiftCost, SightingSettings

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class AdjustmentSettings:
    """When a view is taken, and when a wall is moved."""

    every_m: float = 0.4
    """Way between views. Chosen: from nearer places the same furniture hides the same walls."""
    every_s: float = 2.0
    """Or time. Chosen: twenty scans."""
    apart_m: float = 0.4
    """A view replaces an older one from nearer than this."""
    views: int = 24
    """That are kept. Chosen."""
    inside_m: float = 0.3
    """Least depth in the room: from a doorway little of it is seen."""
    pose_std_m: float = 0.1
    """Of a pose that may be believed. Chosen."""
    seen_from: int = 5
    """Number of places that must agree on a wall. Chosen."""
    nearer_from: int = 8
    """When it is nearer than believed, as furniture would be."""
    agree_m: float = 0.015
    """How well they must agree. Chosen."""
    agreeing: float = 0.75
    """Share of all places that say anything about the wall. Chosen."""
    least_m: float = 0.008
    """Smallest shift worth a change. Chosen."""
    sigmas: float = 3.0
    """And its standard deviations."""
    most_m: float = 0.3
    """What is off by more is no adjustment but another outline."""
    firmest_m: float = 0.003
    """No wall is known better than this. Chosen."""
    held_m: float = 0.0005
    """How far the walls that are off are to be moved is told with the others held to this."""
    loose: float = 5.0
    """And with what was believed about them so many times as vague. Chosen."""
    rounds: int = 6
    """Of reweighting. Chosen."""
    view_gate: float = 3.0
    """Misfit of a view, in standard deviations, from which on it counts less."""
    sightings: SightingSettings = field(default_factory=SightingSettings)


@dataclass(frozen=True, kw_only=True, eq=False)
class WallShifts:
    """How far (K,) the walls of a room are to be moved into it, 0 where they stay, with the standard deviations (K,).

    ``T_base_moved``: by how much the base is off where the newest view was taken, once the walls have moved.
    """

    shift_m: Array
    std_m: Array
    T_base_moved: Pose2

    def __str__(self) -> str:
        moved = [f"wall {k} by {1e3 * self.shift_m[k]:+.0f} mm" for k in np.flatnonzero(self.shift_m)]
        return ", ".join(moved)


class LocalAdjustment:
    """Evidence about the walls of the room that the robot is in; forgotten when it enters another one."""

    def __init__(self, settings: AdjustmentSettings = AdjustmentSettings()) -> None:
        self._settings = settings
        self.reset()

    def reset(self) -> None:
        """Forget all views."""
        self._model: RoomModel | None = None
        self._views: list[ShiftCost] = []
        self.doubt()

    def doubt(self) -> None:
        """The pose may not be believed: the newest view is not, and the next one is taken at once."""
        self._newest: ShiftCost | None = None
        self._last: Pose2 | None = None
        self._last_s = -np.inf

    def add(self, model: RoomModel, scan: OutlineScan, pose: RobotPose) -> bool:
        """Take in a scan when it is time to; whether a view was added. It counts when the next finds no doubt."""
        settings = self._settings
        if self._model is None or not _same(self._model, model):
            self.reset()
            self._model = model
        here = pose.T_parent_base
        vague = np.sqrt(np.trace(pose.covariance[:2, :2])) > settings.pose_std_m
        if vague or model.depth_m(here.position_m) < settings.inside_m or not self._due(here, scan.stamp_s):
            return False
        self._last, self._last_s = here, scan.stamp_s
        if self._newest is not None:
            self._keep(self._newest)
        self._newest = ShiftCost.of(scan, pose, model.walls, settings.sightings)
        return True

    def _due(self, here: Pose2, stamp_s: float) -> bool:
        settings = self._settings
        rested = stamp_s >= self._last_s + settings.every_s - 1e-6
        return self._last is None or rested or here.distance_m(self._last) >= settings.every_m

    def _keep(self, view: ShiftCost) -> None:
        apart_m = self._settings.apart_m
        others = [kept for kept in self._views if np.linalg.norm(kept.position_m - view.position_m) > apart_m]
        self._views = [*others, view][-self._settings.views :]

    def solve(self, std_m: Array) -> WallShifts | None:
        """The walls that are off, if any surely is. ``std_m``: (K,) what is believed about where they are.

        Once one is surely off, others that seem so move with it: where two share an error, neither is to take it all.
        """
        settings = self._settings
        if self._newest is None or len(self._views) < settings.seen_from:
            return None
        firm_m = np.hypot(std_m, settings.firmest_m)
        shifts, deviation = self._most_probable(firm_m)
        supported = self._supported(shifts)
        if not (supported & (np.abs(shifts) > np.maximum(settings.least_m, settings.sigmas * deviation))).any():
            return None
        off = supported & (np.abs(shifts) > settings.least_m)
        shifts, _ = self._most_probable(np.where(off, settings.loose * firm_m, settings.held_m))
        off &= self._supported(shifts) & (np.abs(shifts) > settings.least_m)
        if not off.any() or np.abs(shifts[off]).max() > settings.most_m:
            return None
        shifts = np.where(off, shifts, 0.0)
        return WallShifts(shift_m=shifts, std_m=deviation, T_base_moved=self._newest.correction(shifts))

    def _most_probable(self, std_m: Array) -> tuple[Array, Array]:
        """Shifts (K,) and their standard deviations, by iteratively reweighted least squares."""
        shifts = np.zeros(len(std_m))
        spread = np.diag(std_m**2)
        for _ in range(self._settings.rounds):
            variance = std_m * np.maximum(std_m, np.abs(shifts))
            information, vector = np.diag(1.0 / variance), np.zeros(len(std_m))
            for view in self._views:
                weight = min(1.0, self._settings.view_gate / max(view.misfit(shifts), 1e-9))
                information += weight * view.information
                vector += weight * view.vector
            spread = np.asarray(np.linalg.inv(information), dtype=np.float64)
            shifts = spread @ vector
        return shifts, np.sqrt(np.diag(spread))

    def _supported(self, shifts: Array) -> Mask:
        """(K,) walls that views from enough places see where they then are, and none sees a surface behind."""
        settings = self._settings
        agree, told = np.array([view.agreeing(shifts, settings.agree_m) for view in self._views]).sum(axis=0)
        mixed = np.array([view.lines.mixed for view in self._views]).sum(axis=0)
        least = np.where(shifts > 0.0, settings.nearer_from, settings.seen_from)
        return np.asarray((agree >= least) & (agree >= settings.agreeing * told) & (mixed == 0))


def _same(first: RoomModel, second: RoomModel) -> bool:
    """Whether both are of one room as it is."""
    return first.room_id == second.room_id and np.array_equal(first.polygon, second.polygon)
