"""Reads the facts that planning needs from a snapshot of the graph."""

from __future__ import annotations

from majordomo.scene_graph.doors import physical_doors
from majordomo.scene_graph.errors import FramesNotConnected
from majordomo.scene_graph.nodes import (
    ROOT_ID,
    DoorNode,
    DoorState,
    ObjectNode,
    ObjectState,
    PersonNode,
    RoomNode,
    RoomStatus,
)
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.nearness import excess_m
from majordomo.skills.state import DoorLink, PlaceRelation, PlanState, Thing, World

CONTAINER_LABELS = frozenset(
    {
        "bowl",
        "box",
        "basket",
        "sink",
        "drawer",
        "cabinet",
        "bin",
        "trash can",
        "refrigerator",
        "microwave",
        "oven",
        "bag",
    }
)


def read_state(snapshot: Snapshot) -> PlanState:
    """The facts that ``snapshot`` believes."""
    world = read_world(snapshot)
    robot = snapshot.robot
    room = snapshot.current_room
    places: dict[str, tuple[PlaceRelation, str]] = {}
    for node in snapshot.of_type(ObjectNode):
        if node.graspable and node.state is not ObjectState.HELD:
            place = _place(snapshot, node)
            if place is not None:
                places[node.id] = place
    return PlanState(
        world=world,
        robot_at=room or ROOT_ID,
        robot_room=room,
        holding=robot.holding if robot is not None else None,
        places=places,
        missing=frozenset(node.id for node in snapshot.of_type(ObjectNode) if node.state is ObjectState.MISSING),
        near=_near(snapshot),
    )


def read_world(snapshot: Snapshot) -> World:
    """The things that plans speak about, and the physical doors between rooms that both are known."""
    things = [_thing(snapshot, node) for node in _nodes(snapshot)]
    return World(things={thing.id: thing for thing in things}, doors=_door_links(snapshot))


def is_container(label: str) -> bool:
    """Whether things are put *in* rather than *on* something of this label."""
    return label.replace("_", " ") in CONTAINER_LABELS


def _nodes(snapshot: Snapshot) -> list[RoomNode | DoorNode | ObjectNode | PersonNode]:
    rooms = [room for room in snapshot.of_type(RoomNode) if room.status is not RoomStatus.TEMPORARY]
    return [*rooms, *snapshot.of_type(DoorNode), *snapshot.of_type(ObjectNode), *snapshot.of_type(PersonNode)]


def _thing(snapshot: Snapshot, node: RoomNode | DoorNode | ObjectNode | PersonNode) -> Thing:
    room = snapshot.room_of(node.id)
    position = _on_map(snapshot, node.id)
    if isinstance(node, ObjectNode):
        return Thing(
            id=node.id,
            kind="object",
            label=node.label,
            room=room,
            graspable=node.graspable,
            support=node.support,
            container=is_container(node.label),
            width_m=min(node.size_m[:2]),
            position_m=position,
        )
    kind = {RoomNode: "room", DoorNode: "door", PersonNode: "person"}[type(node)]
    return Thing(id=node.id, kind=kind, label=node.label, room=room, position_m=position)


def _on_map(snapshot: Snapshot, node_id: str) -> tuple[float, float] | None:
    try:
        x_m, y_m, _ = snapshot.position(node_id, ROOT_ID)
    except FramesNotConnected:
        return None
    return float(x_m), float(y_m)


def _door_links(snapshot: Snapshot) -> tuple[DoorLink, ...]:
    return tuple(
        DoorLink(door=door.id, rooms=(door.rooms[0], door.rooms[1]), open=door.state is not DoorState.CLOSED)
        for door in physical_doors(snapshot)
        if len(door.rooms) == 2
    )


def _place(snapshot: Snapshot, node: ObjectNode) -> tuple[PlaceRelation, str] | None:
    support = snapshot.support_of(node.id)
    room = snapshot.room_of(node.id)
    if support is not None and support in snapshot:
        inside = isinstance(target := snapshot.node(support), ObjectNode) and is_container(target.label)
        return (PlaceRelation.IN if inside else PlaceRelation.ON), support
    return (PlaceRelation.IN, room) if room is not None else None


def _near(snapshot: Snapshot) -> frozenset[str]:
    """Objects and persons that the robot is at."""
    holding = snapshot.robot.holding if snapshot.robot is not None else None
    nodes = [*(node.id for node in snapshot.of_type(ObjectNode)), *(node.id for node in snapshot.of_type(PersonNode))]
    gaps = {node_id: excess_m(snapshot, node_id) for node_id in nodes if node_id != holding}
    return frozenset(node_id for node_id, gap_m in gaps.items() if gap_m is not None and gap_m <= 0.0)
