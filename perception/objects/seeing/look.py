"""A look through the camera: a frame, what the network found in it, and which node each of these things is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from perception.panoptic import PanopticScene
from perception.ports import RgbdFrame


@dataclass(frozen=True, kw_only=True, eq=False)
class Look:
    """``nodes``: place in ``scene.instances`` -> identifier, of what is a node of the graph."""

    frame: RgbdFrame
    scene: PanopticScene
    nodes: Mapping[int, str]
