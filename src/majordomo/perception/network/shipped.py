"""The network that comes with the package; docs/model-card.md says what it can and cannot see."""

from __future__ import annotations

from pathlib import Path

SHIPPED = Path(__file__).with_name("shipped.onnx")
"""Trained by ``python -m training all``."""
