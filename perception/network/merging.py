"""Which masks show the same thing, as OpenPSG merges them (psgtr_head.py, ``dedup_things``)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from perception.network.recognition import UNKNOWN


def same_things(
    masks: NDArray[np.bool_],
    labels: NDArray[np.intp],
    scores: NDArray[np.float64],
    stuff: NDArray[np.bool_],
    *,
    same_iou: float,
) -> list[NDArray[np.intp]]:
    """Groups of (N, h, w) ``masks``, each as indices with its founder first; masks without a pixel are in none.

    The surest mask left founds a group; masks of its label that overlap it by more than ``same_iou`` join it, as does
    what is unknown and overlaps as much. Stuff needs no overlap: all of one label is one. Groups come surest first,
    unknown ones last, and do not depend on the order of the masks.
    """
    bits = _packed(masks)
    areas = np.bitwise_count(bits).sum(axis=1, dtype=np.int64)
    left = _order(bits, areas, labels, scores)
    left = left[areas[left] > 0]
    groups = []
    while left.size:
        founder = left[0]
        overlaps = _iou(bits, areas, founder, left) > same_iou
        joins = (labels[left] == labels[founder]) & (overlaps | stuff[founder])
        joins |= overlaps & (labels[left] == UNKNOWN)
        joins[0] = True
        groups.append(left[joins])
        left = left[~joins]
    return groups


def _packed(masks: NDArray[np.bool_]) -> NDArray[np.uint64]:
    """(N, words) the masks, 64 pixels a word."""
    packed = np.packbits(masks.reshape(len(masks), masks.shape[1] * masks.shape[2]), axis=1)
    return np.pad(packed, ((0, 0), (0, -packed.shape[1] % 8))).view(np.uint64)


def _iou(
    bits: NDArray[np.uint64], areas: NDArray[np.int64], founder: np.intp, others: NDArray[np.intp]
) -> NDArray[np.float64]:
    shared = np.bitwise_count(bits[others] & bits[founder]).sum(axis=1, dtype=np.int64)
    return np.asarray(shared / (areas[others] + areas[founder] - shared))


def _order(
    bits: NDArray[np.uint64], areas: NDArray[np.int64], labels: NDArray[np.intp], scores: NDArray[np.float64]
) -> NDArray[np.intp]:
    """Indices, known before unknown, surest first; ties are settled by what is seen, never by the query's number."""
    pixels = (bits % np.uint64(2**31 - 1)) @ np.arange(1, bits.shape[1] + 1, dtype=np.uint64)
    return np.asarray(np.lexsort((pixels, areas, labels, -scores, labels == UNKNOWN)))
