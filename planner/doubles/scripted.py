"""Skills and interpreter of a rehearsal: they follow a script instead of moving and understanding. For tests."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from py_trees.common import Status

from planner.doubles.rehearsal import GRIPPER, SUPPORTS, Stage
from planner.plan import Dialogue, Interpretation
from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.failures import FailureCode
from skills.registry import load_registry
from skills.skill import Skill

PHANTOM = "phantom"
"""An outcome: the motors report success, and nothing has changed."""


@dataclass(kw_only=True)
class Script:
    """What comes of each attempt: a failure code, ``PHANTOM``, or ``None`` for success, taken from the front.

    ``ticks``: control ticks that each action takes.
    """

    outcomes: dict[str, list[FailureCode | str | None]] = field(default_factory=dict)
    ticks: int = 6

    def next(self, skill: str) -> FailureCode | str | None:
        """The outcome of the next attempt of a skill."""
        waiting = self.outcomes.get(skill, [])
        return waiting.pop(0) if waiting else None


class ScriptedAction(Action):
    """Takes some ticks, driving if ``drives``; then does ``effect`` and succeeds, or fails as the script says."""

    def __init__(
        self,
        name: str,
        context: RobotContext,
        *,
        ticks: int,
        outcome: FailureCode | str | None = None,
        effect: Callable[[float], None] | None = None,
        drives: bool = False,
    ) -> None:
        super().__init__(name, context)
        self._ticks, self._outcome, self._effect, self._drives = ticks, outcome, effect, drives
        self._left = ticks
        self.begun = 0
        self.holds_arm = not drives

    def begin(self) -> None:
        """Count the beginnings."""
        self._left = self._ticks
        self.begun += 1

    def step(self) -> Status:
        """One tick nearer to the end."""
        self._left -= 1
        if self._drives:
            self.context.commands.drive = (0.4, 0.0)
        if self._left > 0:
            return Status.RUNNING
        if isinstance(self._outcome, FailureCode):
            return self.fail(self._outcome, f"{self.name} failed as the script says.")
        if self._outcome != PHANTOM and self._effect is not None:
            self._effect(self.context.stamp_s)
        return Status.SUCCESS


class ScriptedSkill:
    """GOTO, PICK or PLACE on a stage: conditions, effects and confirmation are the real skill's, actions are not."""

    def __init__(self, skill: Skill, stage: Stage, script: Script) -> None:
        self.name, self.parameters = skill.name, skill.parameters
        self.schema, self.conditions, self.effects = skill.schema, skill.conditions, skill.effects
        self.cost_s, self.confirmed = skill.cost_s, skill.confirmed
        self.made: list[ScriptedAction] = []
        self._stage, self._script = stage, script

    def actions(self, context: RobotContext, args: Sequence[str]) -> list[Action]:
        """One action for the preparation, one for the effect."""
        outcome, ticks, effect = self._script.next(self.name), self._script.ticks, self._effect(args)
        drives = self.name == "GOTO"
        first = ScriptedAction(f"prepare {self.name}", context, ticks=1)
        last = ScriptedAction(self.name, context, ticks=ticks, outcome=outcome, effect=effect, drives=drives)
        self.made += [first, last]
        return [first, last]

    def _effect(self, args: Sequence[str]) -> Callable[[float], None]:
        stage = self._stage

        def do(stamp_s: float) -> None:
            if self.name == "GOTO":
                stage.stand_at(spot_of(args[0], stage.memory.snapshot()), stamp_s)
            elif self.name == "PICK" and stage.places[args[0]] == stage.robot_at:
                stage.places[args[0]] = GRIPPER
            elif self.name == "PLACE" and stage.places[args[0]] == GRIPPER:
                stage.places[args[0]] = args[1]

        return do


def scripted_skills(stage: Stage, script: Script) -> dict[str, ScriptedSkill]:
    """The three built-in skills, on a stage."""
    return {name: ScriptedSkill(skill, stage, script) for name, skill in load_registry(more=()).items()}


def scripted_look(stage: Stage, script: Script) -> Callable[[str, RobotContext], list[Action]]:
    """Going to a node and looking at it, on a stage; its outcomes are scripted under ``LOOK``."""

    def look_at(node_id: str, context: RobotContext) -> list[Action]:
        def arrive(stamp_s: float) -> None:
            stage.stand_at(spot_of(node_id, stage.memory.snapshot()), stamp_s)

        outcome = script.next("LOOK")
        name = f"look at {node_id}"
        return [ScriptedAction(name, context, ticks=script.ticks, outcome=outcome, effect=arrive, drives=True)]

    return look_at


class ScriptedInterpreter:
    """Understands exactly what it was told; notes what it was asked."""

    def __init__(self, meanings: dict[str, Interpretation]) -> None:
        self.meanings = meanings
        self.asked: list[tuple[str, Dialogue]] = []

    async def interpret(self, text: str, snapshot: Snapshot, dialogue: Dialogue) -> Interpretation:
        """Look the request up, or the last answer to a question."""
        del snapshot
        self.asked.append((text, dialogue))
        return self.meanings[dialogue.answers[-1][1] if dialogue.answers else text]


def spot_of(node_id: str, snapshot: Snapshot) -> str:
    """Where to stand for a node: a support or room itself, an object's support."""
    if isinstance(snapshot.get(node_id), ObjectNode) and node_id not in SUPPORTS:
        return snapshot.support_of(node_id) or snapshot.room_of(node_id) or "room_1"
    return node_id
