"""What a room is for, from what stands in it (design, section 7): naive Bayes over the things that tell.

Each kind of thing counts once a room, weighted by its existence. A person's word stands above everything.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from perception.vocabulary import plain_label
from scene_graph.edits import PutNode
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode, ObjectNode, ObjectState, Point2, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

ROOM_LABELS = ("kitchen", "bedroom", "office", "living room", "dining room", "bathroom", "hall")

# Chance to find at least one such thing in a room of each kind, in the order of ROOM_LABELS.
_CHANCES: Mapping[str, tuple[float, ...]] = {
    "fridge": (0.9, 0.02, 0.04, 0.03, 0.06, 0.01, 0.01),
    "stove": (0.85, 0.01, 0.01, 0.01, 0.02, 0.01, 0.01),
    "oven": (0.8, 0.01, 0.01, 0.01, 0.02, 0.01, 0.01),
    "microwave": (0.65, 0.02, 0.06, 0.02, 0.05, 0.01, 0.01),
    "dishwasher": (0.5, 0.01, 0.01, 0.01, 0.02, 0.01, 0.01),
    "counter": (0.8, 0.02, 0.06, 0.04, 0.1, 0.2, 0.03),
    "toaster": (0.4, 0.01, 0.02, 0.01, 0.05, 0.01, 0.01),
    "sink": (0.8, 0.03, 0.02, 0.02, 0.02, 0.8, 0.01),
    "bed": (0.01, 0.95, 0.03, 0.02, 0.01, 0.01, 0.01),
    "nightstand": (0.01, 0.65, 0.02, 0.04, 0.01, 0.01, 0.02),
    "wardrobe": (0.02, 0.65, 0.06, 0.05, 0.02, 0.03, 0.3),
    "desk": (0.02, 0.2, 0.92, 0.08, 0.03, 0.01, 0.02),
    "laptop": (0.05, 0.15, 0.7, 0.15, 0.06, 0.01, 0.01),
    "keyboard": (0.01, 0.06, 0.6, 0.03, 0.01, 0.01, 0.01),
    "monitor": (0.02, 0.12, 0.7, 0.15, 0.02, 0.01, 0.01),
    "printer": (0.01, 0.04, 0.4, 0.03, 0.01, 0.01, 0.01),
    "sofa": (0.03, 0.06, 0.08, 0.92, 0.05, 0.01, 0.04),
    "tv": (0.08, 0.2, 0.06, 0.75, 0.06, 0.01, 0.01),
    "tv stand": (0.02, 0.1, 0.03, 0.6, 0.04, 0.01, 0.02),
    "bench": (0.06, 0.1, 0.03, 0.06, 0.2, 0.03, 0.35),
    "cabinet": (0.25, 0.15, 0.45, 0.35, 0.25, 0.2, 0.4),
    "plant": (0.15, 0.15, 0.3, 0.4, 0.3, 0.08, 0.4),
    "armchair": (0.02, 0.12, 0.1, 0.5, 0.05, 0.01, 0.04),
    "fireplace": (0.01, 0.02, 0.01, 0.3, 0.05, 0.01, 0.01),
    "toilet": (0.01, 0.01, 0.01, 0.01, 0.01, 0.95, 0.01),
    "bathtub": (0.01, 0.02, 0.01, 0.01, 0.01, 0.7, 0.01),
    "shower": (0.01, 0.02, 0.01, 0.01, 0.01, 0.75, 0.01),
    "toothbrush": (0.01, 0.02, 0.01, 0.01, 0.01, 0.6, 0.01),
    "towel": (0.2, 0.1, 0.01, 0.02, 0.02, 0.7, 0.01),
    "washing machine": (0.25, 0.02, 0.01, 0.01, 0.01, 0.4, 0.03),
    "table": (0.45, 0.12, 0.25, 0.45, 0.95, 0.03, 0.3),
    "dining table": (0.3, 0.01, 0.03, 0.1, 0.95, 0.01, 0.01),
    "coffee table": (0.02, 0.04, 0.06, 0.8, 0.05, 0.01, 0.03),
    "chairs": (0.3, 0.03, 0.15, 0.15, 0.92, 0.01, 0.04),
    "chair": (0.45, 0.3, 0.8, 0.4, 0.92, 0.03, 0.12),
    "shelf": (0.25, 0.35, 0.6, 0.5, 0.2, 0.15, 0.2),
    "shoe": (0.02, 0.25, 0.02, 0.05, 0.01, 0.01, 0.5),
    "umbrella": (0.01, 0.03, 0.03, 0.02, 0.01, 0.01, 0.4),
    "pan": (0.6, 0.01, 0.01, 0.01, 0.08, 0.01, 0.01),
}
# What makes a room of a kind: with none of it, the room is of that kind only where the robot overlooked it.
_MAKINGS: Mapping[str, frozenset[str]] = {
    "kitchen": frozenset({"fridge", "stove", "oven", "counter", "dishwasher", "microwave"}),
    "bedroom": frozenset({"bed"}),
    "office": frozenset({"desk", "printer", "monitor", "keyboard"}),
    "living room": frozenset({"sofa", "armchair", "tv", "tv stand", "coffee table", "fireplace"}),
    "dining room": frozenset({"table", "dining table", "chairs"}),
    "bathroom": frozenset({"toilet", "bathtub", "shower"}),
}
_SAME = {
    "refrigerator": "fridge", "cooker": "stove", "couch": "sofa", "television": "tv", "screen": "monitor",
    "computer": "laptop", "kitchen counter": "counter", "countertop": "counter", "worktop": "counter",
    "kitchen island": "counter", "washbasin": "sink", "bedside table": "nightstand", "closet": "wardrobe",
    "bath": "bathtub", "washer": "washing machine", "bookshelf": "shelf", "bookcase": "shelf", "shoes": "shoe",
    "mouse": "keyboard", "office chair": "chair", "frying pan": "pan", "pot": "pan",
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class LabelSettings:
    """When a label is said, and what a room tells beside what stands in it."""

    period_s: float = 1.0
    """Between looks at all rooms. Chosen."""
    tell_from: float = 0.55
    """Probability from which a label is said. Chosen: clearly more than a half."""
    switch_odds: float = 3.0
    """How many times likelier another one must be to take its place: people have used the name by then. Chosen."""
    floor: float = 0.01
    """Least chance that a thing stands in a room of any kind: people put things anywhere. Chosen."""
    overlooked: float = 0.25
    """Chance that a room of some kind shows nothing of what makes it one. Chosen."""
    worth_writing: float = 0.02
    """Least change of a label's probability that is written. Chosen."""
    prior: tuple[float, ...] = (0.16, 0.18, 0.13, 0.17, 0.10, 0.14, 0.12)
    """How common rooms of each kind are, in the order of ``ROOM_LABELS``. Chosen."""
    hall_by_doors: tuple[float, ...] = (0.1, 1.0, 6.0, 9.0, 25.0, 100.0)
    """How much likelier a hall is than any other room to have 1, 2, 3, 4, 5 and more doors: other rooms are where ways
    end. Chosen."""
    long: float = 3.0
    """Length over width from which on a room is long."""
    hall_if_long: float = 8.0
    """How much likelier a hall is than any other room to be. Chosen."""
    narrow: float = 2.2
    """Length over width from which on a room is narrow,"""
    narrow_m: float = 1.6
    """or its width: what two people need to pass each other."""
    hall_if_narrow: float = 4.0
    """How much likelier a hall is than any other room to be. Chosen."""
    hall_if_wide: float = 0.7
    """And to be neither. Chosen."""
    hall_if_bare: float = 1.5
    """And to show nothing that tells. Chosen."""


def room_label(
    contents: Iterable[tuple[str, float]],
    *,
    polygon_m: tuple[Point2, ...] = (),
    doors: int = 0,
    settings: LabelSettings = LabelSettings(),
) -> tuple[str, float]:
    """The most likely use of a room and its probability; ``("", p)`` where it is not clear.

    Args:
        contents: (label, probability that it is there) of the things in the room.
        polygon_m: inner faces of the walls; a long and narrow room is a hall more often than not.
        doors: number of doors; many of them too, whatever stands in it.
        settings: when a label is said.
    """
    chances = label_chances(contents, polygon_m=polygon_m, doors=doors, settings=settings)
    best = max(chances, key=lambda label: chances[label])
    return (best if chances[best] >= settings.tell_from else ""), chances[best]


def label_chances(
    contents: Iterable[tuple[str, float]], *, polygon_m: tuple[Point2, ...], doors: int, settings: LabelSettings
) -> dict[str, float]:
    """Probability of every use that a room may have; arguments as in :func:`room_label`."""
    log_odds = np.log(np.array(settings.prior))
    evidence = _evidence(contents)
    for label, weight in sorted(evidence.items()):
        chances = np.maximum(np.array(_CHANCES[label]), settings.floor)
        log_odds = log_odds + weight * np.log(chances / chances.mean())
    if evidence:
        log_odds = log_odds + _missing_evidence(evidence, settings.overlooked)
    log_odds = log_odds + _shape_evidence(polygon_m, doors, settings, bare=not evidence)
    weights = np.exp(log_odds - log_odds.max())
    probabilities = weights / weights.sum()
    return dict(zip(ROOM_LABELS, map(float, probabilities), strict=True))


def _evidence(contents: Iterable[tuple[str, float]]) -> dict[str, float]:
    """Weight of each telling kind of thing: the largest probability among its members; two chairs or more are
    ``chairs``.
    """
    weights: dict[str, float] = {}
    chairs: list[float] = []
    for name, probability in contents:
        plain = plain_label(name)
        label = _SAME.get(plain, plain)
        if label == "chair":
            chairs.append(probability)
        if label in _CHANCES:
            weights[label] = max(weights.get(label, 0.0), probability)
    if len(chairs) >= 2:
        weights.pop("chair", None)
        weights["chairs"] = sorted(chairs)[-2]
    return weights


def _missing_evidence(evidence: Mapping[str, float], overlooked: float) -> NDArray[np.float64]:
    """Log likelihood of not having found what makes a room of each kind: a bedroom is seldom without a bed."""
    missing = np.zeros(len(ROOM_LABELS))
    for label, makings in _MAKINGS.items():
        found = max((evidence[thing] for thing in makings if thing in evidence), default=0.0)
        missing[ROOM_LABELS.index(label)] = (1.0 - found) * np.log(overlooked)
    return missing


def _shape_evidence(
    polygon_m: tuple[Point2, ...], doors: int, settings: LabelSettings, *, bare: bool
) -> NDArray[np.float64]:
    """Log likelihood ratio of shape and doors: only a hall is told by them."""
    evidence = np.zeros(len(ROOM_LABELS))
    hall = ROOM_LABELS.index("hall")
    if len(polygon_m) >= 3:
        length_m, width_m = _strip(np.asarray(polygon_m))
        ratio = length_m / max(width_m, 0.1)
        narrow = ratio > settings.narrow or width_m < settings.narrow_m
        likelier = settings.hall_if_narrow if narrow else settings.hall_if_wide
        evidence[hall] += np.log(settings.hall_if_long if ratio > settings.long else likelier)
    if doors > 0:
        evidence[hall] += np.log(settings.hall_by_doors[min(doors, len(settings.hall_by_doors)) - 1])
    if bare:
        evidence[hall] += np.log(settings.hall_if_bare)
    return evidence


def _strip(polygon_m: NDArray[np.float64]) -> tuple[float, float]:
    """Length and width of the rectangle with the area and perimeter of (N, 2) a polygon: a bent corridor unrolled.

    A polygon that is rounder than a square is a square.
    """
    x_m, y_m = polygon_m.T
    area_m2 = abs(float(x_m @ np.roll(y_m, -1) - y_m @ np.roll(x_m, -1))) / 2.0
    quarter_m = float(np.linalg.norm(np.roll(polygon_m, -1, axis=0) - polygon_m, axis=1).sum()) / 4.0
    half_m = np.sqrt(max(quarter_m**2 - area_m2, 0.0))
    return quarter_m + half_m, quarter_m - half_m


class RoomLabels:
    """Agent "room_labels": keeps the label of every room that stands in step with its contents, unless a person has
    said it. The shape of one that was seen in part tells nothing.
    """

    name = "room_labels"

    def __init__(self, memory: WorkingMemory, settings: LabelSettings = LabelSettings()) -> None:
        self._memory = memory
        self._settings = settings
        self.period_s = self._settings.period_s

    async def step(self, stamp_s: float) -> None:
        """Label the rooms whose contents say something new."""
        snapshot = self._memory.snapshot()
        contents = _contents(snapshot)
        edits = []
        for room in snapshot.of_type(RoomNode):
            if room.label_taught or room.status is RoomStatus.TEMPORARY:
                continue
            chances = label_chances(
                contents.get(room.id, []),
                polygon_m=room.polygon_m if room.status is RoomStatus.PERMANENT else (),
                doors=sum(room.id == door.rooms[0] and not door.provisional for door in snapshot.of_type(DoorNode)),
                settings=self._settings,
            )
            label = self._label(room.label, chances)
            probability = round(chances[label], 3) if label else 0.0
            if label != room.label or abs(probability - room.label_probability) > self._settings.worth_writing:
                edits.append(PutNode(replace(room, label=label, label_probability=probability)))
        self._memory.commit(edits, agent=self.name, stamp_s=stamp_s)

    def _label(self, before: str, chances: Mapping[str, float]) -> str:
        """What a room is called now: what it was called, unless another use is by far likelier."""
        best = max(chances, key=lambda label: chances[label])
        needed = self._settings.tell_from
        if before in chances:
            needed = max(needed, self._settings.switch_odds * chances[before])
        return best if chances[best] >= needed else before


def _contents(snapshot: Snapshot) -> dict[str, list[tuple[str, float]]]:
    """Things by room, each with the probability that it is there and is what it is called."""
    contents: dict[str, list[tuple[str, float]]] = {}
    for node in snapshot.of_type(ObjectNode):
        room = snapshot.room_of(node.id)
        if room is not None and node.state is ObjectState.PRESENT:
            contents.setdefault(room, []).append((node.label, node.existence * node.confidence))
    return contents
