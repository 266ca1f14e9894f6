"""All known things and one update per frame: associate, observe, doubt, found, confirm (Filtering, algorithm 1)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import cv2
import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from perception.objects.furniture.surface import SurfaceBelief
from perception.objects.identity.association import MaskMemory, assign
from perception.objects.identity.hypotheses import Asked, Hypothesis
from perception.objects.identity.identity import Identity, IdentitySettings
from perception.objects.identity.pair import Moment, Subject
from perception.objects.identity.probation import ProbationSettings, is_stable, may_come_true
from perception.objects.seeing.detection import Detection
from perception.objects.seeing.sight import Sight
from perception.objects.tracking.existence import (
    ExistenceSettings,
    absence_evidence,
    bounded,
    surface_absent,
    visibility,
)
from perception.objects.tracking.taken_names import TakenNames
from perception.objects.tracking.track import Track, TrackSettings
from perception.vocabulary import category_of
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import next_id
from scene_graph.nodes import ObjectState

Array = NDArray[np.float64]
_BORDER = np.ones((7, 7), np.uint8)
"""Masks are wrong by a few pixels at their borders."""


@dataclass(frozen=True, kw_only=True)
class TrackerSettings:
    """``furniture_min_px``: how large furniture must show to be begun with."""

    existence: ExistenceSettings = field(default_factory=ExistenceSettings)
    identity: IdentitySettings = field(default_factory=IdentitySettings)
    probation: ProbationSettings = field(default_factory=ProbationSettings)
    track: TrackSettings = field(default_factory=TrackSettings)
    furniture_min_px: int = 150


class Tracker:
    """Keeps every track; deterministic for a given generator.

    Attributes:
        tracks: all things, tentative ones included, in order of birth.
        taken: every identifier ever seen; none is given twice.
        matches: instance index -> track, of the newest frame.
        united: number of a track that turned out to be another, or a part of it -> that other; ``removed``: their
            nodes, and those of what turned out to be nothing (``None``), until they are gone from the graph.
    """

    def __init__(self, *, settings: TrackerSettings, random: Generator) -> None:
        self._settings = settings
        self._random = random
        self._born = 0
        self._masks = MaskMemory()
        self._identity = Identity(settings.identity)
        self.tracks: list[Track] = []
        self.taken = TakenNames()
        self.matches: dict[int, Track] = {}
        self.united: dict[int, Track] = {}
        self.removed: dict[str, Track | None] = {}

    def new_track(self, room: str) -> Track:
        """A track without any observation, kept."""
        self._born += 1
        track = Track(self._born, room, settings=self._settings.track, random=self._random)
        self.tracks.append(track)
        return track

    def of_node(self, node_id: str) -> Track | None:
        """The track behind a node."""
        return next((track for track in self.tracks if track.node_id == node_id), None)

    def drop(self, track: Track) -> None:
        """Forget a track altogether."""
        self.tracks = [other for other in self.tracks if other is not track]

    def is_somebody(self, person: Detection, room: str, T_here_room: Mapping[str, SE3]) -> bool:
        """Whether who is taken for a person, in the frame of ``room``, is not a piece of furniture that is known."""
        known = [track for track in self.tracks if track.room in T_here_room]
        decision = self._identity.decide(
            Asked.PERSON, Subject(person, room), Moment(known=known, T_here_room=T_here_room)
        )
        return decision.best.hypothesis is Hypothesis.NEW

    def update(self, sight: Sight) -> None:
        """One frame."""
        self.matches = {}
        sight, in_one = self._things_of_their_own(sight)
        scope = [t for t in self._near(sight) if t.state is not ObjectState.HELD]
        unmatched = self._associate(scope, sight)
        unmatched = [d for d in unmatched if not self._absorb(d, scope, sight)]
        self._settle(scope, sight)
        self._doubt_unseen([track for track in scope if track.number not in in_one], sight)
        self._doubt_surfaces(sight)
        for detection in unmatched:
            self._found(detection, sight)
        self._confirm(sight)
        self._reconsider(sight)
        self._find_missing_again(sight)
        self._forget_tentative(sight.view.stamp_s)
        seen = [(d.mask, self.matches[d.index].number) for d in sight.detections if d.index in self.matches]
        self._masks.remember(seen, sight.view)

    def _near(self, sight: Sight) -> list[Track]:
        """Everything in the robot's room and its neighbors: of the others, nobody knows here where they are."""
        return [t for t in self.tracks if t.room in sight.surroundings.T_here_room]

    def _moment(
        self, sight: Sight, known: Sequence[Track], iou: Mapping[tuple[int, int], float] | None = None
    ) -> Moment:
        return Moment(
            known=known,
            sight=sight,
            T_here_room=sight.surroundings.T_here_room,
            matches=self.matches,
            looked_before=sight.looked_before,
            iou=iou or {},
            scales=self._settings.identity.scales,
        )

    def _things_of_their_own(self, sight: Sight) -> tuple[Sight, set[int]]:
        """Without what is a piece of something or nothing at all; numbers of the tracks that are in one mask."""
        told, in_one, moment = list[Detection](), set[int](), self._moment(sight, self._near(sight))
        for detection in sight.detections:
            it = Subject(detection, sight.view.room)
            best = self._identity.decide(Asked.MASK, it, moment).best
            if best.hypothesis is Hypothesis.NEW:
                told.append(detection)
            elif best.hypothesis is Hypothesis.PART and best.known is None:
                in_one |= {track.number for track, _ in moment.sharers(it)}
        return (replace(sight, detections=told) if len(told) < len(sight.detections) else sight), in_one

    def _associate(self, scope: list[Track], sight: Sight) -> list[Detection]:
        """Observe what is seen again; the detections that are nothing that is known."""
        moment = self._moment(sight, scope, self._masks.overlap(sight.detections, sight.view))
        its = [Subject(detection, sight.view.room) for detection in sight.detections]
        pairs = assign(self._identity.scores(Asked.FRAME, its, moment))
        for i, j in pairs:
            self._observe(scope[i], sight.detections[j], sight)
        matched = {j for _, j in pairs}
        return [d for j, d in enumerate(sight.detections) if j not in matched]

    def _observe(self, track: Track, detection: Detection, sight: Sight) -> None:
        others = [
            other.box
            for other in self.tracks
            if other is not track and other.room == track.room and other.state is ObjectState.PRESENT
            if other.stands_by_itself and other.label.best != track.label.best
        ]
        track.observe(detection, sight.view, sight.surroundings.T_here_room[track.room].inverse(), others)
        self.matches[detection.index] = track
        track.log_odds = bounded(track.log_odds + self._settings.existence.hit, self._settings.existence)
        if track.state is ObjectState.MISSING:
            track.state = ObjectState.PRESENT
            track.log_odds = max(track.log_odds, 1.0)
        home = sight.surroundings.settled_room(track.room, track.position)
        if home != track.room:
            T_here_room = sight.surroundings.T_here_room
            track.change_room(home, T_here_room[home].inverse() @ T_here_room[track.room])

    def _absorb(self, detection: Detection, scope: list[Track], sight: Sight) -> bool:
        """Whether the detection is none of its own; a further part of a piece of furniture is taken in."""
        it = Subject(detection, sight.view.room)
        best = self._identity.decide(Asked.LEFT, it, self._moment(sight, scope)).best
        if best.known is not None and best.known.is_furniture:
            self._observe(best.known, detection, sight)
        return best.hypothesis is not Hypothesis.NEW

    def _doubt_surfaces(self, sight: Sight) -> None:
        """Of furniture that is seen, doubt what lies in plain sight outside of its masks."""
        if sight.turning_radps > self._settings.existence.speed_limit_radps:
            return
        masks = {d.index: d.mask for d in sight.detections}
        of_track: dict[int, list[NDArray[np.bool_]]] = {}
        for index, track in self.matches.items():
            of_track.setdefault(track.number, []).append(masks[index])
        for track in {track.number: track for track in self.matches.values()}.values():
            if isinstance(track.place, SurfaceBelief):
                seen = np.logical_or.reduce(of_track[track.number]).astype(np.uint8)
                around = np.asarray(cv2.dilate(seen, _BORDER)) > 0
                track.place.deny_outside(around, sight.view, sight.surroundings.T_here_room[track.room])

    def _doubt_unseen(self, scope: list[Track], sight: Sight) -> None:
        """Take existence from what should have been seen and was not."""
        if sight.turning_radps > self._settings.existence.speed_limit_radps:
            return
        seen = {track.number for track in self.matches.values()}
        for track in scope:
            if track.number in seen or track.state is not ObjectState.PRESENT:
                continue
            change = self._absence(track, sight)
            if change < 0.0:
                track.misses += 1
                track.log_odds = bounded(track.log_odds + change, self._settings.existence)
            if track.existence < self._settings.existence.missing_below:
                track.state = ObjectState.MISSING

    def _absence(self, track: Track, sight: Sight) -> float:
        T_here_room, settings = sight.surroundings.T_here_room[track.room], self._settings.existence
        moment = self._moment(sight, list({seen.number: seen for seen in self.matches.values()}.values()))
        best = self._identity.decide(Asked.UNSEEN, Subject.of(track), moment).best
        if best.hypothesis is Hypothesis.PART and best.known is None:
            return -settings.through_limit
        if best.hypothesis is Hypothesis.NOTHING:
            return 0.0
        if track.is_furniture:
            points = T_here_room.apply(track.surface_points)
            share = surface_absent(points, sight.view, settings)
            return -settings.through_limit * share if share > 0.6 else 0.0
        seen = visibility(track.box.seen_from(T_here_room), sight.view, settings)
        return absence_evidence(seen, replaced=best.known is not None, settings=settings)

    def _found(self, detection: Detection, sight: Sight) -> None:
        """Start a new, tentative thing."""
        furniture = category_of(detection.label, detection.shape.size_m).furniture
        enough = detection.cloud.pixels >= self._settings.furniture_min_px if furniture else detection.measurable
        if not (detection.in_range and enough):
            return
        seen_at = np.median(detection.cloud.points, axis=0) if furniture else detection.shape.center
        room = sight.surroundings.room_of(seen_at)  # how deep furniture is, and so its center, is a guess at first
        track = self.new_track(room or sight.view.room)
        track.homeless = room is None
        self._observe(track, detection, sight)

    def _settle(self, scope: list[Track], sight: Sight) -> None:
        """Give things seen through a door to their room as soon as it is known, and until then to the robot's; what
        turns out to be a wall of its room is forgotten.
        """
        for track in [t for t in scope if t.homeless]:
            T_here_room = sight.surroundings.T_here_room
            home = sight.surroundings.room_of(T_here_room[track.room].apply(track.position))
            room = home or sight.view.room
            if room != track.room:
                track.change_room(room, T_here_room[room].inverse() @ T_here_room[track.room])
            track.homeless = home is None
            if home is not None:
                it, moment = Subject.of(track), self._moment(sight, [])
                if self._identity.decide(Asked.HOME, it, moment).best.hypothesis is Hypothesis.NOTHING:
                    self.drop(track)

    def _confirm(self, sight: Sight) -> None:
        """Name what has been seen often enough, or recognize it; of a room that is far from here, when that is near."""
        unnamed = [t for t in self._near(sight) if t.node_id is None and not t.homeless]
        for track in [t for t in unnamed if is_stable(t, self._settings.probation)]:
            decision = self._identity.decide(Asked.TENTATIVE, Subject.of(track), self._moment(sight, self._named()))
            best = decision.best
            if decision.waits and track.hits < self._settings.identity.patience_hits:
                continue
            if best.hypothesis in {Hypothesis.NEW, Hypothesis.LOOK_ALIKE}:
                track.node_id = next_id(self.taken, track.label.best)
                self.taken.add(track.node_id)
            elif best.known is None or (best.hypothesis is Hypothesis.PART and not track.is_furniture):
                track.hits = 0  # were it a piece of that, it would be gone with it: it must be seen anew then
            else:
                self._recognize(track, best.known, part=best.hypothesis is Hypothesis.PART)

    def _named(self) -> list[Track]:
        return [track for track in self.tracks if track.node_id is not None]

    def _recognize(self, sighting: Track, known: Track, *, part: bool = False) -> None:
        """The sighting is a thing we know, or a part of it: it goes on under that name."""
        if part:
            known.absorb(sighting)
        else:
            known.become(sighting)
        self.matches = {index: known if t is sighting else t for index, t in self.matches.items()}
        self.drop(sighting)

    def _unite(self, older: Track, newer: Track) -> None:
        """Two nodes are one: the older name stays."""
        self.united[newer.number] = older
        self.removed.update({newer.node_id: older} if newer.node_id is not None else {})

    def _reconsider(self, sight: Sight) -> None:
        """Furniture that turned out to be one with another, or somebody's legs, when it was seen to be so."""
        named = [track for track in self._named() if track.is_furniture]
        seen = [track for track in named if track in self.matches.values()]
        for track in [track for track in named if track.room in sight.surroundings.T_here_room]:
            known = [t for t in (named if track in seen else seen) if t in self.tracks]
            best = self._identity.decide(Asked.NODE, Subject.of(track), self._moment(sight, known)).best
            if best.hypothesis is not Hypothesis.PART or track not in self.tracks:
                continue
            if best.known is None:
                self.removed.update({track.node_id: None} if track.node_id is not None else {})
                self.matches = {index: other for index, other in self.matches.items() if other is not track}
                self.drop(track)
            else:
                older, newer = sorted((track, best.known), key=lambda t: t.number)
                self._unite(older, newer)
                self._recognize(newer, older, part=True)

    def _find_missing_again(self, sight: Sight) -> None:
        """A thing that is missed at its place may have been seen at another already, under a name of its own; or what
        is seen there now is another that is said to be in the very same place, and both are one: the older name stays.
        """
        small = [track for track in self._named() if not track.is_furniture]
        for missing in [track for track in small if track.state is ObjectState.MISSING]:
            moment = self._moment(sight, self._named())
            others = [t for t in small if t in self.tracks and t.state is ObjectState.PRESENT]
            found = [(self._identity.decide(Asked.MISSED, Subject.of(t), moment, [missing]).best, t) for t in others]
            moved = max(found, key=lambda pair: (pair[0].score, -pair[1].number), default=None)
            if moved is not None and moved[0].known is missing:
                older, newer = sorted((missing, moved[1]), key=lambda track: (track.first_seen_s, track.number))
                self._unite(older, newer)
                if older is missing:
                    self._recognize(newer, missing)
                else:
                    self.drop(missing)

    def _forget_tentative(self, stamp_s: float) -> None:
        probation = self._settings.probation
        self.tracks = [t for t in self.tracks if t.node_id is not None or may_come_true(t, stamp_s, probation)]
