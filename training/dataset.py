"""Labeled pictures made ready for a step of training: cut, mirrored, disturbed, with what there is to be found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
import torch
from numpy.typing import NDArray
from scipy import ndimage
from torch import Tensor
from torch.utils.data import Dataset

from training.classes import STUFF, UNKNOWN
from training.export import MEAN, STD
from training.network import HEIGHT, STRIDES, WIDTH
from training.shards import Examples

MOST = 40
"""Things of a picture that are asked for, the largest first; wall and floor come before them."""
_TILES = 4
"""Of a mosaic, two rows of two."""
_TILE_THINGS = 60
"""So many things of each tile are kept: with wall and floor, four times as many are numbered in a byte."""
_NOTHING = 255


@dataclass(frozen=True, kw_only=True)
class LessonSettings:
    """What of a picture is asked for, and how pictures are changed before they are shown; chosen."""

    smallest_px: int = 20
    """What fewer pixels show of a thing is not asked for."""
    hint_px: int = 6
    """Nor is it held against the network to find it, from so many on."""
    large_px: float = 44.0
    """Square root of the area from which on a thing belongs to the coarse heat map."""
    noise_share: float = 0.5
    """Of pictures that get noise."""
    cut_share: float = 0.5
    """Of pictures of which a part is shown."""
    tile_shares: tuple[float, float] = (0.45, 0.95)
    """Of the picture's sides that a tile of a mosaic shows."""
    clear_px: int = 300
    """Things that so many pixels show are chosen to have a tile around them."""


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


@dataclass(frozen=True, kw_only=True)
class _Shown:
    """A picture at the network's size or less. ``ids`` (H, W): number of the thing seen, 255 for none, stuff first."""

    rgb: NDArray[np.uint8]
    ids: NDArray[np.uint8]
    classes: NDArray[np.int16]
    distances_m: NDArray[np.float32]
    relations: NDArray[np.int16]


class Lessons(Dataset[Row]):
    """One example after the other, changed at random if ``vary``.

    Attributes:
        mosaics: share of examples that are put together from parts of four pictures, each around a thing of a kind that
            is the likelier the rarer it is: there is more to learn from each (Bochkovskiy et al. 2020, YOLOv4).
    """

    def __init__(
        self,
        examples: Examples,
        *,
        vary: bool,
        mosaics: float = 0.0,
        settings: LessonSettings = LessonSettings(),
    ) -> None:
        self._examples, self._vary, self.mosaics, self._settings = examples, vary, mosaics, settings
        counts = examples.counts()
        self._rarity = 1.0 / np.sqrt(np.maximum(counts, 1.0))

    def __len__(self) -> int:
        return len(self._examples)

    def __getitem__(self, index: int) -> Row:
        rng = np.random.default_rng(torch.initial_seed() % 2**63 + index * 7919)
        if not self._vary:
            shown = _sized((HEIGHT, WIDTH), 1.0, *self._examples[index])
            return self._row(shown, shown.rgb.astype(np.float32))
        shown = self._mosaic(index, rng) if rng.random() < self.mosaics else self._single(index, rng)
        curve = 255.0 * np.linspace(0.0, 1.0, 256) ** np.exp(rng.normal(0.0, 0.15))
        return self._row(shown, _disturbed(curve.astype(np.uint8)[shown.rgb].astype(np.float32), rng, self._settings))

    def _row(self, shown: _Shown, image: NDArray[np.float32]) -> Row:
        ids = np.ascontiguousarray(shown.ids)
        targets = _targets(ids, shown.classes, shown.distances_m, shown.relations, self._settings)
        normalized = (image - np.array(MEAN, np.float32)) / np.array(STD, np.float32)
        return {"image": np.ascontiguousarray(normalized.transpose(2, 0, 1), dtype=np.float32), **targets}

    def _single(self, index: int, rng: np.random.Generator) -> _Shown:
        rgb, ids, classes, distances_m, relations = self._examples[index]
        rgb, ids, zoom = _cut(rgb, ids, rng, self._settings.cut_share)
        return _mirrored(_sized((HEIGHT, WIDTH), zoom, rgb, ids, classes, distances_m, relations), rng)

    def _mosaic(self, index: int, rng: np.random.Generator) -> _Shown:
        others = rng.integers(0, len(self), _TILES - 1)
        tiles = [_numbered(self._tile(int(k), rng), first) for first, k in enumerate((index, *others))]
        rgb, ids = (
            np.vstack([np.hstack([getattr(tile, name) for tile in tiles[row : row + 2]]) for row in (0, 2)])
            for name in ("rgb", "ids")
        )
        count = len(STUFF)
        return _Shown(
            rgb=rgb,
            ids=ids,
            classes=np.concatenate((tiles[0].classes[:count], *(_padded(tile.classes[count:], 0) for tile in tiles))),
            distances_m=np.concatenate(
                (tiles[0].distances_m[:count], *(_padded(tile.distances_m[count:], 0) for tile in tiles))
            ),
            relations=np.concatenate([tile.relations for tile in tiles]),
        )

    def _tile(self, index: int, rng: np.random.Generator) -> _Shown:
        """A quarter of the network's picture, around one of the things."""
        rgb, ids, classes, distances_m, relations = self._examples[index]
        pixels = np.bincount(ids.ravel(), minlength=256)[: len(classes)]
        clear = np.nonzero(pixels[len(STUFF) :] >= self._settings.clear_px)[0] + len(STUFF)
        height, width = ids.shape
        share = float(rng.uniform(*self._settings.tile_shares))
        h, w = int(height * share), int(width * share)
        middle = np.array((rng.uniform(0, height), rng.uniform(0, width)))
        if len(clear):
            chances = self._rarity[classes[clear]]
            ys, xs = np.nonzero(ids == rng.choice(clear, p=chances / chances.sum()))
            middle = np.array((ys.mean(), xs.mean())) + rng.uniform(-0.25, 0.25, 2) * (h, w)
        top, left = np.clip(middle - (h / 2, w / 2), 0, (height - h, width - w)).astype(int)
        part = slice(top, top + h), slice(left, left + w)
        size = HEIGHT // 2, WIDTH // 2
        zoom = (size[0] / h) / (HEIGHT / height)
        return _mirrored(_sized(size, zoom, rgb[part], ids[part], classes, distances_m, relations), rng)


def batch_of(rows: Sequence[Row]) -> Batch:
    """Rows stacked."""
    stacked = {name: torch.from_numpy(np.stack([row[name] for row in rows])) for name in rows[0]}
    heats = (stacked.pop("heat_0"), stacked.pop("heat_1"))
    weights = (stacked.pop("weight_0"), stacked.pop("weight_1"))
    return Batch(heats=heats, heat_weights=weights, **stacked)


def _sized(
    size: tuple[int, int],
    zoom: float,
    rgb: NDArray[np.uint8],
    ids: NDArray[np.uint8],
    classes: NDArray[np.int16],
    distances_m: NDArray[np.float32],
    relations: NDArray[np.int16],
) -> _Shown:
    """Resized to (height, width); ``zoom``: how much larger everything looks than in the whole picture."""
    return _Shown(
        rgb=cv2.resize(rgb, size[::-1], interpolation=cv2.INTER_LINEAR).astype(np.uint8, copy=False),
        ids=cv2.resize(ids, size[::-1], interpolation=cv2.INTER_NEAREST).astype(np.uint8, copy=False),
        classes=classes,
        distances_m=distances_m / zoom,
        relations=relations,
    )


def _mirrored(shown: _Shown, rng: np.random.Generator) -> _Shown:
    """The other way around, half of the time."""
    return replace(shown, rgb=shown.rgb[:, ::-1], ids=shown.ids[:, ::-1]) if rng.random() < 0.5 else shown


def _numbered(shown: _Shown, tile: int) -> _Shown:
    """Only the largest things, with numbers of their own; stuff keeps its numbers."""
    pixels = np.bincount(shown.ids.ravel(), minlength=256)[: len(shown.classes)]
    things = np.argsort(-pixels[len(STUFF) :], kind="stable")[:_TILE_THINGS] + len(STUFF)
    number = np.full(256, _NOTHING, np.int64)
    number[: len(STUFF)] = np.arange(len(STUFF))
    number[things] = len(STUFF) + tile * _TILE_THINGS + np.arange(len(things))
    kept = [*range(len(STUFF)), *things]
    relations = shown.relations.reshape(-1, 3).astype(np.int64)
    relations = np.stack((number[relations[:, 0]], relations[:, 1], number[relations[:, 2]]), axis=1)
    return _Shown(
        rgb=shown.rgb,
        ids=number[shown.ids].astype(np.uint8),
        classes=shown.classes[kept],
        distances_m=shown.distances_m[kept],
        relations=relations[(relations[:, [0, 2]] != _NOTHING).all(axis=1)].astype(np.int16),
    )


def _padded(values: NDArray[np.generic], value: int) -> NDArray[np.generic]:
    """With room for as many things as a tile may show."""
    return np.pad(values, (0, _TILE_THINGS - len(values)), constant_values=value)


def _cut(
    rgb: NDArray[np.uint8], ids: NDArray[np.uint8], rng: np.random.Generator, cut_share: float
) -> tuple[NDArray[np.uint8], NDArray[np.uint8], float]:
    """A part of the picture half of the time, and how much nearer everything seems by it."""
    if rng.random() > cut_share:
        return rgb, ids, 1.0
    height, width = ids.shape
    share = float(rng.uniform(0.62, 1.0))
    stretch = float(np.exp(rng.normal(0.0, 0.04)))
    h, w = int(height * share), min(int(width * share * stretch), width)
    top, left = int(rng.integers(0, height - h + 1)), int(rng.integers(0, width - w + 1))
    return rgb[top : top + h, left : left + w], ids[top : top + h, left : left + w], 1.0 / share


def _disturbed(image: NDArray[np.float32], rng: np.random.Generator, settings: LessonSettings) -> NDArray[np.float32]:
    """Another exposure and color of light, noise, and now and then blur."""
    if rng.random() < 0.7:
        gain = np.exp(rng.normal(0.0, 0.2)) * np.exp(rng.normal(0.0, 0.05, 3))
        contrast, offset = np.float32(np.exp(rng.normal(0.0, 0.12))), np.float32(rng.normal(0.0, 8.0))
        mean = image.mean()
        image = ((image - mean) * contrast + mean) * gain.astype(np.float32) + offset
    if rng.random() < 0.12:
        image = np.asarray(cv2.GaussianBlur(image, (0, 0), float(rng.uniform(0.3, 0.9))), np.float32)
    if rng.random() < settings.noise_share:
        image = image + rng.standard_normal(image.shape, dtype=np.float32) * np.float32(rng.uniform(0.5, 8.0))
    return np.clip(image, 0.0, 255.0).astype(np.float32)


def _targets(
    ids: NDArray[np.uint8],
    classes: NDArray[np.int16],
    distances_m: NDArray[np.float32],
    relations: NDArray[np.int16],
    settings: LessonSettings,
) -> Row:
    pixels = np.bincount(ids.ravel(), minlength=256)[: len(classes)]
    things = [
        k for k in np.argsort(-pixels[len(STUFF) :], kind="stable") + len(STUFF) if pixels[k] >= settings.smallest_px
    ]
    things = things[:MOST]
    kept = [*range(len(STUFF)), *things]
    count = len(STUFF) + MOST
    row_of = np.full(256, 255, dtype=np.uint8)
    row_of[kept] = np.arange(len(kept))
    rows = row_of[ids]
    boxes, there = np.zeros((count, 4), np.float32), np.zeros(count, np.bool_)
    there[: len(STUFF)] = pixels[: len(STUFF)] >= settings.smallest_px
    windows = ndimage.find_objects(rows.astype(np.int32) + 1, max_label=len(kept))
    for row, (ys, xs) in enumerate(windows[len(STUFF) :], start=len(STUFF)):
        boxes[row] = (xs.start + xs.stop) / 2, (ys.start + ys.stop) / 2, xs.stop - xs.start, ys.stop - ys.start
        there[row] = True
    level = np.zeros(count, np.int64)
    level[: len(kept)] = (np.sqrt(pixels[kept]) >= settings.large_px).astype(np.int64)
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
    hints = [k for k in np.nonzero(pixels[len(STUFF) :] >= settings.hint_px)[0] + len(STUFF) if row_of[k] == 255]
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
