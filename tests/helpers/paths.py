"""Where tests find what they read."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
"""The checkout."""
DATA = ROOT / "tests" / "data"
HELPERS = ROOT / "tests" / "helpers"
PACKAGES = ROOT / "tests" / "packages"
"""Packages of others, as if installed."""
