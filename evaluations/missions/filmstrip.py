"""One mission in a picture: the robot's way on the floor plan, and what its camera saw when something happened."""

from __future__ import annotations

import io
import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.image
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from evaluations.missions.ways import Point, gap, outline
from evaluations.plots import FOUND, TRUE, save
from simulation.houses.house import OUTSIDE, House

MOST = 16
_COLUMNS = 4
_ROW_IN, _WIDE_IN = 2.75, 13.0


@dataclass(frozen=True, kw_only=True)
class Still:
    """What the camera saw (``jpeg``; None without a camera), where the robot stood in the house, when, and why it is
    shown.
    """

    stamp_s: float
    at: Point
    caption: str
    jpeg: bytes | None


def draw_filmstrip(house: House, way: Sequence[Point], stills: Sequence[Still], title: str, file: Path) -> None:
    """Write the picture as PNG, its folder too.

    Args:
        house: walls, doors and furniture as they were at the start.
        way: places (m, house frame) that the robot came by, in order.
        stills: in order; of more than ``MOST`` the first and the last are shown.
        title: over everything.
        file: where to write it.
    """
    shown = [*stills[: MOST // 2], *stills[-(MOST - MOST // 2) :]] if len(stills) > MOST else list(stills)
    rows = max(1, math.ceil(len(shown) / _COLUMNS))
    low, high = _extent(house)
    plan_in = _WIDE_IN * min((high[1] - low[1]) / max(high[0] - low[0], 0.1), 0.6)
    figure = Figure(figsize=(_WIDE_IN, plan_in + _ROW_IN * rows + 0.5), layout="constrained")
    figure.suptitle(textwrap.fill(title, 110), fontsize=12)
    grid = figure.add_gridspec(1 + rows, _COLUMNS, height_ratios=[plan_in, *[_ROW_IN] * rows])
    _draw_plan(figure.add_subplot(grid[0, :]), house, way, shown)
    for number, still in enumerate(shown):
        row, column = divmod(number, _COLUMNS)
        axis = figure.add_subplot(grid[1 + row, column])
        if still.jpeg is not None:
            axis.imshow(matplotlib.image.imread(io.BytesIO(still.jpeg), format="jpeg"))
        caption = textwrap.fill(f"{number + 1}. {still.caption}", 42, max_lines=3, placeholder=" …")
        axis.set_title(f"{caption} ({still.stamp_s:.0f} s)", fontsize=8, loc="left")
        axis.axis("off")
    save(figure, file)


def _draw_plan(axis: Axes, house: House, way: Sequence[Point], stills: Sequence[Still]) -> None:
    for room in house.rooms:
        axis.add_patch(Polygon(room.polygon, facecolor="#f5f5f4", edgecolor="#44403c", linewidth=1.5))
        xs, ys = zip(*room.polygon, strict=True)
        middle = (sum(xs) / len(xs), sum(ys) / len(ys))
        axis.text(*middle, room.label or room.id, fontsize=8, ha="center", va="center", color="#78716c")
    for door in house.doors:
        if OUTSIDE not in door.rooms:
            axis.add_patch(Polygon(gap(house, door), facecolor="#f5f5f4", edgecolor="none"))
    for item in house.furniture:
        axis.add_patch(Polygon(outline(item), facecolor="#d6d3d1", edgecolor="#a8a29e", linewidth=0.8))
        axis.text(item.pose[0], item.pose[1], item.category, fontsize=5, ha="center", va="center", color="#57534e")
    if way:
        xs, ys = zip(*way, strict=True)
        axis.plot(xs, ys, color=FOUND, linewidth=1.6)
    for number, still in enumerate(stills):
        axis.plot(*still.at, "o", color=TRUE, markersize=4)
        axis.annotate(
            str(number + 1), still.at, xytext=(3 + 7 * (number % 3), 3), textcoords="offset points", fontsize=8,
            color=TRUE,
        )  # fmt: skip
    axis.set_aspect("equal")
    axis.autoscale_view()
    axis.axis("off")


def _extent(house: House) -> tuple[Point, Point]:
    """Lower and upper corner of all rooms."""
    xs, ys = zip(*(corner for room in house.rooms for corner in room.polygon), strict=True)
    return (min(xs), min(ys)), (max(xs), max(ys))
