"""Which robot serves: the simulated one, one behind rosbridge, or that of an installed package.

A package of its own names a coroutine function in the entry point group ``majordomo.robots``; it gets what stands
behind the colon of ``--robot NAME:WHERE`` and returns a ``Robot``.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Iterable
from importlib.metadata import entry_points
from typing import cast

from app.robot_port import Robot
from app.settings import ClockMode, Settings
from drivers.rosbridge import robot as rosbridge
from simulation.process.client import SimulatedRobot

ENTRY_POINT_GROUP = "majordomo.robots"

Connect = Callable[[str], Awaitable[Robot]]


class NoSuchRobot(ValueError):
    """No kind of robot has this name."""

    def __init__(self, name: str, available: Iterable[str]) -> None:
        self.name, self.available = name, tuple(sorted(available))
        super().__init__(f"no kind of robot is named {name!r}; there are {', '.join(self.available)}")


class RobotMisfit(ValueError):
    """What is configured cannot be had with a real robot."""


async def start_robot(settings: Settings) -> Robot:
    """The configured robot, sensing and ready to be told something.

    Raises:
        HouseError: the simulator's house cannot be built.
        NoSuchRobot: nobody provides that kind.
        RobotMisfit: the settings want what only a simulator has.
        RosbridgeError: the robot behind rosbridge cannot be had.
    """
    if settings.robot is None:
        mode = "lockstep" if settings.clock is ClockMode.LOCKSTEP else "real"
        return await SimulatedRobot.start(settings.house, seed=settings.seed, mode=mode, speed=settings.speed or 1.0)
    if settings.clock is ClockMode.LOCKSTEP or settings.speed != 1.0 or settings.simulation_api:
        raise RobotMisfit(
            "a real robot has its own time and no truth: leave --clock, --speed and --simulation-api away"
        )
    name, _, where = settings.robot.partition(":")
    return await connection_of(name)(where)


def connection_of(name: str) -> Connect:
    """What connects to robots of this kind.

    Raises:
        NoSuchRobot: nobody provides it.
    """
    if name == "rosbridge":
        return rosbridge.connect
    points = {point.name: point for point in entry_points(group=ENTRY_POINT_GROUP)}
    if name not in points:
        raise NoSuchRobot(name, {"rosbridge", *points})
    return cast("Connect", points[name].load())
