"""Pictures of what the evaluations measured, as PNG files."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

TRUE, FOUND = "#c2410c", "#1d4ed8"


def draw_plans(runs: Sequence[Mapping[str, Any]], file: Path, *, most: int = 20) -> None:
    """True floor plans with what was found over them, a small picture a run (Concepts, figure 10)."""
    runs = runs[:most]
    columns = min(5, max(1, math.ceil(math.sqrt(len(runs)))))
    rows = max(1, math.ceil(len(runs) / columns))
    figure = Figure(figsize=(3.2 * columns, 3.4 * rows), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for axis, run in zip(axes, runs, strict=False):
        _plan(axis, run["true_plan"], run["true_doors"], TRUE, width=2.6)
        _plan(axis, run["found_plan"], run["found_doors"], FOUND, width=0.9)
        verdict = "topology right" if run["topology_right"] else "topology wrong"
        axis.set_title(f"{run['house']}, seed {run['seed']}: {verdict}", fontsize=8)
    for axis in axes:
        axis.set_aspect("equal")
        axis.axis("off")
    colors = ((TRUE, "true"), (FOUND, "found"))
    handles = [axes[0].plot([], [], color=color, label=label)[0] for color, label in colors]
    figure.legend(handles=handles, loc="outside lower center", ncols=2)
    save(figure, file)


def save(figure: Figure, file: Path) -> None:
    """Write the picture, its folder too."""
    file.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(file, dpi=110, metadata={"Software": None})


def _plan(axis: Axes, rooms: Mapping[str, Any], doors: Mapping[str, Any], color: str, *, width: float) -> None:
    for polygon in rooms.values():
        xs, ys = zip(*[*polygon, polygon[0]], strict=True)
        axis.plot(xs, ys, color=color, linewidth=width)
    for x, y in doors.values():
        axis.plot([x], [y], "o", color=color, markersize=2.0 * width, markerfacecolor="none")
