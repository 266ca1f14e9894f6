"""What the concept agents' intentions mean in actions: visit, cross, look (Concepts, section 3)."""

from __future__ import annotations

from planner.executor.arbiter import looks_around, place_of
from planner.executor.settings import ExecutorSettings
from scene_graph.edges import HasIntentionEdge, IntentionAction
from scene_graph.nodes import DoorNode
from skills.action import Action, Refusal, RobotContext
from skills.failures import Evidence, Failure, FailureCode
from skills.goto.journeys import cross, look, look_from_the_middle, visit


def explore(
    intention: HasIntentionEdge, context: RobotContext, settings: ExecutorSettings = ExecutorSettings()
) -> list[Action]:
    """Actions that carry out an exploration intention; a refusal when its target has vanished or does not fit."""
    snapshot = context.snapshot
    target = place_of(snapshot, intention.target)
    if target not in snapshot:
        return [_refusal(context, target, f"{target} is no longer on my map.")]
    if looks_around(intention):
        return look_from_the_middle(context)
    match intention.action:
        case IntentionAction.VISIT:
            return visit(context, target, intention.standoff_m)
        case IntentionAction.LOOK:
            return look_at(target, context, intention.standoff_m, intention.side_rad, settings)
        case IntentionAction.CROSS if isinstance(snapshot.node(target), DoorNode):
            return cross(context, target)
        case IntentionAction.CROSS:
            return [_refusal(context, target, f"{target} is no door and cannot be crossed.")]
        case IntentionAction.TASK:
            return [_refusal(context, target, "a task's actions come from its mission.")]


def look_at(
    node_id: str,
    context: RobotContext,
    standoff_m: float = 0.0,
    side_rad: float | None = None,
    settings: ExecutorSettings = ExecutorSettings(),
) -> list[Action]:
    """Actions that approach a node, through doors if need be, and look at it; a room is looked around in."""
    if node_id not in context.snapshot:
        return [_refusal(context, node_id, f"{node_id} is no longer on my map.")]
    return look(context, node_id, standoff_m or settings.look_standoff_m, side_rad)


def _refusal(context: RobotContext, node_id: str, message: str) -> Action:
    evidence = Evidence(nodes=(node_id,), revision=context.snapshot.revision, observation="graph")
    return Refusal(context, Failure(code=FailureCode.UNREACHABLE, message=message, evidence=evidence))
