"""Walls, floor and doors of random rooms."""

from __future__ import annotations

from simulation.furnishing.shapes import Part, box
from simulation.houses.colors import Rgb
from simulation.world.world import DOOR_RGB, FLOOR_RGB, WALL_RGB
from training.rooms.scene import Item, Scene, at_wall
from training.rooms.shapes import Generator, random_color, shaken_color

WALL_M = 0.2


def build_structure(scene: Scene, rng: Generator) -> None:
    """Walls with gaps, a floor, and some of the doors: colored as in the simulator now and then, else anyhow."""
    plain = rng.random() < 0.4
    wall = shaken_color(WALL_RGB, rng, 0.02) if plain else random_color(rng)
    floor = shaken_color(FLOOR_RGB, rng, 0.02) if plain else random_color(rng)
    w, d = scene.extent_m
    for side, length in enumerate((w, d, w, d)):
        if rng.random() < 0.4:
            width = float(rng.uniform(0.7, 1.3))
            if length > width + 0.6:
                scene.doors.append((side, float(rng.uniform(width / 2 + 0.2, length - width / 2 - 0.2)), width))
    blocks = []
    for side, length in enumerate((w, d, w, d)):
        shade = wall if rng.random() < 0.8 else shaken_color(wall, rng, 0.1)
        gaps = sorted((at - wide / 2, at + wide / 2) for other, at, wide in scene.doors if other == side)
        edges = [-WALL_M, *(edge for gap in gaps for edge in gap), length + WALL_M]
        for low, high in zip(edges[::2], edges[1::2], strict=True):
            blocks.append(_wall_part(scene, side, low, high, 0.0, scene.height_m, shade))
        for low, high in gaps:
            blocks.append(_wall_part(scene, side, low, high, float(rng.uniform(1.9, 2.1)), scene.height_m, shade))
        if gaps and rng.random() < 0.8:
            beyond = shaken_color(shade, rng, 0.05)
            far = float(rng.uniform(1.2, 4.0))
            blocks.append(_wall_part(scene, side, -4.0, length + 4.0, 0.0, scene.height_m, beyond, far))
    scene.add(_fixed("wall", tuple(blocks)))
    ground = box((w / 2, d / 2, -0.01), (w + 12.0, d + 12.0, 0.02), floor)
    scene.add(_fixed("floor", (ground,)))
    door = shaken_color(DOOR_RGB, rng, 0.03) if rng.random() < 0.6 else random_color(rng)
    for side, at, width in scene.doors:
        if rng.random() < 0.45:
            height = float(rng.uniform(1.9, 2.1))
            x, y, yaw = at_wall(scene, side, at, -WALL_M / 2)
            leaf = box((0.0, 0.0, height / 2), (width, float(rng.uniform(0.04, 0.1)), height), door)
            scene.add(
                Item(
                    category="door",
                    parts=(leaf,),
                    bottom_m=(x, y, 0.0),
                    size_m=leaf.size_m,
                    yaw_rad=yaw,
                    furniture=True,
                    attached_to=0,
                )
            )


def _fixed(category: str, parts: tuple[Part, ...]) -> Item:
    return Item(
        category=category, parts=parts, bottom_m=(0.0, 0.0, 0.0), size_m=(0.0, 0.0, 0.0), yaw_rad=0.0, furniture=True
    )


def _wall_part(
    scene: Scene, side: int, low: float, high: float, bottom: float, top: float, color: Rgb, beyond: float = 0.0
) -> Part:
    x, y, _ = at_wall(scene, side, (low + high) / 2, -WALL_M / 2 - beyond)
    size = (high - low, WALL_M, top - bottom) if side % 2 == 0 else (WALL_M, high - low, top - bottom)
    return box((x, y, (bottom + top) / 2), size, color)
