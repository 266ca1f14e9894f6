"""Pictures on disk: one compressed file of numpy arrays for some hundreds of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from simulation.pictures.photographs import Photograph
from simulation.pictures.relations import PREDICATES
from training.classes import CLASSES, UNKNOWN


def save_shard(file: Path, photographs: Sequence[Photograph]) -> None:
    """Write ``photographs`` at once: the file is there in full or not at all."""
    columns: dict[str, list[NDArray[np.generic]]] = {
        "rgb": [_png(photo.rgb) for photo in photographs],
        "ids": [_png(photo.ids) for photo in photographs],
        "classes": [_classes(photo) for photo in photographs],
        "distances_m": [photo.distances_m for photo in photographs],
        "relations": [_rows(photo).ravel() for photo in photographs],
    }
    arrays = {name: np.concatenate(column) for name, column in columns.items()}
    arrays |= {f"{name}_end": np.cumsum([len(row) for row in column]) for name, column in columns.items()}
    part = file.with_suffix(".part")
    with part.open("wb") as stream:
        np.savez(stream, allow_pickle=False, **arrays)
    part.replace(file)


class Examples:
    """Labeled pictures of some shards, kept compressed in memory and unpacked one by one."""

    def __init__(self, files: Iterable[Path]) -> None:
        self._rows: list[tuple[Any, ...]] = []
        for file in files:
            with np.load(file) as shard:
                parts = {
                    name: np.split(shard[name], shard[f"{name}_end"][:-1])
                    for name in ("rgb", "ids", "classes", "distances_m", "relations")
                }
            self._rows.extend(zip(*parts.values(), strict=True))

    def __len__(self) -> int:
        return len(self._rows)

    def counts(self) -> NDArray[np.float64]:
        """(C + 1,) how often each class is in a scene; what has no name comes last, where ``UNKNOWN`` points."""
        kinds = np.concatenate([row[2] for row in self._rows]) if self._rows else np.zeros(0, np.int16)
        return np.bincount(np.where(kinds == UNKNOWN, len(CLASSES), kinds), minlength=len(CLASSES) + 1).astype(float)

    def __getitem__(
        self, index: int
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8], NDArray[np.int16], NDArray[np.float32], NDArray[np.int16]]:
        """``rgb`` (H, W, 3), ``ids`` (H, W), ``classes`` (N,), ``distances_m`` (N,), ``relations`` (R, 3).

        Classes index ``CLASSES`` or are ``UNKNOWN``; relations are subject, predicate, object.
        """
        rgb, ids, classes, distances_m, relations = self._rows[index]
        return (
            _picture(rgb, cv2.IMREAD_COLOR)[:, :, ::-1],
            _picture(ids, cv2.IMREAD_GRAYSCALE),
            classes,
            distances_m,
            relations.reshape(-1, 3),
        )


def _png(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    ordered = picture[:, :, ::-1] if picture.ndim == 3 else picture
    _, packed = cv2.imencode(".png", ordered, [cv2.IMWRITE_PNG_COMPRESSION, 3])
    return np.asarray(packed, dtype=np.uint8).ravel()


def _picture(packed: NDArray[np.uint8], how: int) -> NDArray[np.uint8]:
    picture = cv2.imdecode(packed, how)
    if picture is None:
        raise ValueError("a picture of a shard cannot be read")
    return np.asarray(picture, dtype=np.uint8)


def _classes(photo: Photograph) -> NDArray[np.int16]:
    known = [CLASSES.index(name) if name in CLASSES else UNKNOWN for name in photo.categories]
    return np.array(known, dtype=np.int16)


def _rows(photo: Photograph) -> NDArray[np.int16]:
    rows = [(subject, PREDICATES.index(predicate), other) for subject, predicate, other in photo.relations]
    return np.array(rows, dtype=np.int16).reshape(-1, 3)
