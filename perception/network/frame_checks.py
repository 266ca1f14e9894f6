"""Whether a frame can be shown to a network at all."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from perception.objects.errors import InferenceFailed
from perception.ports import RgbdFrame


@dataclass(frozen=True, kw_only=True)
class FrameCheckSettings:
    """When an image shows nothing."""

    black: int = 4
    """Colors up to this one say nothing: a camera's noise in the dark."""
    white: int = 251
    """And from this one on."""
    blind_share: float = 0.98
    """An image with at least this share of pixels that say nothing is not understood. Chosen."""
    stride: int = 4
    """One pixel of so many in each direction is asked. Chosen: for speed."""


def check_frame(frame: RgbdFrame, settings: FrameCheckSettings = FrameCheckSettings()) -> None:
    """Refuse what no network should be asked: a guess about it would count as having looked and seen nothing.

    Raises:
        InferenceFailed: the image has a wrong type or size, or is all black or saturated.
    """
    rgb = frame.rgb
    if rgb.dtype != np.uint8 or rgb.ndim != 3 or rgb.shape[2] != 3 or 0 in rgb.shape:
        raise InferenceFailed(f"the image should be (H, W, 3) uint8 and is {rgb.shape} {rgb.dtype}", frame.stamp_s)
    size = (frame.intrinsics.height, frame.intrinsics.width)
    if rgb.shape[:2] != size or frame.depth_m.shape != size:
        raise InferenceFailed(
            f"the camera's image is {size}, but color is {rgb.shape[:2]} and depth {frame.depth_m.shape}", frame.stamp_s
        )
    sample = rgb[:: settings.stride, :: settings.stride]
    if np.mean(sample.max(axis=2) <= settings.black) >= settings.blind_share:
        raise InferenceFailed("the image is black", frame.stamp_s)
    if np.mean(sample.min(axis=2) >= settings.white) >= settings.blind_share:
        raise InferenceFailed("the image is saturated", frame.stamp_s)
