"""Who is compared with whom: what is seen, a thing that is known, and what else is known at that moment."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.identity.scales import Scales
from perception.objects.seeing.detection import Detection
from perception.objects.seeing.sight import Sight
from perception.objects.tracking.relations import support_probability
from perception.objects.tracking.track import Track
from perception.vocabulary import Category, carries_things, category_of
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState

Array = NDArray[np.float64]
_FAR_M = 1e9


class Subject:
    """What is asked about: a detection of this frame, or a track that may be something known.

    Attributes:
        room: room whose frame holds ``box`` and ``points``. name, sureness: its likeliest label, and how likely.
        whole: whether it was seen as a whole. spread_m2: variance of its center along one axis, in square meters.
    """

    def __init__(self, source: Detection | Track, room: str) -> None:
        self.source, self.room = source, room
        if isinstance(source, Track):
            self.name, self.distribution = source.label.best, source.label.distribution
            self.box, self.furniture, self.whole = source.box, source.is_furniture, source.seen_whole
            self.first_seen_s, self.last_seen_s = source.first_seen_s, source.last_seen_s
        else:
            shape = source.shape
            self.name, self.distribution = source.label, source.distribution
            self.box, self.whole = Box(shape.center, shape.size_m, shape.yaw_rad), shape.complete
            self.furniture = category_of(source.label, shape.size_m).furniture
            self.first_seen_s = self.last_seen_s = np.inf
        self.sureness = dict(self.distribution).get(self.name, 0.0)
        self._in: dict[str, tuple[Array, Array]] = {}

    def __str__(self) -> str:
        return f"{self.name} {self.track.number if self.track is not None else ''}".strip()

    @classmethod
    def of(cls, track: Track) -> Subject:
        """A track, in its own room."""
        return cls(track, track.room)

    @property
    def track(self) -> Track | None:
        """The track itself, if it is one."""
        return self.source if isinstance(self.source, Track) else None

    @property
    def category(self) -> Category:
        """What is known of its kind."""
        return category_of(self.name, self.box.size_m)

    @cached_property
    def points(self) -> Array:
        """(N, 3) on its surface; of a small track, its middle alone."""
        if not isinstance(self.source, Track):
            return self.source.cloud.points
        return self.source.surface_points if self.furniture else self.box.center[None]

    @cached_property
    def colors(self) -> Mapping[str, float]:
        """Share of each color."""
        return self.source.color.shares if isinstance(self.source, Track) else self.source.colors

    @cached_property
    def spread_m2(self) -> float:
        covariance = self.source.covariance if isinstance(self.source, Track) else self.source.shape.covariance
        return float(np.trace(covariance)) / 3.0

    def seen_from(self, room: str, moment: Moment) -> tuple[Array, Array]:
        """Its center (3,) and points (N, 3) in the frame of ``room``; far away in one that nobody can tell."""
        if room not in self._in:
            T = moment.transform(room, self.room)
            far = np.full((1, 3), _FAR_M)
            self._in[room] = (T.apply(self.box.center), T.apply(self.points)) if T is not None else (far[0], far)
        return self._in[room]


@dataclass(frozen=True, kw_only=True, eq=False)
class Moment:
    """What is known and seen while two are compared. ``known``: all things that count; ``matches``: which thing each
    detection of this frame is, by its index; ``iou``: of masks, by number of a thing and index of a detection.
    ``T_here_room``: of the rooms that are known from here.
    """

    known: Sequence[Track] = ()
    sight: Sight | None = None
    T_here_room: Mapping[str, SE3] = field(default_factory=dict)
    matches: Mapping[int, Track] = field(default_factory=dict)
    looked_before: Mapping[str, float] = field(default_factory=dict)
    iou: Mapping[tuple[int, int], float] = field(default_factory=dict)
    scales: Scales = field(default_factory=Scales)
    _spreads_m2: dict[int, float] = field(default_factory=dict)

    def transform(self, to: str, room: str) -> SE3 | None:
        """From the frame of ``room`` to that of ``to``, as far as the robot can tell from here."""
        if to == room:
            return SE3.identity()
        T = self.T_here_room
        return T[to].inverse() @ T[room] if to in T and room in T else None

    def spread_m2(self, track: Track) -> float:
        """Variance of the center of a thing along one axis."""
        if track.number not in self._spreads_m2:
            self._spreads_m2[track.number] = float(np.trace(track.covariance)) / 3.0
        return self._spreads_m2[track.number]

    def sharers(self, it: Subject) -> list[tuple[Track, NDArray[np.bool_]]]:
        """Known things of its kind where it is, and which of its points, (N,), each of them has."""
        found = list[tuple[Track, NDArray[np.bool_]]]()
        for known in self.known:
            solid = known.state is ObjectState.PRESENT if it.furniture else known.impenetrable
            if solid and known.is_furniture == it.furniture and known is not it.track and known.node_id is not None:
                margin_m = self.scales.margin_m(furniture=it.furniture)
                within = known.box.contains(it.seen_from(known.room, self)[1], margin_m)
                found += [(known, within)] if within.any() else []
        return found

    def carrier(self, it: Subject) -> str | None:
        """The node of what carries it, ``None`` for what lies on the floor."""
        carriers = [t for t in self.known if t.room == it.room and carries_things(t.label.best, t.box.size_m)]
        gap = {"sigma_m": self.scales.contact_sigma_m, "rim_m": self.scales.rim_m}
        chances = [(support_probability(it.box, t.box, t.category, **gap)[1], -t.number, t.node_id) for t in carriers]
        best = max(chances, default=None)
        return best[2] if best is not None and best[0] > self.scales.carries else None


class Pair:
    """A subject and a thing that is known, if it is about one; every evidence is computed at most once."""

    def __init__(self, it: Subject, known: Track | None, moment: Moment) -> None:
        self.it, self.moment, self.scales = it, moment, moment.scales
        self._known = known
        self.measured: dict[Evidence, float] = {}

    @property
    def alone(self) -> bool:
        """Whether it is about no thing in particular."""
        return self._known is None

    @property
    def known(self) -> Track:
        """The thing that is known."""
        if self._known is None:
            raise LookupError("it is compared with no thing in particular")
        return self._known

    def measure(self, evidence: Evidence) -> float:
        """The value of an evidence."""
        if evidence not in self.measured:
            self.measured[evidence] = float(evidence(self))
        return self.measured[evidence]

    @property
    def center(self) -> Array:
        """(3,) middle of the subject in the room of what is known."""
        return self.it.seen_from(self.known.room, self.moment)[0]

    @property
    def points(self) -> Array:
        """(N, 3) points of the subject in the room of what is known."""
        return self.it.seen_from(self.known.room, self.moment)[1]

    def here(self, points: Array) -> Array:
        """Points of the subject's room in the robot's; far away where the way is not known."""
        sight = self.moment.sight
        T_here_room = self.moment.transform(sight.view.room, self.it.room) if sight is not None else None
        return T_here_room.apply(points) if T_here_room is not None else np.full_like(points, _FAR_M)


Evidence = Callable[[Pair], float]
"""A measure of what speaks for or against that the subject of a pair is what is known, or a part of it."""
