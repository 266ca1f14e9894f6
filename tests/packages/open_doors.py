"""A package of its own that teaches the robot to open doors: an example of a skill that is not part of Majordomo."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from majordomo import (
    Action,
    DoorNode,
    DoorState,
    Evidence,
    Failure,
    FailureCode,
    Parameter,
    PlanState,
    RobotContext,
    Snapshot,
    Unmet,
    argument_schema,
    unknown_arguments,
    visit,
)


class Open:
    """OPEN(door): open a closed door.

    The robot must be at the door (GOTO it first) with an empty gripper. Afterwards the door is open.
    """

    name = "OPEN"
    parameters = (Parameter(name="door", kinds=frozenset({"door"}), description="identifier of the door to open"),)
    phrases = ("open {door}", "unlock {door}")

    def schema(self) -> dict[str, Any]:
        """JSON schema of the arguments."""
        return argument_schema(self.parameters)

    def conditions(self, state: PlanState, args: Sequence[str]) -> list[Unmet]:
        """The door is closed, the robot stands at it, and its hand is empty."""
        if unmet := unknown_arguments(self.name, self.parameters, state, args):
            return unmet
        (door,) = args
        if not any(link.door == door and not link.open for link in state.world.doors):
            return [Unmet(message=f"{door} is not closed.", nodes=(door,))]
        if state.holding is not None:
            return [
                Unmet(message=f"the robot holds {state.holding}: PLACE it somewhere first.", nodes=(state.holding,))
            ]
        if state.robot_at != door:
            return [Unmet(message=f"the robot is not at {door}: GOTO {door} first.", nodes=(door,))]
        return []

    def effects(self, state: PlanState, args: Sequence[str]) -> PlanState:
        """The door is open."""
        return state.after(world=state.world.with_door(args[0], is_open=True))

    def cost_s(self, state: PlanState, args: Sequence[str]) -> float:
        """Reaching for the handle, and drawing back."""
        del state, args
        return 20.0

    def actions(self, context: RobotContext, args: Sequence[str]) -> list[Action]:
        """Drive before the door; the arm's part depends on the handle."""
        return visit(context, args[0], 0.6)

    def confirmed(self, snapshot: Snapshot, args: Sequence[str], since_s: float) -> Failure | None:
        """The graph believes that the door is open."""
        del since_s
        node = snapshot.get(args[0])
        if isinstance(node, DoorNode) and node.state is DoorState.OPEN:
            return None
        evidence = Evidence(nodes=tuple(args), revision=snapshot.revision, observation="door state")
        return Failure(code=FailureCode.NOT_CONFIRMED, message=f"{args[0]} is not seen open.", evidence=evidence)
