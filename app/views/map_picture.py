"""The known building as an SVG picture, drawn from the scene document in the map frame."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any
from xml.sax.saxutils import escape

MARGIN_M = 0.5
PIXELS_PER_M = 60.0
WALL_M = 0.12
SMALL_M = 0.3

_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""What XML 1.0 does not admit, escaped or not (production 2, Char)."""

Node = Mapping[str, Any]


def map_svg(scene: Mapping[str, Any]) -> str:
    """An SVG of rooms, doors, furniture, things, people and the robot; meters as user units, y up."""
    nodes: Sequence[Node] = scene["nodes"]
    shapes = [shape for kind, draw in _LAYERS for node in nodes if node["type"] == kind for shape in draw(node)]
    x, y, width, height = _bounds(nodes)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x:.3f} {y:.3f} {width:.3f} {height:.3f}" '
        f'width="{width * PIXELS_PER_M:.0f}" height="{height * PIXELS_PER_M:.0f}" '
        'font-family="sans-serif" text-anchor="middle" dominant-baseline="central">'
        f'<rect x="{x:.3f}" y="{y:.3f}" width="{width:.3f}" height="{height:.3f}" fill="#ffffff"/>'
        f"{''.join(shapes)}</svg>"
    )


def _bounds(nodes: Sequence[Node]) -> tuple[float, float, float, float]:
    points = [point for node in nodes for point in node.get("polygon_m") or ()]
    points += [node["position_m"][:2] for node in nodes if node.get("position_m")]
    if not points:
        points = [(0.0, 0.0)]
    left, right = min(p[0] for p in points) - MARGIN_M, max(p[0] for p in points) + MARGIN_M
    low, high = min(p[1] for p in points) - MARGIN_M, max(p[1] for p in points) + MARGIN_M
    return left, -high, right - left, high - low


def _walls(room: Node) -> list[str]:
    style = f'fill="#46556a" stroke="#46556a" stroke-width="{2 * WALL_M}"'
    return [f'<polygon points="{_corners(room)}" {style}/>']


def _floor(room: Node) -> list[str]:
    return [f'<polygon points="{_corners(room)}" fill="#f4f7fc"/>']


def _room_name(room: Node) -> list[str]:
    return [_name(room, 0.3, room["label"] or room["id"])]


def _door(door: Node) -> list[str]:
    """A gap through the wall, and the leaf of a closed door.

    A door known from both its rooms is in the middle of the wall; known from one, it is on that room's side of it.
    """
    half, leaf_y = door["width_m"] / 2, 0.0 if len(door["rooms"]) > 1 else WALL_M
    reach = 2 * WALL_M
    gap = f'<rect x="{-half:.3f}" y="{-reach}" width="{2 * half:.3f}" height="{2 * reach}" fill="#f4f7fc"/>'
    leaf = f'<line x1="{-half:.3f}" y1="{leaf_y}" x2="{half:.3f}" y2="{leaf_y}" stroke="#b91c1c" stroke-width="0.06"/>'
    return [f"<g {_place(door)}>{gap}{leaf if door['state'] == 'closed' else ''}{_title(door)}</g>"]


def _furniture(thing: Node) -> list[str]:
    width, depth = thing["size_m"][:2]
    if thing["graspable"] or max(width, depth) < SMALL_M:
        return []
    box = f'x="{-width / 2:.3f}" y="{-depth / 2:.3f}" width="{width:.3f}" height="{depth:.3f}"'
    style = 'fill="#e4d6bd" stroke="#a08a61" stroke-width="0.02"'
    return [f"<rect {box} {style} {_place(thing)}>{_title(thing)}</rect>", _name(thing, 0.16, thing["label"])]


def _small_thing(thing: Node) -> list[str]:
    width, depth = thing["size_m"][:2]
    if not thing["graspable"] and max(width, depth) >= SMALL_M:
        return []
    style = f'fill="{_paint(thing["attributes"]["color"])}" stroke="#17202b" stroke-width="0.015"'
    return [f'<circle r="{max(0.06, min(width, depth) / 2):.3f}" {style} {_place(thing)}>{_title(thing)}</circle>']


def _person(person: Node) -> list[str]:
    return [f'<circle r="0.2" fill="#be185d" {_place(person)}>{_title(person)}</circle>']


def _robot(robot: Node) -> list[str]:
    arrow = '<path d="M.19 0L-.08 .13L-.02 0L-.08 -.13z" fill="#ffffff"/>'
    return [f'<g {_place(robot)}><circle r="0.25" fill="#1d4ed8"/>{arrow}{_title(robot)}</g>']


_LAYERS = (
    ("room", _walls),
    ("room", _floor),
    ("door", _door),
    ("object", _furniture),
    ("object", _small_thing),
    ("person", _person),
    ("room", _room_name),
    ("robot", _robot),
)


def _corners(room: Node) -> str:
    return " ".join(f"{x:.3f},{-y:.3f}" for x, y in room.get("polygon_m") or ())


def _place(node: Node) -> str:
    """Moves and turns a shape drawn about its own origin."""
    x, y = node["position_m"][:2]
    return f'transform="translate({x:.3f} {-y:.3f}) rotate({-math.degrees(node.get("yaw_rad", 0.0)):.2f})"'


def _name(node: Node, size_m: float, text: str) -> str:
    x, y = node["position_m"][:2]
    return f'<text x="{x:.3f}" y="{-y:.3f}" font-size="{size_m}" fill="#17202b">{_text(text.replace("_", " "))}</text>'


def _title(node: Node) -> str:
    return f"<title>{_text(node.get('name') or node['label'] or node['id'])}</title>"


def _text(words: str) -> str:
    """Words as XML text, without characters that XML does not know."""
    return escape(_NOT_XML.sub(" ", words))


def _paint(color: str) -> str:
    """A color as SVG names it: of two words the last, of anything else gray."""
    last = color.rpartition(" ")[2]
    return last if re.fullmatch("[a-z]+", last) else "gray"
