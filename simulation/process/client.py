"""The robot as the service sees it: both ports, over a pipe to the simulator's process."""

from __future__ import annotations

import asyncio
import contextlib
import multiprocessing
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

from perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from simulation.errors import DisturbError, HouseError, SimulatorDied
from simulation.houses.house_file import load_house
from simulation.process.child import ADVANCE, CLOSE, run
from simulation.process.messages import Mode, Readings, Reply, Request, Start
from skills.ports import ArmGeometry, ArmTarget, BodyLimits, BodyState


class SimulatedRobot:
    """``SensorPort`` and ``BodyPort`` of the simulated robot. Make one with ``await SimulatedRobot.start(...)``.

    Requests go one at a time, in the order of their calls, through one thread, so the event loop never waits. The stop
    does not queue: it is a flag in shared memory that the simulator reads before every physics step. In lockstep
    nothing moves until time does: commands travel with the next call, and what the body measured comes with the time.
    """

    def __init__(self, start: Start, *, start_timeout_s: float = 60.0, reply_timeout_s: float = 30.0) -> None:
        """``start_timeout_s``: to load the libraries and settle the house. ``reply_timeout_s``: of every other call.

        Many times what they take: a machine may be busy.
        """
        self._start, self._start_timeout_s, self._reply_timeout_s = start, start_timeout_s, reply_timeout_s
        self._context = multiprocessing.get_context("spawn")
        self._stop_latch = self._context.Value("i", 0)
        self._thread = ThreadPoolExecutor(max_workers=1, thread_name_prefix="simulator")
        self._process: BaseProcess | None = None
        self._connection: Connection | None = None
        self._now_s, self._heard_at = 0.0, time.monotonic()
        self._pending: list[Request] = []
        self._readings: Readings | None = None

    @classmethod
    async def start(cls, house: str, *, seed: int = 0, mode: str = "lockstep", speed: float = 1.0) -> SimulatedRobot:
        """Start a simulator on a house file or built-in house.

        Raises:
            HouseError: the house is faulty; names the field.
            SimulatorDied: the process could not start.
        """
        text = load_house(house).model_dump_json(by_alias=True, exclude_none=True)
        robot = cls(Start(house=text, seed=seed, mode=Mode(mode), speed=speed))
        await robot._launch()
        return robot

    @property
    def limits(self) -> BodyLimits:
        """The body's limits, enforced in the simulator."""
        return self._start.robot.limits

    @property
    def geometry(self) -> ArmGeometry:
        """The arm's dimensions."""
        return self._start.robot.geometry

    @property
    def alive(self) -> bool:
        """Whether the simulator's process runs."""
        return self._process is not None and self._process.is_alive()

    @property
    def pid(self) -> int | None:
        """The simulator's process."""
        return self._process.pid if self._process is not None else None

    @property
    def stopped(self) -> bool:
        """Whether the stop is latched."""
        return bool(self._stop_latch.value)

    @property
    def now_s(self) -> float:
        """Simulated time: as last heard, and in real mode carried on with the wall clock."""
        if self._start.mode is Mode.LOCKSTEP:
            return self._now_s
        return self._now_s + min(0.5, time.monotonic() - self._heard_at) * self._start.speed

    async def odometry(self) -> Odometry:
        """Newest odometry."""
        if self._readings is not None:
            return self._readings.odometry
        measured: Odometry = await self._call("odometry")
        return measured

    async def scan(self) -> LidarScan:
        """Newest LiDAR revolution."""
        measured: LidarScan = await self._call("scan")
        return measured

    async def frame(self) -> RgbdFrame:
        """Newest color and depth image."""
        measured: RgbdFrame = await self._call("frame")
        return measured

    async def joints(self) -> JointState:
        """Newest joint and gripper state."""
        if self._readings is not None:
            return self._readings.joints
        measured: JointState = await self._call("joints")
        return measured

    async def state(self) -> BodyState:
        """The body as measured."""
        if self._readings is not None:
            return replace(self._readings.state, stopped=self.stopped)
        measured: BodyState = await self._call("body_state")
        return measured

    async def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Command the base; lapses after the dead-man timeout."""
        await self._command("drive", linear_mps, angular_radps)

    async def look(self, pan_rad: float, tilt_rad: float) -> None:
        """Aim the camera."""
        await self._command("look", pan_rad, tilt_rad)

    async def move_arm(self, target: ArmTarget) -> None:
        """Move the arm."""
        await self._command("move_arm", target)

    async def grip(self, opening_m: float, effort_n: float = 15.0) -> None:
        """Move the fingers."""
        await self._command("grip", opening_m, effort_n)

    def stop(self) -> None:
        """Latch the stop; in force at the next physics step."""
        self._stop_latch.value = 1

    def release_stop(self) -> None:
        """Release the stop; nothing moves until the next command."""
        self._stop_latch.value = 0

    async def advance(self, duration_s: float) -> float:
        """Advance simulated time (lockstep); the new time in seconds."""
        now_s: float = await self._call(ADVANCE, duration_s)
        return now_s

    async def truth(self) -> dict[str, Any]:
        """The simulator's truth, for scoring only."""
        truth: dict[str, Any] = await self._call("truth")
        return truth

    async def disturb(self, event: dict[str, Any]) -> None:
        """Let something happen in the house.

        Raises:
            DisturbError: it cannot happen; says why.
        """
        await self._call("disturb", event)
        self._readings = None

    async def restart(self) -> None:
        """End what is left of the simulator and start a fresh one: same house, same seed."""
        await self._end()
        self.release_stop()
        await self._launch()

    async def close(self) -> None:
        """End the simulator."""
        await self._end()
        self._thread.shutdown(wait=False)

    async def _launch(self) -> None:
        reply: Reply = await asyncio.get_running_loop().run_in_executor(self._thread, self._spawn)
        if reply.problem:
            await self._end()
            path, _, problem = reply.problem.partition(": ")
            raise HouseError(path, problem)

    def _spawn(self) -> Reply:
        ours, theirs = self._context.Pipe()
        process = self._context.Process(
            target=run, args=(theirs, self._stop_latch, self._start), name="simulator", daemon=True
        )
        process.start()
        theirs.close()
        self._process, self._connection = process, ours
        return self._receive(self._start_timeout_s)

    async def _command(self, method: str, *args: Any) -> None:
        if self._start.mode is not Mode.LOCKSTEP:
            await self._call(method, *args)
        elif self._connection is None:
            raise SimulatorDied("it was closed")
        else:
            self._pending.append(Request(method=method, args=args))

    async def _call(self, method: str, *args: Any) -> Any:
        request = Request(method=method, args=args, before=tuple(self._pending))
        self._pending.clear()
        reply: Reply = await asyncio.get_running_loop().run_in_executor(self._thread, self._exchange, request)
        if reply.problem:
            path, _, problem = reply.problem.rpartition(": ")
            raise DisturbError(path, problem)
        if self._start.mode is Mode.LOCKSTEP and reply.readings is not None:
            self._readings = reply.readings
        return reply.value

    def _exchange(self, request: Request) -> Reply:
        if self._connection is None:
            raise SimulatorDied("it was closed")
        try:
            self._connection.send(request)
        except OSError as error:
            raise SimulatorDied(self._obituary()) from error
        return self._receive(self._reply_timeout_s)

    def _receive(self, timeout_s: float) -> Reply:
        connection = self._connection
        if connection is None:
            raise SimulatorDied("it was closed")
        try:
            if not connection.poll(timeout_s):
                raise SimulatorDied(f"no answer for {timeout_s:.0f} s")
            reply: Reply = connection.recv()
        except (EOFError, OSError) as error:
            raise SimulatorDied(self._obituary()) from error
        self._now_s, self._heard_at = reply.now_s, time.monotonic()
        return reply

    def _obituary(self) -> str:
        if self._process is None:
            return "it never lived"
        self._process.join(1.0)
        return f"process {self._process.pid} ended with exit code {self._process.exitcode}"

    async def _end(self) -> None:
        await asyncio.get_running_loop().run_in_executor(self._thread, self._bury)

    def _bury(self) -> None:
        process, connection = self._process, self._connection
        self._process = self._connection = self._readings = None
        self._pending.clear()
        if connection is not None:
            with contextlib.suppress(OSError):
                connection.send(Request(method=CLOSE))
            connection.close()
        if process is not None:
            process.join(2.0)
            if process.is_alive():
                process.kill()
                process.join(2.0)
