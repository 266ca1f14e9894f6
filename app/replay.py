"""``majordomo replay``: perception over a recording, with the same agents and without a robot."""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import AsyncIterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from app.events.event_log import EventLog
from app.recording.errors import NoRecording
from app.recording.playback import Playback
from app.recording.profile import settings_of
from app.recording.replayed_robot import ReplayedRobot
from app.runtime import Runtime
from app.settings import Settings
from app.stacks.robot import RobotStack, load_network
from perception.network.shipped import SHIPPED
from planner.models.protocol import LanguageModel
from planner.tasks.queue import TaskQueue

KINDS = ("room", "door", "object", "person")


@dataclass(frozen=True, kw_only=True)
class Replayed:
    """What came of a replay.

    Attributes:
        scene: the graph at the end, as ``GET /v1/scene`` shows it.
        recorded: the graph that the recording itself holds last, as a document.
        seconds: how long the recording is.
        truncated: whether it ends before its end was written.
    """

    scene: dict[str, Any]
    recorded: dict[str, Any]
    seconds: float
    truncated: bool


@contextlib.asynccontextmanager
async def replaying(playback: Playback, settings: Settings) -> AsyncIterator[tuple[Runtime, ReplayedRobot]]:
    """A service whose robot is the recording; it plays from the start on."""
    robot = ReplayedRobot(playback)
    runtime = Runtime(settings, build=_Builder(robot))
    async with runtime.running():
        yield runtime, robot


async def replay(path: Path, *, model: Path = SHIPPED) -> Replayed:
    """Play a recording as fast as the machine allows, and keep nothing but the graph.

    Raises:
        NoRecording: the file is none of ours.
        RecordingDamaged: it cannot be read to its end.
        OSError: it cannot be read at all.
    """
    with tempfile.TemporaryDirectory(prefix="majordomo-replay-") as folder, Playback(path) as playback:
        try:
            settings = settings_of(playback.profile, data=Path(folder), model=model)
        except ValidationError as error:
            raise NoRecording(path, f"it does not say how it was made: {error.errors()[0]['msg']}") from error
        async with replaying(playback, settings) as (runtime, robot):
            await robot.ended.wait()
            if robot.problem is not None:
                raise robot.problem
            return Replayed(
                scene=runtime.views.scene.document(),
                recorded=playback.graph,
                seconds=playback.played_s,
                truncated=playback.truncated,
            )


def told(replayed: Replayed) -> str:
    """What a person wants to know of it."""
    now, then = _counts(replayed.scene), _counts(replayed.recorded)
    found = ", ".join(f"{now[kind]} {kind}s (recorded: {then[kind]})" for kind in KINDS)
    lines = [f"replayed {replayed.seconds:.1f} s: {found}"]
    if replayed.truncated:
        lines.append("The recording was cut off, as by a crash; all that was in it has been replayed.")
    return "\n".join(lines)


def _counts(scene: Mapping[str, Any]) -> dict[str, int]:
    kinds = [node.get("type") for node in scene.get("nodes", ())]
    return {kind: kinds.count(kind) for kind in KINDS}


class _Builder:
    """Puts all agents around a given robot."""

    def __init__(self, robot: ReplayedRobot) -> None:
        self._robot = robot

    async def __call__(
        self,
        settings: Settings,
        queue: TaskQueue,
        model: LanguageModel | None,
        log: EventLog,
        *,
        anew: bool = False,  # noqa: ARG002 - a replay always begins with nothing
    ) -> RobotStack:
        network = await load_network(settings)
        return RobotStack(self._robot, settings, queue, model, log, network=network)
