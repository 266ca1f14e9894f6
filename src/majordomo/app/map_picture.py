"""The known building as an SVG picture, drawn from the scene document in the map frame."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any
from xml.sax.saxutils import escape, quoteattr

MARGIN_M = 0.5
PIXELS_PER_M = 60.0


def map_svg(scene: Mapping[str, Any]) -> str:
    """An SVG of rooms, doors, furniture, things, people and the robot; meters as user units, y up."""
    nodes: Sequence[Mapping[str, Any]] = scene["nodes"]
    shapes = [shape for kind, draw in _DRAW.items() for node in nodes if node["type"] == kind for shape in draw(node)]
    x, y, width, height = _bounds(nodes)
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{x:.3f} {y:.3f} {width:.3f} {height:.3f}" '
        f'width="{width * PIXELS_PER_M:.0f}" height="{height * PIXELS_PER_M:.0f}" font-family="sans-serif">'
        f'<rect x="{x:.3f}" y="{y:.3f}" width="{width:.3f}" height="{height:.3f}" fill="#ffffff"/>'
        f"{''.join(shapes)}</svg>"
    )


def _bounds(nodes: Sequence[Mapping[str, Any]]) -> tuple[float, float, float, float]:
    points = [point for node in nodes for point in node.get("polygon_m") or ()]
    points += [node["position_m"][:2] for node in nodes if node.get("position_m")]
    if not points:
        points = [(0.0, 0.0)]
    left, right = min(p[0] for p in points) - MARGIN_M, max(p[0] for p in points) + MARGIN_M
    low, high = min(p[1] for p in points) - MARGIN_M, max(p[1] for p in points) + MARGIN_M
    return left, -high, right - left, high - low


def _room(node: Mapping[str, Any]) -> list[str]:
    corners = " ".join(f"{x:.3f},{-y:.3f}" for x, y in node.get("polygon_m") or ())
    x, y = node["position_m"][:2]
    name = node.get("label") or node["id"]
    return [
        f'<polygon points="{corners}" fill="#eef3fb" stroke="#334155" stroke-width="0.08"/>',
        f'<text x="{x:.3f}" y="{-y:.3f}" font-size="0.3" text-anchor="middle">{escape(name)}</text>',
    ]


def _door(node: Mapping[str, Any]) -> list[str]:
    x, y = node["position_m"][:2]
    half, yaw = node["width_m"] / 2, node.get("yaw_rad", 0.0)
    dx, dy = half * math.cos(yaw), half * math.sin(yaw)
    color = "#b91c1c" if node.get("state") == "closed" else "#ffffff"
    ends = f'x1="{x - dx:.3f}" y1="{-(y - dy):.3f}" x2="{x + dx:.3f}" y2="{-(y + dy):.3f}"'
    return [f'<line {ends} stroke="{color}" stroke-width="0.14"/>']


def _object(node: Mapping[str, Any]) -> list[str]:
    x, y = node["position_m"][:2]
    width, depth = (node.get("size_m") or (0.1, 0.1))[:2]
    title = f"<title>{escape(node['label'])}</title>"
    if node.get("graspable"):
        color = quoteattr(node.get("attributes", {}).get("color") or "gray")
        radius = max(0.06, min(width, depth) / 2)
        place = f'cx="{x:.3f}" cy="{-y:.3f}" r="{radius:.3f}"'
        return [f'<circle {place} fill={color} stroke="#17202b" stroke-width="0.015">{title}</circle>']
    turn = -math.degrees(node.get("yaw_rad", 0.0))
    box = f'x="{-width / 2:.3f}" y="{-depth / 2:.3f}" width="{width:.3f}" height="{depth:.3f}"'
    place = f'transform="translate({x:.3f} {-y:.3f}) rotate({turn:.2f})"'
    return [f'<rect {box} {place} fill="#d9c7a8" stroke="#8a7550" stroke-width="0.02">{title}</rect>']


def _person(node: Mapping[str, Any]) -> list[str]:
    x, y = node["position_m"][:2]
    return [f'<circle cx="{x:.3f}" cy="{-y:.3f}" r="0.22" fill="#db2777"/>']


def _robot(node: Mapping[str, Any]) -> list[str]:
    x, y = node["position_m"][:2]
    turn = -math.degrees(node.get("yaw_rad", 0.0))
    body = '<circle r="0.25" fill="#1d4ed8"/><path d="M.2 0L-.06 .11L-.06 -.11z" fill="#ffffff"/>'
    return [f'<g transform="translate({x:.3f} {-y:.3f}) rotate({turn:.2f})">{body}</g>']


_DRAW = {"room": _room, "door": _door, "object": _object, "person": _person, "robot": _robot}
