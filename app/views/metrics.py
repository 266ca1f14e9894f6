"""Prometheus metrics of how things stand, read afresh for every scrape; what is counted over time is in ``tallies``."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from prometheus_client import CollectorRegistry, Gauge, generate_latest

from app.version import __version__
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import TaskStatus
from scene_graph.nodes import node_type
from scene_graph.snapshot import Snapshot

Labels = tuple[str, ...]
"""Values of a metric's labels, in their order."""
AGENT_FIGURES = {
    "rate_hz": "Turns per second of robot time",
    "busy_ms_p50": "Median time of a turn",
    "busy_ms_p99": "99th percentile of a turn",
    "restarts": "Unexpected errors so far",
}


@dataclass(frozen=True, kw_only=True)
class Standing:
    """How things stand at one moment. ``building``: all that is known, ``loaded``: what is in working memory.

    ``agents``: figures by name, as ``GET /v1/status`` shows them. ``listeners``: clients of the stream.
    ``stamp_s``: robot time.
    """

    building: Snapshot
    loaded: Snapshot
    agents: Mapping[str, Mapping[str, Any]]
    queue: TaskQueue
    stamp_s: float
    listeners: int
    stopped: bool
    ready: bool


def metrics_text(standing: Standing) -> bytes:
    """Graph, agents, tasks, queue and robot in Prometheus' text format."""
    registry = CollectorRegistry()
    _gauge(registry, "build_info", "Version of Majordomo", ["version"], {(__version__,): 1})
    _gauge(registry, "robot_time_seconds", "Robot time", [], {(): standing.stamp_s})
    _gauge(registry, "ready", "1 while requests are taken", [], {(): standing.ready})
    _gauge(registry, "stopped", "1 while the software stop is latched", [], {(): standing.stopped})
    _gauge(registry, "stream_clients", "Clients of the event stream", [], {(): standing.listeners})
    _graph(registry, standing)
    for figure, meaning in AGENT_FIGURES.items():
        values: dict[Labels, float] = {(name,): summary[figure] for name, summary in standing.agents.items()}
        _gauge(registry, f"agent_{figure}", meaning, ["agent"], values)
    _queue(registry, standing)
    return generate_latest(registry)


def _graph(registry: CollectorRegistry, standing: Standing) -> None:
    nodes: Counter[Labels] = Counter((node_type(node).value,) for node in standing.building.nodes.values())
    edges: Counter[Labels] = Counter((key.type.value,) for key in standing.building.edges)
    loaded: dict[Labels, float] = {("nodes",): len(standing.loaded.nodes), ("edges",): len(standing.loaded.edges)}
    _gauge(registry, "graph_nodes", "Nodes of the scene graph by type", ["type"], nodes)
    _gauge(registry, "graph_edges", "Edges of the scene graph by type", ["type"], edges)
    _gauge(registry, "graph_loaded", "Nodes and edges in working memory", ["what"], loaded)
    _gauge(registry, "graph_revision", "Revision of the scene graph", [], {(): standing.loaded.revision})


def _queue(registry: CollectorRegistry, standing: Standing) -> None:
    statuses: Counter[Labels] = Counter((task.status.value,) for task in standing.queue.tasks)
    waiting = [task for task in standing.queue.waiting if task.status is TaskStatus.QUEUED]
    oldest_s = max((standing.stamp_s - task.times.received_s for task in waiting), default=0.0)
    _gauge(registry, "tasks", "Remembered tasks by status", ["status"], statuses)
    _gauge(registry, "queue_waiting", "Tasks that wait for the robot", [], {(): len(waiting)})
    _gauge(registry, "queue_oldest_seconds", "How long the first of them has waited", [], {(): oldest_s})


def _gauge(
    registry: CollectorRegistry,
    name: str,
    meaning: str,
    labels: Sequence[str],
    values: Mapping[Labels, float],
) -> None:
    gauge = Gauge(f"majordomo_{name}", meaning, labels, registry=registry)
    for label, value in values.items():
        (gauge.labels(*label) if label else gauge).set(value)
