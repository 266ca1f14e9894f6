"""A snapshot from a JSON document, written by ``scene_writer`` or by hand."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence

from pydantic import ValidationError

from scene_graph.checks.invariants import check
from scene_graph.documents.document import SceneDocument
from scene_graph.documents.edge_reader import EdgeReader
from scene_graph.documents.node_reader import read_node
from scene_graph.documents.places import Places
from scene_graph.edges import Edge, EdgeKey
from scene_graph.errors import SceneFormatError, Violation, edge_name
from scene_graph.nodes import ROBOT_ID, ROOT_ID, Node, RobotNode, RootNode
from scene_graph.snapshot import Snapshot


def parse(document: Mapping[str, object]) -> SceneDocument:
    """Checks types, ranges and identifiers.

    Raises:
        SceneFormatError: naming the path of the first field that is wrong.
    """
    try:
        text = json.dumps(document)
    except (TypeError, ValueError) as error:
        raise SceneFormatError("$", f"not a JSON document: {error}") from error
    try:
        parsed = SceneDocument.model_validate_json(text)
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        raise SceneFormatError(_path(first["loc"], first["type"]), first["msg"]) from error
    _require_unique(parsed)
    _require_ends(parsed)
    return parsed


def read(document: SceneDocument) -> Snapshot:
    """The snapshot of a parsed document, with what it leaves out filled in.

    Raises:
        SceneFormatError: what it says is no sound graph.
    """
    places = Places(document)
    nodes = [read_node(record, places, document.stamp_s) for record in document.nodes]
    start: tuple[Node, ...] = (RootNode(), RobotNode(holding=places.held_id))
    reader = EdgeReader(document, places)
    edges: dict[EdgeKey, Edge] = {}
    listed: dict[str, int] = {}
    for i, edge in reader.stated():
        edges.setdefault(edge.key, edge)
        listed.setdefault(edge_name(edge.key), i)
    for edge in reader.implied():
        edges.setdefault(edge.key, edge)
    snapshot = Snapshot.of(
        [*(node for node in start if node.id not in places.records), *nodes],
        edges.values(),
        revision=document.revision,
        stamp_s=document.stamp_s,
    )
    for violation in check(snapshot):
        raise SceneFormatError(_path_of(violation, document, listed), violation.message)
    return snapshot


def _path(location: Sequence[str | int], kind: str) -> str:
    """Such as ``nodes[3].position_m[0]``; the validator adds the type of a node, which is not part of the path."""
    parts = [*location[:2], *location[3:]] if location[:1] == ("nodes",) else list(location)
    if kind.startswith("union_tag"):
        parts.append("type")
    path = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in parts)
    return path.removeprefix(".") or "$"


def _path_of(violation: Violation, document: SceneDocument, listed: Mapping[str, int]) -> str:
    if violation.subject in listed:
        return f"edges[{listed[violation.subject]}]"
    for i, record in enumerate(document.nodes):
        if record.id == violation.subject:
            return f"nodes[{i}]"
    return "$"


def _require_unique(document: SceneDocument) -> None:
    first: dict[str, int] = {}
    for i, record in enumerate(document.nodes):
        if record.id in first:
            raise SceneFormatError(f"nodes[{i}].id", f"{record.id!r} is also the id of nodes[{first[record.id]}]")
        first[record.id] = i


def _require_ends(document: SceneDocument) -> None:
    """Root and robot need not be listed."""
    known = dict.fromkeys((*(record.id for record in document.nodes), ROOT_ID, ROBOT_ID))
    for i, edge in enumerate(document.edges):
        for end in ("source", "target"):
            node_id = getattr(edge, end)
            if node_id not in known:
                raise SceneFormatError(f"edges[{i}].{end}", f"no node {node_id!r}; nodes: {', '.join(known)}")
