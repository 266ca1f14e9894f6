"""Laws of the particle filter, and Table 1 of the Filtering paper."""

import time

import numpy as np
import pytest

from perception.objects.tracking.particle_filter import Likelihood, ParticleFilter, ParticleSettings

TRUTH = np.array((0.67, 0.10, 0.95))
SIGMA = np.array((0.35, 0.24, 0.03))
MEASUREMENTS = 30
REPETITIONS = 100


def run(likelihood, measurements, seed, **settings):
    random = np.random.default_rng(seed)
    R = np.diag(SIGMA**2)
    belief = ParticleFilter(
        measurements[0], R, settings=ParticleSettings(likelihood=likelihood, **settings), random=random
    )
    return np.array([belief.mean, *(belief.update(z, R) for z in measurements[1:])])


def table_1(likelihood):
    """Root mean square of the last estimate's error, and mean absolute error over a run, both (3,)."""
    last, over_run = [], []
    for seed in range(REPETITIONS):
        measurements = TRUTH + SIGMA * np.random.default_rng(1000 + seed).standard_normal((MEASUREMENTS, 3))
        errors = run(likelihood, measurements, seed) - TRUTH
        last.append(errors[-1])
        over_run.append(np.abs(errors).mean(axis=0))
    return np.sqrt(np.mean(np.square(last), axis=0)), np.mean(over_run, axis=0)


@pytest.fixture(scope="module")
def results():
    return {likelihood: table_1(likelihood) for likelihood in Likelihood}


def test_our_filter_beats_the_papers_filter_on_every_axis_of_table_1(results):
    for ours in (Likelihood.STUDENT, Likelihood.GAUSSIAN):
        assert (results[ours][0] < 0.5 * results[Likelihood.PAPER][0]).all()
        assert (results[ours][1] < results[Likelihood.PAPER][1]).all()


def test_the_last_error_is_close_to_the_bound_of_sigma_over_root_n(results):
    bound = SIGMA / np.sqrt(MEASUREMENTS)
    assert (results[Likelihood.GAUSSIAN][0] < 1.3 * bound).all()
    assert (results[Likelihood.STUDENT][0] < 1.3 * bound).all()
    assert (results[Likelihood.GAUSSIAN][0] > 0.7 * bound).all()


def test_the_gaussian_filter_agrees_with_the_kalman_filter_of_the_same_measurements():
    measurements = TRUTH + SIGMA * np.random.default_rng(5).standard_normal((MEASUREMENTS, 3))
    estimates = run(Likelihood.GAUSSIAN, measurements, 3, particles=4000)
    kalman = np.cumsum(measurements, axis=0) / np.arange(1, MEASUREMENTS + 1)[:, None]
    assert (np.abs(estimates - kalman) < 0.3 * SIGMA / np.sqrt(MEASUREMENTS)).all()


def test_the_reported_covariance_shrinks_like_one_over_n():
    R = np.diag(SIGMA**2)
    belief = ParticleFilter(
        TRUTH, R, settings=ParticleSettings(likelihood=Likelihood.GAUSSIAN), random=np.random.default_rng(0)
    )
    for _ in range(MEASUREMENTS - 1):
        belief.update(TRUTH, R)
    assert np.sqrt(np.diag(belief.covariance)) == pytest.approx(SIGMA / np.sqrt(MEASUREMENTS), rel=0.25)


def test_one_wild_measurement_moves_the_student_filter_less_than_the_gaussian_one():
    moved = {}
    for likelihood in (Likelihood.STUDENT, Likelihood.GAUSSIAN):
        measurements = np.vstack([np.tile(TRUTH, (10, 1)), TRUTH + 4.0 * SIGMA])
        moved[likelihood] = np.abs(run(likelihood, measurements, 1)[-1] - TRUTH)[:2].sum()
    assert moved[Likelihood.STUDENT] < 0.6 * moved[Likelihood.GAUSSIAN]


def test_weights_are_a_distribution_and_every_seed_gives_one_result():
    measurements = TRUTH + SIGMA * np.random.default_rng(9).standard_normal((MEASUREMENTS, 3))
    for likelihood in Likelihood:
        assert np.array_equal(run(likelihood, measurements, 4), run(likelihood, measurements, 4))
    belief = ParticleFilter(TRUTH, np.diag(SIGMA**2), settings=ParticleSettings(), random=np.random.default_rng(0))
    belief.update(TRUTH + 1.0, np.diag(SIGMA**2))
    assert belief.weights.sum() == pytest.approx(1.0)
    assert (belief.weights >= 0.0).all()


def test_a_measurement_far_from_every_particle_leaves_a_finite_belief():
    belief = ParticleFilter(TRUTH, np.eye(3) * 1e-6, settings=ParticleSettings(), random=np.random.default_rng(0))
    assert np.isfinite(belief.update(TRUTH + 50.0, np.eye(3) * 1e-6)).all()


@pytest.mark.benchmark
def test_forty_objects_are_updated_well_within_a_frame():
    R = np.eye(3) * 1e-4
    beliefs = [
        ParticleFilter(TRUTH, R, settings=ParticleSettings(), random=np.random.default_rng(i)) for i in range(40)
    ]
    start = time.perf_counter()
    for belief in beliefs:
        belief.update(TRUTH, R)
    assert time.perf_counter() - start < 0.05


def test_a_sharp_measurement_within_a_vague_belief_replaces_it():
    belief = ParticleFilter(
        TRUTH + 0.3, np.eye(3) * 0.5**2, settings=ParticleSettings(), random=np.random.default_rng(0)
    )
    belief.update(TRUTH, np.eye(3) * 0.01**2)
    assert np.linalg.norm(belief.mean - TRUTH) < 0.01
    assert np.sqrt(np.diag(belief.covariance)) == pytest.approx(0.01, rel=0.3)
