"""What a person teaches about a node: "this is the office", "that is my mug", "her name is Ada"."""

from __future__ import annotations

from dataclasses import replace

from majordomo.scene_graph.edits import PutNode
from majordomo.scene_graph.memory import WorkingMemory
from majordomo.scene_graph.nodes import Node, ObjectNode, PersonNode, RoomNode


class NotTeachable(ValueError):
    """A node that has no such property."""

    def __init__(self, node_id: str, what: str) -> None:
        super().__init__(
            f"{node_id} cannot be given a {what}: only rooms and objects take a label, objects and persons a name"
        )


def teach(memory: WorkingMemory, node_id: str, *, label: str | None, name: str | None, stamp_s: float) -> Node:
    """Write a taught label or name into the graph; perception never overrides it.

    Raises:
        NodeNotFound: no such node.
        NotTeachable: the node takes no label or name.
    """
    node = memory.building().node(node_id)
    if label is not None:
        node = _labelled(node, label)
    if name is not None:
        node = _named(node, name)
    memory.commit([PutNode(node)], agent="person", stamp_s=stamp_s)
    return node


def _labelled(node: Node, label: str) -> Node:
    match node:
        case RoomNode():
            return replace(node, label=label, label_probability=1.0, label_taught=True)
        case ObjectNode():
            return replace(node, label=label, label_distribution=((label, 1.0),))
        case _:
            raise NotTeachable(node.id, "label")


def _named(node: Node, name: str) -> Node:
    match node:
        case ObjectNode() | PersonNode():
            return replace(node, name=name)
        case _:
            raise NotTeachable(node.id, "name")
