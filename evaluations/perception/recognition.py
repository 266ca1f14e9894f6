"""Compares what a network saw in pictures with what is in them: things, masks, relations."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment

from perception.panoptic import PanopticScene
from scene_graph.nodes import UNKNOWN_LABEL
from simulation.furnishing.catalog import CATEGORIES, category_named
from simulation.pictures.photographs import FLOOR, WALL, Photograph

SIZES_PX = (20, 50, 100, 200, 1000)
"""Where the bins of visible pixels begin, at the network's input."""
CLEAR_PX = SIZES_PX[3]
"""From so many on a thing is clear: about as many as a cup has that is 1.4 m away."""
TOP = 20
"""So many relations of a picture count, the surest: recall at 20, as the PSG paper has it."""
SUPPORT = ("on", "in")
EITHER_WAY = "beside"
_STUFF = (WALL, FLOOR)


@dataclass(kw_only=True)
class Tally:
    """Counts over pictures. Things are counted by label and by the bin of ``SIZES_PX`` they are in; what is smaller
    than the first is left out.

    ``there``, ``found``: things shown, and those of them found under their name. ``claimed``, ``true_claims``: clear
    instances of a label, and those that are it. ``confused``: true and given name of what was found under another.
    """

    pictures: int = 0
    there: Counter[tuple[str, int]] = field(default_factory=Counter)
    found: Counter[tuple[str, int]] = field(default_factory=Counter)
    seen: Counter[tuple[str, int]] = field(default_factory=Counter)
    claimed: Counter[str] = field(default_factory=Counter)
    true_claims: Counter[str] = field(default_factory=Counter)
    confused: Counter[tuple[str, str]] = field(default_factory=Counter)
    ious: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))
    relation_recalls: list[float] = field(default_factory=list)
    related: Counter[str] = field(default_factory=Counter)
    related_found: Counter[str] = field(default_factory=Counter)
    strangers: Counter[str] = field(default_factory=Counter)

    def add(self, photo: Photograph, scene: PanopticScene, *, scale: float) -> None:
        """Count one picture. ``scale``: pixels at the network's input per pixel of the picture."""
        self.pictures += 1
        names = [plain(name) for name in photo.categories]
        labels = [plain(instance.label) for instance in scene.instances]
        pixels = photo.pixels() * scale
        overlap = overlaps(photo, [instance.mask for instance in scene.instances])
        match = matches(overlap, names, labels)
        for index, name in enumerate(names):
            size = int(np.searchsorted(SIZES_PX, pixels[index], side="right")) - 1
            if size < 0 or index in _STUFF:
                continue
            other = match.get(index)
            if name not in CATEGORIES and name not in ("person", "door"):
                if pixels[index] >= CLEAR_PX:
                    self.strangers["missed" if other is None else _as(labels[other])] += 1
                continue
            self.there[name, size] += 1
            if other is not None:
                self.seen[name, size] += 1
                if labels[other] == name:
                    self.found[name, size] += 1
                    if pixels[index] >= CLEAR_PX:
                        self.ious[name].append(float(overlap[index, other]))
                elif pixels[index] >= CLEAR_PX:
                    self.confused[name, labels[other]] += 1
        self._count_claims(scene, names, labels, match, scale)
        self._count_relations(photo, scene, names, labels, match)

    def _count_claims(
        self,
        scene: PanopticScene,
        names: Sequence[str],
        labels: Sequence[str],
        match: Mapping[int, int],
        scale: float,
    ) -> None:
        truth = {other: index for index, other in match.items()}
        for number, (instance, label) in enumerate(zip(scene.instances, labels, strict=True)):
            if label in (UNKNOWN_LABEL, "wall", "floor") or instance.mask.sum() * scale < CLEAR_PX:
                continue
            self.claimed[label] += 1
            self.true_claims[label] += number in truth and names[truth[number]] == label

    def _count_relations(
        self,
        photo: Photograph,
        scene: PanopticScene,
        names: Sequence[str],
        labels: Sequence[str],
        match: Mapping[int, int],
    ) -> None:
        if not photo.relations:
            return
        right = {other: index for index, other in match.items() if labels[other] == names[index]}
        claims = {(right.get(t.subject, -1), t.predicate, right.get(t.object, -1)) for t in scene.relations[:TOP]}
        hits = 0
        for subject, predicate, other in photo.relations:
            hit = (subject, predicate, other) in claims
            hit |= predicate == EITHER_WAY and (other, predicate, subject) in claims
            self.related[predicate] += 1
            self.related_found[predicate] += hit
            hits += hit
        self.relation_recalls.append(hits / len(photo.relations))

    def report(self) -> dict[str, Any]:
        """All figures, ready for JSON; shares are None where nothing was counted."""
        clear = SIZES_PX.index(CLEAR_PX)
        labels = sorted({name for name, _ in self.there})
        classes = {name: self._of_class(name, clear) for name in labels}
        by_predicate = {name: share(self.related_found[name], count) for name, count in sorted(self.related.items())}
        known = [value for value in by_predicate.values() if value is not None]
        ious = [iou for each in self.ious.values() for iou in each]
        return {
            "pictures": self.pictures,
            "classes": classes,
            "recall": share(
                sum(count for (_, size), count in self.found.items() if size >= clear),
                sum(count for (_, size), count in self.there.items() if size >= clear),
            ),
            "precision": share(self.true_claims.total(), self.claimed.total()),
            "least_class": min((row["recall"] for row in classes.values() if row["recall"] is not None), default=None),
            "recall_by_pixels": {
                str(low): share(
                    sum(count for (_, size), count in self.found.items() if size == number),
                    sum(count for (_, size), count in self.there.items() if size == number),
                )
                for number, low in enumerate(SIZES_PX)
            },
            "mask_iou": float(np.mean(ious)) if ious else None,
            "relation_recall_at_20": float(np.mean(self.relation_recalls)) if self.relation_recalls else None,
            "relation_mean_recall_at_20": float(np.mean(known)) if known else None,
            "relation_recall_by_predicate": by_predicate,
            "support_recall_at_20": share(
                sum(self.related_found[name] for name in SUPPORT), sum(self.related[name] for name in SUPPORT)
            ),
            "confusions": [[*pair, count] for pair, count in self.confused.most_common(30)],
            "strangers": dict(self.strangers),
        }

    def _of_class(self, name: str, clear: int) -> dict[str, Any]:
        there, found, seen = (
            sum(count for (label, size), count in counter.items() if label == name and size >= clear)
            for counter in (self.there, self.found, self.seen)
        )
        return {
            "there": there,
            "recall": share(found, there),
            "found_under_any_name": share(seen, there),
            "precision": share(self.true_claims[name], self.claimed[name]),
            "mask_iou": float(np.mean(self.ious[name])) if self.ious.get(name) else None,
        }


def share(part: int, whole: int) -> float | None:
    """``part`` of ``whole``, nothing of nothing."""
    return part / whole if whole else None


def plain(label: str) -> str:
    """The simulator's name of what a network calls ``label``."""
    return category_named(label).name


def overlaps(photo: Photograph, masks: Sequence[NDArray[np.bool_]]) -> NDArray[np.float64]:
    """(N, M) intersection over union of what is shown and ``masks`` (H, W)."""
    count = len(photo.categories)
    pixels = photo.pixels().astype(np.float64)
    result = np.zeros((count, len(masks)))
    for number, mask in enumerate(masks):
        shared = np.bincount(photo.ids[mask], minlength=256)[:count]
        result[:, number] = shared / np.maximum(pixels + mask.sum() - shared, 1.0)
    return result


def matches(
    overlap: NDArray[np.float64], names: Sequence[str], labels: Sequence[str], *, least_iou: float = 0.5
) -> dict[int, int]:
    """Which instance shows each thing, one to one, those of the right name preferred.

    ``least_iou``: with less in common they are not the same, as COCO counts it.
    """
    named = np.array([[name == label for label in labels] for name in names], dtype=np.float64)
    worth = np.where(overlap >= least_iou, overlap + named.reshape(overlap.shape), 0.0)
    rows, columns = linear_sum_assignment(-worth)
    return {int(row): int(column) for row, column in zip(rows, columns, strict=True) if worth[row, column] > 0.0}


def _as(label: str) -> str:
    return UNKNOWN_LABEL if label == UNKNOWN_LABEL else "named"
