"""The relocalization agent: notices that the robot is not where it believes to be, says so, and finds out where it is.

Somebody may pick the robot up and set it down elsewhere. Its wheels do not tell, so only what it sees does. While it is
lost it hangs from the root, in no room: nothing is mapped, nothing is driven to. A place is believed once two views in
a row single it out; between places that look the same nothing is decided. Where nothing fits, and nobody carried the
robot, it is the room that was wrong: it is taken back, and the room concept measures it again.
"""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from perception.crossing import door_being_crossed, find_robot, lose_robot, take_back
from perception.geometry.planar import Pose2
from perception.lidar.slice import OutlineSlicer
from perception.localization.continuity import ContinuitySettings, continuity
from perception.localization.doorways import doorway_fit, doorway_model
from perception.localization.fitness import FitnessMonitor, FitnessSettings
from perception.localization.global_localization import (
    GlobalLocalizationSettings,
    Hypothesis,
    Sight,
    decide,
    hypotheses,
    known_rooms,
)
from perception.localization.measurement_model import fit_of
from perception.localization.robot_pose import robot_pose_at
from perception.localization.room_model import room_model
from perception.ports import LidarScan
from perception.sensing import SensorBuffer
from scene_graph.edges import EdgeKey, EdgeType, HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class RelocalizationSettings:
    """Pace of the search, and all that the agent works with."""

    search_every_s: float = 0.5
    """Between searches. Chosen: every fifth scan."""
    settle_s: float = 1.5
    """After this long without a decision the robot looks around; one that was not carried doubts the room first, as
    from elsewhere it could not. Chosen: three searches."""
    looks: int = 2
    """Most often that it looks around. Chosen."""
    step_m: float = 0.5
    """Between views that are kept. Chosen: nearer ones show the same."""
    sights: int = 5
    """Views that are kept at most. Chosen: their odometry drifts apart."""
    continuous: float = 0.55
    """Share of a view that the one before must have shown. Chosen: about half."""
    soon_s: float = 0.6
    """How much earlier the one before may be. Chosen: some scans may be missing."""
    breaks: int = 2
    """Views in a row that do not agree with the last good one, from which on the robot was carried. Chosen: one
    may be chance."""
    blame_s: float = 6.0
    """After this long without any place that fits, a robot that was not carried doubts the room. Chosen."""
    trust_s: float = 30.0
    """After this long it goes on from where its wheels say. Chosen."""
    worth_naming: float = 0.01
    """Least probability of a place that is spoken of. Chosen."""
    worth_writing: float = 0.05
    """Least change of the confidence that is written. Chosen: everybody who reads the graph is told of each."""
    surely_inside_m: float = 0.3
    """From a room's outline: less may be a doorway, or an error of the pose."""
    fitness: FitnessSettings = field(default_factory=FitnessSettings)
    localization: GlobalLocalizationSettings = field(default_factory=GlobalLocalizationSettings)
    continuity: ContinuitySettings = field(default_factory=ContinuitySettings)


class Relocalization:
    """Agent that watches over the robot's place in the graph.

    It acts on ``RobotNode.localized``: whoever sets it to false (``crossing.lose_robot``), for instance because a
    stored building was restored and the robot may stand anywhere in it, gets the place found. Rooms that are not loaded
    are searched too.

    Attributes:
        found: places that the last search could not rule out, most likely first.
    """

    name = "relocalization"

    def __init__(
        self,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        *,
        settings: RelocalizationSettings = RelocalizationSettings(),
        slicer: OutlineSlicer | None = None,
        period_s: float = 0.2,
    ) -> None:
        self.period_s = period_s
        self.found: list[Hypothesis] = []
        self._memory, self._buffer = memory, buffer
        self._settings = settings
        self._slicer = slicer or OutlineSlicer()
        self._monitor = FitnessMonitor(settings=settings.fitness)
        self._scan_stamp_s = -np.inf
        self._search = _Search()
        self._view = _View()
        self._blamed: set[str] = set()

    async def step(self, stamp_s: float) -> None:
        """Judge the newest scan where the robot believes to be, or search for where it was taken."""
        scan, snapshot = self._buffer.scan, self._memory.snapshot()
        robot = snapshot.robot
        if scan is None or robot is None or scan.stamp_s <= self._scan_stamp_s or not self._buffer.odometry:
            return
        self._scan_stamp_s = scan.stamp_s
        sight = self._sight(scan)
        if robot.localized:
            self._watch(snapshot, sight, stamp_s)
        elif not self._blames_room(snapshot, sight, stamp_s):
            await self._find_out(sight, stamp_s)

    def _sight(self, scan: LidarScan) -> Sight:
        T_odom_base = Pose2.from_se3(self._buffer.odometry_near(scan.stamp_s))
        return Sight(scan=scan, outline=self._slicer.cut(scan), T_odom_base=T_odom_base)

    # While the robot believes to know where it is.

    def _watch(self, snapshot: Snapshot, sight: Sight, stamp_s: float) -> None:
        stamp_scan_s = sight.scan.stamp_s
        pose = robot_pose_at(snapshot, self._buffer, stamp_scan_s)
        room = room_model(snapshot, pose.parent) if pose is not None else None
        depth_m = room.depth_m(pose.T_parent_base.position_m) if pose is not None and room is not None else -1.0
        if pose is None or room is None or depth_m < 0.0 or door_being_crossed(snapshot) is not None:
            self._monitor.rest(stamp_scan_s)
        else:
            doors = doorway_model(snapshot, room)
            settings = self._settings.localization
            fit = fit_of(sight.outline, room.walls, doors.openings, pose.T_parent_base, settings.model)
            doorways = doorway_fit(sight.scan, doors, pose.T_parent_base, settings.doorways)
            self._monitor.add(room.room_id, depth_m, fit, doorways, stamp_scan_s)
        carried = self._view.changed(sight, self._settings)
        if self._view.broken:
            self._monitor.startle()
        if (carried or self._monitor.lost) and _knows_a_room(self._memory.building()):
            self._lose(snapshot.current_room, stamp_s, carried=carried)
        else:
            self._doubt(snapshot, stamp_s)

    def _doubt(self, snapshot: Snapshot, stamp_s: float) -> None:
        """Let the others know how far the pose is in doubt."""
        robot, confidence = snapshot.robot, self._monitor.confidence
        if robot is None or robot.confidence == confidence:
            return
        if confidence in {0.0, 1.0} or abs(robot.confidence - confidence) > self._settings.worth_writing:
            with self._memory.edit(self.name, stamp_s) as tx:
                tx.put(replace(tx.snapshot.robot or robot, confidence=confidence))

    def _lose(self, room_id: str | None, stamp_s: float, *, carried: bool) -> None:
        with self._memory.edit(self.name, stamp_s) as tx:
            lose_robot(tx)
        self._search, self._view = _Search(), _View()
        self._search.doubted = None if carried else room_id
        logger.warning("I do not know where I am: what I see is not %s", room_id, extra={"room": room_id})

    # While it does not.

    def _blames_room(self, snapshot: Snapshot, sight: Sight, stamp_s: float) -> bool:
        """After a while without a decision, let a robot that was not carried stay where it was.

        If what it sees does not even fit there, the room is taken back; once for each room. A robot that has left the
        room meanwhile, through a door, would else wait for ever in one that it does not know.
        """
        search = self._search
        if self._view.changed(sight, self._settings):
            search.doubted, search.looks = None, 0
        room = snapshot.get(search.doubted) if search.doubted is not None else None
        waited = search.since_s is not None and stamp_s >= search.since_s + self._settings.blame_s
        if not waited or not isinstance(room, RoomNode):
            return False
        T_room_base = Pose2.from_se3(snapshot.transform(room.id, ROBOT_ID))
        here = [replace(one, room_id=room.id, T_room_base=T_room_base) for one in self.found]
        within = self._settings.localization
        fits = any(one.same_as(place, within) for one, place in zip(self.found, here, strict=True))
        model = room_model(snapshot, room.id)
        inside = model is not None and model.depth_m(T_room_base.position_m) > self._settings.surely_inside_m
        blames = not fits and inside and room.id not in self._blamed
        trusts = search.since_s is not None and stamp_s >= search.since_s + self._settings.trust_s
        if not fits and (self.found or not (blames or trusts)):
            return False
        with self._memory.edit(self.name, stamp_s) as tx:
            find_robot(tx, room.id, T_room_base, sight.scan.stamp_s)
            if blames:
                take_back(tx, room.id)
            if _LOOK in snapshot.edges:
                tx.remove(_LOOK)
        self._monitor.forget_doubt()
        self._search = _Search()
        if blames:
            self._blamed.add(room.id)
            logger.info("nobody carried me: %s is not as I took it to be", room.id, extra={"room": room.id})
        elif not fits:
            logger.info("nobody carried me: I go on from where my wheels say", extra={"room": room.id})
        return True

    async def _find_out(self, sight: Sight, stamp_s: float) -> None:
        search, settings = self._search, self._settings
        if search.since_s is None:
            search.since_s = stamp_s
        if stamp_s < search.next_s - 1e-6:
            return
        search.next_s = stamp_s + settings.search_every_s
        rooms = known_rooms(self._memory.building(), self._monitor.usual_shares())
        self.found = await asyncio.to_thread(hypotheses, [*search.sights, sight], rooms, settings.localization)
        if not self.found and search.sights:
            search.sights, search.decided = (), None
            return
        decided = decide(self.found, settings.localization)
        if decided is None:
            search.decided = None
            self._go_on(sight, stamp_s)
        elif search.confirms(decided, sight, settings.localization):
            self._restore(decided, sight, stamp_s)
        else:
            search.decided = (decided, sight.T_odom_base)

    def _go_on(self, sight: Sight, stamp_s: float) -> None:
        """Keep the view, say what is possible, and look around when that may help."""
        search, settings = self._search, self._settings
        search.keep(sight, settings)
        names = sorted({one.room_id for one in self.found if one.weight > settings.worth_naming})
        if names != search.named:
            search.named = names
            logger.info("this could be %s", " or ".join(names) if names else "no room that I know")
        patience_s = settings.settle_s + (settings.blame_s if search.doubted is not None else 0.0)
        if search.since_s is not None and stamp_s >= search.since_s + patience_s:
            self._look_around(stamp_s)

    def _look_around(self, stamp_s: float) -> None:
        """Ask for the robot, to see from elsewhere what is hidden from here."""
        edge = self._memory.snapshot().edges.get(_LOOK)
        ended = isinstance(edge, HasIntentionEdge) and edge.status in (IntentionStatus.DONE, IntentionStatus.FAILED)
        if edge is not None and not ended:
            return
        with self._memory.edit(self.name, stamp_s) as tx:
            if edge is not None:
                tx.remove(_LOOK)
            elif self._search.looks < self._settings.looks:
                self._search.looks += 1
                tx.put(
                    HasIntentionEdge(
                        source=ROBOT_ID,
                        target=ROBOT_ID,
                        agent=self.name,
                        action=IntentionAction.LOOK,
                        priority=Priority.LOOK_AROUND,
                        proposed_s=stamp_s,
                    )
                )

    def _restore(self, decided: Hypothesis, sight: Sight, stamp_s: float) -> None:
        with self._memory.edit(self.name, stamp_s) as tx:
            find_robot(tx, decided.room_id, decided.T_room_base, sight.scan.stamp_s)
            if _LOOK in tx.snapshot.edges:
                tx.remove(_LOOK)
        self._monitor.forget_doubt()
        self._search = _Search()
        logger.info("I am in %s", decided.room_id, extra={"room": decided.room_id, "fit": decided.fit.explained})


_LOOK = EdgeKey(EdgeType.HAS_INTENTION, ROBOT_ID, ROBOT_ID, Relocalization.name)


def _knows_a_room(building: Snapshot) -> bool:
    return any(room.status is not RoomStatus.TEMPORARY for room in building.of_type(RoomNode))


@dataclass(kw_only=True)
class _View:
    """The last view that agreed with the one before it, and how many have not since."""

    last: Sight | None = None
    broken: int = 0

    def changed(self, sight: Sight, settings: RelocalizationSettings) -> bool:
        """Whether what is seen is another place than a moment ago, for long enough to be sure."""
        before = self.last
        late = before is None or sight.scan.stamp_s > before.scan.stamp_s + settings.soon_s
        if late or before is None or continuity(before, sight, settings.continuity) >= settings.continuous:
            self.last, self.broken = sight, 0
        else:
            self.broken += 1
        return self.broken >= settings.breaks


@dataclass(kw_only=True)
class _Search:
    """One search for the robot's place.

    ``sights``: earlier views from other spots. ``decided``: what the last search decided, with the odometry then.
    ``named``: the rooms that were said to be possible. ``doubted``: the room that the robot was in, unless it was
    carried.
    """

    since_s: float | None = None
    next_s: float = -np.inf
    sights: Sequence[Sight] = ()
    decided: tuple[Hypothesis, Pose2] | None = None
    named: list[str] | None = None
    looks: int = 0
    doubted: str | None = None

    def keep(self, sight: Sight, settings: RelocalizationSettings) -> None:
        """Keep a view from a new spot; the oldest makes room."""
        if not any(sight.T_odom_base.distance_m(other.T_odom_base) < settings.step_m for other in self.sights):
            self.sights = (*self.sights, sight)[-settings.sights :]

    def confirms(self, decided: Hypothesis, sight: Sight, settings: GlobalLocalizationSettings) -> bool:
        """Whether the search before this one decided for the same place, given how the robot moved since."""
        if self.decided is None:
            return False
        before, T_odom_before = self.decided
        moved = T_odom_before.inverse() @ sight.T_odom_base
        return decided.same_as(replace(before, T_room_base=before.T_room_base @ moved), settings)
