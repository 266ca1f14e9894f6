"""Messages of ROS 1 and 2 are read alike, and what is none is named; profiles likewise."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from drivers.rosbridge.errors import BadMessage, BadProfile
from drivers.rosbridge.messages import CameraInfoMessage, Header, Joints, JointStateMessage, trajectory
from drivers.rosbridge.profile import read_profile
from paths import ROOT
from perception.errors import NoPicture
from perception.pictures import depth_of

EXAMPLE = ROOT / "examples" / "rosbridge" / "robot.toml"


@pytest.mark.parametrize("stamp", [{"sec": 12, "nanosec": 500_000_000}, {"secs": 12, "nsecs": 500_000_000}])
def test_stamps_of_ros_1_and_2_are_seconds(stamp):
    assert Header.read("/odom", {"stamp": stamp}).stamp == 12.5


@pytest.mark.parametrize("header", [{}, {"stamp": {}}, {"stamp": None}, {"stamp": {"sec": 1}}, {"stamp": "now"}])
def test_a_message_without_a_stamp_is_refused_and_named(header):
    with pytest.raises(BadMessage, match="/odom: stamp"):
        Header.read("/odom", header)


@pytest.mark.parametrize("key", ["k", "K"])
def test_a_cameras_lens_is_read_as_both_versions_write_it(key):
    lens = CameraInfoMessage.read("/info", {"width": 4, "height": 3, key: [5, 0, 2, 0, 6, 1, 0, 0, 1]}).intrinsics
    assert (lens.fx, lens.fy, lens.cx, lens.cy) == (5, 6, 2, 1)


def test_a_camera_that_was_not_calibrated_is_told_of():
    with pytest.raises(BadMessage, match="calibrated"):
        CameraInfoMessage.read("/info", {"width": 4, "height": 3, "k": [0] * 9})


def test_joints_are_gathered_from_several_messages():
    joints = Joints()
    for name, position in (("lift", 0.5), ("pan", 0.1), ("lift", 0.6)):
        told = {"header": {"stamp": {"sec": 1, "nanosec": 0}}, "name": [name], "position": [position], "effort": [None]}
        joints.take(JointStateMessage.read("/joint_states", told), 1.0)
    assert joints.position == {"lift": 0.6, "pan": 0.1}


def test_a_trajectory_says_when_it_is_to_be_over():
    [point] = trajectory({"lift": 0.4}, 2.25, ros=2)["points"]
    assert point == {"positions": [0.4], "time_from_start": {"sec": 2, "nanosec": 250_000_000}}
    [point] = trajectory({"lift": 0.4}, 2.25, ros=1)["points"]
    assert point["time_from_start"] == {"secs": 2, "nsecs": 250_000_000}


@pytest.mark.parametrize("before", [b"", bytes(12)])
def test_depth_is_read_in_meters_with_or_without_what_ros_puts_before(before):
    millimeters = np.array([[0, 1234], [65535, 7]], dtype=np.uint16)
    png = cv2.imencode(".png", millimeters)[1].tobytes()
    np.testing.assert_allclose(depth_of(before + png), [[0.0, 1.234], [65.535, 0.007]], rtol=1e-6)


def test_a_color_picture_is_no_depth():
    with pytest.raises(NoPicture):
        depth_of(cv2.imencode(".png", np.zeros((2, 2, 3), np.uint8))[1].tobytes())
    with pytest.raises(NoPicture):
        depth_of(b"nothing")


def test_the_example_is_a_profile_and_its_limits_are_the_bodys():
    profile = read_profile(EXAMPLE)
    assert profile.body_limits.linear_mps == 0.5
    assert profile.joint_names[:2] == ("lift_joint", "extension_joint")


def test_without_an_arm_nothing_is_in_reach(tmp_path):
    (tmp_path / "robot.toml").write_text('[lidar]\ntopic = "/points"\n')
    assert read_profile(tmp_path / "robot.toml").body_limits.extension_m == (0.0, 0.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "lidar: Field required"),
        ("[lidar", "no TOML"),
        ('[lidar]\ntopic = "/points"\n[limits]\nlinear_mps = -1', "limits.linear_mps"),
        ('[lidar]\ntopic = "/points"\nspeed = 3', "lidar.speed"),
        ('url = "http://robot"\n[lidar]\ntopic = "/points"', "url"),
    ],
)
def test_a_faulty_profile_is_refused_with_its_field(tmp_path, text, said):
    (tmp_path / "robot.toml").write_text(text)
    with pytest.raises(BadProfile, match=said):
        read_profile(tmp_path / "robot.toml")


def test_a_profile_that_is_not_there_is_named(tmp_path):
    with pytest.raises(BadProfile, match=r"nowhere\.toml: No such file"):
        read_profile(tmp_path / "nowhere.toml")
