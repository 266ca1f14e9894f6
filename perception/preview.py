"""A frame with what the model found in it, as a picture for people and as outlines for programs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from perception.panoptic import Instance, PanopticModel, PanopticScene
from perception.ports import RgbdFrame

_GOLDEN_ANGLE_DEG = 137.508


@dataclass(frozen=True, kw_only=True)
class PreviewSettings:
    """How pictures are made."""

    scale: int = 2
    """The picture is this much larger than the frame, so that labels can be read."""
    jpeg_quality: int = 80
    """Of 100. Chosen."""
    speck_px: float = 12.0
    """Parts of a mask with a smaller outline are left out. Chosen: three pixels square."""
    tolerance_px: float = 1.0
    """How far an outline may be from its mask: a pixel."""


class WatchedModel:
    """A panoptic model that counts the frames it understood. Passes everything through.

    Attributes:
        understood: how many frames were understood so far.
    """

    def __init__(self, model: PanopticModel) -> None:
        self._model = model
        self.understood = 0

    async def infer(self, frame: RgbdFrame) -> PanopticScene:
        """Instances and relations of ``frame``, as the model gives them."""
        scene = await self._model.infer(frame)
        self.understood += 1
        return scene


@dataclass(frozen=True, kw_only=True)
class Outline:
    """The outline of a mask in pixels, x right and y down.

    ``box_px``: left, top, right, bottom, the last two exclusive. ``parts_px``: a polygon for each part, largest first.
    """

    box_px: tuple[int, int, int, int]
    parts_px: tuple[tuple[tuple[int, int], ...], ...]


def outline_of(mask: NDArray[np.bool_], settings: PreviewSettings = PreviewSettings()) -> Outline | None:
    """The outline of an (H, W) mask, to a pixel, without holes and specks; ``None`` if nothing is left."""
    found, _ = cv2.findContours(mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    least_px = settings.speck_px
    large = sorted((part for part in found if cv2.arcLength(part, closed=True) >= least_px), key=cv2.contourArea)
    if not large:
        return None
    x, y, width, height = cv2.boundingRect(np.concatenate(large))
    tolerance_px = settings.tolerance_px
    parts = (cv2.approxPolyDP(part, tolerance_px, closed=True)[:, 0, :].tolist() for part in reversed(large))
    return Outline(
        box_px=(x, y, x + width, y + height),
        parts_px=tuple(tuple((int(u), int(v)) for u, v in part) for part in parts),
    )


def frame_jpeg(frame: RgbdFrame, settings: PreviewSettings = PreviewSettings()) -> bytes:
    """``frame`` as JPEG, as it was taken."""
    return _jpeg(cv2.cvtColor(frame.rgb, cv2.COLOR_RGB2BGR), settings.jpeg_quality)


def preview_jpeg(frame: RgbdFrame, scene: PanopticScene, settings: PreviewSettings = PreviewSettings()) -> bytes:
    """``frame`` as JPEG with every instance outlined and labeled."""
    picture = cv2.cvtColor(frame.rgb, cv2.COLOR_RGB2BGR)
    scale = settings.scale
    resized = cv2.resize(picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_LINEAR)
    canvas: NDArray[np.uint8] = np.asarray(resized, dtype=np.uint8)
    for index, instance in enumerate(scene.instances):
        _draw(canvas, instance, _color(index), scale)
    return _jpeg(canvas, settings.jpeg_quality)


def _jpeg(picture: Any, quality: int) -> bytes:
    _, encoded = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, quality])
    return bytes(encoded)


def _draw(picture: NDArray[np.uint8], instance: Instance, color: Sequence[int], scale: int) -> None:
    mask = cv2.resize(instance.mask.astype(np.uint8), None, fx=scale, fy=scale, interpolation=cv2.INTER_NEAREST)
    outlines, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
    if not outlines:
        return
    cv2.drawContours(picture, outlines, -1, color, 1, cv2.LINE_AA)
    x, y, _, _ = cv2.boundingRect(max(outlines, key=cv2.contourArea))
    text = f"{instance.label} {instance.score:.2f}"
    place = (x, max(12, y - 3))
    cv2.putText(picture, text, place, cv2.FONT_HERSHEY_SIMPLEX, 0.4, (0, 0, 0), 3, cv2.LINE_AA)
    cv2.putText(picture, text, place, cv2.FONT_HERSHEY_SIMPLEX, 0.4, color, 1, cv2.LINE_AA)


def _color(index: int) -> tuple[int, int, int]:
    """Well separated hues."""
    hsv = np.array([[[int(index * _GOLDEN_ANGLE_DEG) % 180, 160, 255]]], dtype=np.uint8)
    blue, green, red = cv2.cvtColor(hsv, cv2.COLOR_HSV2BGR)[0, 0]
    return int(blue), int(green), int(red)
