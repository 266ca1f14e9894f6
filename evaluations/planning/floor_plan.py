"""A building in a few lines of text, and the scene document that it stands for.

Rooms stand along corridors, furniture in rooms, things on or in furniture, one line a piece of furniture::

    corridor room_1 hall
      robot robot
    room room_2 kitchen closed
      person_1 Anna
      table_1 brown: cup_1 red, phone_1 black lost
      bowl_1 yellow on table_1: apple_1 red
    room room_3 pantry beyond room_2

A kind of thing that the catalog lacks is named before the first room, with what can be done with it, its size and the
categories that the graph knows of it::

    kind lemon carried small fruit food
    kind lectern support 0.6x0.5x1.1

A room has a door to the corridor above it, or to the room that it is ``beyond``; ``closed`` shuts that door. A second
corridor is joined to the first. Labels are the identifiers without their number. After it come a color and marks:
``large``, ``small``, ``wide`` (as its support), ``lost`` (not where it was).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import ceil
from typing import Any

from app.errors import LineError
from evaluations.planning.catalog import SIZES, SORTS, Nature, Size, Sort
from skills.furniture.kinds import is_container

STAMP_S = 1000.0
DEPTH_M, CORRIDOR_M, WALL_M = 4.0, 2.0, 0.2
PITCH_M = 1.8
"""Between pieces of furniture: more than what counts as next to each other."""
WING_M = 2 * 2 * (DEPTH_M + WALL_M) + CORRIDOR_M + WALL_M
MARKS = ("large", "small", "wide", "lost")
SCALE = {"large": 1.5, "small": 0.7}


@dataclass(kw_only=True)
class _Item:
    id: str
    words: list[str]
    under: str = ""
    things: list[_Item] = field(default_factory=list)

    @property
    def label(self) -> str:
        return self.id.rpartition("_")[0]


@dataclass(kw_only=True)
class _Room:
    id: str
    label: str
    corridor: bool
    beyond: str
    closed: bool
    items: list[_Item] = field(default_factory=list)
    x_m: float = 0.0
    y_m: float = 0.0
    width_m: float = 0.0
    depth_m: float = DEPTH_M


def scene_document(text: str, name: str = "building") -> dict[str, Any]:
    """The document in the format of ``GET /v1/scene?frame=map``.

    Raises:
        LineError: naming line and field.
    """
    rooms, sorts = _read(text, name)
    layout = _Layout()
    for room in rooms:
        layout.add(room)
    nodes: list[dict[str, Any]] = []
    edges: list[dict[str, Any]] = []
    for room in rooms:
        nodes.append(_room_node(room))
        for index, item in enumerate(room.items):
            _furnish(room, item, index, sorts, nodes, edges)
    return {"revision": 1, "stamp_s": STAMP_S, "nodes": nodes + layout.doors, "edges": edges}


def _read(text: str, name: str) -> tuple[list[_Room], dict[str, Sort]]:
    rooms: list[_Room] = []
    sorts = dict(SORTS)
    seen: set[str] = set()
    for number, line in enumerate(text.splitlines(), 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        if words[0] == "kind":
            sorts[words[1]] = _read_kind(words[1:], name, number)
            continue
        if not line.startswith(" "):
            rooms.append(_read_room(words, rooms, name, number))
            new = [words[1]]
        elif not rooms:
            raise LineError(name, number, words[0], "stands in no room: begin with a corridor")
        else:
            item = _read_item(line.split("#")[0], sorts, name, number)
            if item.under and item.under not in seen:
                raise LineError(name, number, item.under, "comes after what stands on it")
            rooms[-1].items.append(item)
            new = [item.id, *(thing.id for thing in item.things)]
        for node_id in new:
            if node_id in seen:
                raise LineError(name, number, node_id, "is there already")
            seen.add(node_id)
    return rooms, sorts


def _read_kind(words: list[str], name: str, number: int) -> Sort:
    kind, nature, size, *categories = [*words, "", ""][: max(3, len(words))]
    natures = {each.name.lower(): each for each in Nature}
    if not kind or nature not in natures:
        raise LineError(name, number, kind or "kind", f"expected 'kind NAME {'|'.join(natures)} SIZE [CATEGORY ...]'")
    return Sort(size_m=_read_size(size, name, number), nature=natures[nature], categories=tuple(categories))


def _read_size(text: str, name: str, number: int) -> Size:
    if text in SIZES:
        return SIZES[text]
    try:
        x_m, y_m, z_m = map(float, text.split("x"))
    except ValueError as error:
        known = ", ".join(SIZES)
        raise LineError(name, number, "size", f"{text!r} is none of {known}, nor meters such as 0.6x0.5x1.1") from error
    return x_m, y_m, z_m


def _read_room(words: list[str], rooms: list[_Room], name: str, number: int) -> _Room:
    kind, *rest = words
    if kind not in ("corridor", "room") or len(rest) < 2:
        raise LineError(name, number, kind, "expected 'corridor ID LABEL' or 'room ID LABEL [beyond ID] [closed]'")
    if kind == "room" and not rooms:
        raise LineError(name, number, rest[0], "a corridor comes before the first room")
    closed = rest[-1] == "closed"
    rest = rest[:-1] if closed else rest
    beyond = rest[-1] if len(rest) > 3 and rest[-2] == "beyond" else ""
    if beyond and beyond not in {room.id for room in rooms}:
        raise LineError(name, number, "beyond", f"there is no room {beyond} above")
    label = " ".join(rest[1:-2] if beyond else rest[1:])
    return _Room(id=rest[0], label=label, corridor=kind == "corridor", beyond=beyond, closed=closed)


def _read_item(line: str, sorts: dict[str, Sort], name: str, number: int) -> _Item:
    head, _, tail = line.partition(":")
    words = head.split()
    under = words[-1] if len(words) > 2 and words[-2] == "on" else ""
    item = _Item(id=words[0], words=words[1:-2] if under else words[1:], under=under)
    item.things = [_Item(id=w[0], words=w[1:]) for w in (part.split() for part in tail.split(",")) if w]
    for each in (item, *item.things):
        if each.label not in sorts and each.label != "person" and each.id != "robot":
            raise LineError(name, number, each.id, f"no kind of thing {each.label!r}; there are {', '.join(sorts)}")
    return item


class _Layout:
    """Puts rooms along corridors one after the other, and notes the doors between them."""

    def __init__(self) -> None:
        self.doors: list[dict[str, Any]] = []
        self._placed: dict[str, _Room] = {}
        self._corridors: list[_Room] = []
        self._front_m = [0.0, 0.0]

    def add(self, room: _Room) -> None:
        """Give a room its place and size, and its door."""
        room.width_m = max(3.0, PITCH_M * ceil(len(room.items) / 2) + 0.6)
        if room.corridor:
            self._open_wing(room)
        elif room.beyond:
            self._put_behind(room, self._placed[room.beyond])
        else:
            self._put_along(room, self._corridors[-1])
        self._placed[room.id] = room

    def _open_wing(self, room: _Room) -> None:
        room.y_m, room.depth_m = len(self._corridors) * WING_M, CORRIDOR_M
        if self._corridors:
            last = self._corridors[-1]
            self.doors.append(_door(last, room, (0.1, (last.y_m + room.y_m) / 2), closed=False))
        self._corridors.append(room)
        self._front_m = [0.0, 0.0]

    def _put_behind(self, room: _Room, front: _Room) -> None:
        side = 1 if front.y_m > self._corridors[-1].y_m else -1
        room.x_m, room.y_m = front.x_m, front.y_m + side * (DEPTH_M + WALL_M)
        self.doors.append(_door(front, room, (room.x_m, (front.y_m + room.y_m) / 2), closed=room.closed))

    def _put_along(self, room: _Room, corridor: _Room) -> None:
        k = 0 if self._front_m[0] <= self._front_m[1] else 1
        side = 1 - 2 * k
        room.x_m = self._front_m[k] + room.width_m / 2
        room.y_m = corridor.y_m + side * (CORRIDOR_M + DEPTH_M + 2 * WALL_M) / 2
        self._front_m[k] += room.width_m + WALL_M
        corridor.width_m = max(corridor.width_m, *self._front_m)
        corridor.x_m = corridor.width_m / 2
        spot = (room.x_m, corridor.y_m + side * (CORRIDOR_M + WALL_M) / 2)
        self.doors.append(_door(corridor, room, spot, closed=room.closed))


def _door(one: _Room, other: _Room, at: tuple[float, float], *, closed: bool) -> dict[str, Any]:
    numbers = "_".join(room.id.rpartition("_")[2] for room in (one, other))
    return {
        "id": f"door_{numbers}_0",
        "type": "door",
        "room": one.id,
        "rooms": [one.id, other.id],
        "position_m": [*at, 0.0],
        "state": "closed" if closed else "open",
        "crossing": "crossed",
    }


def _room_node(room: _Room) -> dict[str, Any]:
    w, d = room.width_m / 2, room.depth_m / 2
    corners = [[room.x_m + sx * w, room.y_m + sy * d] for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    node = {"id": room.id, "type": "room", "label": room.label, "room": room.id}
    return {**node, "position_m": [room.x_m, room.y_m, 0.0], "polygon_m": corners, "label_probability": 0.9}


def _furnish(
    room: _Room,
    item: _Item,
    index: int,
    sorts: dict[str, Sort],
    nodes: list[dict[str, Any]],
    edges: list[dict[str, Any]],
) -> None:
    """One piece of furniture, person or robot, and what is on it."""
    x_m = room.x_m - room.width_m / 2 + PITCH_M * (index // 2) + 1.0
    y_m = room.y_m + (room.depth_m / 2 - 0.5) * (1 if index % 2 else -1)
    base_m = 0.0
    if item.under:
        below = next(node for node in nodes if node["id"] == item.under)
        x_m, y_m = below["position_m"][0], below["position_m"][1] + 0.25
        base_m = below["size_m"][2]
        edges.append({"source": item.id, "target": item.under, "type": "relation", "label": "on"})
    place = {"room": room.id, "position_m": [round(x_m, 3), round(y_m, 3), 0.0]}
    if item.id == "robot" or item.label == "person":
        kind = "robot" if item.id == "robot" else "person"
        nodes.append({"id": item.id, "type": kind, **place, "name": " ".join(item.words)})
        return
    node = _object(item, sorts, (x_m, y_m), base_m, room.id)
    nodes.append(node)
    for k, thing in enumerate(item.things):
        across_m = node["size_m"][0] * ((k + 0.5) / len(item.things) - 0.5)
        nodes.append(_object(thing, sorts, (x_m + across_m, y_m), base_m + node["size_m"][2], room.id, on=node))
        edges.append(_relation(thing.id, item))


def _relation(thing: str, holder: _Item) -> dict[str, Any]:
    inside = is_container(holder.label.replace("_", " "))
    return {"source": thing, "target": holder.id, "type": "relation", "label": "in" if inside else "on"}


def _object(
    item: _Item,
    sorts: dict[str, Sort],
    at: tuple[float, float],
    base_m: float,
    room: str,
    on: dict[str, Any] | None = None,
) -> dict[str, Any]:
    sort = sorts[item.label]
    marks = [word for word in item.words if word in MARKS]
    color = " ".join(word for word in item.words if word not in MARKS)
    scale = next((SCALE[mark] for mark in marks if mark in SCALE), 1.0)
    size = [round(scale * side, 3) for side in sort.size_m]
    if "wide" in marks and on is not None:
        size = [*on["size_m"][:2], 0.3]
    return {
        "id": item.id,
        "type": "object",
        "label": item.label.replace("_", " "),
        "room": room,
        "position_m": [round(at[0], 3), round(at[1], 3), round(base_m + size[2] / 2, 3)],
        "size_m": size,
        "attributes": {"color": color, "categories": list(sort.categories), "name": ""},
        "state": "missing" if "lost" in marks else "present",
        "first_seen_s": 10.0,
        "last_seen_s": STAMP_S - (600.0 if "lost" in marks else 60.0),
        "graspable": sort.nature is Nature.CARRIED or item.label in ("bowl", "tray"),
        "support": sort.nature is Nature.SUPPORT,
        "observations": 12,
    }
