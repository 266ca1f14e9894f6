"""Where the network lies that is to come with the package."""

from __future__ import annotations

from pathlib import Path

SHIPPED = Path(__file__).with_name("shipped.onnx")
"""Written by ``python -m training all``; no file has been good enough yet to ship."""
