"""``majordomo doctor``: checks what Majordomo needs on this machine and says what to do about what is missing."""

from __future__ import annotations

import importlib
import os
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.markup import escape

LIBRARIES = (
    "numpy",
    "scipy",
    "gtsam",
    "cv2",
    "onnxruntime",
    "filterpy",
    "igraph",
    "pybullet",
    "py_trees",
    "lark",
    "fastapi",
)
FREE_DISK_BYTES = 500_000_000


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One check: what was looked at, whether it is well, what was found or what to do."""

    name: str
    well: bool
    text: str


def examine(console: Console, network: Path) -> bool:
    """Run all checks and print them; whether all is well. ``network``: file of the panoptic scene graph network."""
    findings = [_python(), _libraries(), _house(), _disk(), _model(), _network(network)]
    for finding in findings:
        mark = "[green]ok[/]  " if finding.well else "[red]BAD[/] "
        console.print(f"{mark} {finding.name:<10} {escape(finding.text)}", highlight=False)
    return all(finding.well for finding in findings)


def _python() -> Finding:
    version = ".".join(str(part) for part in sys.version_info[:3])
    well = sys.version_info[:2] == (3, 11)
    return Finding(name="python", well=well, text=version if well else f"{version}: use 3.11 (make install finds one)")


def _libraries() -> Finding:
    missing = [name for name in LIBRARIES if not _imports(name)]
    text = f"{', '.join(missing)} cannot be imported: run make install" if missing else f"{len(LIBRARIES)} import"
    return Finding(name="libraries", well=not missing, text=text)


def _imports(name: str) -> bool:
    try:
        importlib.import_module(name)
    except ImportError:
        return False
    return True


def _house() -> Finding:
    from majordomo.simulation.errors import HouseError
    from majordomo.simulation.house import load_house

    try:
        load_house("flat")
    except HouseError as error:
        return Finding(name="houses", well=False, text=f"{error}: reinstall")
    return Finding(name="houses", well=True, text="the built-in houses load")


def _disk() -> Finding:
    free = shutil.disk_usage(Path.home() if Path.home().exists() else Path("/")).free
    text = f"{free / 1e9:.1f} GB free"
    return Finding(
        name="disk", well=free > FREE_DISK_BYTES, text=text if free > FREE_DISK_BYTES else f"{text}: make room"
    )


def _model() -> Finding:
    url = os.environ.get("MAJORDOMO_LLM_URL")
    text = f"endpoint {url}" if url else "none configured: the command grammar answers alone"
    return Finding(name="model", well=True, text=text)


def _network(path: Path) -> Finding:
    from majordomo.perception.network.errors import NetworkRefused

    try:
        from majordomo.perception.network.model import OnnxPanopticModel

        network = OnnxPanopticModel.load(path.expanduser())
    except ImportError:
        return Finding(name="network", well=False, text="onnxruntime cannot be imported: run make install")
    except NetworkRefused as error:
        return Finding(name="network", well=False, text=f"{error}: docs/network.md says what is needed")
    known = f"{len(network.description.classes)} classes, {len(network.description.predicates)} predicates"
    return Finding(name="network", well=True, text=f"{path}: {known}, and it runs")
