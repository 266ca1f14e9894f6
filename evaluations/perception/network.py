"""``evaluate network``: what a network's file recognizes in pictures of generated houses, and how fast.

Pictures are taken from where the robot could stand, most of them of something near (see ``simulation/photographer``).
The shipped network has learned from other pictures: from houses whose seeds are at least 2^30, and from random rooms.
"""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from rich.console import Console
from rich.progress import track
from rich.table import Table

from evaluations.perception.recognition import CLEAR_PX, SIZES_PX, Tally
from evaluations.plots import save
from evaluations.tables import shown
from perception.network.model import NetworkSettings, OnnxPanopticModel
from perception.ports import RgbdFrame
from scene_graph.geometry.se3 import SE3
from simulation.generation.stocking import stocked_house
from simulation.pictures.photographer import photographer
from simulation.pictures.photographs import Photograph
from simulation.robot.description import CameraDescription

_TIMED = 100
"""Frames of which the time is taken."""


@dataclass(frozen=True, kw_only=True)
class NetworkAims:
    """What a network is to recognize, and what it may cost; chosen."""

    recall: float = 0.90
    precision: float = 0.92
    least_class: float = 0.75
    """Recall of the worst class."""
    mask_iou: float = 0.85
    relation_recall_at_20: float = 0.65
    frame_ms: float = 15.0
    file_mb: float = 12.0
    fewest: int = 20
    """Of which fewer clear ones were shown, a class says nothing about the network."""

    @property
    def shares(self) -> dict[str, float]:
        """Those that are to be reached, by the names of the report's figures."""
        return {name: aim for name, aim in asdict(self).items() if name not in ("frame_ms", "file_mb", "fewest")}


def evaluate(
    *,
    model: Path,
    seeds: Sequence[int],
    pictures: int,
    json_file: Path | None,
    plot_file: Path | None,
    console: Console,
    aims: NetworkAims = NetworkAims(),
) -> bool:
    """Show the network ``pictures`` of each house, print tables, write JSON and plot; whether all aims are met."""
    network = OnnxPanopticModel.load(model)
    tally = Tally()
    for photo in track(views(seeds, pictures), total=len(seeds) * pictures, description="pictures", console=console):
        height, width = photo.ids.shape
        resized = network.placement((height, width)).resized
        tally.add(photo, network.understand(frame_of(photo)), scale=resized[0] * resized[1] / (height * width))
    report = tally.report()
    report["least_class"] = min(
        (row["recall"] for row in report["classes"].values() if row["there"] >= aims.fewest), default=None
    )
    report["model"] = {"file": model.name, "megabytes": model.stat().st_size / 1e6, **speed(network)}
    report["met"] = met(report, aims)
    _print(report, console, aims)
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
        json_file.write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    if plot_file is not None:
        _draw(report, plot_file, aims)
    return bool(report["met"])


def views(seeds: Sequence[int], pictures: int) -> Iterator[Photograph]:
    """``pictures`` of each stocked house."""
    for seed in seeds:
        with photographer(stocked_house(seed=seed), seed=seed) as camera:
            yield from camera.pictures(pictures)


def frame_of(photo: Photograph) -> RgbdFrame:
    """The picture as the camera would send it; networks do not look at the rest."""
    depth_m, intrinsics = np.ones(photo.ids.shape, dtype=np.float32), CameraDescription().intrinsics
    return RgbdFrame(
        stamp_s=0.0, rgb=photo.rgb, depth_m=depth_m, intrinsics=intrinsics, T_base_camera=SE3.identity()
    )  # fmt: skip


def speed(network: OnnxPanopticModel) -> dict[str, Any]:
    """Milliseconds for one frame with its usual threads, from picture to instances and relations."""
    camera = CameraDescription()
    rgb = np.random.default_rng(0).integers(0, 255, (camera.height_px, camera.width_px, 3), dtype=np.uint8)
    nothing = np.full(rgb.shape[:2], 255, dtype=np.uint8)
    frame = frame_of(Photograph(rgb=rgb, ids=nothing, categories=(), distances_m=np.zeros(0, np.float32), relations=()))
    taken = []
    for _ in range(_TIMED):
        start_s = time.perf_counter()
        network.understand(frame)
        taken.append(1000.0 * (time.perf_counter() - start_s))
    return {
        "threads": NetworkSettings.threads,
        "median_ms": float(np.median(taken)),
        "p95_ms": float(np.percentile(taken, 95)),
    }


def met(report: dict[str, Any], aims: NetworkAims = NetworkAims()) -> bool:
    """Whether every figure that could be measured is where it is to be."""
    shares = all(report[name] is None or report[name] >= aim for name, aim in aims.shares.items())
    model = report["model"]
    return shares and model["median_ms"] <= aims.frame_ms and model["megabytes"] <= aims.file_mb


def _print(report: dict[str, Any], console: Console, aims: NetworkAims) -> None:
    table = Table(title=f"{report['pictures']} pictures, things of {CLEAR_PX} pixels and more")
    for column in ("class", "shown", "recall", "found under any name", "precision", "mask IoU"):
        table.add_column(column, justify="left" if column == "class" else "right")
    for name, row in sorted(report["classes"].items(), key=lambda item: item[1]["recall"] or 0.0):
        shares = (row["recall"], row["found_under_any_name"], row["precision"], row["mask_iou"])
        table.add_row(name, str(row["there"]), *(shown(value) for value in shares))
    console.print(table)
    summary = Table(title="the network")
    for column in ("figure", "measured", "aim"):
        summary.add_column(column, justify="left" if column == "figure" else "right")
    for name, aim in aims.shares.items():
        summary.add_row(name.replace("_", " "), shown(report[name]), f">= {aim:.2f}")
    for name in ("relation_mean_recall_at_20", "support_recall_at_20"):
        summary.add_row(name.replace("_", " "), shown(report[name]), "")
    model = report["model"]
    summary.add_row(
        f"milliseconds a frame, {model['threads']} threads", f"{model['median_ms']:.1f}", f"<= {aims.frame_ms:.0f}"
    )
    summary.add_row("file, MB", f"{model['megabytes']:.1f}", f"<= {aims.file_mb:.0f}")
    for low, value in report["recall_by_pixels"].items():
        summary.add_row(f"recall from {low} pixels up to the next", shown(value), "")
    for name, value in report["relation_recall_by_predicate"].items():
        summary.add_row(f"recall@20 of {name}", shown(value), "")
    console.print(summary)
    worst = ", ".join(f"{true} as {given} ({count})" for true, given, count in report["confusions"][:12])
    console.print(f"Most often mistaken: {worst or 'nothing'}.")
    if report["strangers"]:
        console.print(f"Things without a name: {report['strangers']}")


def _draw(report: dict[str, Any], file: Path, aims: NetworkAims) -> None:
    """Recall and precision per class, recall by size, recall per predicate."""
    figure = Figure(figsize=(13.0, 9.0), layout="constrained")
    axes = figure.subplot_mosaic([["class", "pixels"], ["class", "relation"]], width_ratios=(3, 2))
    rows = sorted(report["classes"].items(), key=lambda item: item[1]["recall"] or 0.0)
    names = [name for name, _ in rows]
    axes["class"].barh(names, [row["recall"] or 0.0 for _, row in rows], color="#1d4ed8", label="recall")
    axes["class"].plot([row["precision"] or 0.0 for _, row in rows], names, "o", color="#c2410c", label="precision")
    axes["class"].axvline(aims.least_class, color="#9ca3af", linewidth=1.0)
    axes["class"].set_title(f"things of {CLEAR_PX} pixels and more at the network's input")
    axes["class"].legend(loc="lower left")
    bins = [f"{low}+" for low in SIZES_PX]
    axes["pixels"].bar(bins, [report["recall_by_pixels"][str(low)] or 0.0 for low in SIZES_PX], color="#1d4ed8")
    axes["pixels"].set_title("recall by visible pixels")
    predicates = report["relation_recall_by_predicate"]
    axes["relation"].barh(list(predicates), [value or 0.0 for value in predicates.values()], color="#1d4ed8")
    axes["relation"].set_title("recall@20 by predicate")
    for axis in axes.values():
        axis.grid(alpha=0.3)
    save(figure, file)
