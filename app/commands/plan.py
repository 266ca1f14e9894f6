"""``majordomo plan``: a request is understood and planned for on a stored graph; nothing runs and nothing moves."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner.explainer.explainer import plan_sentence
from planner.goals import Goal
from planner.language.grammar.parser import CommandGrammar
from planner.naming import step_phrase
from planner.plan import Dialogue, Impossible, Interpretation, Kind, Plan
from planner.skill_planner.pddl import Problem, export
from planner.skill_planner.replanner import Replanner
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from scene_graph.snapshot import Snapshot
from skills.registry import load_registry


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What a request means on a graph, the plan for it or the reason why there is none, and the problem as PDDL."""

    meaning: Interpretation
    plan: Plan | Impossible | None
    problem: Problem | None

    @property
    def succeeded(self) -> bool:
        """Whether there is a plan, or an answer."""
        return isinstance(self.plan, Plan) or self.meaning.kind is Kind.ANSWER


def plan_on(snapshot: Snapshot, request: str) -> Outcome:
    """Plan for ``request`` on ``snapshot`` with the command grammar and the installed skills."""
    skills = load_registry()
    verifier = Verifier(skills)
    reading = TaskPlanner(CommandGrammar(), verifier).read(request, snapshot, Dialogue())
    meaning = reading.interpretation
    if meaning.kind is not Kind.PLAN:
        return Outcome(meaning=meaning, plan=None, problem=None)
    plan = Replanner(verifier).first_plan(meaning.goals, snapshot, snapshot.stamp_s)
    problem = export(meaning.goals, verifier.state(snapshot), skills)
    return Outcome(meaning=meaning, plan=plan, problem=problem)


def told(outcome: Outcome, snapshot: Snapshot) -> str:
    """The outcome for a person."""
    if not isinstance(outcome.plan, Plan):
        return outcome.plan.reason if outcome.plan is not None else outcome.meaning.reply
    plan = outcome.plan
    lines = [plan_sentence(plan, snapshot)]
    width = max((len(str(step)) for step in plan.steps), default=0)
    lines += [f"{k:3}  {step!s:{width}}  {step_phrase(step, snapshot)}" for k, step in enumerate(plan.steps, start=1)]
    return "\n".join([*lines, f"about {plan.expected_s:.0f} s, {plan.expected_m:.1f} m"])


def document(outcome: Outcome, request: str) -> dict[str, Any]:
    """The outcome as plain data; ``reply`` is a person's sentence where there is no plan."""
    plan = outcome.plan if isinstance(outcome.plan, Plan) else None
    reason = outcome.plan.reason if isinstance(outcome.plan, Impossible) else outcome.meaning.reply
    found: dict[str, Any] = {"request": request, "kind": outcome.meaning.kind.value, "reply": reason, "plan": None}
    if isinstance(outcome.plan, Impossible):
        found["kind"] = Kind.REFUSE.value
    if outcome.meaning.candidates:
        found["candidates"] = list(outcome.meaning.candidates)
    if plan is not None:
        found["plan"] = {
            "source": plan.source.value,
            "revision": plan.revision,
            "goals": [_goal(goal) for goal in plan.goals],
            "steps": [{"skill": step.skill, "args": list(step.args)} for step in plan.steps],
            "expected_s": round(plan.expected_s, 1),
            "expected_m": round(plan.expected_m, 2),
        }
    return found


def write_problem(problem: Problem, path: Path) -> Path:
    """Write the problem to ``path`` and its domain beside it; the domain's path."""
    domain = path.with_name(f"{path.stem}-domain{path.suffix or '.pddl'}")
    path.write_text(problem.problem, encoding="utf-8")
    domain.write_text(problem.domain, encoding="utf-8")
    return domain


def _goal(goal: Goal) -> dict[str, Any]:
    return {"predicate": goal.predicate.value, "args": list(goal.args)}
