"""The type check of goals: what is wrong with them on a graph, each flaw one sentence that names the fix."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import get_close_matches

from planner.goals import PLACING, Goal, GoalSettings, Predicate, lasting
from planner.naming import listed, name_of
from planner.plan import Flaw
from planner.surfaces import surfaces_near
from scene_graph.identifiers import natural_key
from scene_graph.nodes import ROBOT_ID, ROOT_ID, DoorNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.failures import FailureCode
from skills.state.state import PlanState, Thing


def goal_flaws(
    goals: Sequence[Goal],
    snapshot: Snapshot,
    state: PlanState,
    *,
    opens_doors: bool = False,
    near_m: float = GoalSettings.near_m,
) -> list[Flaw]:
    """Everything wrong with ``goals``: unknown or unfit nodes, places out of reach, contradictions.

    ``opens_doors``: a skill may do something about closed doors, so that only the search can tell.
    ``near_m``: as in ``GoalSettings``.
    """
    found: list[Flaw] = []
    for goal in goals:
        unknown = list(_unknown(goal, snapshot, state))
        if goal.predicate is Predicate.OPEN and not opens_doors and not unknown:
            found.append(Flaw(message="I cannot open doors.", nodes=goal.args))
            continue
        found += unknown or [*_unfit(goal, snapshot, state, near_m), *_unreachable(goal, snapshot, state, opens_doors)]
    found += _contradictions(goals, snapshot)
    return list({flaw.message: flaw for flaw in found}.values())


def shut_doors(flaws: Sequence[Flaw], snapshot: Snapshot) -> tuple[str, ...]:
    """The closed doors that flaws are about, if they are about nothing else."""
    if any(flaw.code is not FailureCode.DOOR_CLOSED for flaw in flaws):
        return ()
    nodes = dict.fromkeys(node for flaw in flaws for node in flaw.nodes)
    return tuple(node for node in nodes if isinstance(snapshot.get(node), DoorNode))


def _unknown(goal: Goal, snapshot: Snapshot, state: PlanState) -> Iterator[Flaw]:
    for arg in dict.fromkeys(goal.args):
        if arg in state.world.things:
            continue
        node = snapshot.get(arg)
        if isinstance(node, RoomNode):
            yield Flaw(message=f"{_name(arg, snapshot)} has not been measured yet: choose a known room.", nodes=(arg,))
        elif node is not None:
            yield Flaw(message=f"{arg} in {goal} is not a room, object, person or door: choose one.", nodes=(arg,))
        else:
            yield Flaw(message=f"{arg} in {goal} is not in the scene graph{_alternatives(arg, state)}.")


def _alternatives(arg: str, state: PlanState) -> str:
    stem = arg.rsplit("_", 1)[0]
    same = sorted((thing for thing in state.world.things if thing.rsplit("_", 1)[0] == stem), key=natural_key)
    close = same or get_close_matches(arg, list(state.world.things), n=4, cutoff=0.6)
    return f": choose one of {', '.join(close[:6])}" if close else ": choose an identifier from the graph"


def _unfit(goal: Goal, snapshot: Snapshot, state: PlanState, near_m: float) -> Iterator[Flaw]:
    first, last = (state.world.things[arg] for arg in (goal.args[0], goal.args[-1]))
    if goal.predicate is Predicate.ROBOT_AT:
        return
    if goal.predicate is Predicate.OPEN:
        if first.kind != "door":
            yield Flaw(message=f"I can open doors only, and not {_name(first.id, snapshot)}.", nodes=(first.id,))
        return
    if first.kind != "object":
        yield Flaw(
            message=f"I can carry objects only, and {_name(first.id, snapshot)} is a {first.kind}.", nodes=(first.id,)
        )
    elif goal.predicate is not Predicate.FOUND and not first.graspable:
        yield Flaw(
            message=f"I cannot carry {_name(first.id, snapshot)}: choose something that I can.", nodes=(first.id,)
        )
    elif goal.predicate in PLACING and first.id == last.id:
        yield Flaw(
            message=f"{_name(first.id, snapshot)} cannot be put at itself: choose another place.", nodes=(first.id,)
        )
    elif goal.predicate in PLACING:
        yield from _unfit_place(goal, last, snapshot, state, near_m)


def _unfit_place(goal: Goal, place: Thing, snapshot: Snapshot, state: PlanState, near_m: float) -> Iterator[Flaw]:
    name = _name(place.id, snapshot)
    surface = place.kind == "object" and (place.support or place.container)
    if goal.predicate is Predicate.ON and not surface:
        yield Flaw(message=f"Nothing can be put on {name}: choose a table, shelf or the like.", nodes=(place.id,))
    elif goal.predicate is Predicate.IN and place.kind != "room" and not place.container:
        yield Flaw(message=f"Nothing can be put in {name}: choose a container or a room.", nodes=(place.id,))
    elif goal.predicate is Predicate.GIVEN and place.kind != "person":
        yield Flaw(message=f"I can give things to people only, and {name} is a {place.kind}.", nodes=(place.id,))
    elif goal.predicate is Predicate.NEAR and place.kind in ("room", "door"):
        yield Flaw(message=f"I cannot put things near {name}: choose an object or a person.", nodes=(place.id,))
    elif goal.predicate is Predicate.NEAR and place.kind == "object" and _has_no_surface(place, state, near_m):
        message = f"There is no surface near {name} to put things on: choose another place."
        yield Flaw(message=message, nodes=(place.id,))


def _has_no_surface(place: Thing, state: PlanState, near_m: float) -> bool:
    """Only for what stays where it is: what is carried may come to a surface before its turn."""
    return not place.graspable and not surfaces_near(place.id, state, near_m)


def _unreachable(goal: Goal, snapshot: Snapshot, state: PlanState, opens_doors: bool) -> Iterator[Flaw]:
    for arg in dict.fromkeys(goal.args):
        if arg == state.holding or (arg == goal.args[0] and goal.object_id in state.missing):
            continue
        room = state.room_of(arg)
        if room is None and state.world.things[arg].kind != "door":
            yield Flaw(message=f"I do not know which room {_name(arg, snapshot)} is in.", nodes=(arg,))
        elif state.robot_room is None:
            yield Flaw(message="I do not know yet which room I am in: let me look around first.", nodes=(ROBOT_ID,))
        elif room is None or room == state.robot_room or state.distance_m(state.robot_room, room) is not None:
            continue
        elif not opens_doors or not state.world.closed_doors(state.robot_room, room):
            yield _no_way(arg, room, snapshot, state)


def _no_way(arg: str, room: str, snapshot: Snapshot, state: PlanState) -> Flaw:
    name = _name(arg, snapshot)
    closed = state.world.closed_doors(state.robot_room or ROOT_ID, room)
    if not closed:
        return Flaw(message=f"I know of no way to {name}.", nodes=(arg,))
    doors = listed([name_of(door, snapshot) for door in closed])
    verb = "is" if len(closed) == 1 else "are"
    message = f"There is no way to {name}: {doors} {verb} closed, and I cannot open doors."
    return Flaw(message=message, nodes=(arg, *closed), code=FailureCode.DOOR_CLOSED)


def _contradictions(goals: Sequence[Goal], snapshot: Snapshot) -> Iterator[Flaw]:
    last = lasting(goals)
    held = [goal.args[0] for goal in last if goal.predicate is Predicate.HOLDING]
    if len(set(held)) > 1:
        names = listed([_name(object_id, snapshot) for object_id in held])
        yield Flaw(message=f"I have one hand and cannot hold {names} at the same time: choose one.", nodes=tuple(held))
    moved = [goal for goal in goals if goal.predicate in PLACING]
    for index, goal in enumerate(goals):
        if goal not in last or goal.predicate is not Predicate.HOLDING:
            continue
        if any(other in goals[index + 1 :] for other in moved):
            name = _name(goal.args[0], snapshot)
            yield Flaw(
                message=f"I have one hand: I cannot keep holding {name} and carry other things.", nodes=goal.args
            )
    yield from _circles(last, snapshot)


def _circles(goals: Sequence[Goal], snapshot: Snapshot) -> Iterator[Flaw]:
    on = {goal.args[0]: goal.args[1] for goal in goals if goal.predicate in (Predicate.ON, Predicate.IN)}
    for start, node in on.items():
        seen, top = {start}, node
        while top in on and top not in seen:
            seen.add(top)
            top = on[top]
        if top == start and len(seen) > 1:
            names = listed([_name(node_id, snapshot) for node_id in sorted(seen, key=natural_key)])
            yield Flaw(message=f"{names[:1].upper()}{names[1:]} cannot stand on each other.", nodes=tuple(sorted(seen)))
            return


def _name(node_id: str, snapshot: Snapshot) -> str:
    return name_of(node_id, snapshot)
