"""PLACE: put down what the gripper holds."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from math import hypot
from typing import Any

from scene_graph.nodes import ObjectNode, ObjectState, PersonNode
from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.anchor import Anchor
from skills.arm.approach import ApproachForReach
from skills.arm.arm import Retract, Stow
from skills.arm.gripper import OpenGripper
from skills.failures import Evidence, Failure, FailureCode
from skills.goto.journeys import travel
from skills.looking.looking import LookAt
from skills.looking.watching import Check, Confirm
from skills.navigation.driving import TurnTo
from skills.place.place_search import free_spots, ranked_spots
from skills.place.put_down import LowerToPlace
from skills.place.settings import SpotSettings
from skills.place.spot_choice import CheckSpot, ChooseSpot
from skills.place.spot_reach import Placement
from skills.skill import Parameter, Unmet, argument_schema, unknown_arguments
from skills.state.state import PlaceRelation, PlanState, Thing


class Place:
    """PLACE(object, target): put down the object that the robot holds.

    The target is a piece of furniture or a container (GOTO it first), a person (GOTO them first; the object is put
    within their reach), or the room the robot is in (any free place there). The robot must hold the object.
    Afterwards the gripper is empty.
    """

    name = "PLACE"
    parameters = (
        Parameter(name="object", kinds=frozenset({"object"}), description="identifier of the object held"),
        Parameter(
            name="target",
            kinds=frozenset({"support", "person", "room"}),
            description="identifier of the furniture or container to put it on or in, or of the person or room",
        ),
    )

    def __init__(self, settings: SpotSettings = SpotSettings()) -> None:
        """``settings``: where things may stand."""
        self._settings = settings

    def schema(self) -> dict[str, Any]:
        """JSON schema of the arguments."""
        return argument_schema(self.parameters)

    def conditions(self, state: PlanState, args: Sequence[str]) -> list[Unmet]:
        """The robot holds the object and is at the target, which is something else and where it should be."""
        if unmet := unknown_arguments(self.name, self.parameters, state, args):
            return unmet
        held, target = args
        if held == target:
            return [Unmet(message=f"{held} cannot be put on itself: choose another target.", nodes=(held,))]
        if state.holding != held:
            return [Unmet(message=f"the robot does not hold {held}: PICK it first.", nodes=(held,))]
        if target in state.missing:
            return [Unmet(message=f"{target} is not where it was last seen: look for it first.", nodes=(target,))]
        if not state.has_room_for(held, target):
            message = f"{target} is full, {held} does not fit there: choose another place, or have it cleared first."
            return [Unmet(message=message, nodes=(target, held), final=True, code=FailureCode.SUPPORT_FULL)]
        if not _is_there(state, target):
            return [Unmet(message=f"the robot is not at {target}: GOTO {target} first.", nodes=(target,))]
        return []

    def effects(self, state: PlanState, args: Sequence[str]) -> PlanState:
        """The object is on, in, or with the target; the hand is empty."""
        held, target = args
        relation = relation_to(state.world.things[target])
        return state.after(holding=None, places=state.moved(held, (relation, target)))

    def cost_s(self, state: PlanState, args: Sequence[str]) -> float:
        """Choosing a spot, lowering, letting go, drawing back, looking."""
        del state, args
        return 25.0

    def actions(self, context: RobotContext, args: Sequence[str]) -> list[Action]:
        """Choose a free spot, stand so that the arm reaches it, look, lower, let go, draw back, and see it stand
        there.
        """
        held, target = args
        placement = Placement(
            object_id=held,
            target=target,
            spots=lambda: free_spots(context, held, target),
            further=lambda: islice(ranked_spots(context, held, target), 1, None),
            spots_if_empty=lambda: free_spots(context, held, target, as_empty=True),
        )
        spot = placement.anchor
        return [
            Stow(context),
            *travel(context, context.building.room_of(target)),
            ChooseSpot(context, placement),
            ApproachForReach(context, target, spot, price=lambda places: placement.price_m(context, places)),
            LookAt(context, target, spot, dwell_s=context.settings.place.put_down.inspect_s),
            CheckSpot(context, placement),
            TurnTo(context, target, spot, tolerance_rad=context.settings.approach.aim_rad),
            LowerToPlace(context, placement),
            OpenGripper(context, held),
            Retract(context),
            Confirm(context, f"{held} is placed", Anchor(held), placed_check(held, target, self._settings)),
        ]

    def confirmed(self, snapshot: Snapshot, args: Sequence[str], since_s: float) -> Failure | None:
        """The object has been seen since, standing on, in, or with the target."""
        held, target = args
        return placed_check(held, target, self._settings)(snapshot, since_s)


def relation_to(target: Thing) -> PlaceRelation:
    """How an object is placed at a target of this kind."""
    if target.kind == "person":
        return PlaceRelation.GIVEN
    return PlaceRelation.IN if target.kind == "room" or target.container else PlaceRelation.ON


def placed_check(object_id: str, target: str, settings: SpotSettings = SpotSettings()) -> Check:
    """A check that ``object_id`` was seen since, out of the hand, at ``target``."""

    def check(snapshot: Snapshot, since_s: float) -> Failure | None:
        amiss = _amiss(snapshot, object_id, target, since_s, settings)
        if amiss is None:
            return None
        evidence = Evidence(nodes=(object_id, target), revision=snapshot.revision, observation=amiss)
        message = f"it is not confirmed that {object_id} is at {target}."
        return Failure(code=FailureCode.NOT_CONFIRMED, message=message, evidence=evidence)

    return check


def _amiss(snapshot: Snapshot, object_id: str, target: str, since_s: float, settings: SpotSettings) -> str | None:
    node, robot = snapshot.get(object_id), snapshot.robot
    if not isinstance(node, ObjectNode):
        return "not in the graph"
    if node.state is not ObjectState.PRESENT or (robot is not None and robot.holding == object_id):
        return f"state {node.state}"
    if node.last_seen_s <= since_s:
        return f"last seen at {node.last_seen_s:.1f} s"
    if target not in snapshot:
        return f"{target} is not in the graph"
    return None if _is_at(snapshot, object_id, target, settings.handover_m) else f"on {snapshot.support_of(object_id)}"


def _is_at(snapshot: Snapshot, object_id: str, target: str, handover_m: float) -> bool:
    node = snapshot.node(target)
    if isinstance(node, ObjectNode):
        return snapshot.support_of(object_id) == target
    same_room = snapshot.room_of(object_id) == snapshot.room_of(target)
    if not isinstance(node, PersonNode):
        return same_room
    x_m, y_m, _ = snapshot.transform(target, object_id).translation_m
    return same_room and hypot(x_m, y_m) <= handover_m


def _is_there(state: PlanState, target: str) -> bool:
    if state.world.things[target].kind == "room":
        return state.is_inside(target)
    return state.is_at(target)
