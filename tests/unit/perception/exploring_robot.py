"""A robot in a house of faces: sensor port, noisy odometry, and a small arbiter and executor in one."""

from __future__ import annotations

import asyncio
import heapq
import math
import time
from dataclasses import dataclass, field, replace
from typing import Protocol

import numpy as np

from perception.errors import SensorSilent
from perception.geometry.planar import Pose2, wrap
from perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from perception.sensing import Sensing, SensorBuffer
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, AffordanceNode, DoorNode
from unit.perception.lidar_house import Array, House, cast

STEP_S = 0.1
SPEED_MPS = 0.5
TURN_RADPS = 1.0


class Agent(Protocol):
    name: str

    async def step(self, stamp_s: float) -> None: ...


@dataclass(kw_only=True)
class HousePort:
    """Sensors of a robot at ``pose``; odometry is off by a constant share of way and turn, and by white noise."""

    house: House
    pose: Pose2
    rng: np.random.Generator
    sigma_m: float = 0.02
    way_error: float = 0.01
    turn_error: float = 0.01
    stamp_s: float = 0.0
    dead_reckoned: Pose2 = field(default_factory=Pose2.identity)
    way_m: float = 0.0

    def move(self, forward_m: float, turn_rad: float) -> None:
        step = Pose2(forward_m * math.cos(turn_rad / 2), forward_m * math.sin(turn_rad / 2), turn_rad)
        self.pose = self.pose @ step
        self.way_m += abs(forward_m)
        way = forward_m * (1.0 + self.way_error + self.rng.normal(0.0, 0.05))
        turn = turn_rad * (1.0 + self.turn_error + self.rng.normal(0.0, 0.05))
        self.dead_reckoned = self.dead_reckoned @ Pose2(way * math.cos(turn / 2), way * math.sin(turn / 2), turn)

    async def odometry(self) -> Odometry:
        believed = self.dead_reckoned
        return Odometry(
            stamp_s=self.stamp_s,
            x_m=believed.x_m,
            y_m=believed.y_m,
            yaw_rad=believed.yaw_rad,
            linear_mps=0.0,
            angular_radps=0.0,
        )

    async def scan(self) -> LidarScan:
        return cast(self.house, self.pose, self.rng, sigma_m=self.sigma_m, stamp_s=self.stamp_s)

    async def frame(self) -> RgbdFrame:
        raise SensorSilent("frame", 0.1)

    async def joints(self) -> JointState:
        return JointState(
            stamp_s=self.stamp_s,
            lift_m=0.75,
            extension_m=0.0,
            wrist_pitch_rad=-1.57,
            wrist_roll_rad=0.0,
            gripper_opening_m=0.1,
            pan_rad=0.0,
            tilt_rad=0.0,
            finger_contacts=(False, False),
            T_base_gripper=SE3.identity(),
        )


class Driver:
    """Grants one intention at a time, highest priority first, and drives there along a way that is free in truth.

    Targets in ``refused`` cannot be reached.
    """

    def __init__(self, memory: WorkingMemory, port: HousePort) -> None:
        self.memory = memory
        self.port = port
        self.way: list[Array] = []
        self.current: HasIntentionEdge | None = None
        self.finished: list[tuple[float, str, str, str]] = []
        self.refused: set[str] = set()

    def step(self) -> None:
        self._revoke()
        intention = self._granted() or self._grant()
        if intention is None:
            self.current = None
            return
        if self.current is None or self.current.key != intention.key or self.current.proposed_s != intention.proposed_s:
            self.current = intention
            goal = self._goal(intention)
            way = find_way(self.port.house, self.port.pose.position_m, goal)
            if way is None or intention.target in self.refused:
                self._finish(intention, IntentionStatus.FAILED, "no way")
                return
            self.way = way
        if self._drive():
            self._finish(intention, IntentionStatus.DONE, "")

    def _granted(self) -> HasIntentionEdge | None:
        return next(iter(self.memory.snapshot().intentions(IntentionStatus.GRANTED)), None)

    @property
    def _lost(self) -> bool:
        robot = self.memory.snapshot().robot
        return robot is not None and not robot.localized

    def _proposed(self) -> list[HasIntentionEdge]:
        """What may be granted: a lost robot only looks around from where it is."""
        proposed = self.memory.snapshot().intentions(IntentionStatus.PROPOSED)
        return [edge for edge in proposed if not self._lost or edge.target == ROBOT_ID]

    def _revoke(self) -> None:
        """A higher priority interrupts, and so does being lost; what was interrupted is proposed again."""
        granted = self._granted()
        outranked = granted is not None and any(edge.priority > granted.priority for edge in self._proposed())
        if granted is not None and (outranked or (self._lost and granted.target != ROBOT_ID)):
            self._put(replace(granted, status=IntentionStatus.PROPOSED))
            self.current = None

    def _grant(self) -> HasIntentionEdge | None:
        proposed = self._proposed()
        if not proposed:
            return None
        best = min(proposed, key=lambda edge: (-edge.priority, self._distance(edge), edge.target))
        granted = replace(best, status=IntentionStatus.GRANTED)
        self._put(granted)
        return granted

    def _distance(self, edge: HasIntentionEdge) -> float:
        return float(np.linalg.norm(self._goal(edge) - self.port.pose.position_m))

    def _goal(self, edge: HasIntentionEdge) -> Array:
        """Where to drive, in the house: the robot's true pose and what it believes about the target."""
        if edge.target == ROBOT_ID:
            return self._middle()
        snapshot = self.memory.snapshot()
        target, point = edge.target, (0.0, edge.standoff_m, 0.0)
        node = snapshot.get(target)
        if isinstance(node, AffordanceNode):
            target = node.target
        if edge.action is IntentionAction.CROSS:
            point = (0.0, -0.9, 0.0)
        elif not isinstance(node, DoorNode):
            point = (0.0, 0.0, 0.0)
        local = snapshot.transform(ROBOT_ID, target).apply(np.array(point))
        return self.port.pose.apply(local[:2])

    def _middle(self) -> Array:
        """The middle of the room that the robot is in, in truth."""
        return min(
            (polygon.mean(axis=0) for polygon in self.port.house.rooms.values()),
            key=lambda middle: float(np.linalg.norm(middle - self.port.pose.position_m)),
        )

    def _drive(self) -> bool:
        budget_s = STEP_S
        while self.way and budget_s > 1e-6:
            offset = self.way[0] - self.port.pose.position_m
            distance = float(np.linalg.norm(offset))
            if distance < 0.03:
                self.way.pop(0)
                continue
            error = wrap(math.atan2(offset[1], offset[0]) - self.port.pose.yaw_rad)
            if abs(error) > 0.3:
                turn = math.copysign(min(abs(error), TURN_RADPS * budget_s), error)
                self.port.move(0.0, turn)
                budget_s -= abs(turn) / TURN_RADPS
            else:
                forward = min(distance, SPEED_MPS * budget_s)
                turn = max(min(error, TURN_RADPS * budget_s), -TURN_RADPS * budget_s)
                self.port.move(forward, turn)
                budget_s -= max(forward / SPEED_MPS, 1e-3)
        return not self.way

    def _finish(self, intention: HasIntentionEdge, status: IntentionStatus, reason: str) -> None:
        self.finished.append((self.port.stamp_s, intention.action.value, intention.target, status.value))
        self._put(replace(intention, status=status, reason=reason))
        self.current = None

    def _put(self, edge: HasIntentionEdge) -> None:
        with self.memory.edit("driver", self.port.stamp_s) as tx:
            tx.put(edge)


def find_way(
    house: House, start: Array, goal: Array, *, cell_m: float = 0.1, radius_m: float = 0.30
) -> list[Array] | None:
    """A* over a grid of places that are free in truth; the goal is replaced by the nearest free cell within 0.6 m."""
    faces = house.faces()
    faces = faces[faces[:, 4] < 1.7]
    low = np.minimum(faces[:, [0, 1]].min(axis=0), faces[:, [2, 3]].min(axis=0)) - 2.5
    high = np.maximum(faces[:, [0, 1]].max(axis=0), faces[:, [2, 3]].max(axis=0)) + 2.5
    shape = np.ceil((high - low) / cell_m).astype(int)
    grid = np.stack(np.meshgrid(*[np.arange(n) for n in shape], indexing="ij"), axis=-1) * cell_m + low
    clearance = np.full(tuple(shape), np.inf)
    for x0, y0, x1, y1, _, _ in faces:
        edge = np.array([x1 - x0, y1 - y0])
        offset = grid - np.array([x0, y0])
        station = np.clip((offset @ edge) / (edge @ edge), 0.0, 1.0)
        clearance = np.minimum(clearance, np.linalg.norm(offset - station[..., None] * edge, axis=-1))
    free = clearance > radius_m
    first, last = _cell(start, low, cell_m), _cell(goal, low, cell_m)
    free[first] = True
    if not free[last]:
        near = np.linalg.norm(grid - goal, axis=-1) + np.where(free, 0.0, np.inf)
        last = tuple(int(i) for i in np.unravel_index(int(np.argmin(near)), near.shape))
        if near[last] > 0.6:
            return None
        goal = grid[last]
    cells = _search(free, clearance, first, last)
    if cells is None:
        return None
    return [grid[cell] for cell in cells[2::3]] + [goal]


def _cell(point: Array, low: Array, cell_m: float) -> tuple[int, int]:
    i, j = np.rint((point - low) / cell_m).astype(int)
    return int(i), int(j)


def _search(
    free: np.ndarray, clearance: Array, first: tuple[int, int], last: tuple[int, int]
) -> list[tuple[int, int]] | None:
    costs, before = {first: 0.0}, {first: first}
    queue = [(0.0, first)]
    while queue:
        _, here = heapq.heappop(queue)
        if here == last:
            cells = [here]
            while before[cells[-1]] != cells[-1]:
                cells.append(before[cells[-1]])
            return cells[::-1]
        for di in (-1, 0, 1):
            for dj in (-1, 0, 1):
                there = (here[0] + di, here[1] + dj)
                if (
                    there == here
                    or not (0 <= there[0] < free.shape[0] and 0 <= there[1] < free.shape[1])
                    or not free[there]
                ):
                    continue
                cost = costs[here] + math.hypot(di, dj) * (1.0 + 0.1 / max(clearance[there], 0.1))
                if cost < costs.get(there, math.inf):
                    costs[there], before[there] = cost, here
                    heapq.heappush(queue, (cost + math.dist(there, last), there))
    return None


@dataclass(kw_only=True)
class Exploration:
    """Agents, driver and house, advanced together. ``seconds``: processor time of each agent's steps."""

    memory: WorkingMemory
    port: HousePort
    buffer: SensorBuffer
    agents: list[Agent]
    driver: Driver
    start: Pose2
    log: list[tuple[float, float, float]] = field(default_factory=list)
    seconds: dict[str, list[float]] = field(default_factory=dict)

    @classmethod
    def of(cls, house: House, start: Pose2, seed: int, make_agents, **noise: float) -> Exploration:  # type: ignore[no-untyped-def]
        memory = WorkingMemory()
        port = HousePort(house=house, pose=start, rng=np.random.default_rng(seed), **noise)
        buffer = SensorBuffer(port)
        agents = [Sensing(buffer), *make_agents(memory, buffer)]
        return cls(memory=memory, port=port, buffer=buffer, agents=agents, driver=Driver(memory, port), start=start)

    def run(self, seconds: float, until=lambda exploration: False) -> None:  # type: ignore[no-untyped-def]
        asyncio.run(self._run(seconds, until))

    async def _run(self, seconds: float, until) -> None:  # type: ignore[no-untyped-def]
        end = self.port.stamp_s + seconds
        while self.port.stamp_s < end and not until(self):
            self.port.stamp_s = round(self.port.stamp_s + STEP_S, 6)
            for agent in self.agents:
                begin = time.process_time()
                await agent.step(self.port.stamp_s)
                self.seconds.setdefault(agent.name, []).append(time.process_time() - begin)
            self.log.append((self.port.stamp_s, *self.localization_error()))
            self.driver.step()

    def truth_of(self, frame: str) -> Pose2:
        """What the graph says about a frame, laid into the house at the true start pose."""
        return self.start @ Pose2.from_se3(self.memory.snapshot().transform("root", frame))

    def localization_error(self) -> tuple[float, float]:
        believed = self.truth_of(ROBOT_ID)
        return believed.distance_m(self.port.pose), abs(wrap(believed.yaw_rad - self.port.pose.yaw_rad))
