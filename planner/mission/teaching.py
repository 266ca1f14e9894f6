"""What a person teaches: "this is the office, on the ground floor", "that is my mug", "her name is Ada"."""

from __future__ import annotations

from dataclasses import replace

from scene_graph.edges import InEdge
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.identifiers import next_id
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import Node, ObjectNode, PersonNode, RegionNode, RoomNode
from scene_graph.snapshot import Snapshot


class NotTeachable(ValueError):
    """A node that has no such property."""

    def __init__(self, node_id: str, what: str) -> None:
        super().__init__(
            f"{node_id} cannot be given a {what}: rooms, regions and objects take a label, objects and persons a name, "
            "rooms a region"
        )


def teach(
    memory: WorkingMemory,
    node_id: str,
    *,
    label: str | None,
    name: str | None,
    region: str | None = None,
    stamp_s: float,
) -> Node:
    """Write a taught label, name or region into the graph; perception never overrides it.

    Raises:
        NodeNotFound: no such node.
        NotTeachable: the node takes no label, name or region.
    """
    building = memory.building()
    node = building.node(node_id)
    if label is not None:
        node = _labelled(node, label)
    if name is not None:
        node = _named(node, name)
    edits: list[Edit] = [PutNode(node)] if label is not None or name is not None else []
    if region is not None:
        edits += _into_region(building, node, region)
    memory.commit(edits, agent="person", stamp_s=stamp_s)
    return node


def _into_region(building: Snapshot, room: Node, name: str) -> list[Edit]:
    """Put a room into the region of this label or identifier, which is made if there is none; an empty one goes."""
    if not isinstance(room, RoomNode):
        raise NotTeachable(room.id, "region")
    known = [
        region for region in building.of_type(RegionNode) if name.casefold() in (region.id, region.label.casefold())
    ]
    region = known[0] if known else RegionNode(id=next_id(building, "region"), label=name)
    before = building.region_of(room.id)
    if before == region.id:
        return []
    edits: list[Edit] = [] if before is None else [RemoveEdge(InEdge(source=room.id, target=before).key)]
    if before is not None and building.rooms_in(before) == (room.id,):
        edits.append(RemoveNode(before))
    return [*edits, PutNode(region), PutEdge(InEdge(source=room.id, target=region.id))]


def _labelled(node: Node, label: str) -> Node:
    match node:
        case RoomNode():
            return replace(node, label=label, label_probability=1.0, label_taught=True)
        case ObjectNode():
            return replace(node, label=label, label_distribution=((label, 1.0),))
        case RegionNode():
            return replace(node, label=label)
        case _:
            raise NotTeachable(node.id, "label")


def _named(node: Node, name: str) -> Node:
    match node:
        case ObjectNode() | PersonNode():
            return replace(node, name=name)
        case _:
            raise NotTeachable(node.id, "name")
