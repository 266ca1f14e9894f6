"""The methods of a path, for the ``Allow`` header of a refusal: a path may be shared by several routes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from starlette.routing import BaseRoute, Match

METHODS = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS")


def allowed(routes: Iterable[BaseRoute], scope: Mapping[str, Any], known: str = "") -> str:
    """The methods that some route takes on the path of ``scope``, and those ``known`` already, as a header has them."""
    named = {method.strip() for method in known.split(",")}
    routes = list(routes)
    taken = [
        method
        for method in METHODS
        if method in named or any(route.matches({**scope, "method": method})[0] is Match.FULL for route in routes)
    ]
    return ", ".join(taken)
