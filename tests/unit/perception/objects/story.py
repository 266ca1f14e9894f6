"""A scripted room, the agent of the objects, and a clock."""

import asyncio
from dataclasses import replace

import numpy as np

from perception.objects.agent import ObjectMemory
from perception.objects.doubles.raycast import Solid
from perception.objects.doubles.scripted import NoSensors, ScriptedRoom, furnished_memory, say
from perception.ports import JointState
from perception.sensing import SensorBuffer
from scene_graph.edits import PutEdge
from scene_graph.geometry.se3 import SE3

TABLE = Solid(label="table", center=(0.0, 0.0, 0.375), size_m=(1.2, 0.8, 0.75), color=(120.0, 75.0, 40.0))


BLUE_BOTTLE = Solid(
    label="bottle", center=(-0.2, 0.1, 0.87), size_m=(0.07, 0.07, 0.24), cylinder=True, color=(30.0, 60.0, 200.0)
)


RED_CUP = Solid(
    label="cup", center=(0.0, -0.2, 0.80), size_m=(0.08, 0.08, 0.10), cylinder=True, color=(200.0, 30.0, 30.0)
)


class Story:
    """A scripted room, the agent, and a clock."""

    def __init__(self, solids, rooms=1, **script):
        self.room = ScriptedRoom(list(solids), **script)
        self.memory = furnished_memory(rooms)
        self.buffer = SensorBuffer(NoSensors())
        self.agent = ObjectMemory(self.memory, self.buffer, self.room, random=np.random.default_rng(3))
        self.pose_error = SE3.identity()
        self.pose_std_rad = 0.0063
        self.now_s = 0.0

    def run(self, steps):
        async def stepping():
            for _ in range(steps):
                self.now_s = round(self.now_s + 0.2, 3)
                self.room.locate(self.memory, self.now_s, error=self.pose_error, std_rad=self.pose_std_rad)
                self.room.fill(self.buffer, self.now_s)
                await self.agent.step(self.now_s)

        asyncio.run(stepping())
        return self.memory.snapshot()

    def agent_only(self, steps):
        """The agent's steps, without new measurements."""

        async def stepping():
            for _ in range(steps):
                self.now_s = round(self.now_s + 0.2, 3)
                await self.agent.step(self.now_s)

        asyncio.run(stepping())

    def wait(self, seconds):
        self.now_s += seconds


def finish(story, target, status, reason=""):
    (edge,) = [e for e in story.memory.snapshot().intentions() if e.target == target]
    story.memory.commit([PutEdge(replace(edge, status=status, reason=reason))], agent="robot_body", stamp_s=story.now_s)


def joints(position, contacts=(False, False), opening_m=0.12, extension_m=0.3):
    return JointState(
        stamp_s=0.0, lift_m=position[2], extension_m=extension_m, wrist_pitch_rad=0.0, wrist_roll_rad=0.0,
        gripper_opening_m=opening_m, pan_rad=0.0, tilt_rad=0.0, finger_contacts=contacts,
        T_base_gripper=SE3(translation_m=position),
    )  # fmt: skip


def grasped():
    """A story in which the robot holds bottle_1 and has driven away from the table."""
    story = Story([TABLE, BLUE_BOTTLE, RED_CUP])
    graph = story.run(6)
    at_bottle = graph.position("bottle_1", "robot")
    say(story.memory, "grasping bottle_1", story.now_s)
    story.room.joints = joints(at_bottle, (True, True), 0.068)
    story.run(3)
    story.room.solids = [TABLE, RED_CUP]
    story.room.eye = (-1.6, 0.0)
    story.room.joints = joints((0.4, 0.0, 0.9), (True, True), 0.068)
    say(story.memory, "driving table_1", story.now_s)
    return story
