"""``evaluate clients``: does the service go on as before while two hundred clients listen, some of which never read?

Twice, in real time, the robot explores beside its simulator with the camera on, once without listeners and once with
them; the clients and who asks the API are processes of their own on the same machine.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import multiprocessing
import os
import sys
import tempfile
from collections.abc import AsyncIterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from app.runtime import Runtime
from app.server import SWITCH_INTERVAL_S
from app.settings import ClockMode, Settings
from evaluations.pool import run_all
from evaluations.service.rates import BESIDE_SIMULATOR, measured
from evaluations.service.stream_load import Heard, listen
from perception.network.shipped import SHIPPED


@dataclass(frozen=True, kw_only=True)
class ClientAims:
    """What listeners may cost; chosen."""

    api_p99_ms: float = 100.0
    kept: float = 0.95
    """Share of the rates without listeners that is to be kept with them."""
    most_mb: float = 100.0
    """By which the service may grow with all its listeners."""


@dataclass(frozen=True, kw_only=True)
class ListeningTiming:
    """In wall seconds."""

    to_connect_s: float = 60.0
    """Within which all clients are let in."""
    afterwards_s: float = 1.0
    """So much longer they listen than is measured."""


def evaluate(
    *,
    house: str,
    seconds: float,
    readers: int,
    mute: int,
    model: Path,
    json_file: Path | None,
    console: Console,
    aims: ClientAims = ClientAims(),
) -> bool:
    """Measure without listeners and with them; whether nobody notices them, and who reads misses nothing."""
    jobs = [(house, seconds, *audience, model) for audience in ((0, 0), (readers, mute))]
    without, with_them = run_all(run_once, jobs, jobs=1, console=console)
    figures = compared(without, with_them, aims)
    console.print(_table((without, with_them), figures, aims))
    if json_file is not None:
        document = {"cores": os.cpu_count(), **figures, "without": without, "with": with_them}
        json_file.parent.mkdir(parents=True, exist_ok=True)
        json_file.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    return bool(figures["held"])


def run_once(house: str, seconds: float, readers: int, mute: int, model: Path = SHIPPED) -> dict[str, Any]:
    """One of the two, in this process."""
    logging.getLogger("majordomo").setLevel(logging.ERROR)
    sys.setswitchinterval(SWITCH_INTERVAL_S)
    return asyncio.run(_explored(house, seconds, readers, mute, model))


def compared(
    without: Mapping[str, Any], with_them: Mapping[str, Any], aims: ClientAims = ClientAims()
) -> dict[str, Any]:
    """What the listeners cost: shares of the rates that are left, and whether all is well."""
    heard = with_them["heard"]
    kept = {rate: with_them[rate] / without[rate] if without[rate] else 0.0 for rate in ("lidar_hz", "rgbd_hz")}
    held = (
        all(share >= aims.kept for share in kept.values())
        and with_them["api_p99_ms"] < aims.api_p99_ms
        and not with_them["api_failures"]
        and not (heard["gaps"] or heard["snapshots"] or heard["closed"])
        and heard["fewest"] > 0
        and with_them["grown_mb"] < aims.most_mb
    )
    return {"kept": kept, "held": held}


async def _explored(house: str, seconds: float, readers: int, mute: int, model: Path) -> dict[str, Any]:
    with tempfile.TemporaryDirectory(prefix="majordomo-evaluate-") as folder:
        camera_hz = BESIDE_SIMULATOR.rgbd_hz
        settings = Settings(
            house=house, camera_hz=camera_hz, model=model, clock=ClockMode.REAL, data=Path(folder), port=0
        )
        runtime, heard = Runtime(settings), Heard()
        listening: list[asyncio.Future[Heard]] = []
        grown_from_mb, kept, timing = 0.0, 0, ListeningTiming()

        @contextlib.asynccontextmanager
        async def audience(port: int, token: str) -> AsyncIterator[None]:
            nonlocal heard, grown_from_mb, kept
            grown_from_mb = resident_mb()
            with ProcessPoolExecutor(max_workers=1, mp_context=multiprocessing.get_context("spawn")) as pool:
                work = (port, token, readers, mute, seconds + timing.afterwards_s)
                listening.append(asyncio.get_running_loop().run_in_executor(pool, listen, *work))
                async with asyncio.timeout(timing.to_connect_s):
                    while runtime.stream.listeners < readers + mute and not listening[0].done():
                        await runtime.wait_for_change()
                yield
                kept = runtime.stream.listeners - readers
                heard = await listening[0]

        figures = await measured(BESIDE_SIMULATOR, runtime, seconds, audience if readers + mute else None)
        memory = {"resident_mb": resident_mb(), "grown_mb": resident_mb() - grown_from_mb if grown_from_mb else 0.0}
        return {**figures, **memory, "readers": readers, "mute": mute, "mute_kept": kept, "heard": asdict(heard)}


def resident_mb() -> float:
    """Memory of this process that is in use now, in megabytes."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def _table(runs: Sequence[Mapping[str, Any]], figures: Mapping[str, Any], aims: ClientAims) -> Table:
    title = f"{runs[1]['readers']} clients that read and {runs[1]['mute']} that never do, on {os.cpu_count()} cores"
    table = Table(title=title)
    for column in ("figure", "without", "with", "aim"):
        table.add_column(column, justify="left" if column == "figure" else "right")
    kept, heard = figures["kept"], runs[1]["heard"]
    rows: dict[str, tuple[str, str]] = {
        "LiDAR Hz": ("{lidar_hz:.1f}", f"{100 * aims.kept:.0f} %, is {100 * kept['lidar_hz']:.0f} %"),
        "RGB-D understood Hz": ("{rgbd_hz:.1f}", f"{100 * aims.kept:.0f} %, is {100 * kept['rgbd_hz']:.0f} %"),
        "API p50 ms": ("{api_p50_ms:.1f}", ""),
        "API p99 ms": ("{api_p99_ms:.1f}", f"< {aims.api_p99_ms:.0f}"),
        "cores used by the service": ("{cpu_cores:.2f}", ""),
        "memory MB": ("{resident_mb:.0f}", f"+ {aims.most_mb:.0f}, is + {runs[1]['grown_mb']:.0f}"),
    }
    for name, (shape, aim) in rows.items():
        table.add_row(name, *(shape.format(**run) for run in runs), aim)
    table.add_row("that never read, not sent away", "", str(runs[1]["mute_kept"]), "")
    table.add_row("events received", "", str(heard["events"]), "")
    for name in ("gaps", "snapshots", "closed"):
        table.add_row({"snapshots": "fell behind"}.get(name, name), "", str(heard[name]), "0")
    return table
