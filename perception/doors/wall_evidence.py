"""What many scans together say about one wall: which parts are wall, which are open, and where exactly a gap ends."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_closing, binary_dilation

from perception.geometry.runs import runs
from perception.lidar.wall_rays import WallRays
from perception.localization.doorways import DoorSizes
from scene_graph.nodes import DoorState

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Gap:
    """An open stretch of a wall, stations in meters from the wall's start.

    ``wall_before_m``, ``wall_after_m``: where wall was seen beside it, so that the post is between there and the open
    stretch; ``None`` where none was seen near. ``panel_m``: how far behind the wall's face the leaf of a closed door
    is, ``None`` where one can look through.
    """

    start_m: float
    end_m: float
    wall_before_m: float | None = None
    wall_after_m: float | None = None
    panel_m: float | None = None

    @property
    def width_m(self) -> float:
        return self.end_m - self.start_m

    @property
    def center_m(self) -> float:
        return (self.start_m + self.end_m) / 2.0

    @property
    def state(self) -> DoorState:
        return DoorState.OPEN if self.panel_m is None else DoorState.CLOSED


@dataclass(frozen=True, kw_only=True)
class GapSettings:
    """What counts as a gap."""

    narrowest_m: float = 0.35
    """Least width that rays pass through: seen at an angle, the reveals of a thick wall take their share of a door."""
    rays: float = 2.0
    """Least number in a part of the wall that tells, each weighed by its distance. Chosen."""
    bridge_m: float = 0.12
    """A part without rays this short is like its neighbors. Chosen: the spacing of rays that graze a far wall."""
    post_m: float = 0.36
    """How far beside a closed leaf, or a stretch that nobody saw, wall still belongs to it. Chosen."""
    hidden_m: float = 1.0
    """How far beside a gap wall may be first seen: rays that end on the reveal of a thick wall, or on what stands right
    behind the door, tell nothing. Chosen."""
    hiding_m: float = DoorSizes.narrowest_m
    """An unseen stretch this long could hide a door."""
    dark_m: float = 0.2
    """If so much of it showed nothing at all. Chosen."""
    panel_m: float = 0.014
    """How deep in the wall a door's leaf is at least. Chosen: less is within the errors of the walls."""
    deepest_m: float = 0.3
    """And at most: a leaf at the far side of a thick wall."""
    leaf_rays: float = 6.0
    """Least number in a part of a leaf: averages of so many tell a few millimeters. Chosen."""
    narrowest_leaf_m: float = DoorSizes.narrowest_m
    """Of a door."""
    widest_leaf_m: float = 1.4
    """Of a single leaf with its frame, and errors of both ends."""
    flush: float = 0.4
    """Share of the panel's depth that the wall above it, and beside it, may be off its face. Chosen: under a half."""


@dataclass(frozen=True, kw_only=True)
class EvidenceSettings:
    """What is counted and what is kept of the rays along a wall, and how gaps are told from it."""

    bin_m: float = 0.02
    """Length of a part of the wall. Chosen: the spacing of rays three meters away."""
    kept_scans: int = 60
    """Whose rays are kept one by one. Chosen: one visit to a door, and memory."""
    most_rays: float = 30.0
    """That count in a part; older ones make room, so that what changes is seen. Chosen: some seconds of looking."""
    farthest_sample_m: float = 5.0
    """Kept rays from farther away do not sharpen a post: there they are 35 mm apart and noisy."""
    frame_m: float = 0.10
    """Beside a known door wall is not looked for: its frame."""
    deepest_m: float = 0.35
    """Rays that end deeper in the wall are of no leaf: the deepest one, and range noise."""
    grazing: float = 2.0
    """Way along the wall per way into it beyond which a ray may have met a reveal instead of the face. Chosen."""
    gaps: GapSettings = field(default_factory=GapSettings)


class WallEvidence:
    """Counts of rays that passed and that ended on the face, along one wall, and the recent rays themselves.

    A ray that ends behind the face, on a reveal or a recessed panel, counts as neither. One that grazes the wall may
    have met the first centimeters of a reveal instead of the face: it tells only where no steeper ray does.
    """

    def __init__(self, length_m: float, settings: EvidenceSettings = EvidenceSettings()) -> None:
        self.length_m = length_m
        self._settings, self._bin_m = settings, settings.bin_m
        bins = max(1, int(np.ceil(length_m / self._bin_m)))
        self._passed = np.zeros(bins)
        self._ended = np.zeros(bins)
        self._grazed = np.zeros(bins)
        self._low_hits = np.zeros(bins)
        self._blocked = np.zeros(bins)
        self._depth = np.zeros((2, bins))
        self._depth_rays = np.zeros((2, bins))
        self._scans: deque[WallRays] = deque(maxlen=settings.kept_scans)

    def add(self, rays: WallRays, *, keep: bool) -> None:
        """Count the rays of one scan; ``keep`` them one by one too, for finding edges."""
        index = np.minimum((rays.station_m / self._bin_m).astype(np.int64), len(self._passed) - 1)
        weight = 1.0 / np.maximum(rays.distance_m, 1.0)
        grazing = np.abs(rays.slope) > self._settings.grazing
        ended = rays.on_face & ~rays.passed & ~grazing
        grazed = rays.on_face & ~rays.passed & grazing
        np.add.at(self._passed, index[rays.passed], weight[rays.passed])
        np.add.at(self._ended, index[ended], weight[ended])
        np.add.at(self._grazed, index[grazed], weight[grazed])
        np.add.at(self._low_hits, index[rays.low_hit], weight[rays.low_hit])
        blocked = np.minimum((rays.blocked_m / self._bin_m).astype(np.int64), len(self._blocked) - 1)
        np.add.at(self._blocked, blocked, 1.0)
        self._bound()
        if keep:
            self._scans.append(rays)
            self._add_depths(rays, index)

    def _add_depths(self, rays: WallRays, index: NDArray[np.int64]) -> None:
        """Sum up how deep rays end at the height of a door, and above; a leaf hides in part from the side."""
        settings, weight = self._settings, 1.0 / (1.0 + rays.slope**2)
        steep = np.abs(rays.slope) < settings.grazing
        for row, depth_m in enumerate((rays.depth_m, rays.lintel_m)):
            ended = steep & (depth_m < settings.deepest_m) & ((row == 1) | ~rays.passed)
            bins, rated = index[ended], weight[ended]
            self._depth[row] += np.bincount(bins, rated * depth_m[ended], minlength=len(self._depth[row]))
            self._depth_rays[row] += np.bincount(bins, rated, minlength=len(self._depth[row]))

    def _bound(self) -> None:
        """Old counts make room for new ones where there are many, so that what changes is seen."""
        most = self._settings.most_rays
        share = np.minimum(1.0, most / np.maximum(self._passed + self._ended, 1e-9))
        self._passed *= share
        self._ended *= share
        self._grazed *= np.minimum(1.0, most / np.maximum(self._grazed, 1e-9))
        self._low_hits *= share

    def gaps(self) -> list[Gap]:
        """Open stretches wide enough for a door."""
        settings, state = self._settings.gaps, self._states()
        found: list[Gap] = []
        for start, end in runs(state == 1):
            gap = Gap(
                start_m=start * self._bin_m,
                end_m=min(end * self._bin_m, self.length_m),
                wall_before_m=self._wall_beside(state, start, -1),
                wall_after_m=self._wall_beside(state, end - 1, 1),
            )
            if gap.width_m >= settings.narrowest_m:
                found.append(gap)
        return found

    def recesses(self) -> list[Gap]:
        """Closed doors: stretches as wide as a door's leaf that lie behind the face, below wall that does not."""
        settings = self._settings.gaps
        told = self._depth_rays[0] >= settings.leaf_rays
        depth_m = self._depths_from_face(told)
        found: list[Gap] = []
        for first, last in runs(self._behind_face(depth_m[0], told)):
            leaf = np.arange(first, last)[told[first:last]]
            panel_m = float(np.median(depth_m[0, leaf])) if len(leaf) else 0.0
            flush = told & (np.abs(depth_m[0]) < settings.flush * panel_m)
            gap = self._recess(first, last, panel_m, flush)
            if _has_leaf(gap, settings) and self._below_flush_wall(leaf, depth_m[1], settings.flush * panel_m):
                found.append(gap)
        return found

    def _depths_from_face(self, told: NDArray[np.bool_]) -> Array:
        """How deep rays end at the height of a door, and above, (2, bins) in meters, from the wall's own face."""
        depth_m = self._depth / np.maximum(self._depth_rays, 1e-9)
        depth_m[0] -= np.median(depth_m[0, told]) if told.any() else 0.0
        return depth_m

    def _behind_face(self, depth_m: Array, told: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Parts of the wall where a leaf may be; short interruptions belong to it."""
        settings = self._settings.gaps
        deep = told & (depth_m > settings.panel_m) & (depth_m < settings.deepest_m) & (self._states() != 1)
        return np.asarray(binary_closing(deep, iterations=round(settings.bridge_m / self._bin_m / 2.0)))

    def _recess(self, first: int, last: int, panel_m: float, flush: NDArray[np.bool_]) -> Gap:
        """The stretch from one part of the wall to another, with the flush wall nearest beside it."""
        beside = round(self._settings.gaps.post_m / self._bin_m)
        before = np.flatnonzero(flush[max(0, first - beside) : first])
        after = np.flatnonzero(flush[last : last + beside])
        return Gap(
            start_m=first * self._bin_m,
            end_m=min(last * self._bin_m, self.length_m),
            wall_before_m=(max(0, first - beside) + before[-1] + 1) * self._bin_m if len(before) else None,
            wall_after_m=(last + after[0]) * self._bin_m if len(after) else None,
            panel_m=panel_m,
        )

    def _below_flush_wall(self, leaf: NDArray[np.int64], lintel_m: Array, flush_m: float) -> bool:
        """Whether rays above enough of a leaf end on the face. ``lintel_m``: how deep they end, for each part."""
        above = leaf[self._depth_rays[1, leaf] > 0]
        return len(above) > 0.3 * len(leaf) and bool(np.median(lintel_m[above]) < flush_m)

    def unseen(self, explained: Sequence[tuple[float, float]] = ()) -> list[Gap]:
        """Stretches that could hide a door: not seen to be wall, and nothing stands close before them.

        ``explained``: from where to where doors are known. A gap too narrow for a door may be part of a hidden one.
        """
        settings, state = self._settings.gaps, self._states()
        free = self._blocked < 1.0
        dark = (state != -1) & free
        grazed = (state == -1) & ~self._told() & free
        near_dark = binary_dilation(dark, iterations=round(settings.post_m / self._bin_m))
        hidden = dark | (grazed & near_dark)
        doors = [(gap.start_m, gap.end_m) for gap in self.gaps() if gap.width_m > settings.hiding_m]
        frame_m = self._settings.frame_m
        for start_m, end_m in (*doors, *explained):
            first, last = (
                round((start_m - frame_m) / self._bin_m),
                round((end_m + frame_m) / self._bin_m),
            )
            hidden[max(first, 0) : max(last, 0)] = False
        found: list[Gap] = []
        for start, end in runs(hidden):
            gap = Gap(start_m=start * self._bin_m, end_m=min(end * self._bin_m, self.length_m))
            in_the_dark_m = float(dark[start:end].sum()) * self._bin_m
            if gap.width_m > settings.hiding_m and in_the_dark_m > settings.dark_m:
                found.append(gap)
        return found

    def _told(self) -> NDArray[np.bool_]:
        """Parts of the wall that rays met steeply enough."""
        return np.asarray(self._passed + self._ended > self._settings.gaps.rays / 3.0)

    def _states(self) -> NDArray[np.int64]:
        """Per part of the wall: 1 open, -1 wall, 0 unknown; short unknown parts take their neighbors' state."""
        settings, told = self._settings.gaps, self._told()
        opened = told & (self._passed > self._ended) & (self._low_hits <= 0.5 * self._passed)
        state = np.where(opened, 1, np.where(told | (self._grazed > settings.rays / 3.0), -1, 0))
        known = np.flatnonzero(state)
        for before, after in pairwise(known.tolist()):
            if 1 < after - before <= settings.bridge_m / self._bin_m and state[before] == state[after]:
                state[before:after] = state[before]
        return state

    def _wall_beside(self, state: NDArray[np.int64], edge: int, step: int) -> float | None:
        """Station of the wall, or its corner, seen nearest beside a gap's last open part; ``None`` at another gap."""
        for distance in range(1, int(np.ceil(self._settings.gaps.hidden_m / self._bin_m)) + 1):
            beside = edge + step * distance
            if not 0 <= beside < len(state):
                return 0.0 if step < 0 else self.length_m
            if state[beside] == 1:
                return None
            if state[beside] == -1:
                return (beside + (0 if step > 0 else 1)) * self._bin_m
        return None

    def samples(self, station_m: float, window_m: float) -> WallRays | None:
        """The kept rays within ``window_m`` of a station, or ``None``."""
        parts, farthest_m = [], self._settings.farthest_sample_m
        for rays in self._scans:
            near = (np.abs(rays.station_m - station_m) < window_m) & (rays.distance_m < farthest_m)
            parts.append((rays, near))
        if not any(near.any() for _, near in parts):
            return None
        return WallRays(
            station_m=np.concatenate([rays.station_m[near] for rays, near in parts]),
            depth_m=np.concatenate([rays.depth_m[near] for rays, near in parts]),
            slope=np.concatenate([rays.slope[near] for rays, near in parts]),
            distance_m=np.concatenate([rays.distance_m[near] for rays, near in parts]),
            passed=np.concatenate([rays.passed[near] for rays, near in parts]),
            on_face=np.concatenate([rays.on_face[near] for rays, near in parts]),
            low_hit=np.concatenate([rays.low_hit[near] for rays, near in parts]),
            lintel_m=np.concatenate([rays.lintel_m[near] for rays, near in parts]),
            blocked_m=np.empty(0),
        )


def _has_leaf(gap: Gap, settings: GapSettings) -> bool:
    """Whether a recess is as wide and as deep as the leaf of a door, between wall on both sides."""
    wide = settings.narrowest_leaf_m < gap.width_m < settings.widest_leaf_m
    deep = gap.panel_m is not None and gap.panel_m > settings.panel_m
    return wide and deep and gap.wall_before_m is not None and gap.wall_after_m is not None
