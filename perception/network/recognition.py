"""What each query says it sees: a class, or, where the network is unsure, something unknown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.network.metadata import Thresholds
from scene_graph.nodes import UNKNOWN_LABEL

UNKNOWN = -1
"""Class index of what the network does not know."""


@dataclass(frozen=True, kw_only=True)
class DistributionSettings:
    """Which classes a label distribution lists."""

    classes: int = 5
    """At most so many, likeliest first. Chosen."""
    weakest: float = 1e-3
    """Least probability of one that is listed. Chosen."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Recognition:
    """One row per query.

    ``something``: (N,) bool, whether it sees anything. ``label``: (N,) class index or ``UNKNOWN``. ``score``: (N,)
    probability of that class, of an unknown thing that there is something. ``classes``: (N, C) probabilities of the
    classes given that there is something.
    """

    something: NDArray[np.bool_]
    label: NDArray[np.intp]
    score: NDArray[np.float64]
    classes: NDArray[np.float64]

    def rows(self, chosen: NDArray[np.intp]) -> Recognition:
        """The chosen rows, in their order."""
        return Recognition(
            something=self.something[chosen],
            label=self.label[chosen],
            score=self.score[chosen],
            classes=self.classes[chosen],
        )

    def distribution(
        self, row: int, names: Sequence[str], settings: DistributionSettings = DistributionSettings()
    ) -> tuple[tuple[str, float], ...]:
        """(label, probability), likeliest first.

        Of an unknown thing, what the best class leaves is the probability of "unknown", and all classes share the rest.
        """
        given = self.classes[row]
        likeliest = np.argsort(-given, kind="stable")[: settings.classes]
        best = [int(i) for i in likeliest if given[i] >= settings.weakest]
        if self.label[row] != UNKNOWN:
            return tuple((names[i], float(given[i])) for i in best)
        top = float(given.max())
        return (UNKNOWN_LABEL, 1.0 - top), *((names[i], top * float(given[i])) for i in best[: settings.classes - 1])


def joined(parts: Sequence[Recognition]) -> Recognition:
    """All rows of ``parts``, one after the other."""
    return Recognition(
        something=np.concatenate([part.something for part in parts]),
        label=np.concatenate([part.label for part in parts]),
        score=np.concatenate([part.score for part in parts]),
        classes=np.concatenate([part.classes for part in parts]),
    )


def softmax(logits: NDArray[np.floating]) -> NDArray[np.float64]:
    """Softmax over the last axis."""
    exponentials = np.exp(logits.astype(np.float64) - logits.max(axis=-1, keepdims=True))
    return np.asarray(exponentials / exponentials.sum(axis=-1, keepdims=True))


def recognize(logits: NDArray[np.floating], is_thing: NDArray[np.bool_], thresholds: Thresholds) -> Recognition:
    """Read (N, C + 1) class logits, background last; ``is_thing``: (C,).

    Open set: the maximum softmax probability (Hendrycks and Gimpel 2017), taken over the classes without background,
    and optionally entropy and energy, decide what is unknown. What is certainly stuff gets its best stuff class:
    being wall or ceiling does not make it a thing.
    """
    probability = softmax(logits)
    something = 1.0 - probability[:, -1]
    classes = softmax(logits[:, :-1])
    label = classes.argmax(axis=1)
    unknown = classes.max(axis=1, initial=0.0) < thresholds.known
    if thresholds.entropy is not None:
        unknown |= _entropy(classes) > thresholds.entropy
    if thresholds.energy is not None:
        unknown |= -_log_sum_exp(logits[:, :-1]) > thresholds.energy
    is_stuff = classes[:, ~is_thing].sum(axis=1) >= thresholds.stuff
    label = np.where(is_stuff, np.where(is_thing, -1.0, classes).argmax(axis=1), label)
    unknown &= ~is_stuff
    named = probability[np.arange(len(label)), label]
    return Recognition(
        something=something >= thresholds.something,
        label=np.where(unknown, UNKNOWN, label),
        score=np.where(unknown, something, named),
        classes=classes,
    )


def _entropy(classes: NDArray[np.float64]) -> NDArray[np.float64]:
    """(N,) entropy as a share of the largest possible one."""
    terms = -classes * np.log(np.maximum(classes, 1e-30))
    return np.asarray(terms.sum(axis=1) / max(np.log(classes.shape[1]), 1e-12))


def _log_sum_exp(logits: NDArray[np.floating]) -> NDArray[np.float64]:
    top = logits.max(axis=1).astype(np.float64)
    return np.asarray(top + np.log(np.exp(logits - top[:, None]).sum(axis=1)))
