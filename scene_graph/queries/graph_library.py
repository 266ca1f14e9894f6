"""igraph without its drawings: for them it would load matplotlib, half a second and 30 MB of every start."""

from __future__ import annotations

import importlib
import sys
from typing import Any


def import_without(name: str, unwanted: str) -> Any:
    """Import a library as if another one, which it would load, were not installed."""
    absent = unwanted not in sys.modules
    if absent:
        sys.modules[unwanted] = None  # type: ignore[assignment] # Python's way to say that it cannot be imported
    try:
        return importlib.import_module(name)
    finally:
        if absent:
            del sys.modules[unwanted]


igraph: Any = import_without("igraph", "matplotlib")
