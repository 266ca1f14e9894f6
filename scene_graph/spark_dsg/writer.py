"""A snapshot as a Spark-DSG document: buildings, rooms, doors as places, objects, agents.

Attributes of the format's own are filled where it has one for what is known. All else of a node is kept under
``majordomo`` in its metadata, where ``reader`` finds it. Walls, corners, affordances and intentions have no layer and
are left out, and so are the frames between them: everything is in the map. No edge leads from a node to itself.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from scene_graph.documents.interchange import to_json
from scene_graph.nodes import NodeType
from scene_graph.snapshot import Snapshot
from scene_graph.spark_dsg.layers import BUILDING, HEADER, HOMES, METADATA, NO_LABEL, NS_PER_S, VERSION, Home, symbol

Record = dict[str, Any]

CARRIED = (*HOMES, NodeType.ROOT, NodeType.REGION)
"""Node types that come through; the root as the building, regions as metadata of the graph."""
_TOLD = ("position_m", "yaw_rad", "size_m")
"""Fields of a record that attributes hold; only rooms have no attribute for how they are turned."""


def to_spark_dsg(snapshot: Snapshot) -> Record:
    """The document of the whole known building, in the map frame; made of plain lists, dictionaries and numbers."""
    scene = to_json(snapshot, frame="map", layers=[str(kind) for kind in CARRIED])
    return _Writer(scene).document()


class _Writer:
    def __init__(self, scene: Mapping[str, Any]) -> None:
        self._scene = scene
        self._records: dict[str, Record] = {record["id"]: record for record in scene["nodes"]}
        self._labels = {
            layer: _numbered(record["label"] for record in scene["nodes"] if record["type"] == layer)
            for layer in (NodeType.ROOM, NodeType.OBJECT)
        }
        self._numbers = self._symbols()

    def document(self) -> Record:
        """All of it."""
        homes = sorted({(home.layer.value, home.partition) for home in (BUILDING, *HOMES.values())})
        return {
            HEADER: {"project_name": "main", "version": VERSION},
            "directed": False,
            "multigraph": False,
            "metadata": self._metadata(),
            "layer_keys": [{"layer": layer, "partition": partition} for layer, partition in homes],
            "layer_names": _layer_names(),
            "nodes": [self._building(), *(self._node(self._records[node_id]) for node_id in self._numbers)],
            "edges": [_edge(source, target, told) for (source, target), told in self._edges().items()],
        }

    def _symbols(self) -> dict[str, int]:
        counts: dict[str, int] = dict.fromkeys(HOMES, 0)
        numbers: dict[str, int] = {}
        for record in self._records.values():
            home = HOMES.get(record["type"])
            if home is not None:
                numbers[record["id"]] = symbol(home.category, counts[record["type"]])
                counts[record["type"]] += 1
        return numbers

    def _metadata(self) -> Record:
        of_type = {kind: [r for r in self._records.values() if r["type"] == kind] for kind in CARRIED}
        spaces = {
            f"_l{HOMES[kind].layer}p0": [[number, label] for label, number in labels.items()]
            for kind, labels in self._labels.items()
            if labels
        }
        return {
            "labelspaces": spaces,
            METADATA: {
                "revision": self._scene["revision"],
                "stamp_s": self._scene["stamp_s"],
                "root": of_type[NodeType.ROOT][0],
                "regions": of_type[NodeType.REGION],
            },
        }

    def _building(self) -> Record:
        rooms = [record["position_m"] for record in self._records.values() if record["type"] == NodeType.ROOM]
        middle = [sum(axis) / len(rooms) for axis in zip(*rooms, strict=True)] if rooms else [0.0, 0.0, 0.0]
        attributes = _semantic("SemanticNodeAttributes", "building", middle, NO_LABEL)
        return _placed(symbol(BUILDING.category, 0), BUILDING, attributes)

    def _node(self, record: Record) -> Record:
        make = {
            NodeType.ROOM: self._room,
            NodeType.DOOR: _place,
            NodeType.OBJECT: self._object,
            NodeType.ROBOT: _agent,
            NodeType.PERSON: _agent,
        }[NodeType(record["type"])]
        attributes = make(record)
        rest = {name: value for name, value in record.items() if name not in _TOLD}
        if record["type"] == NodeType.ROOM:
            rest["yaw_rad"] = record["yaw_rad"]
        attributes["metadata"] = {METADATA: rest}
        return _placed(self._numbers[record["id"]], HOMES[record["type"]], attributes)

    def _room(self, record: Record) -> Record:
        label, chance = record["label"], record["label_probability"]
        attributes = _semantic(
            "RoomNodeAttributes", label or record["id"], record["position_m"], self._number(NodeType.ROOM, label)
        )
        attributes["semantic_class_probabilities"] = {label: chance} if label and chance else {}
        if record["polygon_m"]:
            attributes["bounding_box"] = _box_around(record["polygon_m"], record["height_m"])
        return attributes

    def _object(self, record: Record) -> Record:
        number = self._number(NodeType.OBJECT, record["label"])
        attributes = _semantic("ObjectNodeAttributes", record["id"], record["position_m"], number)
        turned = _about_z(record["yaw_rad"])
        attributes |= {
            "mesh_connections": [],
            "registered": False,
            "world_R_object": turned,
            "last_update_time_ns": _nanoseconds(record["last_seen_s"]),
            "bounding_box": _box("RAABB", record["size_m"], record["position_m"], turned),
        }
        return attributes

    def _number(self, kind: NodeType, label: str) -> int:
        return self._labels[kind].get(label, NO_LABEL)

    def _edges(self) -> dict[tuple[int, int], list[Record]]:
        """Ends of each edge, and what metadata tells about it; relations between the same two things share one."""
        numbers = self._numbers
        edges: dict[tuple[int, int], list[Record]] = {}
        for record in self._records.values():
            if record["type"] == NodeType.ROOM:
                edges[symbol(BUILDING.category, 0), numbers[record["id"]]] = []
            elif record["id"] in numbers and record["room"] is not None:
                edges[numbers[record["room"]], numbers[record["id"]]] = []
            if record["type"] == NodeType.DOOR and len(record["rooms"]) == 2:
                first, second = sorted(numbers[room] for room in record["rooms"])
                edges.setdefault((first, second), []).append({"door": record["id"]})
        for edge in self._scene["edges"]:
            if edge["type"] == "relation" and edge["source"] != edge["target"]:
                first, second = sorted((numbers[edge["source"]], numbers[edge["target"]]))
                told = {name: edge[name] for name in ("source", "target", "label", "probability")}
                edges.setdefault((first, second), []).append(told)
        return edges


def _place(record: Record) -> Record:
    """A door as a place: free space whose clearance is half its width."""
    attributes = _semantic("PlaceNodeAttributes", record["id"], record["position_m"], NO_LABEL)
    attributes |= {
        "active_frontier": False,
        "anti_frontier": False,
        "deformation_connections": [],
        "distance": record["width_m"] / 2.0,
        "frontier_scale": [0.0, 0.0, 0.0],
        "mesh_vertex_labels": [],
        "need_cleanup": False,
        "num_basis_points": 0,
        "num_frontier_voxels": 0,
        "orientation": _about_z(record["yaw_rad"]),
        "pcl_mesh_connections": [],
        "real_place": True,
        "voxblox_mesh_connections": [],
    }
    return attributes


def _agent(record: Record) -> Record:
    return {
        **_bare("AgentNodeAttributes", record["position_m"]),
        "timestamp": 0,
        "world_R_body": _about_z(record["yaw_rad"]),
        "external_key": 0,
        "dbow_ids": None,
        "dbow_values": None,
    }


def _bare(kind: str, position_m: Iterable[float]) -> Record:
    return {
        "type": kind,
        "position": list(position_m),
        "last_update_time_ns": 0,
        "is_active": False,
        "is_predicted": False,
        "metadata": {},
    }


def _semantic(kind: str, name: str, position_m: Iterable[float], label: int) -> Record:
    no_box = _box("INVALID", (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), _about_z(0.0))
    return {
        **_bare(kind, position_m),
        "name": name,
        "semantic_label": label,
        "color": {"r": 0, "g": 0, "b": 0, "a": 255},
        "bounding_box": no_box,
        "semantic_feature": {"rows": 0, "cols": 0, "data": None},
    }


def _box(kind: str, size_m: Iterable[float], center_m: Iterable[float], turned: Record) -> Record:
    return {"type": kind, "dimensions": list(size_m), "world_P_center": list(center_m), "world_R_center": turned}


def _box_around(polygon_m: Iterable[Iterable[float]], height_m: float) -> Record:
    xs, ys = zip(*polygon_m, strict=True)
    size = (max(xs) - min(xs), max(ys) - min(ys), height_m)
    center = ((max(xs) + min(xs)) / 2.0, (max(ys) + min(ys)) / 2.0, height_m / 2.0)
    return _box("AABB", size, center, _about_z(0.0))


def _about_z(yaw_rad: float) -> Record:
    return {"w": math.cos(yaw_rad / 2.0), "x": 0.0, "y": 0.0, "z": math.sin(yaw_rad / 2.0)}


def _nanoseconds(stamp_s: float) -> int:
    """The format knows no time before zero."""
    return max(0, round(stamp_s * NS_PER_S))


def _placed(number: int, home: Home, attributes: Record) -> Record:
    return {"id": number, "layer": int(home.layer), "partition": home.partition, "attributes": attributes}


def _edge(source: int, target: int, told: list[Record]) -> Record:
    metadata = {METADATA: told} if told else {}
    info = {"type": "EdgeAttributes", "weight": 1.0, "weighted": False, "metadata": metadata}
    return {"source": source, "target": target, "info": info}


def _numbered(labels: Iterable[str]) -> dict[str, int]:
    return {label: number for number, label in enumerate(sorted(set(labels) - {""}))}


def _layer_names() -> Record:
    names = {"BUILDINGS": BUILDING, "ROOMS": HOMES[NodeType.ROOM], "PLACES": HOMES[NodeType.DOOR]}
    names |= {"OBJECTS": HOMES[NodeType.OBJECT], "AGENTS": HOMES[NodeType.ROBOT], "PEOPLE": HOMES[NodeType.PERSON]}
    return {name: {"layer": int(home.layer), "partition": home.partition} for name, home in names.items()}
