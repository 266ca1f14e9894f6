"""Where a thing that can be carried is: a particle filter for its center, medians for its size and direction."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable
from dataclasses import dataclass, field

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.shape import Shape
from perception.objects.tracking.particle_filter import ParticleFilter, ParticleSettings
from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class CenterSettings:
    """``jump_sigmas``: smoothed innovation from which on the thing must have been pushed. ``size_memory``: how many
    sizes are kept that were measured from one side; ``size_sides``: from how many sides.
    """

    floor_sigma_m: float = 0.003
    """However often it is measured, a center is known no better: the camera's mounting is not."""
    axis_memory: float = 0.95
    """Weight of the direction so far against a new one: twenty frames count."""
    innovation_gain: float = 0.3
    """Weight of the newest innovation in the smoothed one: three frames must agree."""
    bias_sigma_m: float = 0.008
    """What all measurements from one side have in common, such as how deep the hidden half is."""
    particles: ParticleSettings = field(default_factory=ParticleSettings)
    jump_sigmas: float = 3.5
    size_memory: int = 15
    size_sides: int = 6

    @property
    def innovation_share(self) -> float:
        """Variance of the smoothed innovation as a share of a single one's."""
        return self.innovation_gain / (2.0 - self.innovation_gain)


class CenterBelief:
    """Belief about place and size of one thing, in the frame of its room.

    Attributes:
        box: center, size and direction as believed now.
    """

    def __init__(self, box: Box, covariance: Array, *, settings: CenterSettings, random: Generator) -> None:
        self._settings = settings
        self._filter = ParticleFilter(box.center, covariance, settings=settings.particles, random=random)
        self._pose_covariance = np.zeros((3, 3))
        self._sizes: dict[Hashable, deque[tuple[float, float, float]]] = {}
        self._keep_size(box.size_m, None)
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
        return self._spread + self._pose_covariance + np.eye(3) * self._settings.floor_sigma_m**2

    def observe(self, shape: Shape, T_room_view: SE3, pose_covariance: Array, side: Hashable = None) -> None:
        """Take in one measurement; ``pose_covariance`` (3, 3) is the pose's share of its uncertainty, room frame,
        ``side`` from where it was taken.
        """
        R = T_room_view.rotation()
        if not self._pose_covariance.any() or np.trace(pose_covariance) < np.trace(self._pose_covariance):
            self._pose_covariance = pose_covariance
        self._learn_size(shape, side)
        if shape.oriented:
            self._axis = self._settings.axis_memory * self._axis + _doubled(shape.yaw_rad + T_room_view.yaw_rad)
        center, hidden_m = T_room_view.apply(shape.center), self._hidden_m(shape)
        away = center - self._filter.mean
        center = center - np.clip(away, -hidden_m, hidden_m)
        if self._learn_place(center, R @ shape.covariance @ R.T, hidden_m):
            self._sizes = {side: self._sizes[side]} if side in self._sizes else self._sizes
        self._refresh()

    def _hidden_m(self, shape: Shape) -> Array:
        """How far the center may be from that of a measurement along the room's axes, (3,): of what is known whole and
        now seen in part, the rest may be hidden on either side.
        """
        if shape.complete or not self._seen_whole:
            return np.zeros(3)
        x_m, y_m, z_m = self.box.size_m
        broad_m = (max(x_m, y_m) - max(shape.size_m[:2])) / 2.0
        return np.maximum((broad_m, broad_m, (z_m - shape.size_m[2]) / 2.0), 0.0)

    def _learn_size(self, shape: Shape, side: Hashable) -> None:
        """Whole views count; before the first one, any view does. A thing does not grow: what it measured from other
        sides outweighs what it seems to be from one, where it may be taken for one with its neighbor.
        """
        if shape.complete and not self._seen_whole:
            self._sizes.clear()
            self._seen_whole = True
        if shape.complete or not self._seen_whole:
            self._keep_size(shape.size_m, side)

    def _keep_size(self, size_m: tuple[float, float, float], side: Hashable) -> None:
        sizes = self._sizes.pop(side, None) or deque(maxlen=self._settings.size_memory)
        sizes.append(size_m)
        self._sizes[side] = sizes
        while len(self._sizes) > self._settings.size_sides:
            del self._sizes[next(iter(self._sizes))]

    def _learn_place(self, center: Array, covariance: Array, hidden_m: Array) -> bool:
        """Update the filter, or start it anew where the mean of the last innovations says that the thing was pushed,
        and may lie otherwise than it stood; whether it was.
        """
        self._innovation += self._settings.innovation_gain * (center - self._filter.mean - self._innovation)
        S = (
            self._filter.covariance
            + self._settings.innovation_share * covariance
            + np.eye(3) * self._settings.bias_sigma_m**2
        )
        squared = float(self._innovation @ np.linalg.solve(S, self._innovation))
        if squared > self._settings.jump_sigmas**2:
            self._filter.restart(center, covariance)
            self._innovation = np.zeros(3)
            return True
        self._filter.update(center, covariance + np.diag(hidden_m**2))
        return False

    def _refresh(self) -> None:
        x_m, y_m, z_m = (float(side) for side in np.median(np.concatenate(list(self._sizes.values())), axis=0))
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
