"""Laws of rigid transforms, and agreement with matrix exponentials computed by scipy."""

import copy
import math
import pickle

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from scene_graph.geometry.errors import InvalidTransform
from scene_graph.geometry.rotation import skew
from scene_graph.geometry.se3 import SE3, wrap_angle

law = settings(max_examples=100)

meters = st.floats(-50.0, 50.0)
small_and_large = st.one_of(st.floats(-1.0, 1.0), st.floats(-1e-9, 1e-9), st.just(0.0))
directions = st.tuples(small_and_large, small_and_large, small_and_large)
angles = st.one_of(
    st.floats(0.0, math.pi),
    st.floats(0.0, 1e-7),
    st.floats(math.pi - 1e-7, math.pi),
    st.floats(0.09, 0.11),
    st.just(0.0),
)


@st.composite
def rotation_vectors(draw):
    direction = np.array(draw(directions))
    norm = np.linalg.norm(direction)
    assume(norm > 1e-12)
    return direction / norm * draw(angles)


@st.composite
def tangents(draw):
    return np.concatenate(([draw(meters), draw(meters), draw(meters)], draw(rotation_vectors())))


transforms = tangents().map(SE3.exp)


def hat(xi):
    M = np.zeros((4, 4))
    M[:3, :3] = skew(xi[3:])
    M[:3, 3] = xi[:3]
    return M


@law
@given(transforms, transforms, transforms)
def test_composition_is_associative(a, b, c):
    assert ((a @ b) @ c).is_close(a @ (b @ c), 1e-9)


@law
@given(transforms)
def test_identity_changes_nothing(a):
    assert a @ SE3.identity() == a
    assert SE3.identity() @ a == a


@law
@given(transforms)
def test_a_transform_and_its_inverse_cancel(a):
    assert (a @ a.inverse()).is_close(SE3.identity(), 1e-9)
    assert (a.inverse() @ a).is_close(SE3.identity(), 1e-9)


@law
@given(transforms)
def test_inverting_twice_gives_the_transform_back(a):
    assert a.inverse().inverse().is_close(a, 1e-9)


@law
@given(transforms, transforms)
def test_composition_is_the_product_of_matrices(a, b):
    assert np.allclose((a @ b).matrix(), a.matrix() @ b.matrix(), atol=1e-9)


@law
@given(transforms, transforms)
def test_products_stay_unit_quaternions_with_positive_scalar_part(a, b):
    quat = (a @ b).quat_wxyz
    assert math.isclose(float(quat @ quat), 1.0, abs_tol=1e-14)
    assert quat[0] >= 0.0


@law
@given(tangents())
def test_exp_is_the_matrix_exponential(xi):
    assert np.allclose(SE3.exp(xi).matrix(), expm(hat(xi)), atol=1e-8)


@law
@given(tangents())
def test_log_inverts_exp(xi):
    back = SE3.exp(xi).log()
    if np.linalg.norm(xi[3:]) < math.pi - 1e-6:
        assert np.allclose(back, xi, atol=1e-7)
    assert SE3.exp(back).is_close(SE3.exp(xi), 1e-8)


@law
@given(transforms)
def test_exp_inverts_log(a):
    assert SE3.exp(a.log()).is_close(a, 1e-9)


@law
@given(rotation_vectors())
def test_rotations_agree_with_scipy(theta):
    ours = SE3.exp(np.concatenate((np.zeros(3), theta)))
    assert np.allclose(ours.rotation(), Rotation.from_rotvec(theta).as_matrix(), atol=1e-12)
    assert SE3.from_rotation(Rotation.from_rotvec(theta).as_matrix()).is_close(ours, 1e-7)


@law
@given(transforms, tangents())
def test_adjoint_carries_a_perturbation_from_right_to_left(a, xi):
    xi = xi / 50.0
    assert (a @ SE3.exp(xi)).is_close(SE3.exp(a.adjoint() @ xi) @ a, 1e-7)


@law
@given(transforms, transforms)
def test_adjoint_of_a_product_is_the_product_of_adjoints(a, b):
    assert np.allclose((a @ b).adjoint(), a.adjoint() @ b.adjoint(), atol=1e-8)


@law
@given(transforms)
def test_matrices_and_arrays_rebuild_the_transform(a):
    assert SE3.from_matrix(a.matrix()).is_close(a, 1e-7)
    assert SE3(a.quat_wxyz, a.translation_m) == a
    assert SE3(-a.quat_wxyz, a.translation_m) == a
    assert pickle.loads(pickle.dumps(a)) == copy.deepcopy(a) == a
    assert hash(SE3(a.quat_wxyz, a.translation_m)) == hash(a)


@law
@given(transforms, st.lists(st.tuples(meters, meters, meters), min_size=1, max_size=4))
def test_applying_maps_points_like_the_homogeneous_matrix(a, points):
    homogeneous = np.concatenate((np.array(points), np.ones((len(points), 1))), axis=1)
    assert np.allclose(a.apply(points), (homogeneous @ a.matrix().T)[:, :3], atol=1e-9)
    assert a.apply(np.array(points)[:, None, :]).shape == (len(points), 1, 3)


@law
@given(meters, meters, meters, st.floats(-math.pi, math.pi))
def test_xyz_and_yaw_are_read_back(x, y, z, yaw):
    a = SE3.from_xyz_yaw(x, y, z, yaw)
    assert (a.x_m, a.y_m, a.z_m) == (x, y, z)
    assert abs(wrap_angle(a.yaw_rad - yaw)) < 1e-12


@law
@given(st.floats(-1e4, 1e4))
def test_wrapped_angles_lie_in_one_turn_and_mean_the_same(angle):
    wrapped = wrap_angle(angle)
    assert -math.pi < wrapped <= math.pi
    assert math.isclose(math.cos(wrapped), math.cos(angle), abs_tol=1e-9)
    assert math.isclose(math.sin(wrapped), math.sin(angle), abs_tol=1e-9)
    assert wrap_angle(wrapped) == wrapped
    assert np.allclose(np.exp(1j * wrap_angle(np.array([angle]))), np.exp(1j * wrapped), atol=1e-9)


@law
@given(st.lists(st.sampled_from([0.0, 1.0, math.nan, math.inf, -math.inf]), min_size=7, max_size=7))
def test_only_finite_transforms_with_a_direction_exist(numbers):
    quat, translation = numbers[:4], numbers[4:]
    if np.isfinite(numbers).all() and any(quat):
        assert np.allclose(np.linalg.norm(SE3(quat, translation).quat_wxyz), 1.0)
    else:
        with pytest.raises(InvalidTransform):
            SE3(quat, translation)
