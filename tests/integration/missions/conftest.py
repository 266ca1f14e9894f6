"""Missions in physics."""

from __future__ import annotations

import json
from typing import Any

import pytest

from mission_stage import MissionStage
from simulation.process.client import SimulatedRobot


@pytest.fixture
def anyio_backend() -> str:
    """Asyncio only."""
    return "asyncio"


@pytest.fixture
async def stage(tmp_path, anyio_backend):
    """Starts stages, and ends their simulators."""
    robots = []

    async def start(plan: dict[str, Any]) -> MissionStage:
        path = tmp_path / f"house_{len(robots)}.json"
        path.write_text(json.dumps(plan))
        robot = await SimulatedRobot.start(str(path), seed=0)
        robots.append(robot)
        built = MissionStage(robot, plan, noise_m=0.004)
        await built.begin()
        return built

    yield start
    for robot in robots:
        await robot.close()
