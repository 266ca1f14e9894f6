"""Majordomo: a robot butler that maps its building, plans on a scene graph, and checks what it did."""

__version__ = "0.1.0"
