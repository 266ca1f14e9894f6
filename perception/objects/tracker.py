"""All known things and one update per frame: associate, observe, doubt, found, confirm (Filtering, algorithm 1)."""

from __future__ import annotations

from dataclasses import dataclass, field

import cv2
import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from perception.objects.beliefs import agreement
from perception.objects.furniture.surface import Box, SurfaceBelief
from perception.objects.identity.association import AssociationSettings, MaskMemory, assign, cost_matrix
from perception.objects.identity.confirmation import (
    is_double,
    is_fragment,
    known_as,
    may_prove_built_in,
    turned_up,
    undecided,
)
from perception.objects.identity.identity import IdentitySettings
from perception.objects.identity.pieces import (
    PieceSettings,
    has_no_name,
    is_at_hand,
    is_of_somebody,
    is_part,
    is_piece,
    is_side,
    is_under_arm,
    lies_within,
    without_pieces,
)
from perception.objects.identity.probation import ProbationSettings, is_beyond_doubt, is_stable, may_come_true
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
from scene_graph.identifiers import next_id
from scene_graph.nodes import ObjectState

Array = NDArray[np.float64]
_BORDER = np.ones((7, 7), np.uint8)
"""Masks are wrong by a few pixels at their borders."""


@dataclass(frozen=True, kw_only=True)
class TrackerSettings:
    """``patience_hits``: how many sightings to wait for a look-alike that is just being missed, or until it is clear
    whether what lies in a row of furniture is a piece of its own. ``wall_share``: of the points of a thing seen through
    a door that are in its room's walls, from which on furniture was one of them. ``furniture_min_px``: how large it
    must show to be begun with.
    """

    association: AssociationSettings = field(default_factory=AssociationSettings)
    existence: ExistenceSettings = field(default_factory=ExistenceSettings)
    identity: IdentitySettings = field(default_factory=IdentitySettings)
    pieces: PieceSettings = field(default_factory=PieceSettings)
    probation: ProbationSettings = field(default_factory=ProbationSettings)
    track: TrackSettings = field(default_factory=TrackSettings)
    patience_hits: int = 15
    wall_share: float = 0.85
    furniture_min_px: int = 150


class Tracker:
    """Keeps every track; deterministic for a given generator.

    Attributes:
        tracks: all things, tentative ones included, in order of birth.
        taken: every identifier ever seen; none is given twice.
        places_before: where things in the hand were taken from.
        matches: instance index -> track, of the newest frame.
        united: number of a track that turned out to be another, or a part of it -> that other; ``removed``: their
            nodes, and those of what turned out to be nothing (``None``), until they are gone from the graph.
    """

    def __init__(self, *, settings: TrackerSettings, random: Generator) -> None:
        self._settings = settings
        self._random = random
        self._born = 0
        self._masks = MaskMemory()
        self.tracks: list[Track] = []
        self.taken = TakenNames()
        self.matches: dict[int, Track] = {}
        self.united: dict[int, Track] = {}
        self.removed: dict[str, Track | None] = {}
        self.places_before: dict[int, tuple[str, Array]] = {}

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

    def update(self, sight: Sight) -> None:
        """One frame."""
        sight, in_one = without_pieces(sight, self._near(sight), self._settings.pieces)
        scope = [t for t in self._near(sight) if t.state is not ObjectState.HELD]
        iou = self._masks.overlap([track.number for track in scope], sight.detections, sight.view)
        costs = cost_matrix(scope, sight.detections, iou, sight.surroundings.T_here_room, self._settings.association)
        pairs = assign(costs, self._settings.association.limit)
        self.matches = {}
        for i, j in pairs:
            self._observe(scope[i], sight.detections[j], sight)
        matched = {j for _, j in pairs}
        unmatched = [d for j, d in enumerate(sight.detections) if j not in matched]
        unmatched = [d for d in unmatched if not self._absorb(d, scope, sight)]
        self._settle(scope, sight)
        self._doubt_unseen([track for track in scope if track.number not in in_one], sight)
        self._doubt_surfaces(sight)
        for detection in unmatched:
            self._found(detection, sight)
        self._confirm(sight)
        self._let_go_of_somebody(sight)
        self._find_missing_again(sight)
        self._unite()
        self._forget_tentative(sight.view.stamp_s)
        seen = [(d.mask, self.matches[d.index].number) for d in sight.detections if d.index in self.matches]
        self._masks.remember(seen, sight.view)

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
        """Whether the detection is a further part of a piece of furniture that something in front cuts in two, or of a
        small thing that is seen whole: two cannot be in one place.
        """
        seen = {track.number for track in self.matches.values()}
        for track in scope:
            if agreement(track.label.distribution, detection.distribution) < 0.5:
                continue
            T_room_view = sight.surroundings.T_here_room[track.room].inverse()
            if not track.is_furniture:
                center = T_room_view.apply(detection.shape.center[None])
                if track.number in seen and not track.category.container and bool(track.box.contains(center)[0]):
                    return True
            elif float(track.box.contains(T_room_view.apply(detection.cloud.points), 0.1).mean()) > 0.6:
                self._observe(track, detection, sight)
                return True
        return False

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
        T_here_room = sight.surroundings.T_here_room[track.room]
        settings = self._settings.existence
        if has_no_name(track) and is_of_somebody(track, sight, self._settings.pieces):
            return -settings.through_limit
        if track.is_furniture:
            points = T_here_room.apply(track.surface_points)
            share = surface_absent(points, sight.view, settings)
            return -settings.through_limit * share if share > 0.6 else 0.0
        box = Box(T_here_room.apply(track.position), track.box.size_m, track.box.yaw_rad + T_here_room.yaw_rad)
        if is_under_arm(box.center, sight, self._settings.pieces):
            return 0.0
        seen = visibility(box, sight.view, settings)
        replaced = any(
            detection.index in self.matches
            and not self.matches[detection.index].is_furniture
            and not self.matches[detection.index].category.container
            and bool(box.contains(detection.shape.center[None])[0])
            for detection in sight.detections
        )
        replaced = replaced or (has_no_name(track) and is_part(track, sight, self.matches, seen.center_px))
        return absence_evidence(seen, replaced=replaced, settings=settings)

    def _found(self, detection: Detection, sight: Sight) -> None:
        """Start a new, tentative thing."""
        furniture = category_of(detection.label, detection.shape.size_m).furniture
        enough = detection.cloud.pixels >= self._settings.furniture_min_px if furniture else detection.measurable
        if (
            not detection.in_range
            or not enough
            or (not furniture and is_at_hand(detection, sight, self._settings.pieces))
        ):
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
            points = T_here_room[room].apply(track.surface_points)
            walls = sight.surroundings.in_walls(points) if home is not None and track.category.floor else 0.0
            if walls > self._settings.wall_share:
                self.drop(track)

    def _confirm(self, sight: Sight) -> None:
        """Name what has been seen often enough, or recognize it; of a room that is far from here, when that is near."""
        identity, probation = self._settings.identity, self._settings.probation
        unnamed = [t for t in self._near(sight) if t.node_id is None and not t.homeless]
        for track in [t for t in unnamed if is_stable(t, probation)]:
            known = [t for t in self.tracks if t.node_id is not None]
            if is_piece(track, sight, self.matches, known, self._settings.pieces) or is_side(track, known):
                self.drop(track)
                continue
            same = known_as(
                track,
                known,
                taken_from=self.places_before,
                looked_before=sight.looked_before,
                settings=identity,
            )
            unseen = same is None or same.state is ObjectState.MISSING
            if unseen and lies_within(track, known) and not is_beyond_doubt(track, probation):
                track.hits = 0  # were it a piece of that, it would be gone with it: it must be seen anew then
                continue
            doubtful = undecided(track, known, identity) if same is None else may_prove_built_in(track, same)
            if doubtful and track.hits < self._settings.patience_hits:
                continue
            if same is not None:
                self._recognize(track, same)
            else:
                track.node_id = next_id(self.taken, track.label.best)
                self.taken.add(track.node_id)

    def _let_go_of_somebody(self, sight: Sight) -> None:
        """Forget what was given a node before it was known that somebody stands there: furniture without a name."""
        for track in [t for t in self._near(sight) if t.node_id is not None and t.is_furniture and has_no_name(t)]:
            if is_of_somebody(track, sight, self._settings.pieces):
                self.removed.update({track.node_id: None} if track.node_id is not None else {})
                self.matches = {index: other for index, other in self.matches.items() if other is not track}
                self.drop(track)

    def _near(self, sight: Sight) -> list[Track]:
        """Everything in the robot's room and its neighbors: of the others, nobody knows here where they are."""
        return [t for t in self.tracks if t.room in sight.surroundings.T_here_room]

    def _recognize(self, sighting: Track, known: Track) -> None:
        """The sighting is a thing we know: it goes on under that name."""
        self.places_before.pop(known.number, None)
        if is_fragment(sighting, known):
            known.absorb(sighting)
        else:
            known.become(sighting)
        self.matches = {index: known if t is sighting else t for index, t in self.matches.items()}
        self.drop(sighting)

    def _find_missing_again(self, sight: Sight) -> None:
        """A thing that is missed at its place may have been seen at another already, under a name of its own; or what
        is seen there now is another that is said to be in the very same place, and both are one: the older name stays.
        """
        named = [track for track in self.tracks if track.node_id is not None]
        for missing in [track for track in named if track.state is ObjectState.MISSING and not track.is_furniture]:
            moved = turned_up(missing, named, looked_before=sight.looked_before, settings=self._settings.identity)
            if moved is not None and moved in self.tracks and moved.node_id is not None:
                older, newer = sorted((missing, moved), key=lambda track: (track.first_seen_s, track.number))
                self.united[newer.number] = older
                self.removed.update({newer.node_id: older} if newer.node_id is not None else {})
                if older is missing:
                    self._recognize(moved, missing)
                else:
                    self.drop(missing)

    def _unite(self) -> None:
        """Two nodes that turned out to be one piece of furniture become one; the older name stays."""
        seen = list({t.number: t for t in self.matches.values() if t.node_id is not None and t.is_furniture}.values())
        for track in seen:
            for other in [t for t in self.tracks if t.node_id is not None and t is not track and is_double(track, t)]:
                older, newer = sorted((track, other), key=lambda t: t.number)
                if older in self.tracks and newer in self.tracks:
                    older.absorb(newer)
                    self.united[newer.number] = older
                    self.removed.update({newer.node_id: older} if newer.node_id is not None else {})
                    self.matches = {index: older if t is newer else t for index, t in self.matches.items()}
                    self.drop(newer)

    def _forget_tentative(self, stamp_s: float) -> None:
        probation = self._settings.probation
        self.tracks = [t for t in self.tracks if t.node_id is not None or may_come_true(t, stamp_s, probation)]
