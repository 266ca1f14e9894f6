"""What the service and the simulator's process say to each other."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import Any

from perception.ports import JointState, Odometry
from simulation.robot.description import RobotDescription
from simulation.world.physics import PhysicsSettings
from skills.ports import BodyState


class Mode(StrEnum):
    """``lockstep``: time moves only when told. ``real``: the simulator follows the wall clock."""

    LOCKSTEP = "lockstep"
    REAL = "real"


@dataclass(frozen=True, kw_only=True)
class Start:
    """How the child begins. ``house``: its JSON text. ``speed``: simulated seconds per wall second in real mode."""

    house: str
    seed: int
    mode: Mode
    speed: float
    robot: RobotDescription = field(default_factory=RobotDescription)
    physics: PhysicsSettings = field(default_factory=PhysicsSettings)


@dataclass(frozen=True, kw_only=True)
class Request:
    """Call ``method`` of the engine, after the commands that were given ``before``."""

    method: str
    args: tuple[Any, ...] = ()
    before: tuple[Request, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Readings:
    """What the robot's body measures at one instant: true until time moves or something is moved by hand."""

    odometry: Odometry
    joints: JointState
    state: BodyState


@dataclass(frozen=True, kw_only=True)
class Reply:
    """What came of it. ``problem`` is set, and ``value`` is not, when the engine refused.

    ``readings``: with every advance, so that asking for them costs no further message.
    """

    value: Any = None
    problem: str = ""
    now_s: float = 0.0
    readings: Readings | None = None
