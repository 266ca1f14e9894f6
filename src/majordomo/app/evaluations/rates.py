"""``evaluate rates``: does the service keep up with its sensors, and does every agent get its turn in time?

Twice, in real time: with a drive through a known building played from memory at 20 LiDAR revolutions a second, the
paper's nominal rate; and while exploring beside the simulator, which takes its share of the same machine.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
import tempfile
import time
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from majordomo.app.evaluations.exploration import service_in_lockstep, until_explored
from majordomo.app.evaluations.pool import run_all
from majordomo.app.evaluations.wandering import Wanderer
from majordomo.app.mapping_agents import mapping_agents
from majordomo.app.runtime import Runtime
from majordomo.app.scheduler import RealTimeScheduler, Turns
from majordomo.app.settings import ClockMode, Settings
from majordomo.perception.errors import SensorSilent
from majordomo.perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from majordomo.perception.sensing import Sensing, SensorBuffer
from majordomo.scene_graph.long_term.long_term_store import LongTermStore
from majordomo.scene_graph.memory import WorkingMemory
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.simulation.house import load_house

REPLAY_LIDAR_HZ = 20.0
SIMULATED_LIDAR_HZ = 10.0
OPTIMIZER_HZ = 10.0
MOST_OVERDUE_S = 1.0
SLACK = 0.98
"""A rate counts as held from this share of it on."""


def evaluate(*, house: str, seconds: float, json_file: Path | None, console: Console) -> bool:
    """Measure both; whether all rates are held and nobody waits too long."""
    jobs = [("replay", house, seconds), ("simulator", house, seconds)]
    runs = run_all(run_once, jobs, jobs=1, console=console)
    console.print(_table(runs))
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
        json_file.write_text(json.dumps({"cores": os.cpu_count(), "runs": runs}, indent=2) + "\n", encoding="utf-8")
    return all(run["held"] for run in runs)


def run_once(source: str, house: str, seconds: float) -> dict[str, Any]:
    """One of the two, in this process."""
    logging.getLogger("majordomo").setLevel(logging.ERROR)
    return asyncio.run(_replayed(house, seconds) if source == "replay" else _beside_simulator(house, seconds))


async def _replayed(house: str, seconds: float) -> dict[str, Any]:
    recording = await record(house, seconds * REPLAY_LIDAR_HZ / SIMULATED_LIDAR_HZ)
    robot = _RecordedRobot(recording, speed=REPLAY_LIDAR_HZ / SIMULATED_LIDAR_HZ)
    memory = WorkingMemory(recording.building, long_term=LongTermStore())
    buffer = SensorBuffer(robot)
    agents = [Sensing(buffer), *mapping_agents(memory, buffer)]
    scheduler = RealTimeScheduler(agents, lambda: robot.now_s, speed=robot.speed)
    robot.start()
    await _for(seconds, asyncio.create_task(scheduler.run()))
    return summary("from memory", REPLAY_LIDAR_HZ, seconds, buffer.scans, scheduler.turns, speed=robot.speed)


async def _beside_simulator(house: str, seconds: float) -> dict[str, Any]:
    with tempfile.TemporaryDirectory(prefix="majordomo-evaluate-") as folder:
        runtime = Runtime(Settings(house=house, clock=ClockMode.REAL, speed=1.0, camera=True, data=Path(folder)))
        async with runtime.running():
            while not runtime.ready:
                await runtime.wait_for_change()
            before, started = runtime.scans, time.monotonic()
            turns_before = {one.agent.name: one.taken for one in runtime.turns()}
            await asyncio.sleep(seconds)
            return summary(
                "beside the simulator",
                SIMULATED_LIDAR_HZ,
                time.monotonic() - started,
                runtime.scans - before,
                runtime.turns(),
                turns_before,
            )


async def _for(seconds: float, task: asyncio.Task[None]) -> None:
    """Let ``task`` run for a while; its errors are raised here."""
    done, _ = await asyncio.wait([task], timeout=seconds)
    task.cancel()
    await asyncio.gather(task, return_exceptions=True)
    for one in done:
        one.result()


def summary(
    source: str,
    lidar_hz: float,
    seconds: float,
    scans: int,
    turns: Sequence[Turns],
    turns_before: Mapping[str, int] | None = None,
    *,
    speed: float = 1.0,
) -> dict[str, Any]:
    """What was held. ``scans``: that arrived within ``seconds``. ``turns_before``: that agents had taken before.

    A turn is overdue when it comes later than a period after the one before; at ``speed``, robot seconds per wall
    second, a period is so much shorter. All seconds that are told are those on the wall.
    """
    before = turns_before or {}
    agents = {
        one.agent.name: {
            "rate_hz": (one.taken - before.get(one.agent.name, 0)) / seconds,
            "overdue_s": max(0.0, one.longest_wait_s - one.agent.period_s / speed),
            "restarts": one.restarts,
        }
        for one in turns
    }
    optimizer_hz = agents["energy_optimizer"]["rate_hz"]
    longest = max(agents, key=lambda name: agents[name]["overdue_s"])
    overdue_s = agents[longest]["overdue_s"]
    held = scans / seconds >= SLACK * lidar_hz and optimizer_hz >= SLACK * OPTIMIZER_HZ and overdue_s < MOST_OVERDUE_S
    return {
        "source": source,
        "seconds": seconds,
        "lidar_hz": scans / seconds,
        "lidar_aim_hz": lidar_hz,
        "optimizer_hz": optimizer_hz,
        "overdue_s": overdue_s,
        "overdue": longest,
        "agents": agents,
        "held": bool(held and not any(one["restarts"] for one in agents.values())),
    }


def _table(runs: Sequence[Mapping[str, Any]]) -> Table:
    table = Table(
        title=f"rates in real time on {os.cpu_count()} cores (aim: no turn overdue by {MOST_OVERDUE_S:.0f} s)"
    )
    for column in ("sensors", "LiDAR Hz", "aim", "optimizer Hz", "aim", "overdue s", "who"):
        table.add_column(column, justify="left" if column in {"sensors", "who"} else "right")
    for run in runs:
        table.add_row(
            run["source"],
            f"{run['lidar_hz']:.1f}",
            f"{run['lidar_aim_hz']:.0f}",
            f"{run['optimizer_hz']:.1f}",
            f"{OPTIMIZER_HZ:.0f}",
            f"{run['overdue_s']:.2f}",
            run["overdue"].replace("_", " "),
        )
    return table


@dataclass(frozen=True, kw_only=True, eq=False)
class Recording:
    """A drive through a known building: the graph at its start, and what the sensors said, oldest first."""

    building: Snapshot
    odometry: Sequence[Odometry]
    scans: Sequence[LidarScan]
    joints: Sequence[JointState]


async def record(house: str, seconds: float) -> Recording:
    """Explore ``house``, then drive from room to room for ``seconds`` of simulated time and keep what is measured."""
    made: list[_Recorder] = []

    def recorder(runtime: Runtime) -> list[_Recorder]:
        made.append(_Recorder(runtime))
        return made

    loaded = load_house(house)
    async with service_in_lockstep(loaded, 0, witnesses=recorder) as runtime:
        await until_explored(runtime, loaded)
        begin_s, building = runtime.now_s, runtime.memory.building()
        made[0].recording = True
        while runtime.now_s < begin_s + seconds + 1.0:
            await runtime.wait_for_change()
        return Recording(building=building, odometry=made[0].odometry, scans=made[0].scans, joints=made[0].joints)


class _Recorder:
    """Wanders, and keeps every measurement."""

    name = "evaluation"
    period_s = 0.1

    def __init__(self, runtime: Runtime) -> None:
        self._runtime = runtime
        self._wanderer = Wanderer(self.name, runtime.memory)
        self.recording = False
        self.odometry: list[Odometry] = []
        self.scans: list[LidarScan] = []
        self.joints: list[JointState] = []

    async def step(self, stamp_s: float) -> None:
        if not self.recording:
            return
        robot = self._runtime.require_robot()
        self.odometry.append(await robot.odometry())
        self.scans.append(await robot.scan())
        self.joints.append(await robot.joints())
        self._wanderer.step(stamp_s)


class _RecordedRobot:
    """``SensorPort`` over a recording, played at ``speed`` times the pace at which it was made."""

    def __init__(self, recording: Recording, speed: float) -> None:
        self.speed = speed
        self._recording = recording
        self._stamps_s = [scan.stamp_s for scan in recording.scans]
        self._started = time.monotonic()

    def start(self) -> None:
        """Play from the beginning."""
        self._started = time.monotonic()

    @property
    def now_s(self) -> float:
        """Time of the recording, seconds."""
        return self._stamps_s[0] + self.speed * (time.monotonic() - self._started)

    @property
    def _newest(self) -> int:
        return max(0, bisect_right(self._stamps_s, self.now_s) - 1)

    async def odometry(self) -> Odometry:
        return self._recording.odometry[self._newest]

    async def scan(self) -> LidarScan:
        return self._recording.scans[self._newest]

    async def joints(self) -> JointState:
        return self._recording.joints[self._newest]

    async def frame(self) -> RgbdFrame:
        raise SensorSilent("camera", 0.0)
