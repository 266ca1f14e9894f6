"""Persons: where they stand. Their names are told, not seen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.detection import Detection
from perception.objects.seeing.membership import Surroundings
from perception.objects.seeing.projection import View
from perception.objects.tracking.existence import ExistenceSettings, Visibility, absence_evidence, visibility
from perception.objects.tracking.taken_names import TakenNames
from scene_graph.identifiers import next_id
from scene_graph.nodes import PersonNode, Point3
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PeopleSettings:
    """``gate_m``: how far a person walks between two frames. ``gone_below``: probability under which an unnamed one
    is forgotten.

    The foot of a desk may look like a person's leg. That there is somebody, or somewhere else than before, is taken
    only from what reaches up to ``upright_m`` and is a person with probability ``likely``, or with ``sure`` whatever
    of it is seen.
    """

    gate_m: float = 0.8
    smoothing: float = 0.4
    confirm_hits: int = 3
    gone_below: float = 0.15
    upright_m: float = 0.8
    likely: float = 0.6
    sure: float = 0.9
    body_m: Point3 = (0.4, 0.4, 1.7)
    """A grown-up, standing: breadth, depth, height."""

    def convinces(self, detection: Detection) -> bool:
        """Whether a detection is enough to believe in a person where nobody was."""
        probability = dict(detection.distribution).get(detection.label, 0.0)
        top_m = float(detection.cloud.points[:, 2].max())
        return probability >= (self.likely if top_m >= self.upright_m else self.sure)


class PersonTrack:
    """Belief about one person; ``position`` (2,) in the frame of ``room``."""

    def __init__(self, node_id: str | None, room: str, position: Array) -> None:
        self.node_id = node_id
        self.room = room
        self.position = position
        self.hits = 0
        self.log_odds = 1.0
        self.last_seen_s = 0.0
        self.named = False
        self.gone = False

    @property
    def confidence(self) -> float:
        """Probability that the person still stands there."""
        return float(1.0 / (1.0 + np.exp(-self.log_odds)))


class People:
    """All persons; one update per frame.

    Attributes:
        matches: instance index -> track, of the newest frame.
    """

    def __init__(self, settings: PeopleSettings, existence: ExistenceSettings) -> None:
        self._settings = settings
        self._existence = existence
        self.tracks: list[PersonTrack] = []
        self.taken = TakenNames()
        self.matches: dict[int, PersonTrack] = {}

    def sync(self, snapshot: Snapshot) -> None:
        """Adopt persons that the graph knows, drop those it no longer does."""
        nodes = {node.id: node for node in snapshot.of_type(PersonNode)}
        self.taken.update(nodes)
        self.taken.elsewhere = snapshot.elsewhere
        self.tracks = [t for t in self.tracks if t.node_id is None or t.node_id in nodes]
        known = {t.node_id for t in self.tracks}
        for node in nodes.values():
            room, parent = snapshot.room_of(node.id), snapshot.parent(node.id)
            if node.id not in known and room is not None and parent is not None and parent.source == room:
                track = PersonTrack(node.id, room, parent.T_source_target.translation_m[:2].copy())
                track.hits, track.last_seen_s = self._settings.confirm_hits, node.last_seen_s
                self.tracks.append(track)
        for track in self.tracks:
            track.named = track.node_id is not None and bool(nodes[track.node_id].name)

    def update(self, detections: Sequence[Detection], view: View, surroundings: Surroundings) -> None:
        """Match detections to persons, the largest first, then doubt those who should have been seen. Where a person
        was just seen, a further mask shows another part of the same.
        """
        in_range = sorted((d for d in detections if d.in_range), key=lambda d: -d.cloud.pixels)
        unseen = [t for t in self.tracks if t.room in surroundings.T_here_room]
        taken, broad_m = list[Array](), self._settings.body_m[0]
        self.matches = {}
        for detection in in_range:
            spot, convinces = _feet(detection, view, broad_m / 2.0), self._settings.convinces(detection)
            if any(float(np.linalg.norm(spot - other)) < broad_m for other in taken):
                continue
            taken.append(spot)
            track = self._same_person(spot, unseen, surroundings, view.stamp_s, anywhere=convinces)
            if track is not None:
                unseen.remove(track)
            elif convinces:
                track = self._new(spot, surroundings)
            if track is not None:
                self._observe(track, spot, surroundings, view.stamp_s)
                self.matches[detection.index] = track
        for track in unseen:
            self._doubt(track, view, surroundings)
        self.tracks = [t for t in self.tracks if t.node_id is not None or view.stamp_s - t.last_seen_s < 1.0]

    def spots(self, surroundings: Surroundings) -> Array:
        """Where they stand, (P, 2), in the room frame of the view; those in rooms that it does not reach left out."""
        here = [_here(track, surroundings) for track in self.tracks if track.room in surroundings.T_here_room]
        return np.array(here).reshape(-1, 2)

    def _same_person(
        self,
        spot: Array,
        unseen: list[PersonTrack],
        surroundings: Surroundings,
        stamp_s: float,
        *,
        anywhere: bool,
    ) -> PersonTrack | None:
        """The nearest person who can have walked to ``spot`` since last seen, at one meter a second; one who has not
        gone away, unless ``anywhere``.
        """
        reach = [(float(np.linalg.norm(_here(t, surroundings) - spot)), t) for t in unseen]
        reach = [
            (d, t)
            for d, t in reach
            if d <= self._settings.gate_m
            or (anywhere and (d <= self._settings.gate_m + min(stamp_s - t.last_seen_s, 60.0) or t.confidence < 0.3))
        ]
        return min(reach, key=lambda pair: pair[0])[1] if reach else None

    def _new(self, spot: Array, surroundings: Surroundings) -> PersonTrack | None:
        room = surroundings.room_of(np.array((*spot, 0.9)))
        if room is None:
            return None
        here = surroundings.T_here_room[room].inverse().apply((*spot, 0.0))[:2]
        self.tracks.append(PersonTrack(None, room, here))
        return self.tracks[-1]

    def _observe(self, track: PersonTrack, spot: Array, surroundings: Surroundings, stamp_s: float) -> None:
        room = surroundings.room_of(np.array((*spot, 0.9))) or track.room
        local = surroundings.T_here_room[room].inverse().apply((*spot, 0.0))[:2]
        moved = track.room != room or float(np.linalg.norm(local - track.position)) > 0.4
        gain = 1.0 if moved or track.hits == 0 else self._settings.smoothing
        base = local if moved else track.position
        track.position = base + gain * (local - base)
        track.room, track.last_seen_s = room, stamp_s
        track.hits += 1
        track.log_odds = min(track.log_odds + self._existence.hit, self._existence.bound)
        track.gone = False
        if track.node_id is None and track.hits >= self._settings.confirm_hits:
            track.node_id = next_id(self.taken, "person")
            self.taken.add(track.node_id)

    def _doubt(self, track: PersonTrack, view: View, surroundings: Surroundings) -> None:
        seen = self._place(track, view, surroundings)
        change = absence_evidence(seen, replaced=False, settings=self._existence)
        track.log_odds = max(track.log_odds + change, -self._existence.bound)
        track.gone = track.confidence < self._settings.gone_below and not track.named

    def _place(self, track: PersonTrack, view: View, surroundings: Surroundings) -> Visibility:
        center = np.array((*_here(track, surroundings), self._settings.body_m[2] / 2.0))
        upper = Box(center + np.array((0.0, 0.0, 0.2)), (*self._settings.body_m[:2], 0.9), 0.0)
        return visibility(upper, view, self._existence)


def _here(track: PersonTrack, surroundings: Surroundings) -> Array:
    return surroundings.T_here_room[track.room].apply((*track.position, 0.0))[:2]


def _feet(detection: Detection, view: View, radius_m: float) -> Array:
    """(2,) axis of the body on the floor plane: behind the front that the camera sees."""
    camera = view.T_room_camera.translation_m
    middle = np.median(detection.cloud.points[:, :2], axis=0)
    direction = middle - camera[:2]
    spot: Array = middle + direction / max(float(np.linalg.norm(direction)), 1e-6) * 0.6 * radius_m
    return spot
