"""Groups of commands that packages above this one, or of others, put under ``majordomo`` (entry point group below)."""

from __future__ import annotations

from importlib.metadata import entry_points

import typer

ENTRY_POINT_GROUP = "majordomo.commands"
"""Each entry point names a ``typer.Typer``; its own name becomes the command's."""


def add_installed_commands(application: typer.Typer) -> None:
    """Add them, sorted by name so that the order never changes."""
    for point in sorted(entry_points(group=ENTRY_POINT_GROUP), key=lambda point: point.name):
        application.add_typer(point.load(), name=point.name)
