"""Layers and node symbols of Spark-DSG (version 1.1): who lives where, and under which number."""

from __future__ import annotations

from enum import IntEnum
from typing import NamedTuple

from scene_graph.nodes import NodeType

HEADER = "SPARK_DSG_header"
VERSION = {"major": 1, "minor": 1, "patch": 3}
METADATA = "majordomo"
"""Key under which nodes, edges and the graph keep what the format has no field for."""
NO_LABEL = 0xFFFFFFFF
"""``semantic_label`` of what has no label."""
NS_PER_S = 1e9
"""Times of the format are in nanoseconds."""
_CATEGORY_BITS = 56


class Layer(IntEnum):
    """Numbers of the layers."""

    OBJECTS = 2
    PLACES = 3
    ROOMS = 4
    BUILDINGS = 5


class Home(NamedTuple):
    """Layer and partition of a kind of node, and the category of its symbols. Agents live in partitions of their own,
    each under the number of its category.
    """

    layer: Layer
    category: str
    partition: int = 0


BUILDING = Home(Layer.BUILDINGS, "B")
HOMES: dict[NodeType, Home] = {
    NodeType.ROOM: Home(Layer.ROOMS, "R"),
    NodeType.DOOR: Home(Layer.PLACES, "D"),
    NodeType.OBJECT: Home(Layer.OBJECTS, "O"),
    NodeType.ROBOT: Home(Layer.OBJECTS, "a", ord("a")),
    NodeType.PERSON: Home(Layer.OBJECTS, "h", ord("h")),
}
"""Where nodes are put. Types that are not listed have no layer there."""


def symbol(category: str, index: int) -> int:
    """Number of the node: its category in the highest byte, then its index."""
    return (ord(category) << _CATEGORY_BITS) | index


def index_of(number: int) -> int:
    """The index in a node's number."""
    return number & ((1 << _CATEGORY_BITS) - 1)
