"""What a skill is: conditions, effects and actions, described so that a planner and a language model can use it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.errors import WrongArguments
from skills.failures import Failure, FailureCode
from skills.state.state import PlanState, Thing


@dataclass(frozen=True, kw_only=True)
class Parameter:
    """A skill's parameter: its name and the kinds of node it accepts (``object``, ``support``, ``room``, ``person``,
    ``door``).
    """

    name: str
    kinds: frozenset[str]
    description: str = ""

    def accepts(self, thing: Thing) -> bool:
        """Whether ``thing`` is of an accepted kind; ``support`` accepts objects that things are put on or in."""
        if thing.kind in self.kinds:
            return True
        return thing.kind == "object" and "support" in self.kinds and (thing.support or thing.container)


@dataclass(frozen=True, kw_only=True)
class Unmet:
    """A condition that does not hold: one sentence naming the fix, and the nodes it is about.

    ``final``: no step can make it hold, so that it is a reason why there is no plan. ``code``: what has happened when
    it held while the plan was made.
    """

    message: str
    nodes: tuple[str, ...] = ()
    final: bool = False
    code: FailureCode | None = None


class Skill(Protocol):
    """One thing the robot can do. Its docstring is what the language model reads.

    An installed package adds a skill through the entry point group ``majordomo.skills``. One that takes a single node
    is planned for when that node is named by a ``final`` condition that keeps another skill from it, such as a closed
    door. It may declare ``phrases``, what a person says for it: ``("open {door}",)``; those for doors are understood.
    """

    name: str
    parameters: tuple[Parameter, ...]

    def schema(self) -> dict[str, Any]:
        """JSON schema of the arguments."""
        ...

    def conditions(self, state: PlanState, args: Sequence[str]) -> list[Unmet]:
        """What forbids the skill in ``state``; empty when it may run."""
        ...

    def effects(self, state: PlanState, args: Sequence[str]) -> PlanState:
        """The state after the skill; call only when ``conditions`` is empty."""
        ...

    def cost_s(self, state: PlanState, args: Sequence[str]) -> float:
        """Expected seconds."""
        ...

    def actions(self, context: RobotContext, args: Sequence[str]) -> list[Action]:
        """Actions that carry the skill out from the graph as it is now (the Skill Planner calls this)."""
        ...

    def confirmed(self, snapshot: Snapshot, args: Sequence[str], since_s: float) -> Failure | None:
        """``None`` when perception confirms the effect with observations newer than ``since_s``, else what is amiss."""
        ...


def argument_schema(parameters: Sequence[Parameter]) -> dict[str, Any]:
    """JSON schema of a skill's arguments: every parameter a node identifier, all required, no others."""
    return {
        "type": "object",
        "properties": {p.name: {"type": "string", "description": p.description} for p in parameters},
        "required": [p.name for p in parameters],
        "additionalProperties": False,
    }


def unknown_arguments(name: str, parameters: Sequence[Parameter], state: PlanState, args: Sequence[str]) -> list[Unmet]:
    """Arguments that name nothing, or something of the wrong kind.

    Raises:
        WrongArguments: ``args`` has another length than ``parameters``.
    """
    if len(args) != len(parameters):
        raise WrongArguments(name, [parameter.name for parameter in parameters], args)
    unmet = []
    for parameter, arg in zip(parameters, args, strict=True):
        thing = state.world.things.get(arg)
        if thing is None:
            unmet.append(Unmet(message=f"{arg} is not in the scene graph: name a node that is."))
        elif not parameter.accepts(thing):
            kinds = " or ".join(sorted(parameter.kinds))
            unmet.append(
                Unmet(message=f"{arg} cannot be the {parameter.name} of {name}: choose a {kinds}.", nodes=(arg,))
            )
    return unmet
