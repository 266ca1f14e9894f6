"""Ways over a house's true free floor: how long the shortest is, and through which doors it leads."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.path import Path as Outline
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from evaluations.missions.outcome import Scene
from simulation.furnishing.catalog import category_named
from simulation.houses.house import OUTSIDE, Door, Furniture, House, room_at
from simulation.robot.description import RobotDescription

HALF = 0.5
"""Of a cell: so much nearer than the middle of a covered cell the thing that covers it ends, on average."""
Point = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class WaySettings:
    """What a free way is."""

    cell_m: float = 0.05
    """Side of the grid's cells."""
    robot_radius_m: float = RobotDescription.base_radius_m
    passable_m: float = 0.32
    """What a body of that radius can be asked to pass, given how well it sees: 7 cm to each side."""
    reach_m: float = 0.85
    """How near the robot's middle has to come to a thing: so far the hand is brought from above."""
    person_radius_m: float = 0.25
    stays_m: float = 0.1
    """Who is found no farther from where the house puts them has stayed."""


class Ways:
    """Free floor of the house as it is, on a grid; furniture stands where the house says, doors are as the truth says,
    but for those that are ``shut``, and what lies on the floor is in the way, but for the ``spared``, and so is who
    stands where the house puts them and never walks. ``radius_m``: how far the robot's middle keeps off all of it, its
    own radius if left out.

    Attributes:
        clearance_m: (H, W) distance of each cell from walls and furniture.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        shut: Collection[str] = (),
        spared: Collection[str] = (),
        radius_m: float | None = None,
        settings: WaySettings = WaySettings(),
    ) -> None:
        house, cell_m = scene.house, settings.cell_m
        self._settings = settings
        self._house = house
        corners = np.array([corner for room in house.rooms for corner in room.polygon])
        self._low = corners.min(axis=0) - 1.0
        width, height = (int(n) for n in np.ceil((corners.max(axis=0) + 1.0 - self._low) / cell_m))
        closed = {door["id"] for door in scene.truth["doors"] if door["state"] == "closed"} | {*shut}
        self._open = [door for door in house.doors if door.id not in closed and OUTSIDE not in door.rooms]
        rows, columns = np.indices((height, width))
        self._places = self._low + (np.stack((columns, rows), axis=-1) + 0.5) * cell_m
        free = np.zeros((height, width), np.bool_)
        self._floors = {room.id: self._inside(np.array(room.polygon)) for room in house.rooms}
        for floor in self._floors.values():
            free |= floor
        for door in self._open:
            free |= self._inside(gap(house, door, settings))
        for item in house.furniture:
            free &= ~self._inside(outline(item))
        for record in scene.truth["objects"]:
            if record["id"] not in spared and record["id"] != scene.holding and not (record["on"] or record["in"]):
                free &= ~self._covered(record)
        for spot in _who_stays(scene, settings.stays_m):
            free &= np.linalg.norm(self._places - np.array(spot), axis=-1) >= settings.person_radius_m
        self.clearance_m: NDArray[np.float64] = np.maximum(distance_transform_edt(free) - HALF, 0.0) * cell_m
        off_m = settings.robot_radius_m if radius_m is None else radius_m
        self._number, self._graph = _grid_graph(self.clearance_m > off_m, cell_m)

    def length_m(self, start: Point, *stops: Point | str) -> float:
        """The shortest way from ``start`` that comes within reach of each stop in turn, and into each that is the
        identifier of a room; infinite where there is none.
        """
        total_m, begin = 0.0, self._nearest(start)
        for stop in stops:
            if begin is None:
                return math.inf
            distance_m = dijkstra(self._graph, directed=False, indices=begin)
            within = self._in_room(stop) if isinstance(stop, str) else self._within(stop)
            reached = within[np.isfinite(distance_m[within])]
            if not len(reached):
                return math.inf
            begin = int(reached[np.argmin(distance_m[reached])])
            total_m += float(distance_m[begin])
        return total_m

    def doors_between(self, start: Point, goal: Point) -> list[Door]:
        """Open doors that the shortest way leads through, in its order."""
        begin, within = self._nearest(start), self._within(goal)
        if begin is None or not len(within):
            return []
        distance_m, before = dijkstra(self._graph, directed=False, indices=begin, return_predecessors=True)
        cell = int(within[np.argmin(distance_m[within])])
        if not math.isfinite(float(distance_m[cell])):
            return []
        way = [cell]
        while way[-1] != begin:
            way.append(int(before[way[-1]]))
        points = self._points(np.array(way[::-1]))
        met = {}
        for door in self._open:
            near = np.flatnonzero(np.linalg.norm(points - np.array(door.center), axis=1) < door.width / 2)
            if len(near):
                met[door.id] = (int(near[0]), door)
        return [door for _, door in sorted(met.values(), key=lambda pair: pair[0])]

    def is_free(self, point: Point) -> bool:
        """Whether the robot could stand there."""
        row, column = self._cell(point)
        settings = self._settings
        inside = 0 <= row < self.clearance_m.shape[0] and 0 <= column < self.clearance_m.shape[1]
        return inside and bool(self.clearance_m[row, column] > settings.robot_radius_m + settings.cell_m)

    def middle_of(self, room_id: str) -> Point | None:
        """The place in a room that is farthest from walls and furniture."""
        room = next((room for room in self._house.rooms if room.id == room_id), None)
        if room is None:
            return None
        clearance_m = self.clearance_m * self._floors[room.id]
        x_m, y_m = self._places[np.unravel_index(np.argmax(clearance_m), clearance_m.shape)]
        return float(x_m), float(y_m)

    def _inside(self, polygon_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(H, W) cells within a polygon."""
        flat: NDArray[np.bool_] = Outline(polygon_m).contains_points(self._places.reshape(-1, 2))
        return flat.reshape(self._places.shape[:2])

    def _covered(self, record: Mapping[str, Any]) -> NDArray[np.bool_]:
        """(H, W) cells under a thing: those as near as its sides are on average."""
        radius_m = sum(category_named(record["category"]).size_m[:2]) / 4.0
        away_m = np.linalg.norm(self._places - np.array(record["position_m"][:2]), axis=-1)
        return np.asarray(away_m < max(radius_m, self._settings.cell_m))

    def _cell(self, point: Point) -> tuple[int, int]:
        column, row = np.floor((np.array(point) - self._low) / self._settings.cell_m).astype(int)
        return int(row), int(column)

    def _points(self, numbers: NDArray[np.int64]) -> NDArray[np.float64]:
        """(N, 2) of numbered cells."""
        points: NDArray[np.float64] = self._places[self._number >= 0][numbers]
        return points

    def _within(self, point: Point) -> NDArray[np.int64]:
        """Numbers of the cells within reach of a point, on the same side of the walls."""
        points = self._points(np.arange(int(self._number.max()) + 1))
        near = np.linalg.norm(points - np.array(point), axis=1) < self._settings.reach_m
        floor = self._floors.get(room_at(self._house, *point) or "")
        return np.flatnonzero(near if floor is None else near & floor[self._number >= 0])

    def _in_room(self, room_id: str) -> NDArray[np.int64]:
        """Numbers of the cells of a room."""
        return np.flatnonzero(self._floors[room_id][self._number >= 0])

    def _nearest(self, point: Point) -> int | None:
        points = self._points(np.arange(int(self._number.max()) + 1))
        return int(np.argmin(np.linalg.norm(points - np.array(point), axis=1))) if len(points) else None


def gap(house: House, door: Door, settings: WaySettings = WaySettings()) -> NDArray[np.float64]:
    """The floor of a doorway, from room to room, as (4, 2) corners: along the side of a room that is nearest."""
    rooms = [room for room in house.rooms if room.id in door.rooms]
    sides = [_direction_at(np.array(room.polygon), np.array(door.center)) for room in rooms]
    along = sides[0] if sides else np.array((1.0, 0.0))
    yaw_rad = math.atan2(along[1], along[0])
    return _rectangle(door.center, (door.width, house.wall_thickness + 4 * settings.cell_m), yaw_rad)


def outline(item: Furniture) -> NDArray[np.float64]:
    """What a piece of furniture covers of the floor, as (4, 2) corners."""
    size = item.size or category_named(item.category, None, static=True).size_m
    return _rectangle((item.pose[0], item.pose[1]), size[:2], item.pose[2])


def _grid_graph(free: NDArray[np.bool_], cell_m: float) -> tuple[NDArray[np.int64], coo_matrix]:
    """Numbers of the free cells, -1 elsewhere, and their graph: eight neighbors, lengths in meters."""
    number = np.full(free.shape, -1, np.int64)
    number[free] = np.arange(int(free.sum()))
    height, width = free.shape
    rows, columns, lengths = [], [], []
    for dy, dx in ((0, 1), (1, 0), (1, 1), (1, -1)):
        here = number[: height - dy, max(0, -dx) : width - max(0, dx)]
        there = number[dy:, max(0, dx) : width - max(0, -dx)]
        both = (here >= 0) & (there >= 0)
        rows.append(here[both])
        columns.append(there[both])
        lengths.append(np.full(int(both.sum()), cell_m * math.hypot(dx, dy)))
    count = int(free.sum())
    data = (np.concatenate(lengths), (np.concatenate(rows), np.concatenate(columns)))
    return number, coo_matrix(data, shape=(count, count)).tocsr()


def _rectangle(center: Point, size: tuple[float, float], yaw_rad: float) -> NDArray[np.float64]:
    """(4, 2) corners."""
    cos, sin = math.cos(yaw_rad), math.sin(yaw_rad)
    corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * np.array(size) / 2
    turned: NDArray[np.float64] = corners @ np.array([[cos, sin], [-sin, cos]]) + np.array(center)
    return turned


def _direction_at(polygon: NDArray[np.float64], point: NDArray[np.float64]) -> NDArray[np.float64]:
    """Unit direction of the side that is nearest to a point."""
    begin, end = polygon, np.roll(polygon, -1, axis=0)
    side = end - begin
    length = np.linalg.norm(side, axis=1)
    along = np.clip(((point - begin) * side).sum(axis=1) / np.maximum(length**2, 1e-12), 0.0, 1.0)
    nearest = int(np.argmin(np.linalg.norm(begin + along[:, None] * side - point, axis=1)))
    direction: NDArray[np.float64] = side[nearest] / max(float(length[nearest]), 1e-9)
    return direction


def _who_stays(scene: Scene, stays_m: float) -> Iterator[Point]:
    """Where somebody stands for good: nothing that happens in the house by itself makes them walk, and nobody led them
    away.
    """
    now = {entry["id"]: entry["position_m"] for entry in scene.truth.get("people", ())}
    walking = {event.id for event in scene.house.events}
    for person in scene.house.people:
        if person.id in now and person.id not in walking and math.dist(now[person.id][:2], person.pose[:2]) < stays_m:
            yield person.pose[0], person.pose[1]
