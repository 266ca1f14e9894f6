"""Labeled pictures made ready for a step of training: cut, mirrored, disturbed, with what there is to be found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import torch
from numpy.typing import NDArray
from scipy import ndimage
from torch import Tensor
from torch.utils.data import Dataset

from training.export import MEAN, STD
from training.names import STUFF, UNKNOWN
from training.network import HEIGHT, STRIDES, WIDTH
from training.shards import Examples

MOST = 40
"""Things of a picture that are asked for, the largest first; wall and floor come before them."""
SMALLEST_PX = 20
_HINT_PX = 6
LARGE_PX = 44.0
"""Square root of the area from which on a thing belongs to the coarse heat map."""
_NOISE = 0.5
_CUT = 0.5


@dataclass(kw_only=True)
class Batch:
    """What pictures show. Rows are things; the first of them are stuff.

    ``image`` (B, 3, H, W). ``ids`` (B, H, W): row of what is seen, 255 for nothing. For each row ``classes`` (B, M) or
    ``UNKNOWN``, ``there`` (B, M), ``boxes`` (B, M, 4) center and size in pixels, ``level`` (B, M), ``log_distance``
    (B, M). ``relations`` (B, M, M): 0 for none. ``heats``: targets of both heat maps, and ``heat_weights``.
    """

    image: Tensor
    ids: Tensor
    classes: Tensor
    there: Tensor
    boxes: Tensor
    level: Tensor
    log_distance: Tensor
    relations: Tensor
    heats: tuple[Tensor, Tensor]
    heat_weights: tuple[Tensor, Tensor]


Row = dict[str, NDArray[np.generic]]


class Lessons(Dataset[Row]):
    """One example after the other, changed at random if ``vary``."""

    def __init__(self, examples: Examples, *, vary: bool) -> None:
        self._examples, self._vary = examples, vary

    def __len__(self) -> int:
        return len(self._examples)

    def __getitem__(self, index: int) -> Row:
        rng = np.random.default_rng(torch.initial_seed() % 2**63 + index * 7919)
        rgb, ids, classes, distances_m, relations = self._examples[index]
        zoom, flipped = 1.0, False
        if self._vary:
            rgb, ids, zoom = _cut(rgb, ids, rng)
            flipped = bool(rng.random() < 0.5)
        rgb = cv2.resize(rgb, (WIDTH, HEIGHT), interpolation=cv2.INTER_LINEAR).astype(np.uint8, copy=False)
        ids = cv2.resize(ids, (WIDTH, HEIGHT), interpolation=cv2.INTER_NEAREST).astype(np.uint8, copy=False)
        if flipped:
            rgb, ids = rgb[:, ::-1], ids[:, ::-1]
        if self._vary:
            curve = 255.0 * np.linspace(0.0, 1.0, 256) ** np.exp(rng.normal(0.0, 0.15))
            rgb = curve.astype(np.uint8)[rgb]
        image = rgb.astype(np.float32)
        if self._vary:
            image = _disturbed(image, rng)
        targets = _targets(np.ascontiguousarray(ids), classes, distances_m / zoom, relations)
        normalized = (image - np.array(MEAN, np.float32)) / np.array(STD, np.float32)
        return {"image": np.ascontiguousarray(normalized.transpose(2, 0, 1), dtype=np.float32), **targets}


def batch_of(rows: Sequence[Row]) -> Batch:
    """Rows stacked."""
    stacked = {name: torch.from_numpy(np.stack([row[name] for row in rows])) for name in rows[0]}
    heats = (stacked.pop("heat_0"), stacked.pop("heat_1"))
    weights = (stacked.pop("weight_0"), stacked.pop("weight_1"))
    return Batch(heats=heats, heat_weights=weights, **stacked)


def _cut(
    rgb: NDArray[np.uint8], ids: NDArray[np.uint8], rng: np.random.Generator
) -> tuple[NDArray[np.uint8], NDArray[np.uint8], float]:
    """A part of the picture half of the time, and how much nearer everything seems by it."""
    if rng.random() > _CUT:
        return rgb, ids, 1.0
    height, width = ids.shape
    share = float(rng.uniform(0.62, 1.0))
    stretch = float(np.exp(rng.normal(0.0, 0.04)))
    h, w = int(height * share), min(int(width * share * stretch), width)
    top, left = int(rng.integers(0, height - h + 1)), int(rng.integers(0, width - w + 1))
    return rgb[top : top + h, left : left + w], ids[top : top + h, left : left + w], 1.0 / share


def _disturbed(image: NDArray[np.float32], rng: np.random.Generator) -> NDArray[np.float32]:
    """Another exposure and color of light, noise, and now and then blur."""
    if rng.random() < 0.7:
        gain = np.exp(rng.normal(0.0, 0.2)) * np.exp(rng.normal(0.0, 0.05, 3))
        contrast, offset = np.float32(np.exp(rng.normal(0.0, 0.12))), np.float32(rng.normal(0.0, 8.0))
        mean = image.mean()
        image = ((image - mean) * contrast + mean) * gain.astype(np.float32) + offset
    if rng.random() < 0.12:
        image = np.asarray(cv2.GaussianBlur(image, (0, 0), float(rng.uniform(0.3, 0.9))), np.float32)
    if rng.random() < _NOISE:
        image = image + rng.standard_normal(image.shape, dtype=np.float32) * np.float32(rng.uniform(0.5, 8.0))
    return np.clip(image, 0.0, 255.0).astype(np.float32)


def _targets(
    ids: NDArray[np.uint8], classes: NDArray[np.int16], distances_m: NDArray[np.float32], relations: NDArray[np.int16]
) -> Row:
    pixels = np.bincount(ids.ravel(), minlength=256)[: len(classes)]
    things = [k for k in np.argsort(-pixels[len(STUFF) :], kind="stable") + len(STUFF) if pixels[k] >= SMALLEST_PX]
    things = things[:MOST]
    kept = [*range(len(STUFF)), *things]
    count = len(STUFF) + MOST
    row_of = np.full(256, 255, dtype=np.uint8)
    row_of[kept] = np.arange(len(kept))
    rows = row_of[ids]
    boxes, there = np.zeros((count, 4), np.float32), np.zeros(count, np.bool_)
    there[: len(STUFF)] = pixels[: len(STUFF)] >= SMALLEST_PX
    windows = ndimage.find_objects(rows.astype(np.int32) + 1, max_label=len(kept))
    for row, (ys, xs) in enumerate(windows[len(STUFF) :], start=len(STUFF)):
        boxes[row] = (xs.start + xs.stop) / 2, (ys.start + ys.stop) / 2, xs.stop - xs.start, ys.stop - ys.start
        there[row] = True
    level = np.zeros(count, np.int64)
    level[: len(kept)] = (np.sqrt(pixels[kept]) >= LARGE_PX).astype(np.int64)
    log_distance = np.full(count, np.nan, np.float32)
    far = distances_m[kept]
    log_distance[: len(kept)] = np.where(far > 0.05, np.log(np.maximum(far, 0.05)), np.nan)
    kinds = np.full(count, UNKNOWN, np.int64)
    kinds[: len(kept)] = classes[kept]
    related = np.zeros((count, count), np.int64)
    for subject, predicate, other in relations:
        a, b = int(row_of[subject]), int(row_of[other])
        if a != 255 and b != 255:
            related[a, b] = predicate + 1
            if predicate == 2:  # beside holds both ways
                related[b, a] = predicate + 1
    hints = [k for k in np.nonzero(pixels[len(STUFF) :] >= _HINT_PX)[0] + len(STUFF) if row_of[k] == 255]
    unclear = np.isin(ids, hints) if hints else np.zeros(ids.shape, np.bool_)
    heats = [_heat(boxes[len(STUFF) :], level[len(STUFF) :], there[len(STUFF) :], k, unclear) for k in (0, 1)]
    return {
        "ids": rows, "classes": kinds, "there": there, "boxes": boxes, "level": level, "log_distance": log_distance,
        "relations": related, "heat_0": heats[0][0], "weight_0": heats[0][1], "heat_1": heats[1][0],
        "weight_1": heats[1][1],
    }  # fmt: skip


def _heat(
    boxes: NDArray[np.float32],
    level: NDArray[np.int64],
    there: NDArray[np.bool_],
    which: int,
    unclear: NDArray[np.bool_],
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """One at the cell of each center, falling off with the size of the thing; and what counts."""
    stride = STRIDES[which]
    height, width = HEIGHT // stride, WIDTH // stride
    heat = np.zeros((height, width), np.float32)
    ys, xs = np.arange(height, dtype=np.float32), np.arange(width, dtype=np.float32)
    for x, y, w, h in boxes[there & (level == which)]:
        column, row = min(int(x // stride), width - 1), min(int(y // stride), height - 1)
        sigma_x, sigma_y = max(0.12 * w / stride, 0.4), max(0.12 * h / stride, 0.4)
        across = np.exp(-0.5 * ((xs - column) / sigma_x) ** 2)
        down = np.exp(-0.5 * ((ys - row) / sigma_y) ** 2)
        np.maximum(heat, down[:, None] * across[None, :], out=heat)
    weight = np.ones((height, width), np.float32)
    if which == 0 and unclear.any():
        blocks = unclear.reshape(height, stride, width, stride).any(axis=(1, 3)).astype(np.uint8)
        weight[np.asarray(cv2.dilate(np.asarray(blocks), np.ones((3, 3), np.uint8))) > 0] = 0.0
        weight[heat > 0.5] = 1.0
    return heat, weight
