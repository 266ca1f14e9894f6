"""Plays missions in one house: the robot explores, then gets one request after the other, while people interfere."""

from __future__ import annotations

import math
import time
from collections.abc import Collection, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np
from numpy.random import Generator

from app.runtime import Runtime
from evaluations.mapping.exploration import pass_time, service_in_lockstep, until_explored
from evaluations.missions.attempts import Attempts
from evaluations.missions.disturber import Disturber
from evaluations.missions.filmstrip import Still, draw_filmstrip
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, Scene, stirred
from evaluations.missions.simulated_user import SimulatedUser
from evaluations.missions.ways import Point, Ways, WaySettings
from evaluations.pool import tell
from planner.tasks.tasks import Task, TaskStatus
from scene_graph.identifiers import slug
from simulation.houses.house import House
from skills.failures import FailureCode

OUT_OF_REACH = frozenset(
    {FailureCode.UNREACHABLE, FailureCode.WAY_BLOCKED, FailureCode.DOOR_CLOSED, FailureCode.PERSON_IN_WAY}
)
"""What the robot may rightly say of a thing or place that no free floor leads near enough to."""


@dataclass(frozen=True, kw_only=True)
class EpisodeSettings:
    """How a mission is watched, in simulated time."""

    limit_s: float = 900.0
    """After so long a request is given up."""
    look_s: float = 0.4
    """Between two looks at the truth."""
    settle_s: float = 1.5
    """So long things may fall and roll before it is judged where they are."""
    still_m: float = 0.02
    """Less than this is no way that the robot has made."""


async def play_all(
    name: str, house: House, missions: Sequence[Mission], *, seed: int, model: Path, pictures: Path | None = None
) -> dict[str, Any]:
    """All missions of one house, in their order, and what came of each.

    ``pictures``: folder for a filmstrip of each.
    """
    async with service_in_lockstep(house, seed, camera=True, model=model) as runtime:
        began = time.monotonic()
        explored = await until_explored(runtime, house)
        tell(f"{name}: {'explored' if explored else 'given up'} after {runtime.now_s:.0f} simulated seconds")
        SimulatedUser(runtime, house).introduce()
        rows = []
        for number, mission in enumerate(missions):
            rng = np.random.default_rng((seed, number))
            episode = _Episode(runtime, house, mission, rng, filming=pictures is not None)
            rows.append(await episode.play())
            line = f"{name}: {rows[-1]['verdict']}: {mission.request} [{mission.disturbance or 'undisturbed'}]"
            tell(line)
            if pictures is not None:
                draw_filmstrip(house, episode.way, episode.stills, line, pictures / f"{slug(name)}_{seed}_{number}.png")
        return {
            "house": name,
            "seed": seed,
            "explored": explored,
            "missions": rows,
            "seconds": round(runtime.now_s, 1),
            "wall_seconds": round(time.monotonic() - began, 1),
            "failed_turns": sum(turns.restarts for turns in runtime.turns()),
        }


async def play_mission(runtime: Runtime, house: House, mission: Mission, rng: Generator) -> dict[str, Any]:
    """One mission in a service that is running, and what came of it."""
    return await _Episode(runtime, house, mission, rng).play()


async def scene_of(runtime: Runtime, house: House) -> Scene:
    """The truth as it is now."""
    return Scene(house=house, truth=await runtime.require_robot().truth())


class Verdict(StrEnum):
    """What came of a mission: the first and the fourth are as they should be."""

    DONE = "done"
    PHANTOM = "phantom success"
    WRONG_ANSWER = "wrong answer"
    RIGHTLY_IMPOSSIBLE = "impossible, for the right reason"
    OTHER_REASON = "impossible, for another reason"
    HONEST_FAILURE = "failed, and said so"
    REFUSED = "refused"
    ASKED = "asked"
    UNJUDGED = "reported as done"


@dataclass(kw_only=True)
class _Course:
    """Where the robot has been, and whether it asked something that nobody could answer."""

    still_m: float
    points: list[Point] = field(default_factory=list)
    asked: bool = False

    def at(self, point: Point) -> None:
        """The robot is there now."""
        if not self.points or math.dist(point, self.points[-1]) > self.still_m:
            self.points.append(point)

    @property
    def length_m(self) -> float:
        """How far the robot has driven."""
        return sum(math.dist(a, b) for a, b in zip(self.points, self.points[1:], strict=False))


class _Episode:
    """One mission.

    Attributes:
        stills: what the camera saw at its key moments, if it is filmed.
    """

    def __init__(
        self,
        runtime: Runtime,
        house: House,
        mission: Mission,
        rng: Generator,
        *,
        filming: bool = False,
        settings: EpisodeSettings = EpisodeSettings(),
    ) -> None:
        self._settings = settings
        self._runtime, self._house, self._mission = runtime, house, mission
        self._disturber = Disturber(runtime, mission, rng)
        self._user = SimulatedUser(runtime, house)
        self._course = _Course(still_m=settings.still_m)
        self._attempts = Attempts()
        self._filming, self._failures = filming, 0
        self.stills: list[Still] = []

    @property
    def way(self) -> Sequence[Point]:
        """Where the robot has been."""
        return self._course.points

    async def play(self) -> dict[str, Any]:
        """Ask, watch, interfere, and judge."""
        began = time.monotonic()
        before = await self._scene()
        ways = Ways(before, spared=self._mission.things)
        shortest_m = self._shortest_m(before, ways)
        passable = Ways(before, spared=self._mission.things, radius_m=WaySettings().passable_m)
        within_reach = is_within_reach(self._mission, before, passable)
        task = self._runtime.orders.submit(self._mission.request)
        await self._film(before, self._mission.request)
        task = await self._watch(task)
        await self._note(await self._scene(), task)
        await pass_time(self._runtime, self._settings.settle_s)
        after = await self._scene()
        await self._film(after, task.explanation or task.reply)
        row = self._judged(task, before, after, within_reach=within_reach)
        collisions = int(after.truth["collisions"]) - int(before.truth["collisions"])
        await self._disturber.tidy_up()
        return {
            "kind": self._mission.kind,
            "request": self._mission.request,
            "disturbance": self._mission.disturbance,
            "made": self._disturber.made_s is not None,
            **row,
            "ended": {name: _whereabouts(after, name) for name in self._mission.things},
            "answers": self._user.answers,
            "dialogue": [question for question, _ in task.dialogue],
            "status": task.status.value,
            "codes": [failure.code for failure in task.failures],
            "failures": [
                {"step": failure.step, "message": failure.message, "observation": failure.evidence.observation}
                for failure in task.failures
            ],
            "attempts": [asdict(attempt) for attempt in self._attempts.checked],
            "explanation": task.explanation or task.reply,
            "replans": task.replans,
            "collisions": collisions,
            "touched": touched_last(after.truth, collisions),
            "driven_m": round(self._course.length_m, 2),
            "shortest_m": None if shortest_m is None else round(shortest_m, 2),
            "seconds": round(after.truth["stamp_s"] - before.truth["stamp_s"], 1),
            "wall_seconds": round(time.monotonic() - began, 1),
        }

    async def _watch(self, task: Task) -> Task:
        """Follow the task to its end."""
        began_s = looked_s = self._runtime.now_s
        going_s: float | None = None
        task_id = task.id
        self._runtime.queue.listen(lambda version: self._attempts.follow(version) if version.id == task_id else None)
        while not (task := self._runtime.queue.task(task_id)).status.ended:
            now_s = self._runtime.now_s
            if task.status is TaskStatus.AWAITING_ANSWER:
                await self._answer(task)
            elif now_s > began_s + self._settings.limit_s:
                self._runtime.queue.cancel(task.id, stamp_s=now_s)
            elif now_s >= looked_s + self._settings.look_s:
                looked_s = now_s
                scene = await self._scene()
                self._course.at(scene.robot_at)
                await self._note(scene, task)
                going_s = now_s if going_s is None and len(self._course.points) > 1 else going_s
                await self._interfere(scene, task, 0.0 if going_s is None else now_s - going_s)
            await self._runtime.wait_for_change()
        return task

    async def _answer(self, task: Task) -> None:
        """Say which one is meant; where the right one is not offered, give the request up."""
        text = self._user.answer(task, self._mission, await self._scene())
        if text is None:
            self._course.asked = True
            self._runtime.queue.cancel(task.id, stamp_s=self._runtime.now_s)
        else:
            self._runtime.queue.answer(task.id, text, stamp_s=self._runtime.now_s)

    async def _interfere(self, scene: Scene, task: Task, since_s: float) -> None:
        calm = self._disturber.made_s is None
        await self._disturber.step(scene, task, since_s)
        if calm and self._disturber.made_s is not None:
            await self._film(scene, f"disturbed: {self._mission.disturbance.replace('_', ' ')}")

    async def _note(self, scene: Scene, task: Task) -> None:
        """Take down what was tried, and what went wrong, since the last look."""
        for attempt in self._attempts.check(scene, calm=self._disturber.made_s is None):
            await self._film(scene, f"{attempt.step} {'done' if attempt.done else 'not done'}")
        for failure in task.failures[self._failures :]:
            await self._film(scene, f"{failure.code}: {failure.message}")
        self._failures = len(task.failures)

    async def _film(self, scene: Scene, caption: str) -> None:
        if self._filming:
            jpeg = await self._runtime.views.camera.jpeg()
            stamp_s = float(scene.truth["stamp_s"])
            self.stills.append(Still(stamp_s=stamp_s, at=scene.robot_at, caption=caption, jpeg=jpeg))

    def _judged(self, task: Task, before: Scene, after: Scene, *, within_reach: bool) -> dict[str, Any]:
        """Reported and true outcome, and whether both fit; ``within_reach``: all that is to be moved."""
        reported = task.status is TaskStatus.SUCCEEDED
        outcomes = self._mission.outcomes
        met = any(outcome.met(after, task) and (reported or outcome.refused) for outcome in outcomes)
        question = all(outcome.words and not outcome.states for outcome in outcomes)
        possible = self._disturber.possible and within_reach
        reasons = self._disturber.reasons | (frozenset() if within_reach else OUT_OF_REACH)
        if met:
            verdict = Verdict.DONE
        elif reported:
            verdict = Verdict.UNJUDGED if not outcomes else Verdict.WRONG_ANSWER if question else Verdict.PHANTOM
        elif not possible:
            verdict = impossible_as_told(task, reasons, within_reach=within_reach)
        elif self._course.asked:
            verdict = Verdict.ASKED
        else:
            verdict = Verdict.REFUSED if task.status is TaskStatus.REFUSED else Verdict.HONEST_FAILURE
        spared = frozenset(self._mission.things) | self._disturber.touched
        return {
            "verdict": verdict,
            "possible": possible,
            "within_reach": within_reach,
            "reported": reported,
            "stirred": list(stirred(before, after, spared)),
        }

    def _shortest_m(self, scene: Scene, ways: Ways) -> float | None:
        """The shortest way that does what is asked for; None where nothing moves, or in more orders than one."""
        things, places, rooms = self._mission.things, self._mission.places, self._mission.rooms
        if len(things) != 1 or len(places) != 1 or len(rooms) > 1:
            return None
        stops = [scene.where(name) or ways.middle_of(name) for name in (*things, *places) if name != HAND]
        length_m = ways.length_m(scene.robot_at, *[stop for stop in stops if stop is not None], *rooms)
        return length_m if math.isfinite(length_m) else None

    async def _scene(self) -> Scene:
        return await scene_of(self._runtime, self._house)


def is_within_reach(mission: Mission, scene: Scene, ways: Ways) -> bool:
    """Whether free floor leads near all that is to be moved, near one of the places it may go to, and to a room that
    the robot is to be in.
    """

    def leads_to(stop: Point | None) -> bool:
        return stop is None or math.isfinite(ways.length_m(scene.robot_at, stop))

    def is_reached(name: str) -> bool:
        return name == HAND or leads_to(scene.where(name) or ways.middle_of(name))

    near = all(leads_to(scene.where(name)) for name in mission.things)
    return near and all(not each or any(map(is_reached, each)) for each in (mission.places, mission.rooms))


def impossible_as_told(task: Task, reasons: Collection[FailureCode], *, within_reach: bool) -> Verdict:
    """Whether what the robot said of a request that could not be fulfilled is one of the reasons why; what is out of
    reach it need not know at all.
    """
    unknown = not within_reach and task.status is TaskStatus.REFUSED
    told = bool(task.failures) and task.failures[-1].code in reasons
    return Verdict.RIGHTLY_IMPOSSIBLE if unknown or told else Verdict.OTHER_REASON


def touched_last(truth: Mapping[str, Any], collisions: int) -> list[str]:
    """What was touched in the newest so many collisions, as far as the simulator remembers."""
    touched = truth.get("touched", ())
    return list(touched[max(len(touched) - collisions, 0) :])


def _whereabouts(scene: Scene, thing: str) -> str:
    """What carries a thing at last, or the room it is in."""
    record = scene.thing(thing)
    if record is None:
        return "gone"
    return HAND if scene.holding == thing else str(record["on"] or record["in"] or record["room"])
