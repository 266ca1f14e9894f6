"""What a network's file says of itself: names of classes and predicates, preparation of images, thresholds.

Every value is text under a ``psg.`` key of the ONNX metadata; docs/network.md lists the formats.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, ValidationError

from perception.network.errors import MetadataInvalid, MetadataMissing
from perception.network.resize import FixedSize, ResizeRule, ShorterSide

REQUIRED = ("psg.classes", "psg.predicates", "psg.thing_classes", "psg.mean", "psg.std", "psg.resize", "psg.version")
THRESHOLDS = "psg.thresholds"
CONTRACT_VERSION = 1
Value = TypeVar("Value")
_VERSION = re.compile(r"v?(\d+)(\.\d+)*")


class Thresholds(BaseModel):
    """From where on an answer of the network counts; a file may bring its own (``psg.thresholds``).

    Attributes:
        something: probability that a query sees anything at all, 1 - background.
        relation: probability of a predicate.
        mask: probability of a pixel. OpenPSG uses 0.85 for PSGTR.
        same_iou: overlap from which on two masks of one label are one thing (OpenPSG: 0.5).
        triplets: how many triplets are kept, best first (OpenPSG: 100).
        known: a thing whose most likely class, given that there is something, is less probable is "unknown".
        entropy: so is one whose class probabilities have a higher entropy, as a share of log C; None: not asked.
        energy: so is one with a higher energy, -log of the summed exponentials of its class logits without background
            (Liu et al. 2020, equation 4); its scale is the network's own. None: not asked.
        stuff: what is stuff with at least this probability is never unknown, whichever stuff it is.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    something: float = Field(default=0.5, ge=0.0, le=1.0)
    relation: float = Field(default=0.3, ge=0.0, le=1.0)
    mask: float = Field(default=0.5, gt=0.0, lt=1.0)
    same_iou: float = Field(default=0.5, ge=0.0, le=1.0)
    triplets: int = Field(default=100, ge=1)
    known: float = Field(default=0.5, ge=0.0, le=1.0)
    stuff: float = Field(default=0.8, gt=0.0, le=1.0)
    entropy: float | None = Field(default=None, ge=0.0, le=1.0)
    energy: float | None = None

    @property
    def mask_logit(self) -> float:
        """``mask`` before the sigmoid."""
        return float(np.log(self.mask / (1.0 - self.mask)))


_RESIZE: TypeAdapter[FixedSize | ShorterSide] = TypeAdapter(ResizeRule)
_THRESHOLDS = TypeAdapter(Thresholds)
_TEXTS = TypeAdapter(list[str])
_NUMBERS = TypeAdapter(list[float])


@dataclass(frozen=True, kw_only=True, eq=False)
class Description:
    """A file's metadata, checked.

    ``is_thing``: (C,) whether each class is a countable thing; the others are stuff, one instance a class. ``mean``,
    ``std``: (3,) RGB in units of 0 to 255.
    """

    classes: tuple[str, ...]
    predicates: tuple[str, ...]
    is_thing: NDArray[np.bool_]
    mean: NDArray[np.float32]
    std: NDArray[np.float32]
    resize: FixedSize | ShorterSide
    version: str
    thresholds: Thresholds


def read_metadata(file: str, metadata: Mapping[str, str]) -> Description:
    """The description in ``metadata``.

    Raises:
        MetadataMissing: keys are missing.
        MetadataInvalid: a value is not in the format of docs/network.md.
    """
    missing = [key for key in REQUIRED if key not in metadata]
    if missing:
        raise MetadataMissing(file, missing, [key for key in metadata if key.startswith("psg.")])
    classes = _names(file, metadata, "psg.classes")
    mean, std = _normalization(file, metadata)
    return Description(
        classes=classes,
        predicates=_names(file, metadata, "psg.predicates"),
        is_thing=_things(file, metadata, classes),
        mean=mean,
        std=std,
        resize=_parsed(file, "psg.resize", metadata["psg.resize"], _RESIZE),
        version=_version(file, metadata["psg.version"]),
        thresholds=_parsed(file, THRESHOLDS, metadata.get(THRESHOLDS, "{}"), _THRESHOLDS),
    )


def _names(file: str, metadata: Mapping[str, str], key: str) -> tuple[str, ...]:
    names = _list(file, metadata, key, _TEXTS)
    if not names or not all(name.strip() for name in names):
        raise MetadataInvalid(file, key, "should name at least one, and none empty")
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise MetadataInvalid(file, key, f"names {', '.join(map(repr, twice))} twice")
    return tuple(names)


def _things(file: str, metadata: Mapping[str, str], classes: tuple[str, ...]) -> NDArray[np.bool_]:
    key = "psg.thing_classes"
    things = _list(file, metadata, key, _TEXTS)
    strange = [name for name in things if name not in classes]
    if strange:
        raise MetadataInvalid(file, key, f"names {', '.join(map(repr, strange))}, not among psg.classes")
    return np.isin(classes, things)


def _normalization(file: str, metadata: Mapping[str, str]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Mean and deviation; where no number of both exceeds 1, they are meant for colors of 0 to 1."""
    values = []
    for key in ("psg.mean", "psg.std"):
        numbers = np.array(_list(file, metadata, key, _NUMBERS), dtype=np.float32)
        if numbers.shape != (3,) or not np.isfinite(numbers).all():
            raise MetadataInvalid(file, key, f"should hold three numbers (R, G, B) and is {metadata[key]}")
        values.append(numbers)
    mean, std = values
    if std.min() <= 0.0:
        raise MetadataInvalid(file, "psg.std", f"should be positive and is {metadata['psg.std']}")
    scale = np.float32(255.0 if max(np.abs(mean).max(), std.max()) <= 1.0 else 1.0)
    return mean * scale, std * scale


def _version(file: str, text: str) -> str:
    match = _VERSION.fullmatch(text.strip())
    if match is None:
        raise MetadataInvalid(file, "psg.version", f"should be a version such as '{CONTRACT_VERSION}' and is '{text}'")
    if int(match[1]) > CONTRACT_VERSION:
        raise MetadataInvalid(
            file, "psg.version", f"is {text}, and this program reads the contract up to version {CONTRACT_VERSION}"
        )
    return text.strip()


def _list(file: str, metadata: Mapping[str, str], key: str, adapter: TypeAdapter[list[Value]]) -> list[Value]:
    """A JSON list; names or numbers with commas between them are taken as well."""
    text = metadata[key].strip()
    if not text.startswith("["):
        text = json.dumps([part.strip() for part in text.split(",") if part.strip()])
    return _parsed(file, key, text, adapter)


def _parsed(file: str, key: str, text: str, adapter: TypeAdapter[Value]) -> Value:
    try:
        return adapter.validate_python(json.loads(text))
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(str(part) for part in first["loc"])
        raise MetadataInvalid(file, key, f"cannot be read: {where or 'value'}: {first['msg'].lower()}") from None
    except ValueError:
        raise MetadataInvalid(file, key, f"is not JSON: {text[:60]!r}") from None
