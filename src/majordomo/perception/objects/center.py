"""Where a thing that can be carried is: a particle filter for its center, medians for its size and direction."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from majordomo.perception.objects.particle_filter import ParticleFilter, ParticleSettings
from majordomo.perception.objects.shape import Shape
from majordomo.perception.objects.surface import Box
from majordomo.scene_graph.se3 import SE3

Array = NDArray[np.float64]
_FLOOR_SIGMA_M = 0.003
_AXIS_MEMORY = 0.95
_INNOVATION_GAIN = 0.3
_INNOVATION_SHARE = _INNOVATION_GAIN / (2.0 - _INNOVATION_GAIN)
"""Variance of the smoothed innovation as a share of a single one's."""
_BIAS_SIGMA_M = 0.008


@dataclass(frozen=True, kw_only=True)
class CenterSettings:
    """``jump_sigmas``: smoothed innovation from which on the thing must have been pushed."""

    particles: ParticleSettings = field(default_factory=ParticleSettings)
    jump_sigmas: float = 3.5
    size_memory: int = 15


class CenterBelief:
    """Belief about place and size of one thing, in the frame of its room.

    Attributes:
        box: center, size and direction as believed now.
    """

    def __init__(self, box: Box, covariance: Array, *, settings: CenterSettings, random: Generator) -> None:
        self._settings = settings
        self._filter = ParticleFilter(box.center, covariance, settings=settings.particles, random=random)
        self._pose_covariance = np.zeros((3, 3))
        self._sizes = deque([box.size_m], maxlen=settings.size_memory)
        self._seen_whole = False
        self._axis = _doubled(box.yaw_rad) if box.yaw_rad != 0.0 else np.zeros(2)
        self._innovation = np.zeros(3)
        self._spread = self._filter.covariance
        self.box = box

    @property
    def covariance(self) -> Array:
        """(3, 3) of the center. The robot's pose errs alike in all frames, so its share does not shrink with their
        number.
        """
        return self._spread + self._pose_covariance + np.eye(3) * _FLOOR_SIGMA_M**2

    def observe(self, shape: Shape, T_room_view: SE3, pose_covariance: Array) -> None:
        """Take in one measurement; ``pose_covariance`` (3, 3) is the pose's share of its uncertainty, room frame."""
        R = T_room_view.rotation()
        if not self._pose_covariance.any() or np.trace(pose_covariance) < np.trace(self._pose_covariance):
            self._pose_covariance = pose_covariance
        self._learn_size(shape)
        if shape.oriented:
            self._axis = _AXIS_MEMORY * self._axis + _doubled(shape.yaw_rad + T_room_view.yaw_rad)
        self._learn_place(T_room_view.apply(shape.center), R @ shape.covariance @ R.T)
        self._refresh()

    def _learn_size(self, shape: Shape) -> None:
        """Whole views count; before the first one, any view does."""
        if shape.complete and not self._seen_whole:
            self._sizes.clear()
            self._seen_whole = True
        if shape.complete or not self._seen_whole:
            self._sizes.append(shape.size_m)

    def _learn_place(self, center: Array, covariance: Array) -> None:
        """Update the filter, or start it anew where the mean of the last innovations says that the thing was pushed."""
        self._innovation += _INNOVATION_GAIN * (center - self._filter.mean - self._innovation)
        S = self._filter.covariance + _INNOVATION_SHARE * covariance + np.eye(3) * _BIAS_SIGMA_M**2
        squared = float(self._innovation @ np.linalg.solve(S, self._innovation))
        if squared > self._settings.jump_sigmas**2:
            self._filter.restart(center, covariance)
            self._innovation = np.zeros(3)
        else:
            self._filter.update(center, covariance)

    def _refresh(self) -> None:
        x_m, y_m, z_m = (float(side) for side in np.median(np.array(self._sizes), axis=0))
        yaw_rad = 0.5 * float(np.arctan2(self._axis[1], self._axis[0])) if self._axis.any() else 0.0
        self.box = Box(self._filter.mean, (x_m, y_m, z_m), yaw_rad)
        self._spread = self._filter.covariance

    def put_at(self, position: Array, sigma_m: float, yaw_rad: float | None) -> None:
        """Place it where it must be now, other than by sight."""
        if yaw_rad is not None and self._axis.any():
            self._axis = _doubled(yaw_rad)
        self._pose_covariance = np.zeros((3, 3))
        self._innovation = np.zeros(3)
        self._filter.restart(position, np.eye(3) * sigma_m**2)
        self._refresh()

    def change_frame(self, T_new_old: SE3) -> None:
        """Express it in another room's frame."""
        self._filter.particles = T_new_old.apply(self._filter.particles)
        if self._axis.any():
            self._axis = _doubled(self.box.yaw_rad + T_new_old.yaw_rad)
        self._refresh()


def _doubled(yaw_rad: float) -> Array:
    """A direction that looks the same after half a turn, as a unit vector at twice its angle."""
    return np.array((np.cos(2.0 * yaw_rad), np.sin(2.0 * yaw_rad)))
