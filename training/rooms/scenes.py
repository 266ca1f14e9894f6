"""Random rooms full of things, and what in them is worth a picture."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from simulation.furnishing.shapes import Size3
from training.rooms.furniture import furnish, hang
from training.rooms.scene import Item, Scene
from training.rooms.shapes import Generator
from training.rooms.structure import build_structure
from training.rooms.things import add_people, load, strew


def random_scene(rng: Generator) -> Scene:
    """A furnished room with things on, in, under and beside each other."""
    scene = Scene(
        extent_m=(float(rng.uniform(2.4, 7.5)), float(rng.uniform(2.4, 6.5))), height_m=float(rng.uniform(2.3, 3.0))
    )
    build_structure(scene, rng)
    furnish(scene, rng)
    hang(scene, rng)
    carriers = [index for index, item in enumerate(scene.items) if item.furniture and index > 1]
    for index in carriers:
        load(scene, index, rng)
    strew(scene, rng)
    add_people(scene, rng)
    return scene


def visible_targets(scene: Scene) -> Iterator[tuple[Item, Size3]]:
    """Places worth a picture: tops that carry something, things on the floor, people."""
    for index, item in enumerate(scene.items):
        carries = [other for other in scene.items if index in (other.on, other.inside) and index > 1]
        if carries:
            center = np.mean([other.bottom_m for other in carries], axis=0)
            yield item, (float(center[0]), float(center[1]), float(center[2]))
        elif item.category == "person" or item.on == 1:
            yield item, (item.bottom_m[0], item.bottom_m[1], item.size_m[2] * 0.6)
