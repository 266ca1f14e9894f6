"""Keeps ``rt`` root -> room for all rooms in step with what is known about the doors between them."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import zip_longest

import numpy as np

from perception.doors.insertion import DoorNodeSettings
from perception.geometry.planar import Pose2, diagonal_covariance, planar_covariance, spatial_covariance, wrap
from perception.memory.dual_doors import back_to_back, root_pose
from perception.memory.joining import JoiningSettings, walked_match
from perception.memory.layout_optimization import LayoutOptimizationSettings, Passage, PlacedRoom, lay_out
from scene_graph.edges import EdgeKey, EdgeType, MatchEdge, RtEdge
from scene_graph.identifiers import wall_id_of
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROOT_ID, DoorNode
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)

LAYOUT_AGENT = "long_term_memory"


@dataclass(frozen=True, kw_only=True)
class LayoutSettings:
    """What doors and walls are worth to the layout, and when it is written."""

    station_floor_m: float = 0.003
    """Least standard deviation of a door's place along its wall. Chosen."""
    wall_floor_m: float = 0.001
    """The same of a wall's offset."""
    unknown_wall_std_m: float = 0.01
    """The same of a wall whose edge says nothing: the least that the room concept vouches for."""
    parallel_std_rad: float = float(np.deg2rad(0.15))
    """Between the two faces of a door that is measured well: walls are built parallel. Chosen."""
    not_parallel_rad: float = float(np.deg2rad(4.0))
    """If more was driven, the faces are not parallel. Chosen: more than odometry turns in a door."""
    walked_std_m: float = JoiningSettings.walked_std_m
    """Of the way that was driven through a door, where the graph does not say it."""
    walked_std_rad: float = 0.01
    """And of the heading."""
    well_measured: float = DoorNodeSettings.well_measured
    """Confidence of a door that says where its two faces are."""
    worth_writing_m: float = 5e-4
    """Least shift of a room or wall that is written. Chosen: below the errors of all that is measured."""
    worth_writing_rad: float = 1e-4
    """Or turn."""
    optimization: LayoutOptimizationSettings = field(default_factory=LayoutOptimizationSettings)


class RoomLayout:
    """Recomputes the layout when a door was joined or measured anew."""

    def __init__(self, memory: WorkingMemory, settings: LayoutSettings = LayoutSettings()) -> None:
        self._memory, self._settings = memory, settings
        self._places: dict[EdgeKey, tuple[RtEdge | None, RtEdge | None]] = {}

    def update(self, stamp_s: float) -> None:
        """Lay all rooms out anew, unloaded ones too, when a passage has changed since it was last in working memory."""
        if not self._changed(self._memory.snapshot()):
            return
        snapshot = self._memory.building()
        self._keep_ways(snapshot, stamp_s)
        passages = [self._passage(snapshot, match) for match in _matches(snapshot)]
        rooms = [child for child in snapshot.children(ROOT_ID) if child.startswith("room_")]
        first = min(rooms, key=lambda room: (len(room), room))
        anchor = snapshot.parent(first)
        if anchor is None:
            return
        covariance = planar_covariance(anchor.covariance) + diagonal_covariance(1e-4, 1e-4, 1e-4)
        placed = lay_out(
            first,
            PlacedRoom(T_root_room=root_pose(snapshot, first), covariance=covariance),
            {room: root_pose(snapshot, room) for room in rooms},
            passages,
            {wall: self._wall_std_m(snapshot, *wall) for passage in passages for wall in passage.walls() or ()},
            self._settings.optimization,
        )
        self._write(snapshot, placed, stamp_s, anchor=first)

    def _changed(self, snapshot: Snapshot) -> bool:
        """Whether a door was joined or measured anew; rooms that come and go with their doors change nothing."""
        places = {edge.key: (snapshot.parent(edge.source), snapshot.parent(edge.target)) for edge in _matches(snapshot)}
        changed = any(self._places.get(key) != place for key, place in places.items())
        self._places.update(places)
        return changed

    def _keep_ways(self, snapshot: Snapshot, stamp_s: float) -> None:
        """Where nobody has told the way through a door, keep what the layout says now, or it would follow itself."""
        with self._memory.edit(LAYOUT_AGENT, stamp_s) as tx:
            for match in _matches(snapshot):
                if match.walked is None:
                    tx.put(walked_match(match, _way(snapshot, match), self._settings.walked_std_m))

    def _write(self, snapshot: Snapshot, placed: Mapping[str, PlacedRoom], stamp_s: float, *, anchor: str) -> None:
        """Say in the graph where rooms lie and how far their walls are shifted; of the anchor, only the latter."""
        with self._memory.edit(LAYOUT_AGENT, stamp_s) as tx:
            for room, place in placed.items():
                before = snapshot.parent(room)
                if before is None:
                    continue
                shifts_m = self._all_shifts(snapshot, room, place.wall_shifts_m)
                moved = replace(before, stamp_s=stamp_s, wall_shifts_m=shifts_m)
                if room != anchor:
                    covariance = spatial_covariance(place.covariance)
                    moved = replace(moved, T_source_target=place.T_root_room.to_se3(), covariance=covariance)
                if self._worth_writing(before, moved):
                    tx.put(moved)

    def _passage(self, snapshot: Snapshot, match: MatchEdge) -> Passage:
        """What the two sides of a door, and the way through it, say about its two rooms."""
        settings = self._settings
        door, other = snapshot.door(match.source), snapshot.door(match.target)
        near, far = door.rooms[0], other.rooms[0]
        T_near_door = Pose2.from_se3(snapshot.transform(near, door.id))
        T_far_other = Pose2.from_se3(snapshot.transform(far, other.id))
        walked = T_near_door.inverse() @ _way(snapshot, match) @ T_far_other
        std_m = match.walked_std_m or settings.walked_std_m
        vague = min(door.confidence, other.confidence) < settings.well_measured
        if vague or abs(wrap(walked.yaw_rad - np.pi)) > settings.not_parallel_rad:
            between, covariance = walked, diagonal_covariance(std_m, std_m, settings.walked_std_rad)
        else:
            between = back_to_back(-walked.y_m)
            along_m = float(np.hypot(self._station_std_m(snapshot, door.id), self._station_std_m(snapshot, other.id)))
            covariance = diagonal_covariance(along_m, std_m, settings.parallel_std_rad)
        return Passage(
            first=near,
            second=far,
            T_first_door=T_near_door,
            T_second_other=T_far_other,
            T_door_other=between,
            covariance=covariance,
            first_wall=_wall_of(snapshot, door.id),
            second_wall=_wall_of(snapshot, other.id),
        )

    def _worth_writing(self, before: RtEdge, after: RtEdge) -> bool:
        """Whether a room, or a wall of it, lies elsewhere than before by more than what does not matter."""
        change = Pose2.from_se3(before.T_source_target.inverse() @ after.T_source_target)
        way_m = float(np.hypot(change.x_m, change.y_m))
        shift_m = max(_difference_m(before.wall_shifts_m, after.wall_shifts_m), default=0.0)
        logger.debug("%s moves by %.1f mm in the layout, a wall by %.1f mm", after.target, 1e3 * way_m, 1e3 * shift_m)
        turned = abs(change.yaw_rad) >= self._settings.worth_writing_rad
        return max(way_m, shift_m) >= self._settings.worth_writing_m or turned

    def _all_shifts(self, snapshot: Snapshot, room: str, shifts_m: Mapping[int, float]) -> tuple[float, ...]:
        """One shift for every wall of a room; none at all where nothing that matters is shifted."""
        if max(map(abs, shifts_m.values()), default=0.0) < self._settings.worth_writing_m:
            return ()
        return tuple(shifts_m.get(wall, 0.0) for wall in range(len(snapshot.room(room).polygon_m)))

    def _wall_std_m(self, snapshot: Snapshot, room: str, wall: int) -> float:
        """How well a wall's offset was measured, by its ``rt`` edge; where that says nothing, as a wall in a room that
        is not rectilinear, which is the least that the room concept vouches for.
        """
        edge = snapshot.parent(wall_id_of(room, wall))
        std_m = float(np.sqrt(edge.covariance[1, 1])) if edge is not None else 0.0
        return max(std_m, self._settings.wall_floor_m) if std_m > 0.0 else self._settings.unknown_wall_std_m

    def _station_std_m(self, snapshot: Snapshot, door_id: str) -> float:
        """How well a door's station along its wall was measured, by its ``rt`` edge."""
        edge = snapshot.parent(door_id)
        std_m = float(np.sqrt(edge.covariance[0, 0])) if edge is not None else 0.0
        return float(np.hypot(std_m, self._settings.station_floor_m))


def _way(snapshot: Snapshot, match: MatchEdge) -> Pose2:
    """The far room in the near one as it was driven, or as the layout has it where nobody has told."""
    if match.walked is not None:
        return Pose2(*match.walked)
    near, far = snapshot.door(match.source).rooms[0], snapshot.door(match.target).rooms[0]
    return root_pose(snapshot, near).inverse() @ root_pose(snapshot, far)


def _difference_m(before_m: tuple[float, ...], after_m: tuple[float, ...]) -> list[float]:
    return [abs(before - after) for before, after in zip_longest(before_m, after_m, fillvalue=0.0)]


def _wall_of(snapshot: Snapshot, door_id: str) -> int | None:
    """Index of the wall that a door hangs from; ``None`` when it hangs from the room itself."""
    edge, room = snapshot.parent(door_id), snapshot.door(door_id).rooms[0]
    walls = [wall_id_of(room, wall) for wall in range(len(snapshot.room(room).polygon_m))]
    return walls.index(edge.source) if edge is not None and edge.source in walls else None


def _matches(snapshot: Snapshot) -> list[MatchEdge]:
    """All match edges, in the order of their doors."""
    return [
        edge
        for door in snapshot.of_type(DoorNode)
        for edge in snapshot.edges_from(door.id, EdgeType.MATCH)
        if isinstance(edge, MatchEdge)
    ]
