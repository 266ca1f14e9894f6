"""GOTO: drive to a room, a thing, a person or a door."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from scene_graph.nodes import ROBOT_ID, DoorNode, ObjectNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.anchor import Anchor
from skills.arm.approach import ApproachForReach
from skills.arm.arm import Stow
from skills.failures import Evidence, Failure, FailureCode
from skills.goto.journeys import travel, visit
from skills.goto.nearness import excess_m
from skills.goto.settings import GotoSettings
from skills.looking.looking import LookAt
from skills.skill import Parameter, Unmet, argument_schema, unknown_arguments
from skills.state.state import PlanState


class Goto:
    """GOTO(target): drive to a room, an object or piece of furniture, a person, or a door, and look at it.

    Goes through open doors, also over several rooms. Afterwards the robot stands within arm's reach of the target
    (for a room: inside it). Needed before PICK and PLACE. It opens no doors, and it cannot go to something whose
    place is unknown.
    """

    name = "GOTO"
    parameters = (
        Parameter(
            name="target",
            kinds=frozenset({"room", "object", "support", "person", "door"}),
            description="identifier of the room, object, person or door to drive to",
        ),
    )

    def __init__(self, settings: GotoSettings = GotoSettings()) -> None:
        """``settings``: what a way costs, and what counts as being there."""
        self._settings = settings

    def schema(self) -> dict[str, Any]:
        """JSON schema of the arguments."""
        return argument_schema(self.parameters)

    def conditions(self, state: PlanState, args: Sequence[str]) -> list[Unmet]:
        """The target is known, where it should be, not in the hand, and an open way leads there."""
        if unmet := unknown_arguments(self.name, self.parameters, state, args):
            return unmet
        (target,) = args
        if state.holding is not None and state.holding in state.chain(target):
            return [Unmet(message=f"{target} is in the gripper: no need to go to it.", nodes=(target,))]
        if target in state.missing:
            return [Unmet(message=f"{target} is not where it was last seen: look for it first.", nodes=(target,))]
        room = state.room_of(target)
        if room is None:
            return [Unmet(message=f"it is not known in which room {target} is: look for it first.", nodes=(target,))]
        return _way_closed(state, target, room)

    def effects(self, state: PlanState, args: Sequence[str]) -> PlanState:
        """The robot is at the target."""
        (target,) = args
        return state.after(robot_at=target, robot_room=state.room_of(target), near=frozenset(), beyond_walls=False)

    def cost_s(self, state: PlanState, args: Sequence[str]) -> float:
        """Driving time, and a while to line up and look."""
        way_m, settings = state.distance_m(state.robot_at, args[0]), self._settings
        return settings.settle_s + (settings.unknown_way_m if way_m is None else way_m) / settings.speed_mps

    def actions(self, context: RobotContext, args: Sequence[str]) -> list[Action]:
        """Through the doors, then to the target, then look at it."""
        (target,) = args
        node, settings = context.building.node(target), context.settings.goto
        if isinstance(node, RoomNode | DoorNode):
            return visit(context, target, settings.standoff_m)
        if isinstance(node, ObjectNode) and node.graspable:
            way = travel(context, context.building.room_of(target))
            approach = ApproachForReach(context, target, Anchor(target))
            return [Stow(context), *way, approach, LookAt(context, target, Anchor(target))]
        standoff_m = settings.least_standoff_m if isinstance(node, ObjectNode) else settings.person_standoff_m
        return [*visit(context, target, standoff_m), LookAt(context, target, Anchor(target))]

    def confirmed(self, snapshot: Snapshot, args: Sequence[str], since_s: float) -> Failure | None:
        """The graph places the robot in the room, or near the target; the pose estimate is always fresh."""
        del since_s
        (target,) = args
        distance_m = excess_m(snapshot, target, self._settings.near)
        if distance_m is not None and distance_m <= 0.0:
            return None
        message = f"the robot is not at {target}."
        seen = "in another room" if distance_m is None else f"{distance_m:.2f} m too far"
        evidence = Evidence(nodes=(target, ROBOT_ID), revision=snapshot.revision, observation=seen)
        return Failure(code=FailureCode.NOT_CONFIRMED, message=message, evidence=evidence)


def _way_closed(state: PlanState, target: str, room: str) -> list[Unmet]:
    here = state.robot_room
    if here is None or here == room or state.world.distance_m(here, room) is not None:
        return []
    closed = state.world.closed_doors(here, room)
    if closed:
        message = f"the way to {target} is closed: open {', '.join(closed)} or choose something on this side."
        return [Unmet(message=message, nodes=closed, final=True, code=FailureCode.DOOR_CLOSED)]
    return [
        Unmet(message=f"no known way leads from {here} to {target}: explore first.", nodes=(here, room), final=True)
    ]
