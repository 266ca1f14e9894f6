"""What the network is taught to tell apart."""

from __future__ import annotations

from simulation.furnishing.catalog import category_names
from simulation.pictures.relations import PREDICATES

THINGS = (*category_names(), "person", "door")
STUFF = ("wall", "floor")
CLASSES = (*THINGS, *STUFF)
UNKNOWN = -1
"""Class of what has no name: it has to be found, and none of the names is right."""

__all__ = ["CLASSES", "PREDICATES", "STUFF", "THINGS", "UNKNOWN"]
