"""Lists of actions that bring the robot somewhere: what skills, and the executor for exploring agents, are made of."""

from __future__ import annotations

from math import atan2, cos, radians, sin

import numpy as np

from scene_graph.nodes import ROBOT_ID, DoorNode, DoorState, ObjectNode, RoomNode, RoomStatus
from scene_graph.queries.doors import physical_doors
from scene_graph.queries.topology import Path, Topology
from scene_graph.snapshot import Snapshot
from skills.action import Action, Refusal, RobotContext
from skills.anchor import Anchor
from skills.arm.arm import Stow
from skills.failures import Evidence, Failure, FailureCode
from skills.goto.doors import ApproachDoor, CrossDoor, EnterRoom
from skills.goto.settings import GotoSettings
from skills.looking.accounting import Account, AccountFor, SeeFromElsewhere
from skills.looking.looking import LookAt, SweepCamera, gaze_points
from skills.navigation.driving import DriveTo
from skills.navigation.goals import around, at_poses, freest, near_origin, overlooking
from skills.obstacles.walls import robot_beyond_m


def travel(context: RobotContext, room: str | None) -> list[Action]:
    """Actions through the doors into ``room``; none when the robot is there or either room is not known. Out of where
    nothing is measured yet, the way leads back through the door that it came by.
    """
    snapshot = context.building
    here = snapshot.current_room
    if here is None or room is None or not _stands(snapshot, here) or not _stands(snapshot, room):
        return []
    back = _back_inside(context, snapshot, here)
    if here == room:
        return back
    path = _way(context, snapshot, here, room)
    if path is None:
        return [Refusal(context, no_way(snapshot, here, room))]
    return [*back, *(action for leg in _legs(path) for action in _through(context, *leg))]


def visit(context: RobotContext, node_id: str, standoff_m: float = 0.0) -> list[Action]:
    """Actions that bring the base to a node: a room's origin, or a place ``standoff_m`` from anything else, facing
    it.
    """
    return [Stow(context), *travel(context, context.building.room_of(node_id)), _drive(context, node_id, standoff_m)]


def cross(context: RobotContext, door_id: str) -> list[Action]:
    """Actions that bring the base through a door to 0.9 m beyond the wall, coming from the door's own room."""
    own_room = context.building.door(door_id).rooms[0]
    return [Stow(context), *travel(context, own_room), ApproachDoor(context, door_id), CrossDoor(context, door_id)]


def look(context: RobotContext, node_id: str, standoff_m: float = 0.8, side_rad: float | None = None) -> list[Action]:
    """Actions that look at a node from ``standoff_m``: around a room from its origin, over the whole of an object from
    where all of it is near, from the side ``side_rad`` (a direction in its frame) if that can be; then at whatever
    should be there and is not seen, and at what hides from there once more from another side.
    """
    node, settings = context.building.node(node_id), context.settings.goto
    if isinstance(node, RoomNode):
        return [*visit(context, node_id), SweepCamera(context)]
    if not isinstance(node, ObjectNode):
        return [
            *visit(context, node_id, standoff_m),
            LookAt(context, node_id, Anchor(node_id), dwell_s=settings.look_s),
        ]
    standoff_m = max(standoff_m, settings.least_standoff_m)
    where, account = overlooking(context, node_id, standoff_m, side_rad=side_rad), Account(context, node_id)
    points = gaze_points(node.size_m, context.geometry.camera_height_m, context.settings.looking)
    return [
        Stow(context),
        *travel(context, context.building.room_of(node_id)),
        DriveTo(context, node_id, where),
        *(LookAt(context, node_id, Anchor(node_id, point), dwell_s=settings.look_s) for point in points),
        AccountFor(account),
        SeeFromElsewhere(account, standoff_m),
        AccountFor(account),
    ]


def look_from_the_middle(context: RobotContext) -> list[Action]:
    """Actions that bring the base to where most of its surroundings can be seen, by what it sees and no map."""
    return [Stow(context), DriveTo(context, ROBOT_ID, freest(context))]


def no_way(snapshot: Snapshot, here: str, room: str) -> Failure:
    """Why no open way leads from one room to another: a closed door, or none known."""
    evidence = Evidence(nodes=(here, room), revision=snapshot.revision, observation="topology")
    path = Topology.from_snapshot(snapshot).path(here, room, only_open=False)
    if path is None:
        message = f"no known way leads from {here} to {room}."
        return Failure(code=FailureCode.WAY_BLOCKED, message=message, evidence=evidence)
    states = {member.id: door.state for door in physical_doors(snapshot) for member in door.members}
    closed = tuple(door for door in path.doors if states.get(door) is DoorState.CLOSED)
    message = f"the way from {here} to {room} is closed at {', '.join(closed)}."
    evidence = Evidence(nodes=(*closed, here, room), revision=snapshot.revision, observation="topology")
    return Failure(code=FailureCode.DOOR_CLOSED, message=message, evidence=evidence)


def _way(context: RobotContext, snapshot: Snapshot, here: str, room: str) -> Path | None:
    """The shortest open way from where the robot stands, around doors that were blocked just now if there is one."""
    topology, start = Topology.from_snapshot(snapshot), snapshot.position(ROBOT_ID, here)
    blocked = {door for door, since_s in context.blocked_doors.items() if context.is_lately(since_s)}
    detour = topology.path(here, room, blocked, start_m=(start[0], start[1]))
    return detour if detour is not None else topology.path(here, room, start_m=(start[0], start[1]))


def _back_inside(context: RobotContext, snapshot: Snapshot, here: str) -> list[Action]:
    """Back into the room that the robot hangs from, through its nearest door, when it stands beyond its walls."""
    if robot_beyond_m(snapshot, context.settings.obstacles.map) == 0.0:
        return []
    doors = [door.id for door in snapshot.of_type(DoorNode) if door.rooms[0] == here]
    away_m = {door: float(np.hypot(*snapshot.position(door, ROBOT_ID)[:2])) for door in doors}
    return (
        [_drive(context, min(away_m, key=lambda door: away_m[door]), context.settings.goto.standoff_m)]
        if away_m
        else []
    )


def _drive(context: RobotContext, node_id: str, standoff_m: float) -> Action:
    node, settings = context.building.node(node_id), context.settings.goto
    if isinstance(node, RoomNode):
        return DriveTo(context, node_id, near_origin(context, node_id))
    standoff_m = max(standoff_m, settings.least_standoff_m)
    if isinstance(node, DoorNode):
        return DriveTo(context, node_id, at_poses(context, node_id, _before_door(standoff_m, settings)))
    return DriveTo(context, node_id, around(context, node_id, standoff_m))


def _before_door(standoff_m: float, settings: GotoSettings) -> list[tuple[float, float, float]]:
    """Poses from which to face a door, in its frame: straight before it, at several distances, then from aside."""
    distances = dict.fromkeys((standoff_m, *settings.doors_from_m))
    places = [(d * sin(radians(a)), d * cos(radians(a))) for a in settings.doors_aside_deg for d in distances]
    return [(x_m, y_m, atan2(-y_m, -x_m)) for x_m, y_m in places]


def _legs(path: Path) -> list[tuple[str, str]]:
    """(door, room entered) along a path."""
    return list(zip(path.doors, path.rooms[1:], strict=True))


def _through(context: RobotContext, door: str, room: str) -> list[Action]:
    crossing = CrossDoor(context, door, beyond_m=context.settings.goto.through_m)
    return [ApproachDoor(context, door), crossing, EnterRoom(context, room)]


def _stands(snapshot: Snapshot, room: str) -> bool:
    node = snapshot.get(room)
    return isinstance(node, RoomNode) and node.status is not RoomStatus.TEMPORARY
