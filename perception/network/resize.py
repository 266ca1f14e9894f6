"""How a frame is laid into the network's input, and how masks find back (metadata ``psg.resize``)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

import cv2
import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field

Size = tuple[int, int]
"""Height and width in pixels."""
Pixels = Annotated[int, Field(ge=1, le=8192)]


class FixedSize(BaseModel):
    """Every frame is stretched to one size."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    rule: Literal["fixed"]
    height: Pixels
    width: Pixels

    def size_for(self, frame: Size) -> Size:  # noqa: ARG002 - the other rule needs it
        """Size of the resized frame."""
        return self.height, self.width


class ShorterSide(BaseModel):
    """The aspect is kept: the shorter side becomes ``size``, unless the longer one would exceed ``longest``.

    PSGTR is tested with 800 and 1333 (OpenPSG, configs/psgtr/psgtr_r50_psg.py).
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    rule: Literal["shorter_side"]
    size: Pixels
    longest: Pixels

    def size_for(self, frame: Size) -> Size:
        """Size of the resized frame."""
        scale = min(self.size / min(frame), self.longest / max(frame))
        return max(1, int(frame[0] * scale + 0.5)), max(1, int(frame[1] * scale + 0.5))


ResizeRule = Annotated[FixedSize | ShorterSide, Field(discriminator="rule")]


@dataclass(frozen=True, kw_only=True)
class Placement:
    """Where a frame lies in the input image: in its upper left corner.

    ``frame``: the frame's own size. ``resized``: its size within the input. ``canvas``: the input's size; what the
    frame does not cover is padding.
    """

    frame: Size
    resized: Size
    canvas: Size

    @property
    def padded(self) -> bool:
        """Whether the frame leaves something of the input uncovered."""
        return self.resized != self.canvas

    def mask_of_frame(self, logits: NDArray[np.float32], threshold: float) -> NDArray[np.bool_]:
        """(H, W) pixels of the frame whose logit, interpolated from (h, w) ``logits`` of the canvas, passes.

        A mask too thin for the interpolation to hit is taken from the nearest logits instead of being lost.
        """
        height, width = (round(f * c / r) for f, c, r in zip(self.frame, self.canvas, self.resized, strict=True))
        rows, columns = self.frame
        fine = cv2.resize(logits, (width, height), interpolation=cv2.INTER_LINEAR)[:rows, :columns]
        mask = np.asarray(fine > threshold, dtype=np.bool_)
        if not mask.any():
            nearest = cv2.resize(logits, (width, height), interpolation=cv2.INTER_NEAREST)[:rows, :columns]
            mask = np.asarray(nearest > threshold, dtype=np.bool_)
        return mask


def place(frame: Size, rule: FixedSize | ShorterSide, fixed_canvas: tuple[int | None, int | None]) -> Placement:
    """Lay a frame out by ``rule``; where the input's own size is fixed, the frame shrinks into it and is padded."""
    resized = rule.size_for(frame)
    canvas = (fixed_canvas[0] or resized[0], fixed_canvas[1] or resized[1])
    shrink = min(1.0, canvas[0] / resized[0], canvas[1] / resized[1])
    if shrink < 1.0:
        resized = (max(1, int(resized[0] * shrink)), max(1, int(resized[1] * shrink)))
        canvas = (fixed_canvas[0] or resized[0], fixed_canvas[1] or resized[1])
    return Placement(frame=frame, resized=resized, canvas=canvas)


def input_tensor(
    rgb: NDArray[np.uint8], placement: Placement, mean: NDArray[np.float32], std: NDArray[np.float32]
) -> NDArray[np.float32]:
    """(1, 3, H, W) float32: ``rgb`` (H, W, 3) resized bilinearly, then (x - mean) / std per channel; padding is 0."""
    (height, width), (rows, columns) = placement.resized, placement.canvas
    resized = cv2.resize(rgb, (width, height), interpolation=cv2.INTER_LINEAR).astype(np.float32)
    resized -= mean
    resized /= std
    tensor = np.zeros((1, 3, rows, columns), dtype=np.float32)
    tensor[0, :, :height, :width] = resized.transpose(2, 0, 1)
    return tensor
