"""Actions: what a skill is made of. Each is a py_trees behaviour ticked by the executor at its control rate.

An action reads the graph and the body's state from the shared ``RobotContext`` and leaves commands in it; it never
waits.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import py_trees
from numpy.typing import NDArray
from py_trees.common import Status

from scene_graph.edits import PutNode
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.snapshot import Snapshot
from skills.arm.hand import Hand
from skills.failures import Evidence, Failure, FailureCode
from skills.obstacles.floor_relief import FloorRelief
from skills.obstacles.surroundings import Surroundings
from skills.ports import NO_FLOOR, ArmGeometry, ArmTarget, BodyLimits, BodyPort, BodyState, FloorReturns
from skills.settings import SkillSettings

AGENT = "robot_body"
"""Name under which actions edit the graph."""


@dataclass(kw_only=True)
class Commands:
    """Commands collected during one tick; the newest of each kind wins."""

    drive: tuple[float, float] | None = None
    look: tuple[float, float] | None = None
    arm: ArmTarget | None = None
    grip: tuple[float, float] | None = None

    async def flush(self, body: BodyPort) -> None:
        """Send what was collected and forget it."""
        if self.drive is not None:
            await body.drive(*self.drive)
        if self.look is not None:
            await body.look(*self.look)
        if self.arm is not None:
            await body.move_arm(self.arm)
        if self.grip is not None:
            await body.grip(*self.grip)
        self.drive = self.look = self.arm = self.grip = None


@dataclass(frozen=True, kw_only=True)
class Grip:
    """What the fingers closed on: the object and its frame seen from the gripper, as it was when they closed."""

    object_id: str
    T_gripper_object: SE3
    size_m: tuple[float, float, float]


def _nothing_seen() -> NDArray[np.float64]:
    return np.zeros((0, 3))


@dataclass(kw_only=True)
class RobotContext:
    """What actions share: the graph, the body as measured at this tick, raw obstacle points, and the commands to send.

    ``settings``: what the skills go by where they were tuned. ``obstacles_base``: (N, 3), base frame; ``floor_base``:
    what may rise a little from the floor. ``seen_base``: gives the points (N, 3), base frame, that the depth camera saw
    last. ``path_room``: the path being followed, for display, current room's frame. ``surroundings`` remembers obstacle
    points, ``grip`` what the fingers hold, ``blocked_doors`` in which doors something stood, and when,
    ``blocked_spots`` over which points of which node the arm was stopped as it put something down, and when,
    ``blocked_reaches`` from which side of which node (the base's bearing from it, in its room) it was stopped as it
    reached for it, or did not see it, and when; they outlive a single action.
    """

    memory: WorkingMemory
    limits: BodyLimits
    geometry: ArmGeometry
    body: BodyState
    settings: SkillSettings = field(default_factory=SkillSettings)
    stamp_s: float = 0.0
    obstacles_base: NDArray[np.float64] = field(default_factory=lambda: np.zeros((0, 3)))
    floor_base: FloorReturns = NO_FLOOR
    seen_base: Callable[[], NDArray[np.float64]] = _nothing_seen
    commands: Commands = field(default_factory=Commands)
    path_room: tuple[tuple[float, float], ...] = ()
    surroundings: Surroundings = field(init=False)
    grip: Grip | None = None
    blocked_doors: dict[str, float] = field(default_factory=dict)
    blocked_spots: dict[tuple[str, tuple[float, float, float]], float] = field(default_factory=dict)
    blocked_reaches: dict[tuple[str, float], float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Nothing was hit yet."""
        settings = self.settings.obstacles
        relief = FloorRelief(settings=settings.relief)
        self.surroundings = Surroundings(settings=settings.surroundings, relief=relief)

    @property
    def hand(self) -> Hand:
        """The hand as the robot's description has it, with the margins that are kept to it."""
        return Hand(geometry=self.geometry, limits=self.limits, settings=self.settings.hand)

    def is_lately(self, since_s: float) -> bool:
        """Whether what stopped base or arm then is expected to be there still."""
        return self.stamp_s - since_s < self.settings.blocked_s

    @property
    def snapshot(self) -> Snapshot:
        """What is loaded now: enough for whatever is done in the robot's room, and cheap enough for every tick."""
        return self.memory.snapshot()

    @property
    def building(self) -> Snapshot:
        """Everything known, for what leads beyond the robot's surroundings."""
        return self.memory.building()

    def announce(self, status: str) -> None:
        """Say in the graph what the robot does (``RobotNode.status``)."""
        robot = self.snapshot.robot
        if robot is not None and robot.status != status:
            self.memory.commit([PutNode(replace(robot, status=status))], agent=AGENT, stamp_s=self.stamp_s)


class Action(py_trees.behaviour.Behaviour):
    """One action. ``update`` returns RUNNING, SUCCESS, or FAILURE with ``failure`` set; ``terminate`` leaves the body
    safe.

    A subclass gives ``step``, and ``begin`` when it has something to prepare. It fails with TIMEOUT after
    ``timeout_s``.
    """

    timeout_s: float = 60.0
    holds_arm: bool = False
    """Whether an interruption must freeze the arm where it is."""

    def __init__(self, name: str, context: RobotContext) -> None:
        super().__init__(name)
        self.context = context
        self.failure: Failure | None = None
        self.started_s = self._last_s = 0.0

    def begin(self) -> None:
        """Prepare; called once before the first ``step``."""

    def step(self) -> Status:
        """One control tick."""
        raise NotImplementedError

    def initialise(self) -> None:
        """Start the clock and prepare (py_trees)."""
        self.failure = None
        self.started_s = self._last_s = self.context.stamp_s
        self.begin()

    def update(self) -> Status:
        """One tick (py_trees)."""
        passed_s, self._last_s = self.context.stamp_s - self._last_s, self.context.stamp_s
        if self.context.body.stopped:
            self.started_s += passed_s
            return Status.RUNNING
        if self.elapsed_s > self.timeout_s:
            return self.fail(FailureCode.TIMEOUT, f"{self.name} took longer than {self.timeout_s:.0f} s.")
        status = self.step()
        self._carry_gently()
        return status

    def terminate(self, new_status: Status) -> None:
        """Stand still; when interrupted, freeze the arm where it is."""
        self.context.commands.drive = (0.0, 0.0)
        if new_status is Status.INVALID and self.holds_arm:
            self.context.commands.arm = self.context.body.arm

    def _carry_gently(self) -> None:
        """With something in the hand, speed up slowly; slowing down is never delayed."""
        context = self.context
        if context.grip is None or context.commands.drive is None:
            return
        now = (context.body.linear_mps, context.body.angular_radps)
        settings = context.settings.navigation
        top = (settings.carry_share * limit for limit in (context.limits.linear_mps, context.limits.angular_radps))
        wanted = (_clip(v, limit) for v, limit in zip(context.commands.drive, top, strict=True))
        steps = (settings.carry_step_mps, settings.carry_step_radps)
        linear, angular = (_gently(v, was, step) for v, was, step in zip(wanted, now, steps, strict=True))
        context.commands.drive = (linear, angular)

    @property
    def elapsed_s(self) -> float:
        """Seconds since the action began."""
        return self.context.stamp_s - self.started_s

    def fail(self, code: FailureCode, message: str, nodes: Sequence[str] = (), observation: str = "") -> Status:
        """Record why, and return FAILURE."""
        revision = self.context.snapshot.revision
        evidence = Evidence(nodes=tuple(nodes), revision=revision, observation=observation)
        self.failure = Failure(code=code, message=message, evidence=evidence)
        self.feedback_message = message
        return Status.FAILURE


class Refusal(Action):
    """Fails at once: what a skill returns when the graph says that it cannot be carried out."""

    def __init__(self, context: RobotContext, failure: Failure) -> None:
        super().__init__(f"refuse: {failure.message}", context)
        self._refusal = failure

    def step(self) -> Status:
        """Report the failure."""
        self.failure = self._refusal
        return Status.FAILURE


def _clip(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)


def _gently(wanted: float, now: float, step: float) -> float:
    """``wanted``, but not faster than ``now`` by more than ``step``; a change of direction starts from rest."""
    if wanted * now < 0:
        return _clip(wanted, step)
    return _clip(wanted, abs(now) + step)
