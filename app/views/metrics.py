"""Prometheus metrics: how things stand, read afresh for every scrape, and what was counted over time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from prometheus_client import CollectorRegistry, Gauge, generate_latest

from app.counters import Counters
from app.events.stream import EventStream
from app.stacks.stack import Stack
from app.version import __version__
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import TaskStatus
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import node_type

Labels = tuple[str, ...]
"""Values of a metric's labels, in their order."""
AGENT_FIGURES = {
    "rate_hz": "Turns per second of robot time",
    "busy_ms_p50": "Median time of a turn",
    "busy_ms_p99": "99th percentile of a turn",
    "restarts": "Unexpected errors so far",
}


class MetricsView:
    """How one running stack stands, together with what was counted.

    Args:
        now: robot time in seconds.
        agents: figures by name, as ``GET /v1/status`` shows them.
        ready: whether requests are taken.
    """

    def __init__(
        self,
        stack: Stack,
        queue: TaskQueue,
        stream: EventStream,
        counters: Counters,
        *,
        now: Callable[[], float],
        agents: Callable[[], Mapping[str, Mapping[str, Any]]],
        ready: Callable[[], bool],
    ) -> None:
        self._stack, self._queue, self._stream, self._counters = stack, queue, stream, counters
        self._now, self._agents, self._ready = now, agents, ready

    def text(self) -> bytes:
        """Graph, agents, tasks, queue, robot and process in Prometheus' text format."""
        registry = CollectorRegistry()
        _gauge(registry, "build_info", "Version of Majordomo", ["version"], {(__version__,): 1})
        _gauge(registry, "robot_time_seconds", "Robot time", [], {(): self._now()})
        _gauge(registry, "ready", "1 while requests are taken", [], {(): self._ready()})
        _gauge(registry, "stopped", "1 while the software stop is latched", [], {(): self._stack.stopped})
        _gauge(registry, "stream_clients", "Clients of the event stream", [], {(): self._stream.listeners})
        _graph(registry, self._stack.memory)
        agents = self._agents()
        for figure, meaning in AGENT_FIGURES.items():
            values: dict[Labels, float] = {(name,): summary[figure] for name, summary in agents.items()}
            _gauge(registry, f"agent_{figure}", meaning, ["agent"], values)
        _queue(registry, self._queue, self._now())
        return generate_latest(registry) + self._counters.text()


def _graph(registry: CollectorRegistry, memory: WorkingMemory) -> None:
    building, snapshot = memory.building(), memory.snapshot()
    nodes: Counter[Labels] = Counter((node_type(node).value,) for node in building.nodes.values())
    edges: Counter[Labels] = Counter((key.type.value,) for key in building.edges)
    loaded: dict[Labels, float] = {("nodes",): len(snapshot.nodes), ("edges",): len(snapshot.edges)}
    _gauge(registry, "graph_nodes", "Nodes of the scene graph by type", ["type"], nodes)
    _gauge(registry, "graph_edges", "Edges of the scene graph by type", ["type"], edges)
    _gauge(registry, "graph_loaded", "Nodes and edges in working memory", ["what"], loaded)
    _gauge(registry, "graph_revision", "Revision of the scene graph", [], {(): snapshot.revision})


def _queue(registry: CollectorRegistry, queue: TaskQueue, stamp_s: float) -> None:
    statuses: Counter[Labels] = Counter((task.status.value,) for task in queue.tasks)
    waiting = [task for task in queue.waiting if task.status is TaskStatus.QUEUED]
    oldest_s = max((stamp_s - task.times.received_s for task in waiting), default=0.0)
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
