import math

import numpy as np
import pytest

from scene_graph.geometry.errors import InvalidTransform
from scene_graph.geometry.se3 import SE3, wrap_angle


def test_a_quarter_turn_maps_x_to_y():
    T_room_robot = SE3.from_xyz_yaw(1.0, 2.0, 0.0, math.pi / 2)
    assert np.allclose(T_room_robot.apply((1.0, 0.0, 0.0)), (1.0, 3.0, 0.0))


def test_a_turn_and_a_way_make_a_screw():
    a = SE3.exp((math.pi / 2, 0.0, 1.0, 0.0, 0.0, math.pi / 2))
    assert np.allclose(a.translation_m, (1.0, 1.0, 1.0))


def test_half_turns_about_every_axis_survive_exp_and_log():
    for axis in np.eye(3):
        xi = np.concatenate(((0.3, -0.2, 0.1), axis * math.pi))
        assert np.allclose(np.abs(SE3.exp(xi).log()[3:]), axis * math.pi)
        assert SE3.exp(SE3.exp(xi).log()).is_close(SE3.exp(xi), 1e-12)


def test_numbers_that_are_no_transform_are_refused():
    with pytest.raises(InvalidTransform, match="not a rotation matrix"):
        SE3.from_rotation(np.diag((1.0, 1.0, -1.0)))
    with pytest.raises(InvalidTransform, match="not a rotation matrix"):
        SE3.from_rotation(2.0 * np.eye(3))
    with pytest.raises(InvalidTransform, match="not a homogeneous"):
        SE3.from_matrix(np.ones((4, 4)))
    with pytest.raises(InvalidTransform, match="need shapes"):
        SE3((1.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    with pytest.raises(InvalidTransform, match="need shapes"):
        SE3.from_rotation(np.eye(2))
    with pytest.raises(InvalidTransform, match="six finite numbers"):
        SE3.exp((1.0, 2.0, 3.0))


def test_arrays_handed_in_are_copied_and_those_handed_out_are_read_only():
    translation = np.zeros(3)
    a = SE3(translation_m=translation)
    translation[0] = 7.0
    assert a == SE3.identity()
    with pytest.raises(ValueError, match="read-only"):
        a.quat_wxyz[0] = 0.0


def test_a_transform_cannot_be_changed():
    a = SE3.identity()
    with pytest.raises(AttributeError, match="immutable"):
        a.quat_wxyz = np.zeros(4)
    with pytest.raises(AttributeError, match="immutable"):
        del a.translation_m
    assert a != "identity"
    with pytest.raises(TypeError):
        a @ np.eye(4)


def test_negative_zero_is_zero():
    a = SE3((-0.0, -0.0, -0.0, -1.0), (-0.0, 0.0, 0.0))
    assert a == SE3((0.0, 0.0, 0.0, 1.0))
    assert hash(a) == hash(SE3((0.0, 0.0, 0.0, 1.0)))
    assert "-0.0" not in repr(a)


def test_minus_pi_wraps_to_pi():
    assert wrap_angle(-math.pi) == math.pi
    assert wrap_angle(3 * math.pi) == math.pi
    assert wrap_angle(np.array([-np.pi])).tolist() == [np.pi]
