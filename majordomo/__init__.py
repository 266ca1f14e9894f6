"""Majordomo's public face: what a program, a skill's package or a robot's driver of others imports.

Everything else may move from one version to the next; these names stay.

- Programs that talk to a running service: ``Client``, ``AsyncClient``, what they answer with, and their errors.
- Packages with a skill (``docs/skills.md``): ``Skill``, ``Action`` and what these are made of; ``Rehearsal`` and
  ``Sketch`` to test them.
- Drivers of a robot (``docs/robot.md``): ``SensorPort`` and ``BodyPort``, together ``Robot``, with their measurements
  and commands; ``SimulatedRobot`` is one to read and to try.
- Readers of the scene graph (``docs/graph.md``): ``load_graph``, ``Snapshot`` and the nodes in it.
"""

from app.exchange.stored_graph import load_graph
from app.robot_port import Robot
from app.version import __version__
from client import (
    AsyncClient,
    Client,
    ClientError,
    Event,
    Forbidden,
    Invalid,
    Node,
    NoService,
    NotAllowedNow,
    NotFound,
    Refused,
    Scene,
    Service,
    Status,
    StillWaiting,
    Task,
    TooManyRequests,
    Trace,
    TraceEntry,
    Unauthorized,
    Unavailable,
    find_service,
)
from perception.errors import SensorSilent
from perception.ports import Intrinsics, JointState, LidarScan, Odometry, RgbdFrame, SensorPort
from perception.sensing import ray_directions_base
from planner.doubles.sketch import Sketch
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorNode, DoorState, ObjectNode, ObjectState, PersonNode, RobotNode, RoomNode
from scene_graph.snapshot import Snapshot
from simulation.process.client import SimulatedRobot
from skills.action import Action, RobotContext
from skills.doubles import Rehearsal
from skills.errors import BodySilent
from skills.facts import read_state
from skills.failures import Evidence, Failure, FailureCode
from skills.goto.journeys import visit
from skills.ports import ArmGeometry, ArmTarget, BodyLimits, BodyPort, BodyState
from skills.skill import Parameter, Skill, Unmet, argument_schema, unknown_arguments
from skills.state.state import PlanState

__all__ = [
    "SE3",
    "Action",
    "ArmGeometry",
    "ArmTarget",
    "AsyncClient",
    "BodyLimits",
    "BodyPort",
    "BodySilent",
    "BodyState",
    "Client",
    "ClientError",
    "DoorNode",
    "DoorState",
    "Event",
    "Evidence",
    "Failure",
    "FailureCode",
    "Forbidden",
    "Intrinsics",
    "Invalid",
    "JointState",
    "LidarScan",
    "NoService",
    "Node",
    "NotAllowedNow",
    "NotFound",
    "ObjectNode",
    "ObjectState",
    "Odometry",
    "Parameter",
    "PersonNode",
    "PlanState",
    "Refused",
    "Rehearsal",
    "RgbdFrame",
    "Robot",
    "RobotContext",
    "RobotNode",
    "RoomNode",
    "Scene",
    "SensorPort",
    "SensorSilent",
    "Service",
    "SimulatedRobot",
    "Sketch",
    "Skill",
    "Snapshot",
    "Status",
    "StillWaiting",
    "Task",
    "TooManyRequests",
    "Trace",
    "TraceEntry",
    "Unauthorized",
    "Unavailable",
    "Unmet",
    "__version__",
    "argument_schema",
    "find_service",
    "load_graph",
    "ray_directions_base",
    "read_state",
    "unknown_arguments",
    "visit",
]
