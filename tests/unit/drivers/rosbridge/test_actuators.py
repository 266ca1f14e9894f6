"""What actuators are told: clipped, no faster than the profile says, once, and in the words of the robot's ROS."""

from __future__ import annotations

import math

import pytest

from drivers.rosbridge.actuators import Actuators
from drivers.rosbridge.messages import Joints
from drivers.rosbridge.profile import read_profile
from guide import ROOT
from skills.ports import ArmTarget

PROFILE = read_profile(ROOT / "examples" / "rosbridge" / "robot.toml")
ARM = PROFILE.arm


class Sent:
    """In place of a connection: what was sent."""

    def __init__(self):
        self.messages = []

    def publish(self, topic, message):
        self.messages.append((topic, message))

    def send_goal(self, action, kind, goal):
        self.messages.append((action, {"kind": kind, **goal}))


@pytest.fixture
def sent():
    return Sent()


@pytest.fixture
def joints():
    return Joints(stamp_s=1.0, position=dict.fromkeys(PROFILE.joint_names, 0.0))


def test_an_arm_goes_no_farther_than_its_limits_and_takes_its_time(sent, joints):
    actuators = Actuators(PROFILE, sent)
    actuators.move_arm(ArmTarget(lift_m=9.0, extension_m=math.nan, wrist_pitch_rad=-9.0), joints)
    [(topic, message)] = sent.messages
    assert (topic, message["joint_names"]) == (ARM.topic, [ARM.lift, ARM.extension, ARM.wrist_pitch, ARM.wrist_roll])
    [point] = message["points"]
    assert point["positions"] == [1.3, 0.0, -1.5708, 0.0]
    time = point["time_from_start"]
    assert time["sec"] + 1e-9 * time["nanosec"] == pytest.approx(1.3 / 0.25), "the lift has the longest way"


def test_the_same_is_told_once_until_it_is_forgotten(sent, joints):
    actuators = Actuators(PROFILE, sent)
    for _ in range(3):
        actuators.look(0.5, -0.2, joints)
        actuators.grip(0.05, 99.0)
    assert len(sent.messages) == 2
    assert sent.messages[1][1]["command"] == {"position": 0.05, "max_effort": 40.0}
    actuators.forget()
    actuators.look(0.5, -0.2, joints)
    assert len(sent.messages) == 3


def test_to_hold_is_to_be_where_one_is_and_joints_that_were_not_heard_are_left_alone(sent, joints):
    actuators = Actuators(PROFILE, sent)
    joints.position[ARM.lift] = 0.7
    actuators.hold(joints)
    assert sent.messages[0][1]["points"][0]["positions"] == [0.7, 0.0, 0.0, 0.0]
    sent.messages.clear()
    actuators.hold(Joints())
    assert sent.messages == []


def test_in_ros_1_a_grippers_goal_is_a_message(sent):
    old = PROFILE.model_copy(update={"ros": 1})
    Actuators(old, sent).grip(0.03, 5.0)
    topic = f"{PROFILE.gripper.action}/goal"
    assert sent.messages == [(topic, {"goal": {"command": {"position": 0.03, "max_effort": 5.0}}})]
    assert Actuators.topics(old)[topic] == "control_msgs/GripperCommandActionGoal"


def test_a_robot_without_limbs_says_that_they_rest_and_is_told_nothing(sent):
    bare = PROFILE.model_copy(update={"arm": None, "head": None, "gripper": None})
    actuators = Actuators(bare, sent)
    actuators.move_arm(ArmTarget(lift_m=0.5, extension_m=0.1), Joints())
    actuators.look(0.1, 0.1, Joints())
    actuators.grip(0.02, 3.0)
    actuators.hold(Joints())
    assert (sent.messages, actuators.measured(Joints()).finger_contacts) == ([], (False, False))


def test_a_finger_feels_something_when_its_joint_works_hard(sent, joints):
    joints.effort = dict(zip(PROFILE.gripper.fingers, (-3.0, 0.5), strict=True))
    assert Actuators(PROFILE, sent).measured(joints).finger_contacts == (True, False)
