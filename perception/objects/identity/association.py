"""Which detection is which known thing (Filtering, algorithm 1, lines 3 to 7, with position and label added).

The masks of the previous frame are moved by the camera's motion and compared by intersection over union. Things that
were not in the previous frame are found again by position. The cheapest assignment of all pairs at once is taken.
Where a thing has gone that slipped from the hand is a guess, and what is missed at its place is not there: neither is
found by position, but recognized once it was seen well enough. Else a corner of the table, named by nobody, is the ball
that stood there. Only what the hand has just put down is found where it must be, though it was not seen at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from perception.objects.beliefs import agreement
from perception.objects.seeing.detection import Detection
from perception.objects.seeing.projection import View, back_project, project
from perception.objects.tracking.track import Track
from perception.vocabulary import category_of
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState

Array = NDArray[np.float64]
Labels = NDArray[np.int16]
STEP_PX = 2
"""Masks are compared on every second row and column."""


@dataclass(frozen=True, kw_only=True)
class AssociationSettings:
    """Costs are negative log likelihoods up to a constant; a pair dearer than ``limit`` stays apart."""

    limit: float = 3.5
    iou_weight: float = 1.5
    label_cost: float = 2.5
    gate_sigmas: float = 3.0
    box_margin_m: float = 0.12
    overlap_min: float = 0.35
    overlap_weight: float = 3.0
    distance_weight: float = 0.4
    iou_other_kind: float = 0.3


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

    def overlap(self, numbers: Sequence[int], detections: Sequence[Detection], view: View) -> Array:
        """(T, M) IoU of the remembered mask of each thing of ``numbers``, moved by the camera's motion, with each new
        one.
        """
        iou = np.zeros((len(numbers), len(detections)))
        if self._newest is None or not detections or self._newest[0].room != view.room:
            return iou
        seen_from, labels, remembered = self._newest
        by_label = iou_matrix(warp_labels(labels, seen_from, view), len(remembered), [d.mask for d in detections])
        row_of = {number: row for row, number in enumerate(remembered)}
        for i, number in enumerate(numbers):
            if number in row_of:
                iou[i] = by_label[row_of[number]]
        return iou

    def remember(self, seen: Sequence[tuple[NDArray[np.bool_], int]], view: View) -> None:
        """Keep the masks of a frame, each with the number of the thing that it shows."""
        labels = label_image([mask for mask, _ in seen], view.depth_m.shape)
        self._newest = (view, labels, [number for _, number in seen])


def cost_matrix(
    tracks: Sequence[Track],
    detections: Sequence[Detection],
    iou: Array,
    T_view_room: dict[str, SE3],
    settings: AssociationSettings,
) -> Array:
    """(T, M) cost of taking detection j for track i; infinite where that is out of the question."""
    if not tracks or not detections:
        return np.zeros((len(tracks), len(detections)))
    frame = _Frame(detections, T_view_room)
    rows = [
        _furniture_costs(track, frame, iou[i], settings)
        if track.is_furniture
        else _thing_costs(track, frame, iou[i], settings)
        for i, track in enumerate(tracks)
    ]
    same = np.array([[agreement(t.label.distribution, d.distribution) for d in detections] for t in tracks])
    doubt = np.minimum(settings.label_cost, -np.log(np.maximum(same, 1e-6)))
    return np.asarray(np.array(rows) + doubt - settings.iou_weight * iou)


class _Frame:
    """What the costs of all tracks need of the detections, once per frame and room."""

    def __init__(self, detections: Sequence[Detection], T_view_room: dict[str, SE3]) -> None:
        self.detections = detections
        self.furniture = np.array([category_of(d.label, d.shape.size_m).furniture for d in detections])
        self.spread = np.array([float(np.trace(d.shape.covariance)) / 3.0 for d in detections])
        self.slack_m = np.array([0.0 if d.shape.complete else 0.04 for d in detections])
        self.T_room_view = {room: T.inverse() for room, T in T_view_room.items()}
        centers = np.array([d.shape.center for d in detections])
        self.centers = {room: T.apply(centers) for room, T in self.T_room_view.items()}


def _furniture_costs(track: Track, frame: _Frame, iou: Array, settings: AssociationSettings) -> Array:
    """(M,) by the share of points inside the box; small things need the mask to overlap as well."""
    costs = np.full(len(iou), np.inf)
    for j in np.nonzero(frame.furniture | (iou >= settings.iou_other_kind))[0]:
        points = frame.T_room_view[track.room].apply(frame.detections[int(j)].cloud.points[::4])
        overlap = float(track.box.contains(points, settings.box_margin_m).mean())
        if overlap >= settings.overlap_min:
            costs[j] = settings.overlap_weight * (1.0 - overlap)
    return costs


def _thing_costs(track: Track, frame: _Frame, iou: Array, settings: AssociationSettings) -> Array:
    """(M,) by the distance of centers, in standard deviations; furniture only if the mask overlaps as well."""
    if track.fell or (track.state is ObjectState.MISSING and not track.awaited):
        return np.full(len(iou), np.inf)
    spread = float(np.trace(track.covariance)) / 3.0 + frame.spread
    slack_m = 0.02 + 0.1 * min(track.box.size_m[:2]) + frame.slack_m
    distances = np.linalg.norm(frame.centers[track.room] - track.position, axis=1)
    sigmas = distances / np.sqrt(spread + slack_m**2)
    possible = (sigmas < settings.gate_sigmas) & (~frame.furniture | (iou >= settings.iou_other_kind))
    return np.where(possible, settings.distance_weight * sigmas**2, np.inf)


def assign(costs: Array, limit: float) -> list[tuple[int, int]]:
    """Pairs (i, j) of the cheapest assignment in which a pair costs at most ``limit`` and staying apart costs
    ``limit``.
    """
    if costs.size == 0:
        return []
    bounded = np.minimum(costs, limit)
    rows, columns = linear_sum_assignment(bounded)
    return [(int(i), int(j)) for i, j in zip(rows, columns, strict=True) if costs[i, j] < limit]
