"""Frames of a robot behind rosbridge, compared with a composition of matrices."""

from __future__ import annotations

import numpy as np
import pytest

from drivers.rosbridge.errors import FrameStale, FrameUnknown
from drivers.rosbridge.frames import FrameTree
from drivers.rosbridge.profile import Mount
from scene_graph.geometry.se3 import SE3

T_base_mast = SE3.from_xyz_yaw(0.1, 0.2, 0.3, 0.5)


def test_a_chain_of_frames_is_composed_and_a_moving_one_interpolated():
    tree = FrameTree()
    tree.fix("base_link", "mast", T_base_mast)
    tree.put("/mast", "head", SE3.from_xyz_yaw(0, 0, 1.0, 0.0), 10.0)
    tree.put("mast", "/head", SE3.from_xyz_yaw(0, 0, 1.0, 0.4), 10.2)
    expected = T_base_mast.matrix() @ SE3.from_xyz_yaw(0, 0, 1.0, 0.1).matrix()
    np.testing.assert_allclose(tree.lookup("base_link", "head", 10.05).matrix(), expected, atol=1e-9)
    assert tree.lookup("base_link", "head", 10.6).is_close(T_base_mast @ SE3.from_xyz_yaw(0, 0, 1.0, 0.4))
    assert tree.lookup("base_link", "mast", 1e9).is_close(T_base_mast), "what is fixed never grows old"
    assert tree.lookup("base_link", "base_link", 0.0).is_close(SE3.identity())


def test_a_frame_that_nobody_told_of_is_named_with_those_that_are_known():
    tree = FrameTree()
    tree.fix("base_link", "mast", T_base_mast)
    with pytest.raises(FrameUnknown, match=r"'camera' is on 'base_link'; known: mast"):
        tree.lookup("base_link", "camera", 0.0)


def test_a_moving_frame_that_has_not_been_told_of_for_a_while_is_not_taken_to_be_where_it_was():
    tree = FrameTree()
    tree.put("base_link", "head", T_base_mast, 10.0)
    for stamp_s in (9.0, 11.0):
        with pytest.raises(FrameStale, match="head"):
            tree.lookup("base_link", "head", stamp_s)


def test_a_circle_of_frames_leads_nowhere():
    tree = FrameTree()
    tree.fix("a", "b", T_base_mast)
    tree.fix("b", "a", T_base_mast)
    with pytest.raises(FrameUnknown):
        tree.lookup("base_link", "a", 0.0)


def test_a_mount_turns_about_x_then_y_then_z_of_the_base():
    roll, pitch, yaw = 0.3, -0.4, 1.1
    turns = []
    for angle, (i, j) in ((roll, (1, 2)), (pitch, (2, 0)), (yaw, (0, 1))):
        turn = np.eye(3)
        turn[i, i] = turn[j, j] = np.cos(angle)
        turn[i, j], turn[j, i] = -np.sin(angle), np.sin(angle)
        turns.append(turn)
    mount = Mount(xyz=(1.0, 2.0, 3.0), rpy=(roll, pitch, yaw)).transform
    np.testing.assert_allclose(mount.rotation(), turns[2] @ turns[1] @ turns[0], atol=1e-12)
    np.testing.assert_allclose(mount.translation_m, (1.0, 2.0, 3.0))
