"""The agent that shows the graph to the outside: scene, robot and perception events, and the event log."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from app.events.event_log import EventLog
from app.events.stream import EventStream
from app.persistence.node_history import NodeHistory
from scene_graph.diff import Delta
from scene_graph.edges import EdgeType
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, node_type

Documents = dict[str, dict[str, Any]]


class Publisher:
    """Publishes what changed in the scene document since last time, the robot's pose, and once a second the status.

    Args:
        scene: the scene document in the map frame.
        robot: the robot's document. ``status``: the status document.
        history: is told of every scene.
    """

    name = "publisher"

    def __init__(
        self,
        memory: WorkingMemory,
        stream: EventStream,
        log: EventLog,
        *,
        scene: Callable[[], Mapping[str, Any]],
        robot: Callable[[], Mapping[str, Any]],
        status: Callable[[], Mapping[str, Any]],
        history: NodeHistory,
        period_s: float = 0.2,
    ) -> None:
        self.period_s = period_s
        self._stream = stream
        self._log = log
        self._scene, self._robot, self._status = scene, robot, status
        self._history = history
        self._subscription = memory.subscribe(capacity=4096)
        self._nodes: Documents = {}
        self._edges: Documents = {}
        self._next_status_s = 0.0
        self._localized = True
        self._first = True

    async def step(self, stamp_s: float) -> None:
        """Publish what is new."""
        deltas = self._subscription.poll()
        for delta in deltas:
            self._write(delta)
        if self._first or self._subscription.lagged or any(not _is_motion(delta) for delta in deltas):
            self._first = False
            self._publish_scene(stamp_s)
        robot = self._robot()
        self._stream.publish("robot", robot, stamp_s)
        self._say_whether_localized(robot, stamp_s)
        if stamp_s >= self._next_status_s:
            self._next_status_s = stamp_s + 1.0
            self._stream.publish("perception", self._status(), stamp_s)

    def _say_whether_localized(self, robot: Mapping[str, Any], stamp_s: float) -> None:
        """A sentence for people when the robot has lost its place, and when it has found it."""
        if robot["localized"] != self._localized:
            self._localized = robot["localized"]
            found = f"I know again where I am: in {robot['room']}"
            message = found if self._localized else "I do not know where I am; I stay here until I have found out"
            self._stream.publish("log", {"message": message}, stamp_s)

    def _publish_scene(self, stamp_s: float) -> None:
        scene = self._scene()
        nodes = {node["id"]: node for node in scene["nodes"] if node["id"] != ROBOT_ID}
        edges = {_edge_name(edge): edge for edge in scene["edges"]}
        put_nodes, removed_nodes = _changes(self._nodes, nodes)
        put_edges, removed_edges = _changes(self._edges, edges)
        self._nodes, self._edges = nodes, edges
        if put_nodes or removed_nodes or put_edges or removed_edges:
            data = {
                "revision": scene["revision"],
                "put_nodes": put_nodes,
                "removed_nodes": [node["id"] for node in removed_nodes],
                "put_edges": put_edges,
                "removed_edges": removed_edges,
            }
            self._stream.publish("scene", data, stamp_s)
            written = {node["id"] for node in (*put_nodes, *removed_nodes)}
            moved = {edge["source"] for edge in (*put_edges, *removed_edges)}
            self._history.note(nodes, edges, stamp_s, changed=written | moved)

    def _write(self, delta: Delta) -> None:
        """One line per transaction; the robot's own pose, which changes all the time, is left out.

        Of rooms that come from or go to long-term memory only the names are told: nothing in the building has changed.
        """
        edges = [edge for edge in delta.put_edges if not (edge.key.type is EdgeType.RT and edge.target == ROBOT_ID)]
        removed = [key for key in delta.removed_edges if not (key.type is EdgeType.RT and key.target == ROBOT_ID)]
        if delta.unloaded or delta.loaded:
            rooms = {"loaded": list(delta.loaded), "unloaded": list(delta.unloaded)}
            self._log.write(delta.stamp_s, "memory", {"agent": delta.agent, **rooms})
            return
        if not (delta.put_nodes or delta.removed_nodes or edges or removed):
            return
        data = {
            "agent": delta.agent,
            "nodes": [[node_type(node), node.id] for node in delta.put_nodes],
            "removed": list(delta.removed_nodes),
            "edges": [_edge_line(edge) for edge in edges],
            "removed_edges": [list(key) for key in removed],
        }
        self._log.write(delta.stamp_s, "graph", data)


def _is_motion(delta: Delta) -> bool:
    """Whether nothing changed but the robot's pose in its parent, which is published by itself."""
    if delta.put_nodes or delta.removed_nodes or delta.removed_edges or delta.loaded or delta.unloaded:
        return False
    return all(edge.key.type is EdgeType.RT and edge.target == ROBOT_ID for edge in delta.put_edges)


def _edge_line(edge: Any) -> list[Any]:
    key = edge.key
    extra: list[Any] = []
    if key.type is EdgeType.RT:
        extra = [float(value) for value in edge.T_source_target.translation_m]
    elif key.type is EdgeType.HAS_INTENTION:
        extra = [str(edge.action), str(edge.status)]
    elif key.type is EdgeType.RELATION:
        extra = [edge.probability]
    return [*key, *extra]


def _edge_name(edge: Mapping[str, Any]) -> str:
    return "|".join((edge["type"], edge["source"], edge["target"], edge.get("label") or ""))


def _changes(old: Documents, new: Documents) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    put = [document for name, document in new.items() if old.get(name) != document]
    removed = [document for name, document in old.items() if name not in new]
    return put, removed
