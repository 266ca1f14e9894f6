"""Color images as PNG files and back, without loss; depth images of image files."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from perception.errors import NoPicture

_PNG_BEGINS = b"\x89PNG"
_QUICKLY = (cv2.IMWRITE_PNG_COMPRESSION, 1)


def png_of(rgb: NDArray[np.uint8]) -> bytes:
    """(H, W, 3) as a PNG file."""
    _, encoded = cv2.imencode(".png", cv2.cvtColor(rgb, cv2.COLOR_RGB2BGR), _QUICKLY)
    return bytes(encoded)


def picture_of(encoded: bytes) -> NDArray[np.uint8]:
    """(H, W, 3) of an image file.

    Raises:
        NoPicture: the bytes are none that can be read.
    """
    return np.asarray(cv2.cvtColor(_decoded(encoded, cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB), dtype=np.uint8)


def depth_of(encoded: bytes) -> NDArray[np.float32]:
    """(H, W) meters, 0 where unknown, of a 16 bit PNG in millimeters.

    What ROS's ``compressedDepth`` puts before the file is left aside.

    Raises:
        NoPicture: the bytes are none that can be read, or no depth image.
    """
    decoded = _decoded(encoded[max(0, encoded.find(_PNG_BEGINS)) :], cv2.IMREAD_UNCHANGED)
    if decoded.ndim != 2 or decoded.dtype != np.uint16:
        raise NoPicture(len(encoded))
    return np.asarray(decoded, dtype=np.float32) / np.float32(1000.0)


def _decoded(encoded: bytes, how: int) -> NDArray[np.integer]:
    try:
        decoded = cv2.imdecode(np.frombuffer(encoded, dtype=np.uint8), how)
    except cv2.error as error:
        raise NoPicture(len(encoded)) from error
    if decoded is None:
        raise NoPicture(len(encoded))
    return np.asarray(decoded)
