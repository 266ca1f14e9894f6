"""Nodes and edges as plain JSON values and back, without loss: all fields, full transforms, full covariances.

This is the format of files, not of the interface: what is read is exactly what was written.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from pydantic import TypeAdapter, ValidationError

from scene_graph.edges import (
    ConnectsEdge,
    Edge,
    EdgeType,
    HasEdge,
    HasIntentionEdge,
    InEdge,
    MatchEdge,
    RelationEdge,
    RtEdge,
)
from scene_graph.errors import SceneFormatError
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import NODE_CLASSES, Node, NodeType, node_type

Record = dict[str, Any]

EDGE_CLASSES: dict[EdgeType, type[Edge]] = {
    EdgeType.RT: RtEdge,
    EdgeType.IN: InEdge,
    EdgeType.RELATION: RelationEdge,
    EdgeType.CONNECTS: ConnectsEdge,
    EdgeType.MATCH: MatchEdge,
    EdgeType.HAS: HasEdge,
    EdgeType.HAS_INTENTION: HasIntentionEdge,
}
_RT_FIELDS = ("source", "target", "quat_wxyz", "translation_m", "covariance", "stamp_s")


def node_record(node: Node) -> Record:
    """``type`` and every field of a node."""
    return {"type": node_type(node).value, **_adapter(type(node)).dump_python(node, mode="json")}


def edge_record(edge: Edge) -> Record:
    """``type`` and every field of an edge; the covariance of an rt edge row by row, or null when all of it is zero."""
    kind = edge.key.type.value
    if not isinstance(edge, RtEdge):
        return {"type": kind, **_adapter(type(edge)).dump_python(edge, mode="json")}
    return {
        "type": kind,
        "source": edge.source,
        "target": edge.target,
        "quat_wxyz": edge.T_source_target.quat_wxyz.tolist(),
        "translation_m": edge.T_source_target.translation_m.tolist(),
        "covariance": edge.covariance.tolist() if edge.covariance.any() else None,
        "stamp_s": edge.stamp_s,
        **({"wall_shifts_m": list(edge.wall_shifts_m)} if edge.wall_shifts_m else {}),
    }


def read_node(record: Mapping[str, Any], path: str) -> Node:
    """The node of a record; ``path`` names it in errors.

    Raises:
        SceneFormatError: it is none.
    """
    kind, values = _split(record, path, NodeType)
    return cast("Node", _read(NODE_CLASSES[NodeType(kind)], values, path))


def read_edge(record: Mapping[str, Any], path: str) -> Edge:
    """The edge of a record; ``path`` names it in errors.

    Raises:
        SceneFormatError: it is none.
    """
    kind, values = _split(record, path, EdgeType)
    if kind == EdgeType.RT:
        return _read_rt(values, path)
    return cast("Edge", _read(EDGE_CLASSES[EdgeType(kind)], values, path))


def _split(record: Mapping[str, Any], path: str, kinds: type[NodeType | EdgeType]) -> tuple[str, Mapping[str, Any]]:
    if not isinstance(record, Mapping):
        raise SceneFormatError(path, f"not an object but {type(record).__name__}")
    kind = record.get("type")
    if kind not in {known.value for known in kinds}:
        raise SceneFormatError(f"{path}.type", f"no type {kind!r}; types: {', '.join(kinds)}")
    return str(kind), {name: value for name, value in record.items() if name != "type"}


def _read(cls: type[Any], values: Mapping[str, Any], path: str) -> object:
    known = {field.name for field in fields(cls)}
    for name in values:
        if name not in known:
            raise SceneFormatError(f"{path}.{name}", f"no such field; fields: {', '.join(sorted(known))}")
    try:
        return _adapter(cls).validate_python(values)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise SceneFormatError(".".join([path, *map(str, first["loc"])]), first["msg"]) from error


def _read_rt(values: Mapping[str, Any], path: str) -> RtEdge:
    for name in _RT_FIELDS:
        if name not in values:
            raise SceneFormatError(f"{path}.{name}", "missing")
    covariance = values["covariance"]
    try:
        return RtEdge(
            source=str(values["source"]),
            target=str(values["target"]),
            T_source_target=SE3(values["quat_wxyz"], values["translation_m"]),
            covariance=np.zeros((6, 6)) if covariance is None else _matrix(covariance),
            stamp_s=float(values["stamp_s"]),
            wall_shifts_m=tuple(map(float, values.get("wall_shifts_m", ()))),
        )
    except (TypeError, ValueError) as error:
        raise SceneFormatError(path, str(error)) from error


def _matrix(rows: object) -> NDArray[np.float64]:
    return np.asarray(rows, dtype=np.float64)


def _adapter(cls: type[Any]) -> TypeAdapter[Any]:
    return _adapters()[cls]


@cache
def _adapters() -> dict[type[Any], TypeAdapter[Any]]:
    return {cls: TypeAdapter(cls) for cls in (*NODE_CLASSES.values(), *EDGE_CLASSES.values()) if cls is not RtEdge}
