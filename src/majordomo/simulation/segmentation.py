"""The renderer's segmentation, reduced to labeled masks. It leaves the simulator for the stand-in model only."""

from __future__ import annotations

import numpy as np

from majordomo.simulation.camera import Picture
from majordomo.simulation.messages import Segment
from majordomo.simulation.world import World

STRUCTURE = frozenset({"wall", "floor", "door"})


def segments(picture: Picture, world: World) -> tuple[Segment, ...]:
    """Furniture, things and people in the picture; neither walls, floor and doors nor the robot itself."""
    found = []
    for body in np.unique(picture.bodies):
        category = world.category_of(int(body)) if body >= 0 else None
        if category is not None and category not in STRUCTURE:
            found.append(Segment(category=category, mask=picture.bodies == body))
    return tuple(found)
