"""What the robot sees, for people and programs: pictures, and outlines with the nodes that they belong to."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from perception.objects.seeing.look import Look
from perception.ports import RgbdFrame
from perception.preview import Outline, frame_jpeg, outline_of, preview_jpeg
from perception.vocabulary import category_of

KEPT = 4
"""So many looks that were told of stay, so that their pictures can be fetched."""


class FrameGone(LookupError):
    """The frame of this time is no longer kept; ``available_s`` lists those that are."""

    def __init__(self, stamp_s: float, available_s: list[float]) -> None:
        super().__init__(f"there is no frame of {stamp_s} s any more; kept are those of {available_s or 'no time'}")
        self.stamp_s, self.available_s = stamp_s, available_s


@dataclass(frozen=True, kw_only=True)
class Gaze:
    """Where the camera looks, seen from above, in the base frame: x forward, counter-clockwise.

    ``range_m``: how far away things are still measured.
    """

    x_m: float
    y_m: float
    yaw_rad: float
    width_rad: float
    range_m: float

    @classmethod
    def of(cls, frame: RgbdFrame, *, range_m: float) -> Gaze:
        """The gaze with which a frame was taken."""
        x_m, y_m, _ = (float(value) for value in frame.T_base_camera.translation_m)
        forward = frame.T_base_camera.rotation()[:, 2]
        width_rad = 2.0 * math.atan2(frame.intrinsics.width / 2.0, frame.intrinsics.fx)
        return cls(x_m=x_m, y_m=y_m, yaw_rad=math.atan2(forward[1], forward[0]), width_rad=width_rad, range_m=range_m)

    def document(self) -> dict[str, float]:
        """As the interface shows it."""
        named = {"x": self.x_m, "y": self.y_m, "yaw_rad": self.yaw_rad, "width_rad": self.width_rad}
        return {name: round(value, 3) for name, value in (named | {"range_m": self.range_m}).items()}


class CameraWindow:
    """Shows the newest look, and those it told of lately.

    Args:
        newest: the newest look, ``None`` before the first.
    """

    def __init__(self, newest: Callable[[], Look | None]) -> None:
        self._newest = newest
        self._told: dict[float, Look] = {}

    async def document(self, now_s: float) -> dict[str, Any] | None:
        """The newest look without its picture, which ``jpeg`` gives by its ``stamp_s``; ``None`` before the first."""
        look = self._newest()
        if look is None:
            return None
        stamp_s = look.frame.stamp_s
        self._told[stamp_s] = look
        while len(self._told) > KEPT:
            self._told.pop(min(self._told))
        return {
            "stamp_s": stamp_s,
            "age_s": round(max(0.0, now_s - stamp_s), 3),
            "width": look.frame.intrinsics.width,
            "height": look.frame.intrinsics.height,
            "instances": await asyncio.to_thread(_instances, look),
        }

    async def jpeg(self, *, stamp_s: float | None = None, outlines: bool = True) -> bytes | None:
        """The picture of the look at ``stamp_s``, of the newest without; ``None`` before the first.

        Raises:
            FrameGone: no look of this time was told of, or so long ago that it is no longer kept.
        """
        look = newest = self._newest()
        if newest is not None and stamp_s is not None:
            look = self._told.get(stamp_s)
            if look is None:
                raise FrameGone(stamp_s, sorted(self._told))
        if look is None:
            return None
        if outlines:
            return await asyncio.to_thread(preview_jpeg, look.frame, look.scene)
        return await asyncio.to_thread(frame_jpeg, look.frame)


def _instances(look: Look) -> list[dict[str, Any]]:
    """Every instance that has an outline, the largest first, so that what is drawn later lies on top."""
    found = [(index, instance, outline_of(instance.mask)) for index, instance in enumerate(look.scene.instances)]
    seen = [(index, instance, outline) for index, instance, outline in found if outline is not None]
    return [
        {
            "node": look.nodes.get(index),
            "label": instance.label,
            "background": category_of(instance.label).background,
            "score": round(float(instance.score), 3),
            "box_px": list(outline.box_px),
            "outline_px": [[list(point) for point in part] for part in outline.parts_px],
        }
        for index, instance, outline in sorted(seen, key=lambda found: -_area(found[2]))
    ]


def _area(outline: Outline) -> int:
    left, top, right, bottom = outline.box_px
    return (right - left) * (bottom - top)
