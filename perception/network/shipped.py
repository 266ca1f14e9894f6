"""The network that comes with the package; docs/model-card.md says what it can and cannot see."""

from __future__ import annotations

from pathlib import Path

SHIPPED = Path(__file__).with_name("shipped.onnx")
"""Trained by ``python -m training all``."""
SHA256 = "2c3bc73f8a0a8bc369b674e92e7ad8c053a1515d9431b9e17196d4903643e910"
"""Of that file; renew it with the file."""
