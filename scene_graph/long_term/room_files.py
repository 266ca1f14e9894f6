"""A building on disk: one JSON file a room, each replaced as a whole, and one that says when it was written."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from scene_graph.errors import SceneFormatError
from scene_graph.identifiers import natural_key
from scene_graph.long_term.json_files import replace_file, set_aside
from scene_graph.long_term.records import edge_record, node_record, read_edge, read_node
from scene_graph.long_term.room_parts import RoomParts
from scene_graph.nodes import Node

VERSION = 2
"""Of the files. Those of version 1 are read too: they do not say what was held, nor by which robot's clock they tell
time. One of a later version is set aside, since nobody here knows what it would hold.
"""
_KNOWN = (1, VERSION)
_BUILDING = "building.json"
_ROOMS = "rooms"


@dataclass(frozen=True, kw_only=True)
class Written:
    """When a file was written.

    Attributes:
        stamp_s: robot time; ``saved_s``: the same moment on the wall, seconds since 1970, 0 when unknown.
        begun_s: wall time at which that robot's clock began, which tells one clock from another, 0 when unknown.
    """

    stamp_s: float = 0.0
    saved_s: float = 0.0
    begun_s: float = 0.0


@dataclass(frozen=True, kw_only=True)
class StoredBuilding:
    """What was read.

    Attributes:
        rooms: one entry for every file that could be read, in natural order of the file names.
        stamp_s: robot time at which it was written; ``saved_s``: wall time, seconds since 1970, 0 when unknown.
        shared: nodes of the building as a whole, such as regions.
        held: what the robot had in its hand, if anything.
        strays: rooms whose times are of another robot's clock than the building's, because the process ended between
            the two; with the moment at which they were written.
        broken: files that could not be read and were set aside, with the reason.
    """

    rooms: tuple[RoomParts, ...] = ()
    stamp_s: float = 0.0
    saved_s: float = 0.0
    shared: tuple[Node, ...] = ()
    held: str | None = None
    strays: Mapping[str, Written] = field(default_factory=dict)
    broken: tuple[tuple[Path, str], ...] = ()


class RoomFiles:
    """Writes and reads the files of one building in a folder of their own."""

    def __init__(self, folder: Path, *, begun_s: float = 0.0) -> None:
        """``begun_s``: wall time at which the robot's clock began, by which the rooms to be written tell time."""
        self._folder, self._begun_s = folder, begun_s
        self._written: dict[str, RoomParts] = {}

    def write(
        self,
        rooms: Iterable[RoomParts],
        *,
        shared: Iterable[Node],
        stamp_s: float,
        saved_s: float,
        held: str | None = None,
    ) -> int:
        """Make the folder hold just these rooms; files of rooms that have not changed stay. How many were written.

        ``held``: what the robot has in its hand.
        """
        now = Written(stamp_s=stamp_s, saved_s=saved_s, begun_s=self._begun_s)
        (self._folder / _ROOMS).mkdir(parents=True, exist_ok=True)
        present = {parts.room_id: parts for parts in rooms}
        changed = [parts for room_id, parts in present.items() if self._written.get(room_id) != parts]
        for parts in changed:
            self._put(self._path(parts.room_id), {**room_document(parts), **asdict(now)})
        for path in set((self._folder / _ROOMS).glob("*.json")) - {self._path(room_id) for room_id in present}:
            path.unlink(missing_ok=True)
        self._put(
            self._folder / _BUILDING,
            {
                "version": VERSION,
                **asdict(now),
                "held": held,
                "shared": [node_record(node) for node in shared],
            },
        )
        self._written = present
        return len(changed)

    def read(self) -> StoredBuilding:
        """Everything that can be read; a broken file is reported, renamed to ``*.broken``, and left out."""
        broken: list[tuple[Path, str]] = []
        rooms: list[RoomParts] = []
        moments: dict[str, Written] = {}
        for path in sorted((self._folder / _ROOMS).glob("*.json"), key=lambda path: natural_key(path.stem)):
            try:
                document = _load(path)
                rooms.append(read_room(document))
                moments[rooms[-1].room_id] = _written(document)
            except (ValueError, OSError) as error:
                broken.append((set_aside(path, error), str(error)))
        whole, head, problem = self._read_head()
        if problem is not None:
            broken.append(problem)
        strays = {room: moment for room, moment in moments.items() if moment.begun_s != whole.begun_s}
        told = {"stamp_s": whole.stamp_s, "saved_s": whole.saved_s, **head}
        return StoredBuilding(rooms=tuple(rooms), strays=strays, broken=tuple(broken), **told)

    def _read_head(self) -> tuple[Written, dict[str, Any], tuple[Path, str] | None]:
        """When the building was written, what is said of it as a whole, and what is wrong with its file."""
        path = self._folder / _BUILDING
        if not path.exists():
            return Written(), {}, None
        try:
            head = _load(path)
            shared = tuple(read_node(record, f"shared[{i}]") for i, record in enumerate(head["shared"]))
            held = head.get("held")
            if not isinstance(held, str | None):
                raise SceneFormatError("held", "no identifier")
            return _written(head), {"shared": shared, "held": held}, None
        except (KeyError, TypeError, ValueError, OSError) as error:
            return Written(), {}, (set_aside(path, error), str(error))

    def _path(self, room_id: str) -> Path:
        return self._folder / _ROOMS / f"{room_id}.json"

    def _put(self, path: Path, document: Mapping[str, Any]) -> None:
        replace_file(path, json.dumps(document, allow_nan=False, separators=(",", ":")).encode())


def room_document(parts: RoomParts) -> dict[str, Any]:
    """One room as a JSON document."""
    return {
        "version": VERSION,
        "room": parts.room_id,
        "nodes": [node_record(node) for node in parts.nodes],
        "edges": [edge_record(edge) for edge in parts.edges],
    }


def read_room(document: Mapping[str, Any]) -> RoomParts:
    """One room from its document.

    Raises:
        SceneFormatError: it is of another version or damaged; the field is named.
    """
    for name, kind in (("room", str), ("nodes", list), ("edges", list)):
        if not isinstance(document.get(name), kind):
            raise SceneFormatError(name, f"missing, or no {kind.__name__}")
    nodes = tuple(read_node(record, f"nodes[{i}]") for i, record in enumerate(document["nodes"]))
    if document["room"] not in {node.id for node in nodes}:
        raise SceneFormatError("room", f"{document['room']!r} is not among the nodes")
    edges = tuple(read_edge(record, f"edges[{i}]") for i, record in enumerate(document["edges"]))
    return RoomParts(room_id=document["room"], nodes=nodes, edges=edges)


def unreadable_rooms(folder: Path) -> list[tuple[Path, str]]:
    """The files of a building that cannot be read, with the reason; nothing is changed."""
    broken: list[tuple[Path, str]] = []
    for path in sorted((folder / _ROOMS).glob("*.json")):
        try:
            read_room(_load(path))
        except (ValueError, OSError) as error:
            broken.append((path, str(error)))
    return broken


def _load(path: Path) -> Mapping[str, Any]:
    document = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(document, dict):
        raise SceneFormatError("$", "not an object")
    if document.get("version") not in _KNOWN:
        raise SceneFormatError("version", f"{document.get('version')!r}, and this program reads up to {VERSION}")
    return document


def _written(document: Mapping[str, Any]) -> Written:
    """When a file was written; of a room of version 1 only the building's file says so."""
    try:
        return Written(**{name: float(document.get(name, 0.0)) for name in ("stamp_s", "saved_s", "begun_s")})
    except TypeError as error:
        raise SceneFormatError("stamp_s", "no number") from error
