"""Generated houses: valid, the same each time, and such that a robot gets everywhere."""

from __future__ import annotations

import math

import igraph
import numpy as np
import pybullet
import pytest
from scipy.ndimage import distance_transform_edt, label

from simulation.errors import HouseError
from simulation.furnishing.catalog import category_named
from simulation.generation.generator import generate_house
from simulation.houses.house import OUTSIDE
from simulation.houses.house_file import parse_house
from simulation.houses.polygons import contains
from simulation.world.world import World

ROBOT_M = 0.30
CELL_M = 0.05
SEEDS = range(13)


def kinds(seed):
    return {"rooms": 4 + seed % 9, "seed": seed, "loops": seed % 4 == 1, "rectilinear": seed % 4 == 3}


@pytest.fixture(scope="module")
def houses():
    return [generate_house(**kinds(seed)) for seed in SEEDS]


def doors_between_rooms(house):
    return [door for door in house.doors if OUTSIDE not in door.rooms]


def graph_of(house):
    ids = [room.id for room in house.rooms]
    edges = [tuple(ids.index(room) for room in door.rooms) for door in doors_between_rooms(house)]
    return igraph.Graph(n=len(ids), edges=edges)


def test_a_house_has_the_rooms_asked_for_and_survives_being_written(houses):
    for seed, house in zip(SEEDS, houses, strict=True):
        assert len(house.rooms) == kinds(seed)["rooms"]
        assert parse_house(house.model_dump_json(by_alias=True, exclude_none=True)) == house


def test_the_same_arguments_give_the_same_house_and_another_seed_another():
    first, again, other = (generate_house(rooms=6, seed=seed) for seed in (5, 5, 6))
    assert first == again
    assert first.rooms != other.rooms


def test_doors_form_a_tree_or_loops_as_asked(houses):
    for seed, house in zip(SEEDS, houses, strict=True):
        graph = graph_of(house)
        assert graph.is_connected()
        assert (graph.ecount() >= graph.vcount()) == kinds(seed)["loops"]


def test_rooms_are_rectangles_unless_other_shapes_are_asked_for(houses):
    for seed, house in zip(SEEDS, houses, strict=True):
        corners = [len(room.polygon) for room in house.rooms]
        assert (max(corners) > 4) == kinds(seed)["rectilinear"]


def test_a_robot_reaches_every_room_from_where_it_starts(houses):
    for house in houses:
        passable, corner = passable_cells(house)
        regions, _ = label(passable)
        start = regions[cell(house.robot.pose[:2], corner)]
        assert start > 0
        for room in house.rooms:
            inside = [at for at in np.argwhere(regions == start)[::7] if contains(room.polygon, middle(at, corner))]
            assert inside, f"{house.name}: {room.id} cannot be reached"


def passable_cells(house):
    """Cells where a robot may stand: in rooms or doorways, farther from everything than its radius."""
    points = np.array([point for room in house.rooms for point in room.polygon])
    corner = points.min(axis=0) - 1.0
    shape = np.ceil((points.max(axis=0) + 1.0 - corner) / CELL_M).astype(int)
    x, y = (corner[k] + (np.indices(shape)[k] + 0.5) * CELL_M for k in (0, 1))
    free = np.zeros(shape, dtype=bool)
    for room in house.rooms:
        free |= inside_polygon(room.polygon, x, y)
    for door in doors_between_rooms(house):
        a = np.array(nearest_side(house, door))
        along = (a[1] - a[0]) / np.linalg.norm(a[1] - a[0])
        dx, dy = x - door.center[0], y - door.center[1]
        lengthwise, across = np.abs(dx * along[0] + dy * along[1]), np.abs(dy * along[0] - dx * along[1])
        free |= (lengthwise < door.width / 2) & (across < house.wall_thickness / 2 + CELL_M)
    for item in house.furniture:
        width, depth, _ = item.size or category_named(item.category, None, static=True).size_m
        c, s = math.cos(item.pose[2]), math.sin(item.pose[2])
        dx, dy = x - item.pose[0], y - item.pose[1]
        free &= ~((np.abs(c * dx + s * dy) < width / 2) & (np.abs(c * dy - s * dx) < depth / 2))
    return distance_transform_edt(free) * CELL_M > ROBOT_M, corner


def inside_polygon(polygon, x, y):
    inside = np.zeros(x.shape, dtype=bool)
    for (ax, ay), (bx, by) in zip(polygon, (*polygon[1:], polygon[0]), strict=True):
        if ay != by:
            inside ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) / (by - ay) * (bx - ax))
    return inside


def nearest_side(house, door):
    room = next(room for room in house.rooms if room.id == door.rooms[0])
    pairs = list(zip(room.polygon, (*room.polygon[1:], room.polygon[0]), strict=True))

    def away(side):
        a, b = np.array(side[0]), np.array(side[1])
        along = (b - a) / np.linalg.norm(b - a)
        station = np.clip((np.array(door.center) - a) @ along, 0.0, np.linalg.norm(b - a))
        return float(np.linalg.norm(a + station * along - door.center))

    return min(pairs, key=away)


def cell(point, corner):
    column, row = ((np.array(point) - corner) / CELL_M).astype(int)
    return int(column), int(row)


def middle(at, corner):
    return tuple((corner + (np.array(at) + 0.5) * CELL_M).tolist())


def test_an_empty_house_is_empty():
    house = generate_house(rooms=5, seed=1, furnished=False)
    assert house.furniture == ()
    assert house.objects == ()


def test_what_cannot_be_is_refused():
    with pytest.raises(HouseError, match="0 rooms cannot be generated"):
        generate_house(rooms=0, seed=0)
    with pytest.raises(HouseError, match="no loop"):
        generate_house(rooms=1, seed=0, loops=True)


def test_everything_on_the_furniture_has_room_there(houses):
    for house in houses:
        client = pybullet.connect(pybullet.DIRECT)
        try:
            World(house, client=client, rng=np.random.default_rng(0))
        finally:
            pybullet.disconnect(client)
