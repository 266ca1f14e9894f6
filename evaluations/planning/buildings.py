"""The buildings that requests are about, from a flat of 24 nodes to a hospital of 5,000."""

from __future__ import annotations

import json
from functools import cache
from importlib import resources
from pathlib import Path
from typing import Any

from evaluations.planning.building_extension import extension_lines
from evaluations.planning.floor_plan import scene_document
from scene_graph.documents.interchange import from_json
from scene_graph.snapshot import Snapshot

NODES = {"studio": 24, "family": 90, "villa": 200, "office": 500, "school": 1500, "hospital": 5000}
"""Built-in buildings, by about how many nodes the scene of each has; those of more than 200 are stocked by a seed."""
SEED = 7


class UnknownBuilding(ValueError):
    """Neither a built-in building nor a file."""

    def __init__(self, name: str) -> None:
        super().__init__(
            f"no building {name!r}: name one of {', '.join(NODES)}, or a stored scene graph's or floor plan's file"
        )


def building_document(name: str) -> dict[str, Any]:
    """A built-in building in the format of ``GET /v1/scene?frame=map``, made anew."""
    text = resources.files(__package__).joinpath("buildings", f"{name}.txt").read_text(encoding="utf-8")
    if NODES[name] > 200:
        more = NODES[name] - len(scene_document(text, name)["nodes"])
        text = "\n".join([text, *extension_lines(name, more, SEED)])
    return scene_document(text, name)


@cache
def building(name: str, folder: Path | None = None) -> Snapshot:
    """The graph of a built-in building, or of a file, relative to ``folder``.

    Raises:
        UnknownBuilding: there is none of this name.
        SceneFormatError: a file is no scene graph.
        LineError: a file is no floor plan.
    """
    if name in NODES:
        return from_json(building_document(name))
    file = (folder or Path()) / name
    if not file.is_file():
        raise UnknownBuilding(name)
    text = file.read_text(encoding="utf-8")
    document: dict[str, Any] = scene_document(text, name) if file.suffix == ".txt" else json.loads(text)
    return from_json(document)
