"""``majordomo export``: the scene graph of the running service, or of a file, in a format of one's choice."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import httpx

from app.commands.options import GraphFormat
from app.exchange.stored_graph import read_graph
from client import NoService, Service
from scene_graph.documents.interchange import to_json
from scene_graph.snapshot import Snapshot
from scene_graph.spark_dsg.writer import to_spark_dsg

STANDARD_OUTPUT = Path("-")


_WRITERS: Mapping[GraphFormat, Callable[[Snapshot], dict[str, Any]]] = {
    GraphFormat.MAJORDOMO: to_json,
    GraphFormat.SPARK_DSG: to_spark_dsg,
}


def graph_of(service: Service) -> Snapshot:
    """The building as the service knows it now.

    Raises:
        NoService: it does not answer, or refuses.
    """
    headers = service.headers
    try:
        response = httpx.get(f"{service.address}/v1/scene", params={"frame": "map"}, headers=headers, timeout=30.0)
    except httpx.TransportError as error:
        raise NoService(f"the service at {service.address} does not answer: {error}") from error
    if response.is_error:
        raise NoService(f"the service at {service.address} answered {response.status_code}")
    return read_graph(response.json())


def export(snapshot: Snapshot, path: Path, kind: GraphFormat) -> None:
    """Write the graph to ``path``, whole or not at all; ``-`` is standard output.

    Raises:
        OSError: the file cannot be written.
    """
    write_text(json.dumps(_WRITERS[kind](snapshot), indent=1) + "\n", path)


def write_text(text: str, path: Path) -> None:
    """Write ``text`` to ``path``, whole or not at all; ``-`` is standard output.

    Raises:
        OSError: the file cannot be written.
    """
    if path == STANDARD_OUTPUT:
        sys.stdout.write(text)
        return
    partial = path.with_name(f"{path.name}.partial")
    partial.write_text(text, encoding="utf-8")
    partial.replace(path)
