"""Whether a frame can be shown to a network at all."""

from __future__ import annotations

import numpy as np

from perception.objects.errors import InferenceFailed
from perception.ports import RgbdFrame

BLACK, WHITE = 4, 251
"""Colors up to the one and from the other on say nothing."""
BLIND_SHARE = 0.98
"""An image with at least this share of pixels that say nothing is not understood."""
_STRIDE = 4


def check_frame(frame: RgbdFrame) -> None:
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
    sample = rgb[::_STRIDE, ::_STRIDE]
    if np.mean(sample.max(axis=2) <= BLACK) >= BLIND_SHARE:
        raise InferenceFailed("the image is black", frame.stamp_s)
    if np.mean(sample.min(axis=2) >= WHITE) >= BLIND_SHARE:
        raise InferenceFailed("the image is saturated", frame.stamp_s)
