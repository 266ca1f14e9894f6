"""Keeping known doors true: where they are, how wide, and whether they are open."""

from __future__ import annotations

import logging
from dataclasses import dataclass, replace

from perception.crossing import CLOSED_REASON, DOOR_AGENT, given_up, match_of, uncrossed
from perception.doors.dual_measurement import better_dual, completed, seen_through
from perception.doors.insertion import (
    DoorNodeSettings,
    door_label,
    hang,
    is_suspicion,
    measured_confidence,
    seen_confidence,
)
from perception.doors.posts import MeasuredGap
from perception.doors.room_evidence import Span
from perception.doors.scene import Scene
from scene_graph.identifiers import wall_id_of
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import CrossingStatus, DoorNode, DoorState
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class DoorMaintenanceSettings:
    """When a known door is written anew."""

    votes: int = 5
    """Scans in a row that change open to closed or back. Chosen: half a second; somebody may walk through."""
    refine_every_s: float = 1.0
    """Between refinements of one door. Chosen: ten scans more."""
    changed_m: float = 0.004
    """Least change worth writing. Chosen: half of what counts as measured."""
    vanished_s: float = 4.0
    """How long a provisional door may show no gap. Chosen."""
    forget_s: float = 60.0
    """How long a door between two known rooms counts as closed after it was last seen so. Chosen: people open doors,
    and the robot may go and look."""
    forget_every_s: float = 1.0
    """Between looks at which of them are due. Chosen: for speed."""


class DoorMaintenance:
    """Refines doors that are not measured well yet, and follows their state."""

    def __init__(
        self,
        memory: WorkingMemory,
        settings: DoorMaintenanceSettings = DoorMaintenanceSettings(),
        nodes: DoorNodeSettings = DoorNodeSettings(),
    ) -> None:
        self._memory = memory
        self._settings, self._nodes = settings, nodes
        self._votes: dict[str, int] = {}
        self._refined_s: dict[str, float] = {}
        self._gap_seen_s: dict[str, float] = {}
        self._learned: dict[str, tuple[int, int, int]] = {}
        self._closed_s: dict[str, float] = {}
        self._forgot_s = -1e9

    def run(self, scene: Scene) -> None:
        """Look after every door of the room once."""
        known = scene.doors()
        standing = [(wall, span) for door, wall, span in known if not door.provisional]
        for door, wall, span in known:
            if door.provisional and any(wall == other and place.covers(span) for other, place in standing):
                self._remove(door, scene.stamp_s)
            elif door.provisional or door.confidence < self._nodes.well_measured:
                self._refine(scene, door, wall, span)
            if not door.provisional:
                self._follow_state(scene, door, wall, span)
        self._forget(scene)

    def learn(self, scene: Scene) -> None:
        """Complete the doors of a room that the robot may have left by what is known of them from the rooms behind."""
        for door, wall, span in scene.doors():
            dual = better_dual(scene.snapshot, door, self._nodes) if not door.provisional else None
            if dual is None:
                continue
            known = seen_through(scene, wall, dual)
            told = (scene.evidence.scans, round(known.center_m * 1000.0), round(known.width_m * 1000.0))
            if self._learned.get(door.id) != told:
                self._learned[door.id] = told
                gap = scene.evidence.gap_at(wall, span)
                self._complete(scene, door, wall, span, scene.evidence.measure(wall, gap) if gap is not None else None)

    def _complete(self, scene: Scene, door: DoorNode, wall: int, span: Span, measured: MeasuredGap | None) -> None:
        """Write what both sides together know of a permanent door, where that is more than was known."""
        dual = better_dual(scene.snapshot, door, self._nodes)
        if dual is not None:
            sharp_m = scene.evidence.settings.posts.sharp_m
            measured = completed(measured, seen_through(scene, wall, dual), self._nodes, sharp_m=sharp_m)
            more = measured.width_m == dual.width_m
        else:
            more = measured is not None and self._tells_more(measured, door)
        if measured is not None and (measured.posts == 2 or more):
            self._write(scene, door, wall, span, measured, door.state)

    def _tells_more(self, measured: MeasuredGap, door: DoorNode) -> bool:
        """Whether an opening with an unmeasured end is seen to be wider than it was thought to be: it only can be."""
        return measured_confidence(measured, self._nodes) >= door.confidence and measured.width_m > door.width_m

    def _refine(self, scene: Scene, door: DoorNode, wall: int, span: Span) -> None:
        settings = self._settings
        if scene.stamp_s < self._refined_s.get(door.id, -1e9) + settings.refine_every_s - 1e-6:
            return
        self._refined_s[door.id] = scene.stamp_s
        gap = scene.evidence.gap_at(wall, span)
        if gap is None and is_suspicion(door):
            if not any(span.overlaps(hidden) for hidden in scene.evidence.unseen(wall)):
                self._remove(door, scene.stamp_s)
            return
        if gap is None:
            seen_s = self._gap_seen_s.setdefault(door.id, scene.stamp_s)
            if door.provisional and scene.stamp_s > seen_s + settings.vanished_s:
                self._remove(door, scene.stamp_s)
            return
        self._gap_seen_s[door.id] = scene.stamp_s
        measured = scene.evidence.measure(wall, gap)
        if is_suspicion(door) and measured.width_m < self._nodes.sizes.narrowest_m:
            return
        if door.provisional:
            self._write(scene, door, wall, span, measured, gap.state)
        else:
            self._complete(scene, door, wall, span, measured)

    def _write(
        self, scene: Scene, door: DoorNode, wall: int, span: Span, measured: MeasuredGap, state: DoorState
    ) -> None:
        confidence = max(door.confidence, measured_confidence(measured, self._nodes))
        if door.provisional:
            confidence = seen_confidence(measured, self._nodes)
        change_m = max(abs(measured.center_m - span.center_m), abs(measured.width_m - span.width_m))
        if change_m < self._settings.changed_m and confidence == door.confidence and state is door.state:
            return
        edge = hang(door.id, wall_id_of(scene.room.room_id, wall), scene.wall_length_m(wall), measured, scene.stamp_s)
        label = door_label(measured.width_m, self._nodes)
        with self._memory.edit(DOOR_AGENT, scene.stamp_s) as tx:
            tx.put(replace(door, width_m=measured.width_m, confidence=confidence, label=label, state=state), edge)

    def _remove(self, door: DoorNode, stamp_s: float) -> None:
        logger.info("%s is no door of its own", door.id, extra={"door": door.id})
        with self._memory.edit(DOOR_AGENT, stamp_s) as tx:
            tx.remove(door.id)

    def _follow_state(self, scene: Scene, door: DoorNode, wall: int, span: Span) -> None:
        looks_open = scene.evidence.looks_open(wall, span)
        if looks_open is None:
            return
        seen = DoorState.OPEN if looks_open else DoorState.CLOSED
        if not looks_open:
            self._closed_s.update((same.id, scene.stamp_s) for same in _both_sides(scene.snapshot, door.id))
        self._votes[door.id] = 0 if seen is door.state else self._votes.get(door.id, 0) + 1
        if self._votes[door.id] < self._settings.votes:
            return
        self._votes[door.id] = 0
        logger.info("%s is %s", door.id, seen, extra={"door": door.id})
        with self._memory.edit(DOOR_AGENT, scene.stamp_s) as tx:
            for same in _both_sides(tx.snapshot, door.id):
                tx.put(_in_state(same, seen))

    def _forget(self, scene: Scene) -> None:
        """Closed doors between known rooms that nobody has looked at for a while may be open again."""
        if scene.stamp_s < self._forgot_s + self._settings.forget_every_s - 1e-6:
            return
        self._forgot_s = scene.stamp_s
        for door in scene.snapshot.of_type(DoorNode):
            if door.state is not DoorState.CLOSED or match_of(scene.snapshot, door.id) is None:
                continue
            seen_s = self._closed_s.setdefault(door.id, scene.stamp_s)
            if scene.stamp_s > seen_s + self._settings.forget_s:
                logger.info("%s may be open again", door.id, extra={"door": door.id})
                with self._memory.edit(DOOR_AGENT, scene.stamp_s) as tx:
                    tx.put(replace(tx.snapshot.door(door.id), state=DoorState.UNKNOWN))


def _both_sides(snapshot: Snapshot, door_id: str) -> list[DoorNode]:
    """The door as known from this room and, when it is, from the other."""
    other = match_of(snapshot, door_id)
    return [snapshot.door(door_id), *([snapshot.door(other)] if other is not None else [])]


def _in_state(door: DoorNode, state: DoorState) -> DoorNode:
    """The door in a new state. A closed door that nobody crossed is given up until it opens again."""
    door = replace(door, state=state)
    if state is DoorState.CLOSED and door.crossing is CrossingStatus.UNCROSSED:
        return given_up(door, CLOSED_REASON)
    if state is DoorState.OPEN and door.crossing is CrossingStatus.GIVEN_UP and door.crossing_reason == CLOSED_REASON:
        return uncrossed(door)
    return door
