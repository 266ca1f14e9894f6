"""The shapes that a network's file must have (design, section 6), checked as declared and as they come out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from perception.network.errors import TensorMismatch, TensorMissing
from perception.network.metadata import Description
from perception.network.resize import FixedSize

INPUT = "image"
TRIPLET_OUTPUTS = (
    "sub_logits", "obj_logits", "rel_logits", "sub_boxes", "obj_boxes", "sub_masks", "obj_masks"
)  # fmt: skip
INSTANCE_OUTPUTS = ("instance_logits", "instance_masks")
_FLOATS = ("tensor(float)", "tensor(float16)", "tensor(double)")

Dimension = int | str
"""A number, or the name of a size that is free but the same wherever it is named."""


class Tensor(Protocol):
    """A declared input or output, as onnxruntime describes it; ``shape``: numbers, and names or None where free."""

    name: str
    type: str
    shape: Sequence[int | str | None]


@dataclass(frozen=True, kw_only=True)
class Signature:
    """What a checked file declares. ``canvas``: the input's height and width where they are fixed."""

    canvas: tuple[int | None, int | None]
    has_instances: bool

    @property
    def outputs(self) -> tuple[str, ...]:
        """Names of the outputs to ask for."""
        return TRIPLET_OUTPUTS + (INSTANCE_OUTPUTS if self.has_instances else ())


def expected_shapes(description: Description) -> Mapping[str, tuple[Dimension, ...]]:
    """Shape of every output of the contract."""
    label, predicate = len(description.classes) + 1, len(description.predicates) + 1
    return {
        "sub_logits": (1, "Q", label),
        "obj_logits": (1, "Q", label),
        "rel_logits": (1, "Q", predicate),
        "sub_boxes": (1, "Q", 4),
        "obj_boxes": (1, "Q", 4),
        "sub_masks": (1, "Q", "h", "w"),
        "obj_masks": (1, "Q", "h", "w"),
        "instance_logits": (1, "N", label),
        "instance_masks": (1, "N", "h", "w"),
    }


def check_names(file: str, inputs: Sequence[Tensor], outputs: Sequence[Tensor]) -> None:
    """Whether ``image`` alone goes in and everything that is needed comes out.

    Raises:
        TensorMissing: an input or output is not there.
        TensorMismatch: there are inputs that nobody will fill.
    """
    going_in, coming_out = [t.name for t in inputs], [t.name for t in outputs]
    if INPUT not in going_in:
        raise TensorMissing(file, "input", [INPUT], going_in)
    if len(going_in) > 1:
        raise TensorMismatch(file, INPUT, "the only input", f"one of {', '.join(going_in)}")
    wanted = [*TRIPLET_OUTPUTS, *(INSTANCE_OUTPUTS if set(INSTANCE_OUTPUTS) & set(coming_out) else ())]
    missing = [name for name in wanted if name not in coming_out]
    if missing:
        raise TensorMissing(file, "output", missing, coming_out)


def check_declared(file: str, image: Tensor, outputs: Sequence[Tensor], description: Description) -> Signature:
    """Compare what the file declares with the contract; free dimensions are left to the first run.

    Raises:
        TensorMismatch: a rank, size or type is wrong.
    """
    canvas = _check_input(file, image, description)
    sizes: dict[str, int] = {}
    by_name = {tensor.name: tensor for tensor in outputs}
    for name, expected in expected_shapes(description).items():
        tensor = by_name.get(name)
        if tensor is not None:
            if tensor.type not in _FLOATS:
                raise TensorMismatch(file, name, "floating point", tensor.type)
            if tensor.shape:  # without one, the first run shows it
                _check_shape(file, name, expected, tensor.shape, sizes)
    return Signature(canvas=canvas, has_instances=INSTANCE_OUTPUTS[0] in by_name)


def check_results(file: str, results: Mapping[str, NDArray[Any]], description: Description) -> None:
    """Compare the arrays of a run with the contract.

    Raises:
        TensorMismatch: a shape is wrong.
    """
    sizes: dict[str, int] = {}
    expected = expected_shapes(description)
    for name, array in results.items():
        _check_shape(file, name, expected[name], array.shape, sizes)
        if 0 in array.shape[2:]:
            raise TensorMismatch(file, name, _text(expected[name]), _text(array.shape))


def _check_input(file: str, image: Tensor, description: Description) -> tuple[int | None, int | None]:
    expected: tuple[Dimension, ...] = (1, 3, "H", "W")
    if image.type != "tensor(float)":
        raise TensorMismatch(file, INPUT, f"float32 {_text(expected)}", image.type)
    _check_shape(file, INPUT, expected, image.shape, {})
    height, width = (size if isinstance(size, int) else None for size in image.shape[2:])
    rule = description.resize
    if isinstance(rule, FixedSize) and (height or rule.height, width or rule.width) != (rule.height, rule.width):
        asked = f"(1, 3, {rule.height}, {rule.width}) as psg.resize says"
        raise TensorMismatch(file, INPUT, asked, _text(image.shape))
    return height, width


def _check_shape(
    file: str,
    name: str,
    expected: tuple[Dimension, ...],
    found: Sequence[int | str | None],
    sizes: dict[str, int],
) -> None:
    """``sizes``: what the named dimensions have turned out to be so far; filled in here."""
    if len(found) != len(expected):
        raise TensorMismatch(file, name, f"of rank {len(expected)} {_text(expected)}", f"of rank {len(found)}")
    for wanted, size in zip(expected, found, strict=True):
        if not isinstance(size, int | np.integer):
            continue
        known = sizes.setdefault(wanted, int(size)) if isinstance(wanted, str) else wanted
        if int(size) != known:
            filled = tuple(sizes.get(d, d) if isinstance(d, str) else d for d in expected)
            raise TensorMismatch(file, name, _text(filled), _text(found))


def _text(shape: Sequence[int | str | None]) -> str:
    return f"({', '.join('?' if size is None else str(size) for size in shape)})"
