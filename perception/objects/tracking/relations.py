"""What lies on, in and beside what: checked by geometry, smoothed over frames (Filtering, section 3.1, step 4b)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from perception.objects.furniture.surface import Box
from perception.objects.tracking.track import Track
from perception.panoptic import Triplet
from perception.vocabulary import Category, carries_things
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState

Key = tuple[int, int, str]
"""Track numbers of subject and object, and the predicate."""
SUPPORTING = ("on", "in")


@dataclass(frozen=True, kw_only=True)
class RelationSettings:
    """A relation is stated from ``state_from`` on and taken back below ``drop_below``. ``gain``: weight of the newest
    frame.
    """

    gain: float = 0.35
    state_from: float = 0.5
    drop_below: float = 0.3
    model_from: float = 0.3
    contact_sigma_m: float = 0.03
    rim_m: float = 0.02
    beside_m: float = 0.15
    well_over_m: float = 0.2
    """From the rim of a support; farther in, one is as good as another."""
    at_rim: float = 0.1
    """By which share a support counts less at its rim, of two of one height whose measured boxes overlap."""


class RelationMemory:
    """Probability of each relation between two tracks.

    Attributes:
        probability: by (subject, object, predicate), smoothed.
    """

    def __init__(self, settings: RelationSettings) -> None:
        self._settings = settings
        self.probability: dict[Key, float] = {}
        self._stated: set[Key] = set()

    def remember(self, key: Key, probability: float) -> None:
        """Take over a relation that the graph already holds."""
        self.probability[key] = probability
        self._stated.add(key)

    def unite(self, united: Mapping[int, Track]) -> None:
        """What was said of a part is said of the whole; what was said of a thing that turned up elsewhere is not, but
        what was said of what turned up.
        """
        moved = {
            united[n].number for k in self.probability for n in k[:2] if n in united and not united[n].is_furniture
        }
        self.probability = {k: p for k, p in self.probability.items() if not moved & set(k[:2])}
        for key in [k for k in self.probability if k[0] in united or k[1] in united]:
            p = self.probability.pop(key)
            a, b = (united[n].number if n in united else n for n in key[:2])
            if a != b:
                self.probability[a, b, key[2]] = max(p, self.probability.get((a, b, key[2]), 0.0))

    def update(
        self,
        tracks: Sequence[Track],
        T_here_room: Mapping[str, SE3],
        fresh: frozenset[int],
        triplets: Sequence[Triplet],
        matches: Mapping[int, Track],
    ) -> None:
        """One frame. ``fresh``: numbers of the tracks whose place was seen or set just now."""
        present = [t for t in tracks if t.node_id and t.state is ObjectState.PRESENT and t.room in T_here_room]
        alive = {t.number for t in present}
        room_of = {t.number: t.room for t in tracks if t.node_id and t.state is ObjectState.PRESENT}
        self.probability = {
            (a, b, predicate): p
            for (a, b, predicate), p in self.probability.items()
            if a in room_of and b in room_of and room_of[a] == room_of[b]
        }
        boxes = {t.number: t.box.seen_from(T_here_room[t.room]) for t in present}
        said = _said(triplets, matches, self._settings.model_from)
        observed: dict[Key, float] = {}
        for track in present:
            if track.number in fresh and not track.is_furniture:
                observed.update(self._support(track, present, boxes, said))
        observed.update(self._beside(present, boxes, observed, fresh))
        for key, probability in said.items():
            if key[2] not in SUPPORTING and {key[0], key[1]} <= alive:
                observed.setdefault(key, probability)
        self._smooth(observed, fresh)

    def stated(self) -> dict[Key, float]:
        """Relations to state now, with hysteresis."""
        keep = {
            key
            for key, p in self.probability.items()
            if p >= self._settings.state_from or (key in self._stated and p >= self._settings.drop_below)
        }
        self._stated = keep
        return {key: self.probability[key] for key in sorted(keep)}

    def _support(
        self, track: Track, present: Sequence[Track], boxes: Mapping[int, Box], said: Mapping[Key, float]
    ) -> dict[Key, float]:
        """The one thing that carries ``track``, if geometry allows one; of two side by side, that whose middle is
        nearer.
        """
        sigma_m = float(np.hypot(self._settings.contact_sigma_m, np.sqrt(track.covariance[2, 2])))
        best: tuple[float, float, Key] | None = None
        for other in present:
            if other is track or not carries_things(other.label.best, other.box.size_m):
                continue
            predicate, p = support_probability(
                boxes[track.number], boxes[other.number], other.category, sigma_m=sigma_m, rim_m=self._settings.rim_m
            )
            key = (track.number, other.number, predicate)
            if p > 0.2:
                p = 1.0 - (1.0 - p) * (1.0 - 0.5 * said.get(key, 0.0))
            well_over = p * over_middle(boxes[track.number], boxes[other.number], self._settings)
            if best is None or well_over > best[0]:
                best = (well_over, p, key)
        return {best[2]: best[1]} if best is not None and best[1] > 0.1 else {}

    def _beside(
        self, present: Sequence[Track], boxes: Mapping[int, Box], observed: Mapping[Key, float], fresh: frozenset[int]
    ) -> dict[Key, float]:
        carrier = {a: b for (a, b, predicate), p in self.probability.items() if predicate in SUPPORTING and p >= 0.5}
        carrier.update({a: b for (a, b, _), p in observed.items() if p >= 0.5})
        found: dict[Key, float] = {}
        for i, first in enumerate(present):
            for second in present[i + 1 :]:
                a, b = first.number, second.number
                if a in carrier and carrier[a] == carrier.get(b) and {a, b} & fresh:
                    gap_m = _gap(boxes[a], boxes[b])
                    if gap_m < self._settings.beside_m:
                        found[a, b, "beside"] = 0.9
        return found

    def _smooth(self, observed: Mapping[Key, float], fresh: frozenset[int]) -> None:
        for key, p in observed.items():
            old = self.probability.get(key)
            self.probability[key] = p if old is None else old + self._settings.gain * (p - old)
        for key in list(self.probability):
            relevant = key[0] in fresh or (key[1] in fresh and key[2] == "beside")
            if key not in observed and relevant:
                self.probability[key] *= 1.0 - self._settings.gain
                if self.probability[key] < 0.05:
                    del self.probability[key]


def support_probability(
    thing: Box, support: Box, category: Category, *, sigma_m: float, rim_m: float
) -> tuple[str, float]:
    """("on" or "in", probability) that ``support``, of ``category``, carries ``thing``; both in one frame.

    On: the bottom is near the top and the middle above the footprint. In: the bottom is below the rim of a container.
    """
    x, y, _ = np.abs(support.local(thing.center[None])[0])
    outside_m = max(x - support.size_m[0] / 2.0, y - support.size_m[1] / 2.0, 0.0)
    footprint = float(np.exp(-0.5 * (outside_m / (rim_m + sigma_m / 2.0)) ** 2))
    if min(thing.size_m[0], thing.size_m[1]) > 1.2 * max(support.size_m[:2]):
        return "on", 0.0
    bottom = float(thing.center[2]) - thing.size_m[2] / 2.0
    base, top = (float(support.center[2]) + sign * support.size_m[2] / 2.0 for sign in (-1.0, 1.0))
    if category.container and base - 0.03 <= bottom < top - 0.015:
        return "in", 0.95 * footprint
    gap_m = bottom - top
    if category.levels and bottom > base + 0.12:
        gap_m = max(gap_m, 0.0)
    return "on", 0.98 * footprint * float(np.exp(-0.5 * (gap_m / (1.5 * sigma_m)) ** 2))


def over_middle(thing: Box, support: Box, settings: RelationSettings = RelationSettings()) -> float:
    """Factor, at most 1, that decides between supports of one height whose measured boxes overlap: it falls by a tenth
    toward the rim.
    """
    x, y, _ = np.abs(support.local(thing.center[None])[0])
    from_rim_m = min(support.size_m[0] / 2.0 - x, support.size_m[1] / 2.0 - y)
    return 1.0 - settings.at_rim * (1.0 - float(np.clip(from_rim_m / settings.well_over_m, 0.0, 1.0)))


def _said(triplets: Sequence[Triplet], matches: Mapping[int, Track], from_probability: float) -> dict[Key, float]:
    said: dict[Key, float] = {}
    for triplet in triplets:
        a, b = matches.get(triplet.subject), matches.get(triplet.object)
        if a is not None and b is not None and a is not b and a.node_id and b.node_id:
            key = (a.number, b.number, triplet.predicate)
            said[key] = max(triplet.probability, said.get(key, 0.0))
    return {key: p for key, p in said.items() if p >= from_probability}


def _gap(a: Box, b: Box) -> float:
    """Horizontal distance between two things taken as round, in meters."""
    radii = (min(a.size_m[:2]) + min(b.size_m[:2])) / 2.0
    return float(np.hypot(*(a.center - b.center)[:2])) - radii
