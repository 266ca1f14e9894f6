"""A generated hospital: corridors with wards on both sides, in every ward furniture with things on it."""

from __future__ import annotations

import numpy as np

from planner.doubles.sketch import Sketch
from scene_graph.snapshot import Snapshot

ROOM_M = 4.2
WARDS_A_CORRIDOR = 20
FURNITURE = ("bed", "table", "cabinet", "desk", "shelf")
THINGS = ("cup", "bottle", "book", "apple", "towel", "remote", "phone", "bowl", "box", "mug")
COLORS = ("red", "blue", "green", "white", "yellow", "black")


def hospital(nodes: int, seed: int = 0) -> Snapshot:
    """A hospital of about ``nodes`` nodes, one room for every 17; the robot stands in the first corridor."""
    rng = np.random.default_rng(seed)
    sketch = Sketch()
    rooms = max(nodes // 17, 4)
    numbers = dict.fromkeys((*FURNITURE, *THINGS), 0)
    corridors: list[str] = []
    wards: list[tuple[str, float, float]] = []
    while len(corridors) + len(wards) < rooms:
        y_m = 3 * ROOM_M * len(corridors)
        corridor = f"room_{len(corridors) + len(wards) + 1}"
        sketch.room(corridor, "corridor", at=(WARDS_A_CORRIDOR / 4 * ROOM_M, y_m))
        if corridors:
            sketch.door(corridors[-1], corridor, at=(0.0, y_m - 1.5 * ROOM_M))
        corridors.append(corridor)
        for index in range(min(WARDS_A_CORRIDOR, rooms - len(corridors) - len(wards))):
            x_m, side = (index // 2) * ROOM_M, 1 if index % 2 else -1
            ward = f"room_{len(corridors) + len(wards) + 1}"
            label = ("ward", "office", "kitchen", "storage room", "bathroom")[int(rng.integers(5))]
            sketch.room(ward, label, at=(x_m, y_m + side * ROOM_M))
            sketch.door(corridor, ward, at=(x_m, y_m + side * ROOM_M / 2))
            wards.append((ward, x_m, y_m + side * ROOM_M))
    left = nodes - rooms - 2 * (rooms - 1) - 4
    surfaces: list[tuple[str, float, float]] = []
    for ward, x_m, y_m in wards:
        for k in range(3):
            label = FURNITURE[int(rng.integers(len(FURNITURE)))]
            numbers[label] += 1
            at = (x_m + (k - 1) * 1.3, y_m + 1.2)
            sketch.furniture(f"{label}_{numbers[label]}", label, ward, at=at)
            surfaces.append((f"{label}_{numbers[label]}", *at))
    for index in range(max(left - len(surfaces), 0)):
        surface, x_m, y_m = surfaces[index % len(surfaces)]
        label, color = THINGS[int(rng.integers(len(THINGS)))], COLORS[int(rng.integers(len(COLORS)))]
        numbers[label] += 1
        dx_m, dy_m = rng.uniform(-0.5, 0.5), rng.uniform(-0.3, 0.3)
        sketch.thing(f"{label}_{numbers[label]}", label, on=surface, at=(x_m + dx_m, y_m + dy_m), color=color)
    sketch.person("person_1", "Anna", wards[-1][0], at=wards[-1][1:])
    sketch.person("person_2", "user", corridors[0], at=(1.0, 0.0))
    return sketch.snapshot(robot_in=corridors[0], at=(0.0, 0.0))
