"""One thing the robot knows of: tentative, confirmed, then a node of the graph, and never deleted from there.

What it is and where it is are beliefs of their own; a track adds its life. Everything is in the frame of its room.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from perception.objects.beliefs import AccentBelief, ColorBelief, LabelBelief, LabelSettings, is_taught
from perception.objects.furniture.back import BackSettings, SeatBack, back_of
from perception.objects.furniture.levels import LevelMemory, LevelSettings
from perception.objects.furniture.surface import Box, SurfaceBelief, SurfaceSettings
from perception.objects.seeing.detection import Detection
from perception.objects.seeing.projection import View
from perception.objects.seeing.shape import ShapeSettings, measure_shape, point_covariance
from perception.objects.tracking.center import CenterBelief, CenterSettings
from perception.objects.tracking.handled import HandDid, Handled
from perception.vocabulary import Category, category_of, has_back, is_of_one_size, may_grow_m, spans_its_kind
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import UNKNOWN_LABEL, ObjectNode, ObjectState

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class TrackSettings:
    """``log_odds``: of existence at birth."""

    label: LabelSettings = field(default_factory=LabelSettings)
    center: CenterSettings = field(default_factory=CenterSettings)
    surface: SurfaceSettings = field(default_factory=SurfaceSettings)
    levels: LevelSettings = field(default_factory=LevelSettings)
    back: BackSettings = field(default_factory=BackSettings)
    shape: ShapeSettings = field(default_factory=ShapeSettings)
    log_odds: float = 1.0
    side_rad: float = math.pi / 4.0
    """From within such an angle, frames repeat each other's mistakes."""
    places: int = 4
    """So many places from which a thing was seen are remembered: more than are ever asked for."""
    apart: float = 0.5
    """Two places lie apart as a thing sees them, if they are farther from each other than this share of the way to it.
    """
    part_trust: float = 0.25
    """What a view of a part counts, cut by the picture's border or by what stands before it: networks name parts badly.
    """
    stored_accents: float = 2.0
    """As how many frames that can tell counts what was stored of the accents."""
    known_hits: int = 10
    """So many frames make a piece of furniture known well."""
    known_label: float = 0.5
    """So sure its name must be then."""
    beyond_m: float = 0.05
    """What comes in one size does not reach farther than by this beyond its box."""
    at_other_m: float = 0.06
    """So near to the box of another piece a point is of that."""


class Track:
    """Belief about one thing.

    Attributes:
        number: running number; order of birth. node_id: its node, once confirmed. room: room whose frame holds it.
            place: a ``CenterBelief`` for what can be carried, a ``SurfaceBelief`` for furniture, ``None`` before the
            first sight. levels: how high the boards or the seat of furniture are. back: where the back of a seat is,
            once it was seen. state, log_odds: whether it still is
            where it is said to be. hits: frames that saw it; seen_from: where the camera was then, (2,) each,
            from the thing along its room's axes: a few places that are well apart as the thing sees them.
            seen_whole: whether one of them showed all of it; ``misses``: frames in a row that should have and did not.
            homeless: whether it is in none of the rooms known so far; ``room`` then is the one it was seen from.
            handled: what the hand did to it last, unless it turned out to be elsewhere since.
    """

    def __init__(self, number: int, room: str, *, settings: TrackSettings, random: Generator) -> None:
        self.number = number
        self.room = room
        self.node_id: str | None = None
        self.label = LabelBelief(settings.label)
        self.color = ColorBelief()
        self.accents = AccentBelief()
        self.seen_from: list[Array] = []
        self.place: CenterBelief | SurfaceBelief | None = None
        self.levels = LevelMemory(settings=settings.levels)
        self.back: SeatBack | None = None
        self.state = ObjectState.PRESENT
        self.log_odds = settings.log_odds
        self.homeless = False
        self.handled: Handled | None = None
        self.hits = 0
        self.seen_whole = False
        self.misses = 0
        self.first_seen_s = 0.0
        self.last_seen_s = 0.0
        self._settings = settings
        self._random = random

    @property
    def is_furniture(self) -> bool:
        """Whether its surface is kept rather than its center."""
        return isinstance(self.place, SurfaceBelief)

    @property
    def category(self) -> Category:
        """What is known of its kind."""
        return category_of(self.label.best, self.box.size_m)

    @property
    def existence(self) -> float:
        """Probability that it is where it is said to be."""
        return float(1.0 / (1.0 + np.exp(-self.log_odds)))

    def note_hand(self, did: HandDid, stamp_s: float) -> None:
        """Remember what the hand has just done to it, and where it was then."""
        self.handled = Handled(did=did, stamp_s=stamp_s, room=self.room, position=self.position.copy())

    def unseen_since(self, *did: HandDid) -> bool:
        """Whether the hand did that to it last, and it was not seen since."""
        return self.handled is not None and self.handled.did in did and self.last_seen_s < self.handled.stamp_s

    @property
    def box(self) -> Box:
        """Center, size and direction in the room frame."""
        return self.place.box if self.place is not None else Box(np.zeros(3), (0.1, 0.1, 0.1), 0.0)

    @property
    def position(self) -> Array:
        """(3,) center in the room frame."""
        return self.box.center

    @property
    def covariance(self) -> Array:
        """(3, 3) of the center."""
        return self.place.covariance if self.place is not None else np.eye(3)

    @property
    def surface_points(self) -> Array:
        """(V, 3) reliable points of a piece of furniture; none of other things."""
        return self.place.memory.reliable if isinstance(self.place, SurfaceBelief) else np.zeros((0, 3))

    @property
    def surfaces_m(self) -> tuple[float, ...]:
        """Heights above its bottom on which things can stand, as measured, lowest first."""
        if not self.category.levels:
            return ()
        bottom_m = float(self.position[2]) - self.box.size_m[2] / 2.0
        return tuple(height_m - bottom_m for height_m in self.levels.heights_m if height_m > bottom_m)

    @property
    def T_room_object(self) -> SE3:
        """Pose of its own frame in the room."""
        x_m, y_m, z_m = self.box.center.tolist()
        return SE3.from_xyz_yaw(x_m, y_m, z_m, self.box.yaw_rad)

    def observe(self, detection: Detection, view: View, T_room_view: SE3, others: Sequence[Box] = ()) -> None:
        """Take in a detection that is this thing. In the boxes ``others``, in its room frame, stand other pieces of
        furniture: what the mask shows of them is not of this one.
        """
        side = self._side_of(detection, view, T_room_view)
        trust = 1.0 if _is_whole(detection) else self._settings.part_trust
        self.label.update(detection.distribution, detection.weight, (*side, trust), trust=trust)
        self.color.update(detection.colors, detection.weight)
        self.accents.update(detection.accents, detection.weight)
        self._note_place(T_room_view.apply(view.T_room_camera.translation_m), detection, T_room_view)
        self.hits += 1
        self.seen_whole |= detection.shape.complete
        self.misses = 0
        self.first_seen_s = self.first_seen_s if self.hits > 1 else view.stamp_s
        self.last_seen_s = view.stamp_s
        R = T_room_view.rotation()
        pose_covariance = R @ point_covariance(view, detection.shape.center) @ R.T
        size_m = self.box.size_m if self.place is not None else detection.shape.size_m
        if category_of(self.label.best, size_m).furniture:
            self._observe_surface(detection, view, T_room_view, pose_covariance, others)
        else:
            self._observe_center(detection, view, T_room_view, pose_covariance, side)

    def _note_place(self, camera: Array, detection: Detection, T_room_view: SE3) -> None:
        """Remember from where it is seen, unless it was seen from much the same side and distance before."""
        thing = T_room_view.apply(detection.shape.center) if self.place is None else self.position
        place = (camera - thing)[:2]
        if len(self.seen_from) < self._settings.places and all(
            _lie_apart(place, other, self._settings.apart) for other in self.seen_from
        ):
            self.seen_from.append(place)

    def _side_of(self, detection: Detection, view: View, T_room_view: SE3) -> tuple[int, int]:
        """From which side and how near the thing is seen: frames of one such view repeat each other's mistakes."""
        thing = T_room_view.apply(detection.shape.center) if self.place is None else self.position
        x_m, y_m, _ = (T_room_view.apply(view.T_room_camera.translation_m) - thing).tolist()
        octave = round(math.log2(max(math.hypot(x_m, y_m), 0.5)))
        return math.floor(math.atan2(y_m, x_m) / self._settings.side_rad), octave

    def _observe_surface(
        self, detection: Detection, view: View, T_room_view: SE3, pose_covariance: Array, others: Sequence[Box]
    ) -> None:
        if not isinstance(self.place, SurfaceBelief):
            self.place = SurfaceBelief(self._settings.surface)
        elif not detection.in_range or self._vaguer(detection):
            return
        camera = T_room_view.apply(view.T_room_camera.translation_m)
        points = self._own(T_room_view.apply(detection.cloud.points), detection.label, others)
        self.place.yield_to(others)
        top_shown = not detection.mask[0].any()
        self.place.observe(points, pose_covariance, category_of(self.label.best), camera, top_shown=bool(top_shown))
        if self.category.levels and detection.in_range:
            self.levels.observe(detection.mask, view, T_room_view, self.box)
        if has_back(self.label.best):
            self.back = back_of(self.surface_points, self.box, self._settings.back) or self.back
        self.label.measure(self.box.size_m)

    def _own(self, points: Array, called: str, others: Sequence[Box]) -> Array:
        """Of points (N, 3) under a mask, those that are not of something else: a stove in a row of counters and the
        counters beside it often are in one mask.
        """
        own = np.ones(len(points), dtype=bool)
        for box in others:
            own &= ~box.contains(points, self._settings.at_other_m)
        spare_m = may_grow_m(self.label.best, self.box.size_m)
        whole = spare_m <= 0.0 or spans_its_kind(called, self.box.size_m)
        if self.stands_by_itself and (called != self.label.best or whole):
            own &= self.box.contains(points, min(spare_m / 2.0, self._settings.beyond_m))
        return points[own] if own.any() or len(self.surface_points) else points

    @property
    def stands_by_itself(self) -> bool:
        """Whether it is known well to be a piece whose kind comes in one size: nothing else is where it is, and it does
        not reach farther.
        """
        known = self.hits >= self._settings.known_hits and self.label.confidence >= self._settings.known_label
        return known and self.is_furniture and is_of_one_size(self.label.best)

    @property
    def impenetrable(self) -> bool:
        """Whether nothing else can be where it is: it is a node with a name, small and not a container. What the hand
        has just put down is not known to be there before it is seen.
        """
        known = self.node_id is not None and self.state is ObjectState.PRESENT and self.label.best != UNKNOWN_LABEL
        return known and not (self.is_furniture or self.unseen_since(HandDid.PUT) or self.category.container)

    def _vaguer(self, detection: Detection) -> bool:
        """Whether a thing of known name was seen as something without one: such masks show more than the thing."""
        return category_of(self.label.best).known and not category_of(detection.label).known

    def _observe_center(
        self, detection: Detection, view: View, T_room_view: SE3, pose_covariance: Array, side: tuple[int, int]
    ) -> None:
        if isinstance(self.place, CenterBelief) and not detection.measurable:
            return
        shape = detection.shape
        if detection.label != self.label.best:
            shape = measure_shape(
                detection.cloud, view, category_of(self.label.best, shape.size_m), self._settings.shape
            )
        if not isinstance(self.place, CenterBelief):
            R = T_room_view.rotation()
            box = Box(T_room_view.apply(shape.center), shape.size_m, 0.0)
            self.place = self._center(box, R @ shape.covariance @ R.T)
        else:
            self.place.observe(shape, T_room_view, pose_covariance, side)
            self.label.measure(self.box.size_m)

    def _center(self, box: Box, covariance: Array) -> CenterBelief:
        return CenterBelief(box, covariance, settings=self._settings.center, random=self._random)

    def put_at(self, room: str, position: Array, sigma_m: float, yaw_rad: float | None = None) -> None:
        """Place it where it must be now, other than by sight: released there or dropped there."""
        self.room = room
        self.label.start_from(self.label.distribution, self.hits)
        if self.place is not None:
            self.levels = self.levels.raised(float(position[2] - self.position[2]))
            self.place.put_at(position, sigma_m, yaw_rad)

    def change_room(self, room: str, T_new_old: SE3) -> None:
        """Express it in the frame of another room."""
        self.room = room
        self.levels = self.levels.raised(T_new_old.z_m)
        if self.back is not None:
            self.back = replace(self.back, toward_rad=self.back.toward_rad + T_new_old.yaw_rad)
        if self.place is not None:
            self.place.change_frame(T_new_old)

    def become(self, other: Track) -> None:
        """Take over the place of ``other``, a newer sighting of this very thing; identity and history stay."""
        self.room, self.place, self.levels = other.room, other.place, other.levels
        self.back = other.back
        self.color, self.accents = other.color, other.accents
        self.state, self.log_odds = ObjectState.PRESENT, other.log_odds
        self.handled = None
        self.label.start_from(self.label.distribution, self.hits)
        self.label.update(other.label.distribution, view=other.number)
        self.seen_from = [*self.seen_from, *other.seen_from][-self._settings.places :]
        self.hits += other.hits
        self.seen_whole |= other.seen_whole
        self.misses = 0
        self.last_seen_s = other.last_seen_s

    def absorb(self, part: Track) -> None:
        """Take in a piece of furniture that turned out to be a part of this one."""
        if isinstance(self.place, SurfaceBelief) and isinstance(part.place, SurfaceBelief):
            self.place.absorb(part.place)
            self.levels.absorb(part.levels)
        trust = 1.0 if part.seen_whole else self._settings.part_trust
        self.label.update(part.label.distribution, view=part.number, trust=trust)
        self.hits += part.hits
        self.misses = 0
        self.last_seen_s = max(self.last_seen_s, part.last_seen_s)

    def adopt(self, node: ObjectNode, T_room_object: SE3, covariance: Array) -> None:
        """Start from what the graph remembers, after a restart or when memory brings a room back."""
        self.node_id = node.id
        if is_taught(node.label, node.label_distribution):
            self.label.teach(node.label)
        self.label.start_from(node.label_distribution or ((node.label, 0.9),), node.observations)
        if node.color:
            self.color.update({node.color: 1.0})
        self.accents.update(node.accents, self._settings.stored_accents)
        self.state = node.state
        existence = float(np.clip(node.existence, 0.01, 0.99))
        self.log_odds = float(np.log(existence / (1.0 - existence)))
        self.hits, self.first_seen_s, self.last_seen_s = node.observations, node.first_seen_s, node.last_seen_s
        size_m = node.size_m if min(node.size_m) > 0.0 else (0.1, 0.1, 0.1)
        box = Box(T_room_object.translation_m, size_m, T_room_object.yaw_rad)
        if category_of(node.label, node.size_m).furniture:
            self.place = SurfaceBelief.of(box, self._settings.surface, frames=node.observations)
            bottom_m = T_room_object.z_m - size_m[2] / 2.0
            self.levels = LevelMemory.of(
                tuple(bottom_m + height_m for height_m in node.surfaces_m), self._settings.levels
            )
            if node.back_rad is not None:
                self.back = SeatBack(toward_rad=node.back_rad + T_room_object.yaw_rad, face_m=node.back_m)
        else:
            self.place = self._center(box, covariance + np.eye(3) * 1e-6)


def _lie_apart(one: Array, other: Array, share: float) -> bool:
    away_m = max(float(np.linalg.norm(one)), float(np.linalg.norm(other)))
    return float(np.linalg.norm(one - other)) > share * away_m


def _is_whole(detection: Detection) -> bool:
    """Whether all of it is seen. What stands in a row of furniture is never seen whole; that it is as long and as deep
    as its kind says as much.
    """
    return detection.shape.complete or spans_its_kind(detection.label, detection.shape.size_m)
