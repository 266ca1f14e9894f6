"""Documents about the scene that the interface answers with, made from one snapshot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

from app.http.documents.requests import SceneQuery
from app.views.camera import Gaze
from scene_graph.documents.interchange import to_json
from scene_graph.nodes import ROBOT_ID, ROOT_ID, NodeType
from scene_graph.queries.queries import Near, NodeFilter, Related, select
from scene_graph.queries.topology import path_between
from scene_graph.snapshot import Snapshot


def scene_document(snapshot: Snapshot, frame: str, layers: tuple[str, ...] = ()) -> dict[str, Any]:
    """The scene in ``frame`` (``map`` or ``room``), limited to the node types named in ``layers``, if any."""
    chosen: Literal["map", "room"] = "room" if frame == "room" else "map"
    return to_json(snapshot, frame=chosen, layers=layers or None)


def document_nodes(snapshot: Snapshot) -> list[dict[str, Any]]:
    """All nodes, as the map shows them."""
    nodes: list[dict[str, Any]] = to_json(snapshot, frame="map")["nodes"]
    return nodes


def query_scene(snapshot: Snapshot, query: SceneQuery) -> dict[str, Any]:
    """Nodes that pass the query, and how many there are in all.

    Raises:
        NodeNotFound, UnknownRoom, UnknownRegion: it names something that is not there.
    """
    records = {record["id"]: record for record in document_nodes(snapshot)}
    selection = select(snapshot, _filter(query))
    found = [records[node.id] for node in selection.nodes if node.id in records]
    hidden = len(selection.nodes) - len(found)
    page = found[query.offset : query.offset + query.limit]
    return {"revision": snapshot.revision, "nodes": page, "total": selection.total - hidden}


def _filter(query: SceneQuery) -> NodeFilter:
    asked = query.attributes
    types = (query.type,) if isinstance(query.type, NodeType) else tuple(query.type or ())
    categories = asked.category or asked.categories
    return NodeFilter(
        types=types,
        label=query.label,
        color=asked.color,
        name=asked.name,
        categories=(categories,) if categories else (),
        room=query.room,
        region=query.region,
        related=Related(predicate=query.relation.predicate, target=query.relation.target) if query.relation else None,
        near=Near(node=query.near.node, point_m=query.near.point_m, radius_m=query.near.radius_m)
        if query.near
        else None,
        state=query.state,
        max_age_s=query.max_age_s,
        order_by=query.order_by,
        descending=query.descending,
    )


def scene_path(snapshot: Snapshot, origin: str, target: str) -> dict[str, Any] | None:
    """Rooms and doors between two nodes, ``None`` if there is no way."""
    path = path_between(snapshot, origin, target)
    if path is None:
        return None
    return {
        "from": origin,
        "to": target,
        "rooms": list(path.rooms),
        "doors": list(path.doors),
        "length_m": path.length_m,
    }


def robot_document(
    snapshot: Snapshot,
    *,
    path_room: Sequence[tuple[float, float]],
    gaze: Gaze | None,
    stopped: bool,
    stamp_s: float,
) -> dict[str, Any]:
    """Pose, room, load and path of the robot in the map frame; where its camera looks, in its own."""
    T_map_robot = snapshot.transform(ROOT_ID, ROBOT_ID)
    parent = snapshot.parent(ROBOT_ID)
    path_map: list[list[float]] = []
    if path_room and parent is not None:
        T_map_frame = snapshot.transform(ROOT_ID, parent.source)
        path_map = [
            [round(float(x), 3), round(float(y), 3)]
            for x, y, _ in T_map_frame.apply([(x, y, 0.0) for x, y in path_room])
        ]
    robot = snapshot.robot
    return {
        "stamp_s": round(stamp_s, 3),
        "room": snapshot.current_room,
        "localized": robot is not None and robot.localized,
        "pose_map": {
            "x": round(T_map_robot.x_m, 4),
            "y": round(T_map_robot.y_m, 4),
            "yaw_rad": round(T_map_robot.yaw_rad, 4),
        },
        "holding": robot.holding if robot else None,
        "status": robot.status if robot else "",
        "stopped": stopped,
        "path_map": path_map,
        "camera": gaze.document() if gaze is not None else None,
    }
