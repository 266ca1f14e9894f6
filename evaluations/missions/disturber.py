"""The person who interferes with a mission: waits for the moment, does what is to be done, and clears up afterwards."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Sequence

from numpy.random import Generator

from app.runtime import Runtime
from evaluations.missions.disturbances import DISTURBANCES, Disturbance, Event, Moment
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, Scene
from evaluations.missions.ways import Ways, WaySettings
from planner.tasks.tasks import Task
from simulation.errors import DisturbError
from skills.failures import FailureCode


class Disturber:
    """Interferes once with one mission.

    Attributes:
        made_s: simulated time at which it was done, None before. possible: whether the request can still be fulfilled.
    """

    def __init__(self, runtime: Runtime, mission: Mission, rng: Generator, *, stroll_s: float = 25.0) -> None:
        """``stroll_s``: so long a person stands in the way before they go home."""
        self._runtime, self._mission, self._rng, self._stroll_s = runtime, mission, rng, stroll_s
        self._disturbance: Disturbance | None = DISTURBANCES.get(mission.disturbance)
        self._undoing: list[Event] = []
        self._ways: tuple[object, Ways] | None = None
        self.made_s: float | None = None
        self.possible = True

    @property
    def reasons(self) -> frozenset[FailureCode]:
        """What the robot may rightly say if nothing came of the request; nothing before it was disturbed."""
        if self._disturbance is None or self.made_s is None:
            return frozenset()
        return self._disturbance.reasons

    @property
    def touched(self) -> frozenset[str]:
        """Furniture whose things may have been pushed by what was done to it."""
        rough = self._disturbance is not None and self._disturbance.ends_it and self.made_s is not None
        return frozenset(self._mission.places) if rough else frozenset()

    async def step(self, scene: Scene, task: Task, since_s: float) -> None:
        """Do it when its time has come; ``since_s``: since the robot got going."""
        if self._disturbance is None:
            return
        if self.made_s is not None:
            strolls = any(event["do"] == "walk" for event in self._undoing)
            if strolls and self._runtime.now_s > self.made_s + self._stroll_s:
                await self.tidy_up()
            return
        moment = Moment(
            scene=scene, mission=self._mission, task=task, ways=self._ways_in(scene), since_s=since_s, rng=self._rng
        )
        if not self._disturbance.due(moment):
            return
        for events in self._disturbance.deeds(moment):
            done = await self._do(events)
            if done:
                self.made_s = self._runtime.now_s
                self._undoing = [undo for event in done for undo in _undoing(event, scene)]
                self.possible = _still_possible(self._disturbance, moment, done)
                return

    async def tidy_up(self) -> None:
        """Take back what would stand in the way of the next mission."""
        await self._do(self._undoing)
        self._undoing = []

    def _ways_in(self, scene: Scene) -> Ways:
        """Those of the house as it is; drawn anew when a door has opened or closed."""
        doors = scene.truth["doors"]
        if self._ways is None or self._ways[0] != doors:
            self._ways = (doors, Ways(scene))
        return self._ways[1]

    async def _do(self, events: Sequence[Event]) -> list[Event]:
        """Those that the house allows, up to the first that it does not."""
        done: list[Event] = []
        with contextlib.suppress(DisturbError):
            for event in events:
                await self._runtime.require_robot().disturb(dict(event))
                done.append(event)
        return done


def _still_possible(disturbance: Disturbance, moment: Moment, done: Sequence[Event]) -> bool:
    """Whether something can still come of the request."""
    if not disturbance.blocks:
        return not disturbance.ends_it
    shut = {str(event["id"]) for event in done if event["do"] == "close_door"}
    shut |= {str(event["object"]["id"]).removeprefix("crate_") for event in done if event["do"] == "add"}
    left = Ways(moment.scene, shut=shut, radius_m=WaySettings().passable_m)
    stops = [moment.where(name) for name in (moment.thing, moment.place) if name is not None and name != HAND]
    return math.isfinite(left.length_m(moment.scene.robot_at, *[stop for stop in stops if stop is not None]))


def _undoing(event: Event, scene: Scene) -> list[Event]:
    """What takes an event back, where it would stay in the way."""
    match event["do"]:
        case "add":
            return [{"do": "remove", "id": event["object"]["id"]}]
        case "close_door":
            return [{"do": "open_door", "id": event["id"]}]
        case "walk":
            home = next(entry["position_m"] for entry in scene.truth["people"] if entry["id"] == event["id"])
            return [{"do": "walk", "id": event["id"], "to": {"pose": [*home]}}]
        case _:
            return []
