"""Covariance along chains of frames, against sampling and against numerical Jacobians."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.geometry.uncertainty import composed_covariance, inverse_covariance, position_covariance
from scene_graph.nodes import ObjectNode, RobotNode, RoomNode, RootNode
from scene_graph.snapshot import Snapshot

law = settings(max_examples=40)

numbers = st.floats(-3.0, 3.0)
transforms = st.lists(numbers, min_size=6, max_size=6).map(SE3.exp)
seeds = st.integers(0, 2**32 - 1)


def random_covariance(seed, scale):
    A = np.random.default_rng(seed).normal(size=(6, 6)) * scale
    return A @ A.T


def numerical_jacobian(function, step=1e-6):
    """Of a map from tangent vectors to transforms, at zero, in right perturbations of its value."""
    center = function(np.zeros(6)).inverse()
    columns = [((center @ function(step * e)).log() - (center @ function(-step * e)).log()) for e in np.eye(6)]
    return np.array(columns).T / (2.0 * step)


def chain(transforms, covariances):
    """root -> room_1 -> (cup_1, robot)."""
    (root_room, room_cup, room_robot), (c1, c2, c3) = transforms, covariances
    return Snapshot.of(
        [RootNode(), RoomNode(id="room_1"), ObjectNode(id="cup_1", label="cup"), RobotNode()],
        [
            RtEdge(source="root", target="room_1", T_source_target=root_room, covariance=c1),
            RtEdge(source="room_1", target="cup_1", T_source_target=room_cup, covariance=c2),
            RtEdge(source="room_1", target="robot", T_source_target=room_robot, covariance=c3),
        ],
    )


@law
@given(transforms, transforms, seeds, seeds)
def test_composition_propagates_covariance_through_numerical_jacobians(a, b, seed_a, seed_b):
    cov_a, cov_b = random_covariance(seed_a, 0.1), random_covariance(seed_b, 0.1)
    J_a = numerical_jacobian(lambda xi: a @ SE3.exp(xi) @ b)
    J_b = numerical_jacobian(lambda xi: a @ b @ SE3.exp(xi))
    expected = J_a @ cov_a @ J_a.T + J_b @ cov_b @ J_b.T
    assert np.allclose(composed_covariance(cov_a, b, cov_b), expected, atol=1e-6 * (1.0 + np.abs(expected).max()))


@law
@given(transforms, seeds)
def test_inversion_propagates_covariance_through_its_numerical_jacobian(a, seed):
    cov = random_covariance(seed, 0.1)
    J = numerical_jacobian(lambda xi: (a @ SE3.exp(xi)).inverse())
    expected = J @ cov @ J.T
    assert np.allclose(inverse_covariance(a, cov), expected, atol=1e-6 * (1.0 + np.abs(expected).max()))


@law
@given(st.tuples(transforms, transforms, transforms), seeds)
def test_transforms_between_siblings_are_independent_of_what_is_above_their_parent(ts, seed):
    covs = [random_covariance(seed + i, 0.05) for i in range(3)]
    T, cov = chain(ts, covs).transform_with_covariance("robot", "cup_1")
    T_alone, cov_alone = chain((SE3.identity(), *ts[1:]), (np.zeros((6, 6)), *covs[1:])).transform_with_covariance(
        "robot", "cup_1"
    )
    assert T_alone == T
    assert np.array_equal(cov, cov_alone)
    J_cup = numerical_jacobian(lambda xi: ts[2].inverse() @ ts[1] @ SE3.exp(xi))
    J_robot = numerical_jacobian(lambda xi: (ts[2] @ SE3.exp(xi)).inverse() @ ts[1])
    expected = J_cup @ covs[1] @ J_cup.T + J_robot @ covs[2] @ J_robot.T
    assert np.allclose(cov, expected, atol=1e-6 * (1.0 + np.abs(expected).max()))


@law
@given(st.tuples(transforms, transforms, transforms))
def test_transforms_compose_along_any_third_frame(ts):
    graph = chain(ts, [np.zeros((6, 6))] * 3)
    frames = ("root", "room_1", "cup_1", "robot")
    for a in frames:
        assert graph.transform(a, a) == SE3.identity()
        for b in frames:
            assert graph.transform(a, b).is_close(graph.transform(b, a).inverse(), 1e-8)
            for c in frames:
                assert (graph.transform(a, b) @ graph.transform(b, c)).is_close(graph.transform(a, c), 1e-8)


def test_covariance_along_a_chain_agrees_with_sampling():
    rng = np.random.default_rng(7)
    ts = [SE3.exp(v) for v in ([1, 2, 0, 0, 0, 0.7], [2, -1, 0.5, 0.1, -0.2, 1.0], [0.5, 1, 0, 0, 0, -2.0])]
    covs = [random_covariance(i, 0.01) for i in range(3)]
    mean, cov = chain(ts, covs).transform_with_covariance("root", "cup_1")
    noise = [rng.multivariate_normal(np.zeros(6), c, size=4000) for c in covs[:2]]
    samples = [ts[0] @ SE3.exp(n0) @ ts[1] @ SE3.exp(n1) for n0, n1 in zip(*noise, strict=True)]
    errors = np.array([(mean.inverse() @ sample).log() for sample in samples])
    sampled = np.cov(errors.T)
    spread = np.sqrt(np.outer(np.diag(cov), np.diag(cov)))
    assert np.abs(sampled - cov).max() / spread.max() < 0.1
    points = np.array([sample.translation_m for sample in samples])
    assert np.allclose(np.cov(points.T), position_covariance(mean, cov), atol=0.1 * float(np.trace(np.cov(points.T))))


@law
@given(st.floats(-math.pi, math.pi), seeds)
def test_standard_deviation_of_a_position_does_not_depend_on_where_the_parent_stands(yaw, seed):
    cov = random_covariance(seed, 0.1)
    T = SE3.from_xyz_yaw(1.0, 2.0, 0.0, yaw)
    assert np.isclose(np.trace(position_covariance(T, cov)), np.trace(cov[:3, :3]))
