"""A stand-in for the panoptic scene graph network until the trained one ships.

Masks and labels come from the simulated camera's segmentation channel, made worse: labels are confused, borders jitter,
whole instances are missed. It sits behind the protocol of the network; nothing else sees the segmentation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from majordomo.perception.panoptic import Instance, PanopticScene
from majordomo.perception.ports import RgbdFrame
from majordomo.simulation.catalog import CATEGORIES
from majordomo.simulation.client import SimulatedRobot
from majordomo.simulation.messages import Segment

SMALL_PX = 30
"""Instances below this size are mostly missed, as a network misses them."""


class SegmentationStandIn:
    """``PanopticModel`` over the segmentation channel.

    Args:
        robot: the simulated robot whose frames are to be understood.
        rng: source of its errors.
        label_error: probability that the most likely label is wrong.
        mask_error: share of border pixels that are wrong.
        miss: probability that an instance is not found at all.
    """

    def __init__(
        self,
        robot: SimulatedRobot,
        rng: np.random.Generator,
        *,
        label_error: float = 0.03,
        mask_error: float = 0.05,
        miss: float = 0.03,
    ) -> None:
        self._robot, self._rng = robot, rng
        self._label_error, self._mask_error, self._miss = label_error, mask_error, miss
        self._labels = sorted(CATEGORIES)

    async def infer(self, frame: RgbdFrame) -> PanopticScene:
        """Noisy instances of ``frame``; relations are left to geometry."""
        segments = await self._robot.segmentation(frame.stamp_s)
        found = [instance for segment in segments if (instance := self._perceive(segment)) is not None]
        return PanopticScene(stamp_s=frame.stamp_s, instances=tuple(found), relations=())

    def _perceive(self, segment: Segment) -> Instance | None:
        pixels = int(segment.mask.sum())
        missed = max(self._miss, 0.8 * (1.0 - pixels / SMALL_PX))
        mask = self._worsened(segment.mask)
        if self._rng.random() < missed or not mask.any():
            return None
        distribution = self._distribution(segment.category)
        label, score = distribution[0]
        return Instance(label=label, score=score, mask=mask, label_distribution=distribution)

    def _worsened(self, mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """The mask with pixels of its border flipped, inside and outside."""
        inner = mask & ~ndimage.binary_erosion(mask)
        outer = ndimage.binary_dilation(mask) & ~mask
        flips = self._rng.random(mask.shape) < 4 * self._mask_error
        return np.asarray((mask & ~(inner & flips)) | (outer & flips), dtype=np.bool_)

    def _distribution(self, category: str) -> tuple[tuple[str, float], ...]:
        """The label, sometimes a wrong one, with what a softmax would leave for others."""
        others = [label for label in self._labels if label != category]
        first, second, third = (str(label) for label in self._rng.choice(others, size=3, replace=False))
        score = float(np.clip(self._rng.normal(0.85, 0.08), 0.4, 0.98))
        best, next_best = (first, category) if self._rng.random() < self._label_error else (category, first)
        rest = 1.0 - score
        return ((best, score), (next_best, 0.5 * rest), (second, 0.3 * rest), (third, 0.2 * rest))
