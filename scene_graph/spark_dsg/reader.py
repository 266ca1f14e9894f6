"""A snapshot from a Spark-DSG document, written by ``writer`` or by somebody else, such as Hydra.

What ``writer`` left in the metadata comes back as it was, except that positions, sizes and turns are those of the
attributes. Of others' graphs rooms, objects and the robot are taken, and doors where two rooms are joined: in the
middle between the two places through which the way leads, or else between the rooms.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import ValidationError

from scene_graph.documents.document import DECIMALS
from scene_graph.documents.interchange import from_json
from scene_graph.errors import SceneFormatError
from scene_graph.identifiers import slug
from scene_graph.nodes import ROBOT_ID, ROOT_ID, UNKNOWN_LABEL, NodeType
from scene_graph.snapshot import Snapshot
from scene_graph.spark_dsg.document import Attributes, Box, Document, Edge, Node, Quaternion
from scene_graph.spark_dsg.layers import HEADER, HOMES, METADATA, NS_PER_S, Layer, index_of

Record = dict[str, Any]

_INHABITANTS = (NodeType.OBJECT, NodeType.PERSON, NodeType.ROBOT)
_LISTED_NODE = re.compile(r"nodes\[(\d+)\]")


def is_spark_dsg(document: Mapping[str, Any]) -> bool:
    """Whether a JSON document is one of Spark-DSG."""
    return HEADER in document or "layer_keys" in document or "layer_ids" in document


def from_spark_dsg(document: Mapping[str, Any]) -> Snapshot:
    """The snapshot of a Spark-DSG document.

    Raises:
        SceneFormatError: ``path`` names the field that is wrong, ``problem`` says why.
    """
    try:
        parsed = Document.model_validate(document)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        path = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in first["loc"])
        raise SceneFormatError(path.removeprefix("."), first["msg"]) from error
    reader = _Reader(parsed)
    scene = reader.scene()
    try:
        return from_json(scene)
    except SceneFormatError as error:
        raise SceneFormatError(_LISTED_NODE.sub(reader.origin, error.path), error.problem) from error


class _Reader:
    def __init__(self, document: Document) -> None:
        self._document = document
        self._nodes = {node.id: node for node in document.nodes}
        self._index = {node.id: index for index, node in enumerate(document.nodes)}
        self._require_sound()
        self._parents = self._hierarchy()
        self._ids = self._names()
        self._origins: list[int | None] = []

    def scene(self) -> Record:
        """The document in our own format."""
        own = self._document.own
        records: list[tuple[int | None, Record]] = [(None, own["root"])] if "root" in own else []
        records += [(None, region) for region in own.get("regions", ())]
        records += [(self._index[number], self._record(self._nodes[number])) for number in self._ids]
        if not any("door" in told for edge in self._document.edges for told in edge.own):
            records += [(None, door) for door in self._passages()]
        self._origins = [origin for origin, _ in records]
        return {
            "revision": own.get("revision", 0),
            "stamp_s": own.get("stamp_s", 0.0),
            "nodes": [record for _, record in records],
            "edges": list(self._relations()),
        }

    def origin(self, listed: re.Match[str]) -> str:
        """Where in the document a node of ``scene`` comes from."""
        origin = self._origins[int(listed[1])]
        return f"metadata.{METADATA}" if origin is None else f"nodes[{origin}].attributes.metadata.{METADATA}"

    def _require_sound(self) -> None:
        for index, node in enumerate(self._document.nodes):
            if self._index[node.id] != index:
                raise SceneFormatError(f"nodes[{index}].id", f"{node.id} is also the id of another node")
        for index, edge in enumerate(self._document.edges):
            for end, number in (("source", edge.source), ("target", edge.target)):
                if number not in self._nodes:
                    raise SceneFormatError(f"edges[{index}].{end}", f"there is no node {number}")

    def _hierarchy(self) -> dict[int, int]:
        """Parent of each node that has one: the lowest that is above it."""
        parents: dict[int, int] = {}
        for edge in self._document.edges:
            upper, lower = self._nodes[edge.source], self._nodes[edge.target]
            if upper.layer < lower.layer:
                upper, lower = lower, upper
            known = self._nodes.get(parents.get(lower.id, -1))
            if upper.layer > lower.layer and (known is None or upper.layer < known.layer):
                parents[lower.id] = upper.id
        return parents

    def _names(self) -> dict[int, str]:
        """Identifiers of the nodes that are taken over, by their numbers."""
        names: dict[int, str] = {}
        taken: set[str] = set()
        robot = self._robot()
        for node in self._document.nodes:
            own = node.attributes.own
            if own is not None and "id" in own:
                names[node.id] = str(own["id"])
            elif node.id == robot:
                names[node.id] = ROBOT_ID
            elif node.partition == 0 and node.layer in {Layer.ROOMS, Layer.OBJECTS} and not _is_agent(node):
                stem = "room" if node.layer == Layer.ROOMS else slug(self._label(node))
                number = index_of(node.id)
                while f"{stem}_{number}" in taken:
                    number += 1
                names[node.id] = f"{stem}_{number}"
            else:
                continue
            taken.add(names[node.id])
        return names

    def _robot(self) -> int | None:
        """The newest pose of the first agent, where the graph is somebody else's."""
        if any(node.attributes.own for node in self._document.nodes):
            return None
        category = HOMES[NodeType.ROBOT].category
        poses = [node.id for node in self._document.nodes if _is_agent(node) and chr(node.id >> 56) == category]
        return max(poses, default=None)

    def _record(self, node: Node) -> Record:
        attributes, own = node.attributes, node.attributes.own
        if own is not None:
            record = {**own, "position_m": list(attributes.position)}
            record.setdefault("yaw_rad", _yaw_rad(attributes.turned))
            if own.get("type") == NodeType.OBJECT:
                record["size_m"] = list(attributes.bounding_box.size_m or (0.0, 0.0, 0.0))
            return record
        record = {"id": self._ids[node.id], "position_m": list(attributes.position)}
        if node.layer == Layer.ROOMS:
            return record | self._foreign_room(node)
        room = self._room_of(node.id)
        if record["id"] == ROBOT_ID:
            return record | {"type": "robot", "room": room, "yaw_rad": _yaw_rad(attributes.turned)}
        seen_s = attributes.last_update_time_ns / NS_PER_S
        told = {"type": "object", "label": self._label(node), "room": room, "last_seen_s": seen_s}
        return record | told | _extent(attributes)

    def _foreign_room(self, node: Node) -> Record:
        label = self._document.labels(Layer.ROOMS).get(node.attributes.semantic_label, "")
        record: Record = {"type": "room", "label": label}
        outline = _outline(node.attributes.bounding_box)
        return record | ({"polygon_m": outline} if outline else {})

    def _label(self, node: Node) -> str:
        attributes = node.attributes
        return self._document.labels(node.layer).get(attributes.semantic_label, attributes.name) or UNKNOWN_LABEL

    def _room_of(self, number: int) -> str | None:
        """The room above a node, if there is one."""
        above: int | None = number
        while above is not None and self._nodes[above].layer < Layer.ROOMS:
            above = self._parents.get(above)
        return self._ids.get(above) if above is not None and self._nodes[above].layer == Layer.ROOMS else None

    def _relations(self) -> Iterator[Record]:
        """Who is in which region and who is in no room, and what ``writer`` left of relations."""
        regions = {region["id"] for region in self._document.own.get("regions", ()) if "id" in region}
        for node in self._document.nodes:
            own = node.attributes.own
            if own is not None and own.get("region") in regions:
                yield {"source": own.get("id"), "target": own["region"], "type": "in"}
            elif own is not None and own.get("type") in _INHABITANTS and own.get("room") is None:
                yield {"source": ROOT_ID, "target": own.get("id"), "type": "rt"}
        for edge in self._document.edges:
            yield from ({**told, "type": "relation"} for told in edge.own if "label" in told)

    def _passages(self) -> Iterator[Record]:
        """A door for each two rooms that are joined, open: somebody's places lead through."""
        crossings = self._crossings()
        for edge in self._joined(Layer.ROOMS):
            first, second = sorted((edge.source, edge.target))
            ends = crossings.get((first, second), (self._nodes[first], self._nodes[second]))
            (x0, y0, _), (x1, y1, _) = (end.attributes.position for end in ends)
            clearance_m = min((end.attributes.distance for end in ends if end.attributes.distance > 0.0), default=0.0)
            door: Record = {
                "id": f"door_{index_of(first)}_{index_of(second)}",
                "type": "door",
                "rooms": [self._ids[first], self._ids[second]],
                "position_m": [(x0 + x1) / 2.0, (y0 + y1) / 2.0, 0.0],
            }
            yield door | ({"width_m": 2.0 * clearance_m} if clearance_m else {})

    def _crossings(self) -> dict[tuple[int, int], tuple[Node, Node]]:
        """Of each two rooms the two joined places, one in either, that are nearest to each other."""
        found: dict[tuple[int, int], tuple[Node, Node]] = {}
        for edge in self._joined(Layer.PLACES):
            places = (self._nodes[edge.source], self._nodes[edge.target])
            first, second = self._parents.get(edge.source), self._parents.get(edge.target)
            if first is None or second is None or first == second:
                continue
            key = (min(first, second), max(first, second))
            if key not in found or _apart_m(places) < _apart_m(found[key]):
                found[key] = places
        return found

    def _joined(self, layer: Layer) -> Iterator[Edge]:
        for edge in self._document.edges:
            ends = (self._nodes[edge.source], self._nodes[edge.target])
            if all(end.layer == layer and end.partition == 0 for end in ends) and edge.source != edge.target:
                yield edge


def _is_agent(node: Node) -> bool:
    return node.attributes.type == "AgentNodeAttributes"


def _apart_m(places: tuple[Node, Node]) -> float:
    return math.dist(places[0].attributes.position, places[1].attributes.position)


def _extent(attributes: Attributes) -> Record:
    """Size and turn of somebody's object, as its box has them; the box's center is where the object is."""
    size_m = attributes.bounding_box.size_m
    if size_m is None:
        return {"yaw_rad": _yaw_rad(attributes.turned)}
    box = attributes.bounding_box
    return {
        "size_m": list(size_m),
        "position_m": list(box.world_P_center),
        "yaw_rad": _yaw_rad(box.world_R_center),
    }


def _outline(box: Box) -> list[list[float]]:
    """The rectangle that a room's box covers, counter-clockwise."""
    if box.size_m is None:
        return []
    (length, width, _), (x, y, _), yaw = box.size_m, box.world_P_center, _yaw_rad(box.world_R_center)
    along, across = (math.cos(yaw), math.sin(yaw)), (-math.sin(yaw), math.cos(yaw))
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    return [
        [
            x + (a * length * along[0] + b * width * across[0]) / 2.0,
            y + (a * length * along[1] + b * width * across[1]) / 2.0,
        ]
        for a, b in corners
    ]


def _yaw_rad(turned: Quaternion) -> float:
    """Of a turn about z twice the angle of (w, z), which keeps what was written; otherwise the heading of x."""
    w, x, y, z = turned.w, turned.x, turned.y, turned.z
    if x == 0.0 and y == 0.0:
        return round(2.0 * math.atan2(z, w), DECIMALS)
    return round(math.atan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z)), DECIMALS)
