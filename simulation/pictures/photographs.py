"""Pictures with everything that is true in them: masks, kinds, distances, relations. For scoring and training only."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from simulation.pictures.relations import Relation, Seen, Solid, true_relations

WALL, FLOOR = 0, 1
"""Indices of all walls and of the floor in every picture: stuff has no instances."""
NOTHING = 255
MOST_INSTANCES = 254
RELATED_PX = 30
"""What fewer pixels show of a thing says nothing about its relations."""
_EVERYWHERE = Seen(box_px=(-9.0, -9.0, -9.0, -9.0), distance_m=-99.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Photograph:
    """``rgb`` (H, W, 3) uint8. ``ids`` (H, W) uint8: an index into the lists below, or ``NOTHING``.

    ``categories``: what each is; ``distances_m``: (N,) along the optical axis, 0 for what is not seen; ``relations``:
    between what at least ``RELATED_PX`` pixels show.
    """

    rgb: NDArray[np.uint8]
    ids: NDArray[np.uint8]
    categories: tuple[str, ...]
    distances_m: NDArray[np.float32]
    relations: tuple[Relation, ...]

    def pixels(self) -> NDArray[np.int64]:
        """(N,) how many pixels show each."""
        return np.bincount(self.ids.ravel(), minlength=256)[: len(self.categories)]


def photograph(
    rgb: NDArray[np.uint8],
    ids: NDArray[np.uint8],
    depth_m: NDArray[np.float64] | NDArray[np.float32],
    categories: Sequence[str],
    solids: Sequence[Solid],
) -> Photograph:
    """The picture ``rgb`` of ``solids`` of these ``categories``, ``depth_m`` (H, W) from the camera."""
    seen = _seen(ids, depth_m, len(solids))
    return Photograph(
        rgb=np.ascontiguousarray(rgb),
        ids=ids,
        categories=tuple(categories),
        distances_m=np.array([place.distance_m if place else 0.0 for place in seen], dtype=np.float32).clip(0.0),
        relations=true_relations(solids, seen),
    )


def _seen(ids: NDArray[np.uint8], depth_m: NDArray[np.float64] | NDArray[np.float32], count: int) -> list[Seen | None]:
    places: list[Seen | None] = [None] * count
    pixels = np.bincount(ids.ravel(), minlength=256)
    for index, window in enumerate(ndimage.find_objects(ids.astype(np.int32) + 1, max_label=count)):
        if window is None or pixels[index] < RELATED_PX:
            continue
        if index in (WALL, FLOOR):
            places[index] = _EVERYWHERE
            continue
        rows, columns = window
        distance = float(np.median(depth_m[window][ids[window] == index]))
        places[index] = Seen(box_px=(columns.start, rows.start, columns.stop, rows.stop), distance_m=distance)
    return places
