"""Reads a stored scene graph: the JSON of ``GET /v1/scene?frame=map``, one written by hand, or one of Spark-DSG."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from scene_graph.documents.interchange import from_json
from scene_graph.errors import SceneFormatError
from scene_graph.snapshot import Snapshot
from scene_graph.spark_dsg.reader import from_spark_dsg, is_spark_dsg

STANDARD_INPUT = Path("-")


def load_graph(path: Path) -> Snapshot:
    """The graph in a file; ``-`` is standard input.

    Raises:
        SceneFormatError: naming the offending field, line or file.
        OSError: the file cannot be read.
    """
    if path.is_dir():
        raise SceneFormatError(f"graph {str(path)!r}", "this is a folder: name the file of a scene graph")
    try:
        text = sys.stdin.read() if path == STANDARD_INPUT else path.read_text(encoding="utf-8")
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise SceneFormatError(str(path), f"line {error.lineno}, column {error.colno}: {error.msg}") from error
    except UnicodeDecodeError as error:
        raise SceneFormatError(str(path), f"byte {error.start}: this is no UTF-8 text") from error
    except RecursionError as error:
        raise SceneFormatError(str(path), "its brackets are nested too deeply") from error
    if not isinstance(document, dict):
        raise SceneFormatError("$", "a scene graph is an object with nodes and edges")
    return read_graph(document)


def read_graph(document: Mapping[str, Any]) -> Snapshot:
    """The graph of a document, in whichever of the two formats it is.

    Raises:
        SceneFormatError: naming the offending field.
    """
    return from_spark_dsg(document) if is_spark_dsg(document) else from_json(document)
