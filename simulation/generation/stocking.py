"""Generated houses filled with things of every kind, and people: for networks to be shown and scored on."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from simulation.furnishing.catalog import CATEGORIES, category_named
from simulation.generation.generator import generate_house
from simulation.generation.settings import StockingSettings
from simulation.houses.colors import COLORS
from simulation.houses.house import Furniture, House, Object, Person, Room
from simulation.houses.placement import to_house
from simulation.houses.polygons import contains, distance_to_boundary

_FURNITURE = tuple(name for name, category in CATEGORIES.items() if category.static)
_SMALL = tuple(name for name, category in CATEGORIES.items() if not category.static)
_KEPT_COLOR = ("apple", "orange", "banana", "plant")


def stocked_house(*, seed: int, settings: StockingSettings = StockingSettings()) -> House:
    """A generated house of two to six rooms whose furniture carries things of all kinds; the same for the same seed."""
    rng = np.random.default_rng((seed, 0x57))
    rooms = int(rng.integers(2, 7))
    house = generate_house(rooms=rooms, seed=seed, rectilinear=bool(rng.random() < 0.3))
    furniture = tuple(_another(piece, rng, settings) for piece in house.furniture)
    things = [thing for piece in furniture for thing in _load(piece, rng, settings)]
    strewn = [thing for room in house.rooms for thing in _strewn(room, furniture, rng, settings)]
    things += [thing for thing in strewn if not _is_at_robot(house, thing.pose, settings.robot_free_m)]
    visitors = [person for room in house.rooms for person in _visitor(room, furniture, rng, settings.visitor_free_m)]
    people = [person for person in visitors if not _is_at_robot(house, person.pose, settings.person_free_m)]
    doors = tuple(door.model_copy(update={"state": "closed"}) if rng.random() < 0.2 else door for door in house.doors)
    objects = tuple(thing.model_copy(update={"id": f"thing_{number}"}) for number, thing in enumerate(things))
    return house.model_copy(
        update={"furniture": furniture, "objects": objects, "people": tuple(people), "doors": doors}
    )


def _another(piece: Furniture, rng: np.random.Generator, settings: StockingSettings) -> Furniture:
    """Now and then something of another kind that fits in its place, and of another color."""
    size = piece.size or CATEGORIES[piece.category].size_m
    if rng.random() < settings.other_furniture:
        fitting = [name for name in _FURNITURE if all(CATEGORIES[name].size_m[k] <= 1.1 * size[k] for k in (0, 1))]
        if fitting:
            category = str(rng.choice(fitting))
            piece = piece.model_copy(update={"category": category, "size": CATEGORIES[category].size_m})
    color = None if piece.category in _KEPT_COLOR or rng.random() < settings.usual_color else _color(rng)
    return piece.model_copy(update={"color": color})


def _load(piece: Furniture, rng: np.random.Generator, settings: StockingSettings) -> Iterator[Object]:
    """Things on it or in it, apart from each other."""
    kind = category_named(piece.category, piece.size, static=True)
    if not (kind.support or kind.container):
        return
    size = piece.size or kind.size_m
    placed: list[tuple[float, float, float]] = []
    for _ in range(int(rng.integers(0, settings.most_on_one + 1))):
        thing = _small(rng, settings.usual_color)
        extent = thing.size or CATEGORIES[thing.category].size_m
        radius = math.hypot(*extent[:2]) / 2
        play = [max(0.0, side / 2 - radius - settings.margin_m - (0.1 if kind.container else 0.0)) for side in size[:2]]
        x, y = (float(rng.uniform(-1.0, 1.0)) * most for most in play)
        if all(math.dist((x, y), other[:2]) > radius + other[2] + settings.margin_m for other in placed):
            placed.append((x, y, radius))
            place = {"in_": piece.id} if kind.container else {"on": piece.id}
            yield thing.model_copy(update={"offset": (x, y), "pose": None, **place})


def _strewn(
    room: Room, furniture: tuple[Furniture, ...], rng: np.random.Generator, settings: StockingSettings
) -> Iterator[Object]:
    for _ in range(int(rng.integers(0, settings.most_on_floor + 1))):
        spot = _free_spot(room, furniture, 0.2, rng)
        if spot is not None:
            yield _small(rng, settings.usual_color).model_copy(
                update={"pose": (*spot, 0.0, float(rng.uniform(-math.pi, math.pi)))}
            )


def _is_at_robot(house: House, pose: Sequence[float] | None, away_m: float) -> bool:
    return pose is not None and math.dist(pose[:2], house.robot.pose[:2]) < away_m


def _visitor(room: Room, furniture: tuple[Furniture, ...], rng: np.random.Generator, free_m: float) -> Iterator[Person]:
    spot = _free_spot(room, furniture, free_m, rng) if rng.random() < 0.25 else None
    if spot is not None:
        yield Person(id=f"person_in_{room.id}", pose=(*spot, float(rng.uniform(-math.pi, math.pi))))


def _small(rng: np.random.Generator, usual_color: float) -> Object:
    """A thing of any kind that is nowhere yet."""
    category = str(rng.choice(_SMALL))
    scale = float(rng.uniform(0.88, 1.15)) if rng.random() < 0.4 else 1.0
    x, y, z = (round(scale * side, 4) for side in CATEGORIES[category].size_m)
    color = None if category in _KEPT_COLOR or rng.random() < usual_color else _color(rng)
    return Object(id="new", category=category, color=color, size=(x, y, z), pose=(0.0, 0.0, 0.0, 0.0))


def _color(rng: np.random.Generator) -> str:
    return str(rng.choice(("", "", "light ", "dark "))) + str(rng.choice(tuple(COLORS)))


def _free_spot(
    room: Room, furniture: tuple[Furniture, ...], away_m: float, rng: np.random.Generator
) -> tuple[float, float] | None:
    """A floor point away from walls and furniture; none where a few tries find none."""
    corners = np.array(room.polygon)
    for _ in range(8):
        x, y = (float(c) for c in rng.uniform(corners.min(axis=0), corners.max(axis=0)))
        if is_free(room, furniture, (x, y), away_m):
            return x, y
    return None


def is_free(room: Room, furniture: tuple[Furniture, ...], point: tuple[float, float], away_m: float) -> bool:
    """Whether a floor point is in the room, ``away_m`` from its walls and from all furniture."""
    if not contains(room.polygon, point) or distance_to_boundary(point, room.polygon) < away_m:
        return False
    for piece in furniture:
        size = piece.size or CATEGORIES[piece.category].size_m
        back = (0.0, 0.0, -piece.pose[2])
        x, y = to_house(back, (point[0] - piece.pose[0], point[1] - piece.pose[1]))
        if abs(x) < size[0] / 2 + away_m and abs(y) < size[1] / 2 + away_m:
            return False
    return True
