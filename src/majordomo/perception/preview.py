"""The newest frame with what the model found in it, as a picture for people."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from majordomo.perception.panoptic import Instance, PanopticModel, PanopticScene
from majordomo.perception.ports import RgbdFrame

SCALE = 2
"""The picture is this much larger than the frame, so that labels can be read."""
_GOLDEN_ANGLE_DEG = 137.508


class WatchedModel:
    """A panoptic model that remembers the last frame and what was found in it. Passes everything through.

    Attributes:
        newest: the last frame that was understood, with what was found in it.
        understood: how many frames were understood so far.
    """

    def __init__(self, model: PanopticModel) -> None:
        self._model = model
        self.newest: tuple[RgbdFrame, PanopticScene] | None = None
        self.understood = 0

    async def infer(self, frame: RgbdFrame) -> PanopticScene:
        """Instances and relations of ``frame``, as the model gives them."""
        scene = await self._model.infer(frame)
        self.newest = (frame, scene)
        self.understood += 1
        return scene


def preview_jpeg(frame: RgbdFrame, scene: PanopticScene) -> bytes:
    """``frame`` as JPEG with every instance outlined and labeled."""
    picture = cv2.cvtColor(frame.rgb, cv2.COLOR_RGB2BGR)
    resized = cv2.resize(picture, None, fx=SCALE, fy=SCALE, interpolation=cv2.INTER_LINEAR)
    canvas: NDArray[np.uint8] = np.asarray(resized, dtype=np.uint8)
    for index, instance in enumerate(scene.instances):
        _draw(canvas, instance, _color(index))
    _, encoded = cv2.imencode(".jpg", canvas, [cv2.IMWRITE_JPEG_QUALITY, 80])
    return bytes(encoded)


def _draw(picture: NDArray[np.uint8], instance: Instance, color: Sequence[int]) -> None:
    mask = cv2.resize(instance.mask.astype(np.uint8), None, fx=SCALE, fy=SCALE, interpolation=cv2.INTER_NEAREST)
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
