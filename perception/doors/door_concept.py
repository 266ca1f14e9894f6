"""The door concept agent (Concepts, section 3.5.2): gaps in the walls of the current room become doors."""

from __future__ import annotations

import logging
from dataclasses import dataclass, field

import numpy as np

from perception.crossing import DOOR_AGENT, door_being_crossed, in_doubt, match_of
from perception.doors.dual_measurement import better_dual
from perception.doors.insertion import DoorNodeSettings, free_door_id, is_suspicion, put_provisional, put_suspected
from perception.doors.intentions import DoorIntentions, IntentionSettings
from perception.doors.maintenance import DoorMaintenance, DoorMaintenanceSettings
from perception.doors.room_evidence import RoomEvidence, RoomEvidenceSettings
from perception.doors.scene import Scene
from perception.lifecycle import LifeCycle, Verdict
from perception.localization.robot_pose import robot_pose_at
from perception.localization.room_model import room_model
from perception.sensing import SensorBuffer
from scene_graph.identifiers import wall_id_of
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class DoorSettings:
    """When a gap is taken for a door, and what the parts of the agent are tuned to."""

    seen_s: float = 1.0
    """How long a gap without two posts must be seen to be proposed. Chosen: ten scans."""
    clear_m: float = 0.2
    """How far from any wall the robot must be for its scans to count. Chosen: in a doorway they are of two rooms."""
    detect_every_s: float = 0.5
    """Between looks for gaps. Chosen: for speed."""
    settled_scans: int = 20
    """How long a room is watched before its unseen walls are. Chosen: two seconds."""
    pose_std_m: float = 0.05
    """How well localized the robot must be for its scans to count. Chosen: two parts of a wall's evidence."""
    same_gap_m: float = 0.3
    """Gaps whose middles are in one cell of this length are one. Chosen: less than a door."""
    evidence: RoomEvidenceSettings = field(default_factory=RoomEvidenceSettings)
    nodes: DoorNodeSettings = field(default_factory=DoorNodeSettings)
    intentions: IntentionSettings = field(default_factory=IntentionSettings)
    maintenance: DoorMaintenanceSettings = field(default_factory=DoorMaintenanceSettings)


class DoorConcept:
    """Agent that finds doors in the walls of the current room, measures them, and asks for them to be crossed.

    Dormant where no room stands, and while the room behind a door is being measured.
    """

    name = DOOR_AGENT

    def __init__(
        self,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        *,
        settings: DoorSettings = DoorSettings(),
        period_s: float = 0.1,
    ) -> None:
        self.period_s = period_s
        self._memory = memory
        self._buffer = buffer
        self._settings = settings
        self._maintenance = DoorMaintenance(memory, settings.maintenance, settings.nodes)
        self._intentions = DoorIntentions(memory, settings.intentions, settings.nodes)
        self._evidence: dict[str, RoomEvidence] = {}
        self._settled: dict[str, tuple[object, ...]] = {}
        self._room_id: str | None = None
        self._scan_stamp_s = -np.inf
        self._stamp_s = 0.0
        self._detected_s = -np.inf
        self._first_seen_s: dict[tuple[str, int, int], float] = {}
        self._life = LifeCycle(
            "door",
            explain=self._explain,
            initialize=self._initialize,
            maintain=self._maintain,
            affordances=self._affordances,
        )

    async def step(self, stamp_s: float) -> None:
        """Take in the newest scan and live one tick."""
        self._stamp_s = stamp_s
        self._room_id = self._observe(self._memory.snapshot())
        self._life.tick()

    def _observe(self, snapshot: Snapshot) -> str | None:
        """Count what the newest scan says about the walls; the room it was taken in, if one stands."""
        scan = self._buffer.scan
        pose = robot_pose_at(snapshot, self._buffer, scan.stamp_s) if scan is not None else None
        if scan is None or pose is None or door_being_crossed(snapshot) is not None:
            return None
        room = room_model(snapshot, pose.parent)
        if room is None or room.depth_m(pose.T_parent_base.position_m) < self._settings.clear_m:
            return None
        evidence = self._evidence.get(room.room_id)
        if evidence is None or not np.array_equal(evidence.polygon, room.polygon):
            evidence = self._evidence[room.room_id] = RoomEvidence(room.polygon, self._settings.evidence)
        localized = np.sqrt(np.trace(pose.covariance[:2, :2])) < self._settings.pose_std_m and not in_doubt(snapshot)
        if localized and scan.stamp_s > self._scan_stamp_s:
            self._scan_stamp_s = scan.stamp_s
            evidence.add(scan, pose.T_parent_base)
        return room.room_id

    def _scene(self) -> Scene | None:
        """The room that the robot is in."""
        return self._scene_of(self._room_id) if self._room_id is not None else None

    def _scene_of(self, room_id: str) -> Scene | None:
        """A room that was watched, with the graph as it is now."""
        snapshot = self._memory.snapshot()
        room, evidence = room_model(snapshot, room_id), self._evidence.get(room_id)
        if room is None or evidence is None:
            return None
        return Scene(snapshot=snapshot, room=room, evidence=evidence, stamp_s=self._stamp_s)

    # The four stages of the life cycle.

    def _explain(self) -> Verdict:
        """Silent while known doors explain every gap."""
        if self._stamp_s < self._detected_s + self._settings.detect_every_s - 1e-6:
            return Verdict.DONE
        self._detected_s = self._stamp_s
        for room_id in self._evidence:
            self._suspect(room_id)
        scene = self._scene()
        return Verdict.NO if scene is not None and scene.unexplained() else Verdict.DONE

    def _suspect(self, room_id: str) -> None:
        """When a room has been watched for a while, ask to look at its longest stretch of wall never seen.

        A room that was left is asked for too: what the robot could not see from its way stays to be seen.
        """
        evidence = self._evidence[room_id]
        doors = tuple(door.id for door in self._memory.snapshot().of_type(DoorNode) if door.rooms[0] == room_id)
        told = (evidence.scans, len(evidence.checked), doors)
        if evidence.scans < self._settings.settled_scans or self._settled.get(room_id) == told:
            return
        scene = self._scene_of(room_id)
        if scene is None or any(is_suspicion(door) for door, _, _ in scene.doors()):
            return
        hidden = scene.unseen()
        if not hidden:
            self._settled[room_id] = told
            return
        wall, stretch = max(hidden, key=lambda item: item[1].width_m)
        with self._memory.edit(self.name, self._stamp_s) as tx:
            door_id = free_door_id(tx.snapshot, room_id, wall)
            length_m = scene.wall_length_m(wall)
            put_suspected(tx, door_id, room_id, wall, length_m, stretch, self._stamp_s, self._settings.nodes)

    def _initialize(self) -> Verdict:
        """Propose to visit each gap that no door explains, once it is seen well or long enough."""
        scene = self._scene()
        if scene is None:
            return Verdict.NO
        for wall, gap in scene.unexplained():
            settings, measured = self._settings, scene.evidence.measure(wall, gap)
            key = (scene.room.room_id, wall, round(gap.center_m / settings.same_gap_m))
            seen_s = self._stamp_s - self._first_seen_s.setdefault(key, self._stamp_s)
            wide = measured.width_m >= settings.nodes.sizes.narrowest_m
            if not wide or (measured.posts < 2 and seen_s < settings.seen_s):
                continue
            with self._memory.edit(self.name, self._stamp_s) as tx:
                door_id = free_door_id(tx.snapshot, scene.room.room_id, wall)
                length_m = scene.wall_length_m(wall)
                room_id, stamp_s = scene.room.room_id, self._stamp_s
                put_provisional(
                    tx,
                    door_id,
                    room_id,
                    wall,
                    length_m,
                    measured,
                    stamp_s,
                    state=gap.state,
                    settings=settings.nodes,
                )
            logger.info("something like a door in %s", wall_id_of(scene.room.room_id, wall), extra={"door": door_id})
        return Verdict.BUSY

    def _maintain(self) -> Verdict:
        """Refine doors that are not measured well yet, here and behind known ones, and watch whether they are open."""
        scene = self._scene()
        if scene is not None:
            self._maintenance.run(scene)
            for room_id in sorted(self._behind(scene) & self._evidence.keys()):
                left = self._scene_of(room_id)
                if left is not None:
                    self._maintenance.learn(left)
        return Verdict.DONE

    def _behind(self, scene: Scene) -> set[str]:
        """Rooms from which a door of this one is not measured as well as from here."""
        rooms: set[str] = set()
        for door, _, _ in scene.doors():
            other_id = match_of(scene.snapshot, door.id)
            if other_id is not None and other_id in scene.snapshot:
                other = scene.snapshot.door(other_id)
                better = better_dual(scene.snapshot, other, self._settings.nodes)
                rooms |= {other.rooms[0]} if better is not None else set()
        return rooms

    def _affordances(self) -> Verdict:
        """Follow the own intentions to their end."""
        self._intentions.run(self._memory.snapshot(), self._scene_of, self._stamp_s)
        return Verdict.DONE
