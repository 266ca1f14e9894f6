"""What the room may look like, as weighted particles, until what is seen decides.

Each solution of the measurement that is like none before becomes a particle. All are judged by the same views, taken
from places spread over the whole survey: an outline from an unlucky moment, half in the doorway, does not last.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from perception.geometry.walls import Walls
from perception.localization.alignment import align
from perception.localization.motion_model import odometry_covariance
from perception.rooms.survey.measurement import Fit
from perception.rooms.views.view import View


@dataclass(frozen=True, kw_only=True)
class HypothesesSettings:
    """How particles are weighed, and how many are kept."""

    judges: int = 6
    """Views that every hypothesis must explain. Chosen: spread over the survey, for speed."""
    sharpness: float = 4.0
    """Of the weights, per view fully explained. Chosen: views of one survey are not independent."""
    closed: float = 0.1
    """Head start of an outline with walls all around, as a share of one view. Chosen."""
    alike_m: float = 0.15
    """Outlines whose corners are nearer are one. Chosen: one and a half stations."""
    kept: int = 6
    """Particles at most. Chosen: for speed."""
    least: float = 0.005
    """Those of less weight are dropped."""
    clear: float = 5.0
    """How many times likelier than the next one the most likely must be for the evidence to have decided. Chosen."""
    slack_m: float = 0.03
    """Standard deviation of where a view is, beyond odometry's: errors of the pose at the last view. Chosen."""
    slack_rad: float = 0.02
    """And of its heading."""


@dataclass(kw_only=True)
class Particle:
    """One outline with the poses that belong to it, and its weight among all."""

    fit: Fit
    weight: float = 1.0


@dataclass(kw_only=True)
class OutlineHypotheses:
    """The particles, most likely first."""

    settings: HypothesesSettings = field(default_factory=HypothesesSettings)
    particles: list[Particle] = field(default_factory=list)

    @property
    def best(self) -> Fit | None:
        """The most likely outline when they were last weighed."""
        return self.particles[0].fit if self.particles else None

    @property
    def crowded(self) -> bool:
        """Whether there are more particles than are kept, so that it is time to weigh them."""
        return len(self.particles) > self.settings.kept

    @property
    def decided(self) -> bool:
        """Whether the evidence singled one outline out when they were last weighed."""
        return bool(self.particles) and all(
            one.weight * self.settings.clear < self.particles[0].weight for one in self.particles[1:]
        )

    def add(self, fit: Fit) -> None:
        """Take in a new solution: it renews the particle that it is like, or is one more."""
        known = next((one for one in self.particles if self._alike(one.fit, fit)), None)
        if known is None:
            self.particles.append(Particle(fit=fit))
        else:
            known.fit = fit

    def weigh(self, views: Sequence[View]) -> None:
        """Weigh all by the views so far, most likely first; those that explain them too poorly are dropped."""
        if not self.particles:
            return
        settings = self.settings
        judges = [views[int(i)] for i in np.unique(np.linspace(0, len(views) - 1, settings.judges).astype(np.int64))]
        scores = np.array([self._score(one.fit, judges) for one in self.particles]) * settings.sharpness
        weights = np.exp(scores - scores.max())
        for one, weight in zip(self.particles, weights / weights.sum(), strict=True):
            one.weight = float(weight)
        self.particles.sort(key=lambda one: -one.weight)
        self.particles = [one for one in self.particles[: settings.kept] if one.weight > settings.least]

    def _score(self, fit: Fit, judges: Sequence[View]) -> float:
        """How many of the views the outline explains, each by its share of returns on walls."""
        settings = self.settings
        slack = np.diag([settings.slack_m, settings.slack_m, settings.slack_rad]) ** 2
        walls, last = Walls.of_polygon(fit.outline.polygon), fit.views[-1]
        total = settings.closed if fit.outline.closed else 0.0
        for view in judges:
            moved = last.T_odom_base.inverse() @ view.T_odom_base
            guess = last.T_frame_base @ moved
            found = align(view.scan.points_base, walls, guess, odometry_covariance(moved) + slack)
            total += found.matched if found is not None else 0.0
        return total

    def _alike(self, one: Fit, other: Fit) -> bool:
        first, second = one.outline.polygon, other.outline.polygon
        if first.shape != second.shape:
            return False
        apart = np.linalg.norm(first[:, None] - second[None], axis=2).min(axis=1)
        return bool(apart.max() < self.settings.alike_m)
