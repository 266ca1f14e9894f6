"""What can go wrong between the network and the object memory."""

from __future__ import annotations

from perception.errors import PerceptionError


class InferenceFailed(PerceptionError):
    """A panoptic model gave no answer for a frame; the next frame may fare better."""

    def __init__(self, reason: str, stamp_s: float) -> None:
        super().__init__(f"no panoptic scene for the frame at {stamp_s:.2f} s: {reason}")
        self.reason = reason
        self.stamp_s = stamp_s
