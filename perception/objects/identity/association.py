"""Which detection is which known thing (Filtering, algorithm 1, lines 3 to 7, with position and label added).

The masks of the previous frame are moved by the camera's motion and compared by intersection over union. Things that
were not in the previous frame are found again by position. The best assignment of all pairs at once is taken.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from perception.objects.seeing.detection import Detection
from perception.objects.seeing.projection import View, back_project, project
from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]
Labels = NDArray[np.int16]
STEP_PX = 2
"""Masks are compared on every second row and column."""


def label_image(masks: Sequence[NDArray[np.bool_]], shape: tuple[int, int]) -> Labels:
    """(H / 2, W / 2) with k + 1 where mask k is; later masks win."""
    image = np.zeros((-(-shape[0] // STEP_PX), -(-shape[1] // STEP_PX)), dtype=np.int16)
    for k, mask in enumerate(masks):
        image[mask[::STEP_PX, ::STEP_PX]] = k + 1
    return image


def warp_labels(labels: Labels, previous: View, current: View) -> Labels:
    """M' = ΔT M: where the pixels of ``labels`` would be seen from the current camera, by their depth.

    Both views must be in the same room frame.
    """
    T_now_before = current.T_camera_room @ previous.T_room_camera
    if T_now_before.is_close(SE3.identity(), 1e-4):
        return labels
    depth_m = previous.depth_m[::STEP_PX, ::STEP_PX]
    v, u = np.nonzero((labels > 0) & (depth_m > 0.0))
    warped = np.zeros_like(labels)
    if len(u) == 0:
        return warped
    pixels_u, pixels_v = u.astype(np.float64) * STEP_PX, v.astype(np.float64) * STEP_PX
    points = back_project(pixels_u, pixels_v, depth_m[v, u].astype(np.float64), previous.intrinsics)
    pixels, range_m = project(T_now_before.apply(points), current.intrinsics)
    cells = np.nan_to_num(np.round(pixels / STEP_PX), nan=-1.0).astype(np.int64)
    height, width = labels.shape
    seen = (cells[:, 0] >= 0) & (cells[:, 0] < width) & (cells[:, 1] >= 0) & (cells[:, 1] < height)
    order = np.argsort(-range_m[seen], kind="stable")
    warped[cells[seen][order, 1], cells[seen][order, 0]] = labels[v, u][seen][order]
    closed = cv2.morphologyEx(warped, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))
    return np.asarray(np.where(warped > 0, warped, closed), dtype=np.int16)


def iou_matrix(labels: Labels, count: int, masks: Sequence[NDArray[np.bool_]]) -> Array:
    """(count, M) intersection over union of labels 1 to ``count`` with M masks: |A ∩ B| / |A ∪ B|."""
    areas = np.bincount(labels.ravel(), minlength=count + 1)[1 : count + 1].astype(np.float64)
    matrix = np.zeros((count, len(masks)))
    for j, mask in enumerate(masks):
        small = mask[::STEP_PX, ::STEP_PX]
        shared = np.bincount(labels[small], minlength=count + 1)[1 : count + 1]
        union = areas + np.count_nonzero(small) - shared
        matrix[:, j] = shared / np.maximum(union, 1.0)
    return matrix


class MaskMemory:
    """The masks of the newest frame, and which thing each of them was."""

    def __init__(self) -> None:
        self._newest: tuple[View, Labels, list[int]] | None = None

    def overlap(self, detections: Sequence[Detection], view: View) -> dict[tuple[int, int], float]:
        """IoU of the remembered mask of each thing, moved by the camera's motion, with each new one, by number of the
        thing and index of the detection.
        """
        if self._newest is None or not detections or self._newest[0].room != view.room:
            return {}
        seen_from, labels, numbers = self._newest
        iou = iou_matrix(warp_labels(labels, seen_from, view), len(numbers), [d.mask for d in detections])
        return {(n, d.index): float(iou[i, j]) for i, n in enumerate(numbers) for j, d in enumerate(detections)}

    def remember(self, seen: Sequence[tuple[NDArray[np.bool_], int]], view: View) -> None:
        """Keep the masks of a frame, each with the number of the thing that it shows."""
        labels = label_image([mask for mask, _ in seen], view.depth_m.shape)
        self._newest = (view, labels, [number for _, number in seen])


def assign(scores: Array) -> list[tuple[int, int]]:
    """Pairs (i, j) of the assignment with the highest sum in which every score is above zero; the rest stays apart."""
    if scores.size == 0:
        return []
    rows, columns = linear_sum_assignment(np.maximum(scores, 0.0), maximize=True)
    return [(int(i), int(j)) for i, j in zip(rows, columns, strict=True) if scores[i, j] > 0.0]
