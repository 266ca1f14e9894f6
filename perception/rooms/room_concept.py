"""The room concept agent (Concepts, section 3.5.1): from "no room explains what I see" to a room that stands."""

from __future__ import annotations

import asyncio
import logging
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from perception.crossing import OUTDOORS, door_being_crossed, given_up, is_lost, taken_back, uncrossed
from perception.geometry.planar import Pose2
from perception.lidar.range_noise import CalmingSettings, calmed
from perception.lidar.slice import OutlineSlicer
from perception.lifecycle import LifeCycle, Verdict
from perception.localization.robot_pose import RobotPose, robot_pose_at
from perception.localization.room_model import room_model
from perception.ports import RobotShape
from perception.rooms.maintenance.revision import let_stand, revise_room, same_place
from perception.rooms.maintenance.room_maintenance import RoomMaintenance, RoomMaintenanceSettings
from perception.rooms.survey.insertion import insert_room, propose_visit, withdraw
from perception.rooms.survey.instance import MeasuredRoom
from perception.rooms.survey.survey import Survey, SurveySettings
from perception.sensing import SensorBuffer, scan_points_between
from scene_graph.edges import HasIntentionEdge, IntentionStatus
from scene_graph.identifiers import next_id
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]

logger = logging.getLogger(__name__)

UNMEASURABLE = "the room behind it could not be measured"


@dataclass(frozen=True, kw_only=True)
class RoomSettings:
    """Patience of the room concept, and all that it works with."""

    attempts: int = 8
    """Vantage points before a room is taken as it is. Chosen."""
    look_s: float = 1.5
    """How long it looks around at each. Chosen: fifteen scans."""
    returns: int = 4
    """Times that the robot may come back through a door without a room behind it before it is given up. Chosen."""
    well_inside_m: float = 0.35
    """Depth in the known room from which on the robot is back in it: more than a doorway."""
    stranded_s: float = 4.0
    """After this long without a way further into a room it is taken as it looks. Chosen."""
    lowest_m: float = 0.10
    """Returns below are floor, not obstacles: five standard deviations of the usual range noise."""
    usual_height_m: float = 2.5
    """Of a room whose walls' top nobody has seen."""
    calming: CalmingSettings = field(default_factory=CalmingSettings)
    survey: SurveySettings = field(default_factory=SurveySettings)
    maintenance: RoomMaintenanceSettings = field(default_factory=RoomMaintenanceSettings)


class RoomConcept:
    """Agent that measures a room where none explains the scan, and puts it into the graph."""

    name = "room_concept"

    def __init__(
        self,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        *,
        settings: RoomSettings = RoomSettings(),
        shape: RobotShape = RobotShape(),
        slicer: OutlineSlicer | None = None,
        period_s: float = 0.1,
    ) -> None:
        self.period_s = period_s
        self._memory = memory
        self._buffer = buffer
        self._settings, self._shape = settings, shape
        self._slicer = slicer or OutlineSlicer()
        self._survey = self._new_survey()
        self._maintenance = RoomMaintenance(self.name, memory, settings.maintenance)
        self._scan_stamp_s = -np.inf
        self._stamp_s = 0.0
        self._arrived_s: dict[float, float] = {}
        self._stranded_s = np.inf
        self._returns: dict[str, int] = {}
        self._life = LifeCycle(
            "room",
            explain=self._explain,
            initialize=self._initialize,
            maintain=self._maintain,
            affordances=self._affordances,
        )

    async def step(self, stamp_s: float) -> None:
        """Take in the newest scan, fit when enough is new, and live one tick."""
        self._stamp_s = stamp_s
        self._observe(self._memory.snapshot())
        if _room_needed(self._memory.snapshot()) and self._survey.due(stamp_s):
            await asyncio.to_thread(self._survey.solve, stamp_s)
        self._life.tick()

    def _new_survey(self) -> Survey:
        return Survey(self._settings.survey, self._shape)

    def _observe(self, snapshot: Snapshot) -> None:
        """Collect a view when the robot stands in no known room: before the first, or beyond the current one."""
        scan = self._buffer.scan
        if scan is None or scan.stamp_s <= self._scan_stamp_s:
            return
        self._scan_stamp_s = scan.stamp_s
        pose = robot_pose_at(snapshot, self._buffer, scan.stamp_s)
        if pose is None or is_lost(snapshot):
            return
        if self._survey.started and self._survey.parent != pose.parent:
            self._survey = self._new_survey()
        model = room_model(snapshot, pose.parent)
        if model is None or not model.contains(pose.T_parent_base.position_m):
            self._survey.known = model
            self._survey.add(self._slicer.cut(scan), pose)
            return
        if self._survey.started and model.depth_m(pose.T_parent_base.position_m) > self._settings.well_inside_m:
            self._abandon(snapshot)
        if door_being_crossed(snapshot) is None:
            self._maintenance.observe(snapshot, model, self._slicer.cut(scan), pose, self._stamp_s)

    # The four stages of the life cycle.

    def _explain(self) -> Verdict:
        return Verdict.NO if _room_needed(self._memory.snapshot()) else Verdict.DONE

    def _initialize(self) -> Verdict:
        snapshot = self._memory.snapshot()
        pose = robot_pose_at(snapshot, self._buffer, self._scan_stamp_s)
        if pose is None or not self._survey.started:
            return Verdict.BUSY
        if self._survey.outdoors and door_being_crossed(snapshot) is not None:
            return self._give_up(snapshot, OUTDOORS)
        if self._survey.sufficient:
            return self._conclude(snapshot, pose)
        intention = own_intention(snapshot)
        if intention is None:
            return self._begin(snapshot, pose)
        if intention.status in (IntentionStatus.DONE, IntentionStatus.FAILED):
            return self._arrived(snapshot, pose, intention)
        return Verdict.BUSY

    def _maintain(self) -> Verdict:
        """A room that stands is kept, unless what is seen contradicts it: then it is taken back and measured again."""
        if not _room_needed(self._memory.snapshot()) and self._maintenance.run(self._stamp_s):
            self._survey = self._new_survey()
        return Verdict.DONE

    def _affordances(self) -> Verdict:
        """Withdraw a visit to a room that needs no measuring any more."""
        snapshot = self._memory.snapshot()
        intention = own_intention(snapshot)
        if intention is not None and not _room_needed(snapshot):
            self._abandon(snapshot)
        return Verdict.DONE

    # Steps of the initialization.

    def _begin(self, snapshot: Snapshot, pose: RobotPose) -> Verdict:
        """Propose to visit what looks like a room; where for a while no way leads on, take it as it looks from here."""
        begun = self._propose(pose, next_id(snapshot, "room"))
        if begun is not None:
            self._stranded_s = np.inf
            return begun
        self._stranded_s = min(self._stranded_s, self._stamp_s)
        if self._stamp_s < self._stranded_s + self._settings.stranded_s:
            return Verdict.BUSY
        self._stranded_s = np.inf
        logger.info("no way leads further into what looks like a room")
        return self._conclude(snapshot, pose)

    def _arrived(self, snapshot: Snapshot, pose: RobotPose, intention: HasIntentionEdge) -> Verdict:
        """At a vantage point, or unable to get there: take the room as it is now, or look from elsewhere."""
        arrived_s = self._arrived_s.setdefault(intention.proposed_s, self._stamp_s)
        if self._survey.closed:
            return self._conclude(snapshot, pose)
        if self._stamp_s < arrived_s + self._settings.look_s:
            return Verdict.BUSY
        if len(self._survey.places) >= self._settings.attempts:
            return self._conclude(snapshot, pose)
        return self._propose(pose, intention.target) or self._conclude(snapshot, pose)

    def _propose(self, pose: RobotPose, room_id: str) -> Verdict | None:
        place = self._place_outside(self._memory.snapshot(), pose)
        if place is None:
            return None
        with self._memory.edit(self.name, self._stamp_s) as tx:
            propose_visit(
                tx, room_id, parent=pose.parent, T_parent_place=pose.T_parent_base @ place, stamp_s=self._stamp_s
            )
        logger.info("looks like a room; going to measure it", extra={"room": room_id})
        return Verdict.BUSY

    def _place_outside(self, snapshot: Snapshot, pose: RobotPose) -> Pose2 | None:
        """The next vantage point that is not in the room which the robot came from, base frame."""
        known, obstacles = room_model(snapshot, pose.parent), self._obstacles_base()
        while (place := self._survey.next_place(obstacles, pose)) is not None:
            if known is None or not known.contains((pose.T_parent_base @ place).position_m):
                return place
        return None

    def _conclude(self, snapshot: Snapshot, pose: RobotPose) -> Verdict:
        """The room stands, as permanent when it is closed, else as partial; nothing at all gives the door up."""
        self._survey.decide()
        room, doubted = self._survey.measured(pose), taken_back(snapshot)
        if doubted is not None:
            return self._revise(doubted, room)
        if room is None:
            return self._give_up(snapshot, OUTDOORS if self._survey.outdoors else UNMEASURABLE)
        intention = own_intention(snapshot)
        room_id = intention.target if intention else next_id(snapshot, "room")
        with self._memory.edit(self.name, self._stamp_s) as tx:
            insert_room(
                tx,
                room,
                room_id,
                status=self._status,
                height_m=self._height_m,
                stamp_s=self._scan_stamp_s,
                settings=self._settings.survey.instance,
            )
        self._say("stands", room_id, room)
        self._survey = self._new_survey()
        return Verdict.DONE

    def _revise(self, doubted: RoomNode, room: MeasuredRoom | None) -> Verdict:
        """The room that was taken back stands as it was measured now, or for want of that as it was."""
        if room is not None and not same_place(doubted, room, self._settings.maintenance.revision):
            logger.info("what was measured is not %s; it stands as it was", doubted.id, extra={"room": doubted.id})
            room = None
        with self._memory.edit(self.name, self._stamp_s) as tx:
            if room is None:
                let_stand(tx, doubted)
            else:
                revise_room(
                    tx,
                    room,
                    doubted.id,
                    status=self._status,
                    height_m=self._height_m,
                    stamp_s=self._scan_stamp_s,
                    settings=self._settings.maintenance.revision,
                    instance=self._settings.survey.instance,
                )
        if room is not None:
            self._say("is revised", doubted.id, room)
        self._survey = self._new_survey()
        return Verdict.DONE

    @property
    def _status(self) -> RoomStatus:
        return RoomStatus.PERMANENT if self._survey.closed else RoomStatus.PARTIAL

    @property
    def _height_m(self) -> float:
        return self._slicer.ceiling_m or self._slicer.wall_top_m or self._settings.usual_height_m

    def _say(self, happened: str, room_id: str, room: MeasuredRoom) -> None:
        sides = np.ptp(room.polygon, axis=0)
        logger.info(
            "%s %s: %.2f m x %.2f m, %d walls, %s",
            room_id,
            happened,
            sides[0],
            sides[1],
            len(room.polygon),
            self._status,
            extra={"room": room_id, "views": len(self._survey.fit.views) if self._survey.fit else 0},
        )

    def _give_up(self, snapshot: Snapshot, reason: str) -> Verdict:
        door = door_being_crossed(snapshot)
        if door is None:
            return Verdict.BUSY
        with self._memory.edit(self.name, self._stamp_s) as tx:
            tx.put(given_up(door, reason))
            withdraw(tx)
        logger.info("gave up on %s: %s", door.id, reason, extra={"door": door.id})
        self._survey = self._new_survey()
        return Verdict.NO

    def _abandon(self, snapshot: Snapshot) -> None:
        """The robot is back in a known room: what was begun is forgotten, and the door may be crossed again."""
        door = door_being_crossed(snapshot)
        with self._memory.edit(self.name, self._stamp_s) as tx:
            withdraw(tx)
            if door is not None:
                self._returns[door.id] = self._returns.get(door.id, 0) + 1
                again = self._returns[door.id] < self._settings.returns
                tx.put(uncrossed(door) if again else given_up(door, UNMEASURABLE))
        self._survey = self._new_survey()

    def _obstacles_base(self) -> Array:
        """(N, 2) returns at the height of the robot's body."""
        scan = self._buffer.scan
        if scan is None:
            return np.empty((0, 2))
        settings = self._settings
        ranges_m = calmed(scan.ranges_m.astype(np.float64), settings.calming).astype(np.float32)
        return scan_points_between(replace(scan, ranges_m=ranges_m), settings.lowest_m, self._shape.height_m)[:, :2]


def own_intention(snapshot: Snapshot) -> HasIntentionEdge | None:
    """The room concept's visit, if it has proposed one."""
    return next((edge for edge in snapshot.intentions() if edge.agent == RoomConcept.name), None)


def _room_needed(snapshot: Snapshot) -> bool:
    """Whether the robot is where no room stands: at the very start, or behind a door that is being crossed."""
    edge = snapshot.parent(ROBOT_ID)
    if edge is None or is_lost(snapshot):
        return False
    room = snapshot.get(edge.source)
    if not isinstance(room, RoomNode) or room.status is RoomStatus.TEMPORARY:
        return True
    return door_being_crossed(snapshot) is not None
