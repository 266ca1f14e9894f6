"""Prometheus metrics, collected afresh for every scrape."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any

from prometheus_client import CollectorRegistry, Gauge, generate_latest

from majordomo.planner.tasks import Task
from majordomo.scene_graph.nodes import node_type
from majordomo.scene_graph.snapshot import Snapshot


def metrics_text(snapshot: Snapshot, agents: Mapping[str, Mapping[str, Any]], tasks: Iterable[Task]) -> bytes:
    """Graph size, agents and tasks in Prometheus' text format."""
    registry = CollectorRegistry()
    nodes = Gauge("majordomo_graph_nodes", "Nodes of the scene graph by type", ["type"], registry=registry)
    for kind, count in Counter(node_type(node) for node in snapshot.nodes.values()).items():
        nodes.labels(kind).set(count)
    Gauge("majordomo_graph_revision", "Revision of the scene graph", registry=registry).set(snapshot.revision)
    figures = {
        "rate_hz": Gauge("majordomo_agent_rate_hz", "Turns per second of robot time", ["agent"], registry=registry),
        "busy_ms_p50": Gauge("majordomo_agent_busy_ms_p50", "Median time of a turn", ["agent"], registry=registry),
        "busy_ms_p99": Gauge("majordomo_agent_busy_ms_p99", "99th percentile of a turn", ["agent"], registry=registry),
        "restarts": Gauge("majordomo_agent_restarts", "Unexpected errors so far", ["agent"], registry=registry),
    }
    for name, summary in agents.items():
        for figure, gauge in figures.items():
            gauge.labels(name).set(summary[figure])
    statuses = Gauge("majordomo_tasks", "Remembered tasks by status", ["status"], registry=registry)
    for status, count in Counter(str(task.status) for task in tasks).items():
        statuses.labels(status).set(count)
    return generate_latest(registry)
