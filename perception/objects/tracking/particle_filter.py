"""Where a thing is, as a cloud of particles, with named likelihoods (Filtering, section 3.1 and algorithm 1).

``paper`` is the filter of the paper: every step adds noise of the initial spread, weights are ``1 / (1 + d)``,
nothing is resampled. ``paper_resampled`` reads it as a textbook does, which draws particles by their weights before
each prediction; the paper does not say so. ``student`` and ``gaussian`` weigh by the covariance of the measurement,
carry weights on, and resample.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Likelihood(StrEnum):
    """How a particle is judged by a measurement."""

    PAPER = "paper"
    PAPER_RESAMPLED = "paper_resampled"
    GAUSSIAN = "gaussian"
    STUDENT = "student"

    @property
    def of_the_paper(self) -> bool:
        """Whether weights are ``1 / (1 + d)``, of the newest measurement alone."""
        return self in {Likelihood.PAPER, Likelihood.PAPER_RESAMPLED}


@dataclass(frozen=True, kw_only=True)
class ParticleSettings:
    """``process_sigma_m``: how far a thing at rest may creep between measurements. ``smoothing``: width of the kernel
    that resampling spreads copies with, as a part of the cloud's own spread (it is shrunk to keep that spread).
    """

    likelihood: Likelihood = Likelihood.STUDENT
    particles: int = 256
    process_sigma_m: float = 0.0005
    smoothing: float = 0.5
    degrees_of_freedom: float = 6.0
    resample_below: float = 0.5
    depleted: float = 6.0
    """Effective number of particles under which the cloud no longer tells a distribution."""


class ParticleFilter:
    """Belief about one position, (3,) in meters in one fixed frame.

    Attributes:
        particles: (N, 3) hypotheses.
        weights: (N,) that sum to one.
    """

    def __init__(self, position: Array, covariance: Array, *, settings: ParticleSettings, random: Generator) -> None:
        self._settings = settings
        self._random = random
        self._initial_root = _square_root(covariance)
        self.restart(position, covariance)

    def restart(self, position: Array, covariance: Array) -> None:
        """Forget the past: s_i ~ N(mu_0, Sigma_0), w_i = 1 / N."""
        N = self._settings.particles
        noise = self._random.standard_normal((N, 3))
        if not self._settings.likelihood.of_the_paper:
            noise = (noise - noise.mean(axis=0)) / np.maximum(noise.std(axis=0), 1e-9)
        self._initial_root = _square_root(covariance)
        self.particles = np.asarray(position, dtype=np.float64) + noise @ self._initial_root.T
        self.weights = np.full(N, 1.0 / N)

    @property
    def mean(self) -> Array:
        """(3,) weighted mean, the estimate of algorithm 1, line 10."""
        mean: Array = self.weights @ self.particles
        return mean

    @property
    def covariance(self) -> Array:
        """(3, 3) weighted covariance of the particles."""
        centered = self.particles - self.mean
        covariance: Array = (centered * self.weights[:, None]).T @ centered
        return covariance

    def update(self, measurement: Array, covariance: Array) -> Array:
        """Predict, weigh by ``measurement`` (3,) with its ``covariance`` (3, 3), and return the new estimate (3,)."""
        if self._settings.likelihood.of_the_paper:
            return self._update_as_paper(measurement)
        self.particles = self.particles + self._settings.process_sigma_m * self._random.standard_normal(
            self.particles.shape
        )
        prior = (self.mean, self.covariance)
        with np.errstate(divide="ignore"):
            log_weights = np.log(self.weights) + self._log_likelihood(measurement, covariance)
        weights = np.exp(log_weights - log_weights.max())
        self.weights = weights / weights.sum()
        effective = 1.0 / float(self.weights @ self.weights)
        if effective < self._settings.depleted:
            self._refill(*prior, measurement, covariance)
        elif effective < self._settings.resample_below * len(weights):
            self._resample(self.mean)
        return self.mean

    def _refill(self, mean: Array, P: Array, measurement: Array, R: Array) -> None:
        """No particle is left near the measurement: draw new ones from the product of the two as normal
        distributions.
        """
        K = P @ np.linalg.inv(P + R)
        fused = (np.eye(3) - K) @ P
        self.restart(mean + K @ (measurement - mean), (fused + fused.T) / 2.0)

    def _update_as_paper(self, measurement: Array) -> Array:
        """Algorithm 1, lines 8 to 10, after the prediction s_i = T s_i + n_i; T is one in a frame that rests."""
        if self._settings.likelihood is Likelihood.PAPER_RESAMPLED:
            self.particles = self.particles[self._drawn_by_weight()]
        noise = self._random.standard_normal(self.particles.shape) @ self._initial_root.T
        self.particles = self.particles + noise
        distances = np.linalg.norm(self.particles - measurement, axis=1)
        weights = 1.0 / (1.0 + distances)
        self.weights = weights / weights.sum()
        return self.mean

    def _log_likelihood(self, measurement: Array, covariance: Array) -> Array:
        whitened = (self.particles - measurement) @ np.linalg.inv(_square_root(covariance)).T
        squared: Array = np.einsum("ij,ij->i", whitened, whitened)
        if self._settings.likelihood is Likelihood.GAUSSIAN:
            return -0.5 * squared
        nu = self._settings.degrees_of_freedom
        log_likelihood: Array = -0.5 * (nu + 3.0) * np.log1p(squared / nu)
        return log_likelihood

    def _resample(self, mean: Array) -> None:
        """Systematic resampling, copies spread by a kernel that leaves mean and covariance as they are."""
        N = len(self.weights)
        root = _square_root(self.covariance)
        chosen = self._drawn_by_weight()
        h = self._settings.smoothing
        noise = self._random.standard_normal((N, 3)) @ root.T
        particles = mean + np.sqrt(1.0 - h * h) * (self.particles[chosen] - mean) + h * noise
        self.particles = particles + (mean - particles.mean(axis=0))
        self.weights = np.full(N, 1.0 / N)

    def _drawn_by_weight(self) -> NDArray[np.intp]:
        """(N,) indices of particles, each about as often as its weight says: systematic sampling."""
        N = len(self.weights)
        positions = (np.arange(N) + self._random.random()) / N
        return np.minimum(np.searchsorted(np.cumsum(self.weights), positions), N - 1)


def _square_root(covariance: Array) -> Array:
    """Lower triangular L with L L^T = covariance, which may be singular."""
    return np.asarray(np.linalg.cholesky(np.asarray(covariance) + 1e-10 * np.eye(3)), dtype=np.float64)
