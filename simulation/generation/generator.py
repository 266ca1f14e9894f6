"""Houses from a seed, for tests and evaluations: as many as wanted, all different, each the same every time."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simulation.errors import HouseError
from simulation.generation.furnishing import Furnishing, furnish
from simulation.generation.plans import Plan, draw_plan
from simulation.generation.settings import GenerationSettings
from simulation.houses.house import OUTSIDE, Door, Furniture, House, Object, Robot, Room
from simulation.houses.house_checks import check_house

MOST_ROOMS = 30
"""As many as the layouts are good for."""


@dataclass(frozen=True, kw_only=True)
class Turn:
    """How the plan, in millimeters along x and y, lies in the house: turned, then shifted."""

    yaw_rad: float
    shift_m: tuple[float, float]

    def point(self, x_m: float, y_m: float) -> tuple[float, float]:
        """House coordinates, rounded to the millimeter."""
        c, s = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        return round(c * x_m - s * y_m + self.shift_m[0], 3), round(s * x_m + c * y_m + self.shift_m[1], 3)

    def pose(self, x_m: float, y_m: float, yaw_rad: float) -> tuple[float, float, float]:
        """House coordinates of what stands at a pose in the plan."""
        return *self.point(x_m, y_m), round(math.remainder(yaw_rad + self.yaw_rad, math.tau), 5)


def generate_house(
    *,
    rooms: int,
    seed: int,
    loops: bool = False,
    rectilinear: bool = False,
    furnished: bool = True,
    settings: GenerationSettings = GenerationSettings(),
) -> House:
    """A house that a robot of 0.3 m radius can explore; the same arguments give the same house.

    Args:
        rooms: how many, corridors and halls included, at most ``MOST_ROOMS``.
        seed: of everything that is random.
        loops: whether some room can be left by one door and come back to by another; else its doors form a tree.
        rectilinear: whether some rooms, about a third, are L-, T- or U-shaped; else all are rectangles.
        furnished: whether there are furniture and objects.
        settings: what such houses are like.

    Raises:
        HouseError: such a house cannot be.
    """
    if not 1 <= rooms <= MOST_ROOMS:
        raise HouseError("rooms", f"a house of {rooms} rooms cannot be generated; 1 to {MOST_ROOMS} can")
    if loops and rooms == 1:
        raise HouseError("rooms", "one room alone has no loop; ask for two or more")
    for_plan, for_turn, for_furniture, for_robot = np.random.default_rng(seed).spawn(4)
    plan = draw_plan(for_plan, rooms, loops=loops, rectilinear=rectilinear, settings=settings.plan)
    far_m = settings.farthest_m
    turn = Turn(
        yaw_rad=float(for_turn.uniform(-math.pi, math.pi)),
        shift_m=(float(for_turn.uniform(-far_m, far_m)), float(for_turn.uniform(-far_m, far_m))),
    )
    names = _names(plan)
    furnishing = furnish(for_furniture, plan, furnished=furnished, settings=settings.furnishing)
    furniture = _furniture(furnishing, turn)
    house = House(
        name=f"generated_{rooms}_{seed}",
        wall_thickness=plan.wall_mm / 1000,
        wall_height=round(float(for_turn.uniform(2.4, 3.0)), 2),
        rooms=tuple(_room(plan, index, name, turn) for index, name in enumerate(names)),
        doors=tuple(_door(plan, index, names, turn) for index in range(len(plan.doors))),
        furniture=furniture,
        objects=_objects(furnishing, furniture),
        robot=Robot(pose=turn.pose(*furnishing.start, float(for_robot.uniform(-math.pi, math.pi)))),
    )
    check_house(house)
    return house


def _names(plan: Plan) -> list[str]:
    """Room ids: the label, with a number where there are several."""
    names, seen = [], Counter[str]()
    several = Counter(use.label for use in plan.uses)
    for use in plan.uses:
        seen[use.label] += 1
        number = f"_{seen[use.label]}" if several[use.label] > 1 else ""
        names.append(use.label.replace(" ", "_") + number)
    return names


def _room(plan: Plan, index: int, name: str, turn: Turn) -> Room:
    polygon = tuple(turn.point(x / 1000, y / 1000) for x, y in plan.outlines[index])
    return Room(id=name, label=plan.uses[index].label, polygon=polygon)


def _furniture(furnishing: Furnishing, turn: Turn) -> tuple[Furniture, ...]:
    counts = Counter[str]()
    pieces: list[Furniture] = []
    for piece in furnishing.pieces:
        counts[piece.category] += 1
        pieces.append(
            Furniture(
                id=f"{piece.category}_{counts[piece.category]}",
                category=piece.category,
                pose=turn.pose(piece.x_m, piece.y_m, piece.yaw_rad),
                size=piece.size_m,
            )
        )
    return tuple(pieces)


def _objects(furnishing: Furnishing, furniture: Sequence[Furniture]) -> tuple[Object, ...]:
    counts = Counter[str]()
    things: list[Object] = []
    for thing in furnishing.things:
        counts[thing.category] += 1
        things.append(
            Object(
                id=f"{thing.category}_{counts[thing.category]}",
                category=thing.category,
                color=thing.color,
                on=furniture[thing.on].id,
            )
        )
    return tuple(things)


def _door(plan: Plan, index: int, names: list[str], turn: Turn) -> Door:
    """Inner doors stand open; a front door is closed."""
    door = plan.doors[index]
    inner = len(door.rooms) == 2
    x, y = door.center
    return Door(
        id=f"door_{index + 1}",
        rooms=(names[door.rooms[0]], names[door.rooms[1]] if inner else OUTSIDE),
        center=turn.point(x / 1000, y / 1000),
        width=door.width / 1000,
        state="open" if inner else "closed",
    )
