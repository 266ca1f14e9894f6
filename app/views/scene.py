"""The scene of one running stack, and the robot in it, as documents."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from app.stacks.stack import Stack
from app.views.camera import Gaze
from app.views.scene_documents import robot_document, scene_document
from perception.objects.seeing.detection import DetectionSettings

MOST_CACHED = 16
"""Combinations of frame and layers of which the JSON is kept; a page asks for one or two."""


class SceneView:
    """What the robot knows, at the newest revision. ``now``: robot time in seconds."""

    def __init__(self, stack: Stack, now: Callable[[], float]) -> None:
        self._stack, self._now = stack, now
        self._cache: dict[tuple[str, tuple[str, ...]], tuple[int, bytes]] = {}

    def document(self, frame: str = "map", layers: tuple[str, ...] = ()) -> dict[str, Any]:
        """The scene in ``frame`` (``map`` or ``room``), limited to the node types in ``layers``, if any."""
        return scene_document(self._stack.memory.building(), frame, layers)

    def json(self, frame: str, layers: tuple[str, ...] = ()) -> bytes:
        """The document as JSON, made once per revision."""
        revision = self._stack.memory.snapshot().revision
        cached = self._cache.get((frame, layers))
        if cached is None or cached[0] != revision:
            body = json.dumps(self.document(frame, layers), separators=(",", ":")).encode()
            cached = self._cache[frame, layers] = (revision, body)
            while len(self._cache) > MOST_CACHED:
                self._cache.pop(next(iter(self._cache)))
        return cached[1]

    def history(self, node_id: str) -> dict[str, Any] | None:
        """What became of a node, ``None`` if it is unknown."""
        return self._stack.history.document(node_id, exists=node_id in self._stack.memory.building())

    def robot(self) -> dict[str, Any]:
        """Pose, room, load and path of the robot, in the map frame."""
        stack, frame = self._stack, self._stack.frame
        return robot_document(
            stack.memory.snapshot(),
            path_room=stack.path_room,
            gaze=Gaze.of(frame, range_m=DetectionSettings().range_limit_m) if frame is not None else None,
            stopped=stack.stopped,
            stamp_s=self._now(),
        )
