"""Random small problems for planners: rooms, doors open and closed, furniture, stacks, people, a hand full or empty."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from planner.doubles.sketch import Sketch
from planner.goals import Goal, goal
from scene_graph.nodes import DoorState
from scene_graph.snapshot import Snapshot


def random_problem(seed: int) -> tuple[Snapshot, list[Goal]]:
    """A building of two to four rooms in a row, and one to five goals about what is in it; what is in the hand, if
    anything, may be wanted at once, later or not at all.
    """
    rng = np.random.default_rng(seed)
    rooms = [f"room_{k + 1}" for k in range(int(rng.integers(2, 5)))]
    at = {room: (4.2 * (k % 2), 4.2 * (k // 2)) for k, room in enumerate(rooms)}
    sketch = Sketch()
    for room in rooms:
        sketch.room(room, at=at[room])
    for a, b in pairwise(rooms):
        middle = tuple((p + q) / 2 for p, q in zip(at[a], at[b], strict=True))
        sketch.door(a, b, at=middle, state=DoorState.CLOSED if rng.random() < 0.05 else DoorState.OPEN)
    spread = lambda room: tuple(float(c + rng.uniform(-1.6, 1.6)) for c in at[room])
    pick = lambda names: names[int(rng.integers(len(names)))]
    tables = [f"table_{k + 1}" for k in range(int(rng.integers(2, 5)))]
    for table in tables:
        room = pick(rooms)
        sketch.furniture(table, "table", room, at=spread(room))
    sketch.furniture("box_1", "box", rooms[0], at=spread(rooms[0]))
    room = pick(rooms)
    sketch.person("person_1", "Anna", room, at=spread(room))
    cups = [f"cup_{k + 1}" for k in range(int(rng.integers(2, 5)))]
    for k, cup in enumerate(cups):
        below = cups[k - 1] if k and rng.random() < 0.25 else pick([*tables, *tables, pick(rooms)])
        sketch.thing(cup, "cup", on=below)
    aims = [_aim(pick(cups), tables, rooms, pick) for _ in range(int(rng.integers(1, 4)))]
    if rng.random() < 0.3:
        aims.append(goal("holding", pick(cups)))
    start = pick(rooms)
    holding = cups[-1] if rng.random() < 0.4 else None
    if holding is not None and rng.random() < 0.7:
        aims.insert(int(rng.integers(len(aims) + 1)), _aim(holding, tables, rooms, pick))
    return sketch.snapshot(robot_in=start, at=spread(start), holding=holding), aims


def _aim(cup, tables, rooms, pick) -> Goal:
    place = pick(tables)
    aims = [goal("on", cup, place), goal("on", cup, place), goal("near", cup, place), goal("in", cup, "box_1")]
    aims += [goal("given", cup, "person_1"), goal("robot_at", pick([*tables, "person_1"]))]
    return pick([*aims, goal("in", cup, pick(rooms)), goal("robot_at", pick(rooms))])
