"""The scene graph as a JSON document and back (design, section 9)."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from scene_graph.documents.scene_reader import parse, read
from scene_graph.documents.scene_writer import Frame, SceneWriter, layers_named
from scene_graph.snapshot import Snapshot


def to_json(
    snapshot: Snapshot, frame: Frame = "map", layers: Collection[str] | None = None, stamp_s: float | None = None
) -> dict[str, Any]:
    """``{revision, stamp_s, nodes, edges}``, made of plain lists, dictionaries, numbers and texts.

    Args:
        snapshot: what to write.
        frame: ``map``: positions from the robot's start pose, x forward, every physical door one node. ``room``:
            positions from the room of each node, door nodes as they are.
        layers: node types to write, with the edges among them; None writes all.
        stamp_s: time to write; the snapshot's own by default.

    Raises:
        UnknownLayer: there is no such node type.
    """
    writer = SceneWriter(snapshot, frame, layers_named(layers))
    return {
        "revision": snapshot.revision,
        "stamp_s": snapshot.stamp_s if stamp_s is None else stamp_s,
        "nodes": writer.nodes(),
        "edges": writer.edges(),
    }


def from_json(document: Mapping[str, Any]) -> Snapshot:
    """The snapshot of a document in the map frame, full or hand-written.

    Only ``id`` and ``type`` of nodes and ``source``, ``target`` and ``type`` of edges are required; frames, rooms and
    positions are filled in from what is told. Angles other than yaw, and covariances other than of an object's
    position, are not part of a document.

    Raises:
        SceneFormatError: ``path`` names the field that is wrong, ``problem`` says why.
    """
    return read(parse(document))
