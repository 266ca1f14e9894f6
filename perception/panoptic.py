"""What a panoptic scene graph model answers for one frame (design, section 6): one instance list, one relation list."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from perception.ports import RgbdFrame


@dataclass(frozen=True, kw_only=True, eq=False)
class Instance:
    """One thing in the image. ``mask``: (H, W) bool. ``label_distribution``: (label, probability), likeliest first."""

    label: str
    score: float
    mask: NDArray[np.bool_]
    label_distribution: tuple[tuple[str, float], ...]


@dataclass(frozen=True, kw_only=True)
class Triplet:
    """Relation ``instances[subject] predicate instances[object]`` with its probability."""

    subject: int
    predicate: str
    object: int
    probability: float


@dataclass(frozen=True, kw_only=True, eq=False)
class PanopticScene:
    """Everything a model found in one frame."""

    stamp_s: float
    instances: tuple[Instance, ...]
    relations: tuple[Triplet, ...]


class PanopticModel(Protocol):
    """A panoptic scene graph model behind one call; heavy work happens off the event loop."""

    async def infer(self, frame: RgbdFrame) -> PanopticScene:
        """Instances and relations of ``frame``."""
        ...
