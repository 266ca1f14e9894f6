"""The Skill Planner: a step becomes actions, and the skills are described for people and models (design, section 8)."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

from planner.plan import Step
from planner.skill_planner.settings import SkillPlanningSettings
from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.errors import SkillNotFound
from skills.facts import read_state
from skills.failures import Failure
from skills.skill import Skill


class SkillPlanner:
    """Looks skills up by name and asks them for actions, confirmation, cost and description."""

    def __init__(self, skills: Mapping[str, Skill], settings: SkillPlanningSettings = SkillPlanningSettings()) -> None:
        self._skills, self._settings = dict(skills), settings

    def skill(self, name: str) -> Skill:
        """The skill of this name.

        Raises:
            SkillNotFound: listing those that are registered.
        """
        try:
            return self._skills[name]
        except KeyError:
            raise SkillNotFound(name, self._skills) from None

    def actions(self, step: Step, context: RobotContext) -> list[Action]:
        """Actions that carry a step out from the graph as it is now."""
        return self.skill(step.skill).actions(context, step.args)

    def confirmed(self, step: Step, snapshot: Snapshot, since_s: float) -> Failure | None:
        """``None`` when perception confirms the step's effect, seen after ``since_s``; else what is amiss."""
        return self.skill(step.skill).confirmed(snapshot, step.args, since_s)

    def timeout_s(self, step: Step, snapshot: Snapshot) -> float:
        """How long a step may act before it counts as stuck."""
        expected_s = self.skill(step.skill).cost_s(read_state(snapshot), step.args)
        return max(self._settings.least_timeout_s, self._settings.timeout_factor * expected_s)

    def describe(self) -> list[dict[str, Any]]:
        """Name, parameters, schema and docstring of every skill, by name."""
        return [_description(self._skills[name]) for name in sorted(self._skills)]


def _description(skill: Skill) -> dict[str, Any]:
    parameters = [{"name": p.name, "kinds": sorted(p.kinds)} for p in skill.parameters]
    text = inspect.getdoc(type(skill)) or ""
    return {"name": skill.name, "description": text, "parameters": parameters, "schema": skill.schema()}


def skill_lines(skills: Mapping[str, Skill]) -> str:
    """The skills as a prompt lists them, one a line: the first paragraph of the docstring."""
    return "\n".join(f"- {_summary(skill)}" for skill in skills.values())


def _summary(skill: Skill) -> str:
    first = (inspect.getdoc(type(skill)) or skill.name).split("\n\n")[0]
    return " ".join(first.split())
