"""The flat with things in it, and tasks, as evaluations of missions find them."""

from __future__ import annotations

from evaluations.missions.outcome import Scene
from planner.tasks.tasks import Task, TaskStatus, TaskTimes
from simulation.houses.house_file import load_house

FLAT = load_house("flat")

CUP = {"id": "cup_1", "category": "cup", "color": "red", "position_m": [1.0, 1.0, 0.8], "room": "kitchen", "in": None}

CUP_ON_TABLE = {**CUP, "on": "table_1"}


def scene(*objects, holding=None, pose=None, shut=()):
    doors = [{"id": door.id, "state": "closed" if door.id in shut else "open"} for door in FLAT.doors]
    people = [{"id": person.id, "position_m": list(person.pose[:2])} for person in FLAT.people]
    robot = {"pose": list(pose or FLAT.robot.pose), "holding": holding}
    truth = {"objects": list(objects), "robot": robot, "people": people, "doors": doors, "collisions": 0}
    return Scene(house=FLAT, truth=truth)


def task(status=TaskStatus.SUCCEEDED, reply=""):
    return Task(id="task_1", request="", times=TaskTimes(received_s=0.0), status=status, reply=reply)
