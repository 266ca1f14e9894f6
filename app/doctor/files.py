"""Checks of files: the houses, the network, the disk, and what the data folder holds."""

from __future__ import annotations

import hashlib
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from pathlib import Path

from app.doctor.finding import Finding, Health
from app.journal.file import check, read_only
from perception.network.shipped import SHA256, SHIPPED
from scene_graph.long_term.room_files import unreadable_rooms


def houses() -> Finding:
    """Whether the built-in houses load."""
    from simulation.errors import HouseError
    from simulation.houses.house_file import load_house

    try:
        load_house("flat")
    except HouseError as error:
        return Finding(name="houses", health=Health.BAD, text=str(error), advice="reinstall the package")
    return Finding(name="houses", text="the built-in houses load")


def network(path: Path) -> Finding:
    """Whether the network's file is whole, keeps its contract, and runs."""
    from perception.network.errors import NetworkRefused

    advice = "docs/network.md says what is needed"
    if path == SHIPPED and path.exists() and hashlib.sha256(path.read_bytes()).hexdigest() != SHA256:
        text = f"{path} is not the file that was shipped"
        return Finding(name="network", health=Health.BAD, text=text, advice="reinstall the package")
    try:
        from perception.network.model import OnnxPanopticModel

        found = OnnxPanopticModel.load(path.expanduser())
    except ImportError as error:
        text = f"what runs it cannot be imported ({error})"
        return Finding(name="network", health=Health.BAD, text=text, advice="run make install")
    except NetworkRefused as error:
        return Finding(name="network", health=Health.BAD, text=str(error), advice=advice)
    known = f"{len(found.description.classes)} classes, {len(found.description.predicates)} predicates"
    return Finding(name="network", text=f"{path}: {known}, and it runs")


def disk(data: Path, *, little_bytes: int = 500_000_000, too_little_bytes: int = 50_000_000) -> Finding:
    """Room on the disk of the data folder: a recording takes a gigabyte in minutes, the journal up to 64 MB."""
    place = _existing(data)
    free = shutil.disk_usage(place).free
    text = f"{free / 1e9:.1f} GB free at {place}"
    if free >= little_bytes:
        return Finding(name="disk", text=text)
    health = Health.ODD if free >= too_little_bytes else Health.BAD
    return Finding(name="disk", health=health, text=text, advice="make room, or choose another folder with --data")


def data_folder(data: Path) -> Finding:
    """Whether the data folder can be written, and others cannot read the token."""
    place = _existing(data)
    if not place.is_dir() or (data.exists() and not data.is_dir()):
        text = f"{place} is no folder"
        return Finding(name="data", health=Health.BAD, text=text, advice="name a folder with --data")
    try:
        with tempfile.NamedTemporaryFile(dir=place):
            pass
    except OSError as error:
        text = f"{place} cannot be written: {error.strerror}"
        advice = f"give yourself the right to write there (ls -ld {place}), or choose another folder with --data"
        return Finding(name="data", health=Health.BAD, text=text, advice=advice)
    token = data / "token"
    if token.exists() and token.stat().st_mode & 0o077:
        return Finding(name="data", health=Health.ODD, text=f"others can read {token}", advice=f"chmod 600 {token}")
    return Finding(name="data", text=f"{data} can be written" if data.exists() else f"{data} will be made")


def journals(data: Path) -> Iterator[Finding]:
    """How the journals and the rooms of every known building are, and what was set aside earlier."""
    folders = sorted(path for path in (data / "buildings").glob("*") if path.is_dir())
    for folder in folders:
        yield _building(folder)


def _building(folder: Path) -> Finding:
    name, file = "building", folder / "tasks.sqlite3"
    flaw = _flaw(file) if file.exists() else None
    if flaw is not None:
        return flaw
    broken = unreadable_rooms(folder)
    if broken:
        text = f"{folder.name}: {len(broken)} of its rooms cannot be read ({broken[0][1]})"
        advice = "nothing to do: at the next start they are set aside, and explored again"
        return Finding(name=name, health=Health.ODD, text=text, advice=advice)
    aside = sorted(path.name for path in folder.rglob("*") if ".damaged-" in path.name or path.suffix == ".broken")
    if aside:
        text = f"{folder.name} is well; set aside earlier: {', '.join(aside[:5])}"
        return Finding(name=name, health=Health.ODD, text=text, advice="look into them or delete them")
    return Finding(name=name, text=f"{folder.name} is well")


def _flaw(file: Path) -> Finding | None:
    """What is wrong with a journal, if anything."""
    try:
        connection = read_only(file)
        try:
            check(connection)
        finally:
            connection.close()
    except sqlite3.OperationalError as error:
        if "locked" not in str(error):
            return _damaged(file, error)
        text = f"{file} is locked by another program"
        advice = f"end it (fuser {file} tells who), or serve with another --data"
        return Finding(name="building", health=Health.BAD, text=text, advice=advice)
    except sqlite3.DatabaseError as error:
        return _damaged(file, error)
    return None


def _damaged(file: Path, error: sqlite3.Error) -> Finding:
    text = f"{file} is damaged: {error}"
    advice = "the next start sets it aside and begins a new one; restore a copy first if you have one"
    return Finding(name="building", health=Health.BAD, text=text, advice=advice)


def _existing(path: Path) -> Path:
    """The folder itself, or the nearest above it that exists."""
    path = path.absolute()
    return next(place for place in (path, *path.parents) if place.exists())
