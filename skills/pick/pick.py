"""PICK: take a thing into the gripper."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.action import Action, Refusal, RobotContext
from skills.anchor import Anchor
from skills.arm.approach import ApproachForReach
from skills.arm.arm import Lift, Retract, Stow
from skills.arm.gripper import CloseGripper
from skills.arm.hand import HandSettings
from skills.arm.way_in import off_end
from skills.failures import Evidence, Failure, FailureCode
from skills.goto.journeys import travel
from skills.looking.watching import Check, Confirm, Refine
from skills.navigation.driving import TurnTo
from skills.pick.reach import Reach
from skills.skill import Parameter, Unmet, argument_schema, unknown_arguments
from skills.state.state import PlanState


class Pick:
    """PICK(object): take an object into the gripper.

    The gripper must be empty and the robot at the object or at what it stands on (GOTO first). The object must be
    small enough to grasp, with nothing on it or, in a shelf, before it; what is in it comes along. Afterwards the
    robot holds the object and can GOTO somewhere and PLACE it.
    """

    name = "PICK"
    parameters = (
        Parameter(name="object", kinds=frozenset({"object"}), description="identifier of the object to take"),
    )

    def __init__(self, settings: HandSettings = HandSettings()) -> None:
        """``settings``: what the hand can take hold of."""
        self._settings = settings

    def schema(self) -> dict[str, Any]:
        """JSON schema of the arguments."""
        return argument_schema(self.parameters)

    def conditions(self, state: PlanState, args: Sequence[str]) -> list[Unmet]:
        """The hand is empty, and the object can be grasped, is where it should be, is free, and is near."""
        if unmet := unknown_arguments(self.name, self.parameters, state, args):
            return unmet
        (target,) = args
        return _not_graspable(state, target, self._settings) or _not_free(state, target)

    def effects(self, state: PlanState, args: Sequence[str]) -> PlanState:
        """The robot holds the object; it still stands where the object was."""
        (target,) = args
        robot_at = state.robot_at
        if robot_at == target:
            robot_at = state.places[target][1] if target in state.places else state.robot_room or robot_at
        return state.after(
            holding=target, places=state.moved(target, None), robot_at=robot_at, near=state.near - {target}
        )

    def cost_s(self, state: PlanState, args: Sequence[str]) -> float:
        """Looking closely, reaching, closing, lifting, drawing back."""
        del state, args
        return 30.0

    def actions(self, context: RobotContext, args: Sequence[str]) -> list[Action]:
        """Stand so that the arm reaches, look closely, face it, reach, close, lift, draw back, and see that it is
        held.
        """
        (target,) = args
        snapshot = context.building
        holder = snapshot.support_of(target) or snapshot.room_of(target)
        if holder is None:
            message = f"it is not known where {target} is."
            return [Refusal(context, Failure(code=FailureCode.OBJECT_GONE, message=message))]
        place, here = Anchor.fix(snapshot, target, holder), Anchor(target)

        def aim() -> Anchor:
            return off_end(context.snapshot, target, context.hand)

        return [
            Stow(context),
            *travel(context, snapshot.room_of(target)),
            ApproachForReach(context, target, here),
            TurnTo(context, target, here),
            Refine(context, target, place),
            TurnTo(context, target, aim, tolerance_rad=context.settings.approach.aim_rad),
            Reach(context, target),
            CloseGripper(context, target),
            Lift(context, target),
            Retract(context, watch=target),
            Confirm(context, f"{target} is held", place, held_check(target), grip_needed=True),
        ]

    def confirmed(self, snapshot: Snapshot, args: Sequence[str], since_s: float) -> Failure | None:
        """Perception of the grip says that the robot holds the object."""
        return held_check(args[0])(snapshot, since_s)


def held_check(object_id: str) -> Check:
    """A check that perception says the robot holds ``object_id``."""

    def check(snapshot: Snapshot, since_s: float) -> Failure | None:
        del since_s
        node, robot = snapshot.get(object_id), snapshot.robot
        held = isinstance(node, ObjectNode) and node.state is ObjectState.HELD
        if held and robot is not None and robot.holding == object_id:
            return None
        seen = f"state {node.state}" if isinstance(node, ObjectNode) else "not in the graph"
        evidence = Evidence(nodes=(object_id, ROBOT_ID), revision=snapshot.revision, observation=seen)
        message = f"it is not confirmed that the robot holds {object_id}."
        return Failure(code=FailureCode.NOT_CONFIRMED, message=message, evidence=evidence)

    return check


def _not_graspable(state: PlanState, target: str, settings: HandSettings) -> list[Unmet]:
    thing = state.world.things[target]
    if not thing.graspable:
        return [Unmet(message=f"{target} cannot be grasped: choose something small.", nodes=(target,), final=True)]
    if thing.width_m > settings.doubtful_width_m:
        message = f"{target} is {thing.width_m:.2f} m wide, too wide for the fingers: choose something narrower."
        return [Unmet(message=message, nodes=(target,), final=True)]
    return []


def _not_free(state: PlanState, target: str) -> list[Unmet]:
    if state.holding == target:
        return [Unmet(message=f"the robot already holds {target}.", nodes=(target,))]
    if state.holding is not None:
        message = f"the robot holds {state.holding}: PLACE it somewhere first."
        return [Unmet(message=message, nodes=(state.holding,))]
    if target in state.missing:
        return [Unmet(message=f"{target} is not where it was last seen: look for it first.", nodes=(target,))]
    if above := state.standing_on(target):
        return [Unmet(message=f"{above[0]} stands on {target}: move it away first.", nodes=(above[0], target))]
    if before := state.in_the_way_of(target):
        return [Unmet(message=f"{before[0]} stands before {target}: move it away first.", nodes=(before[0], target))]
    if not state.is_at(target):
        return [Unmet(message=f"the robot is not at {target}: GOTO {target} first.", nodes=(target,))]
    return []
