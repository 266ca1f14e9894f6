"""Where tests find what they read."""

from pathlib import Path

ROOT = Path(__file__).parents[1]
"""The checkout."""
DATA = ROOT / "tests" / "data"
PACKAGES = ROOT / "tests" / "packages"
"""Packages of others, as if installed."""
