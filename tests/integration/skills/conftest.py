"""A stage for the skills alone: the simulated robot, and a graph that is told the truth."""

from __future__ import annotations

import json
from typing import Any

import pytest

from physics_stage import Stage, two_rooms
from simulation.process.client import SimulatedRobot


@pytest.fixture
def anyio_backend() -> str:
    """Asyncio only."""
    return "asyncio"


@pytest.fixture
async def stage(tmp_path, anyio_backend):
    """Starts stages, and ends their simulators."""
    robots = []

    async def start(plan: dict[str, Any], *, seed: int = 0, noise_m: float = 0.0) -> Stage:
        path = tmp_path / f"house_{len(robots)}.json"
        path.write_text(json.dumps(plan))
        robot = await SimulatedRobot.start(str(path), seed=seed)
        robots.append(robot)
        built = Stage(robot, plan, noise_m=noise_m, seed=seed)
        await built.begin()
        return built

    yield start
    for robot in robots:
        await robot.close()


@pytest.fixture
def make_house():
    """Makes house documents."""
    return two_rooms
