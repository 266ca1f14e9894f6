"""Keeping the room true that the robot stands in: its confidence, its walls, and whether its outline is believed."""

from __future__ import annotations

import logging
from dataclasses import dataclass, field, replace

import numpy as np

from perception.crossing import in_doubt, move_robot, take_back
from perception.lidar.slice import OutlineScan
from perception.localization.robot_pose import RobotPose
from perception.localization.room_model import RoomModel
from perception.rooms.maintenance.adjustment import AdjustmentSettings, LocalAdjustment
from perception.rooms.maintenance.outline_fitness import OutlineFitness, OutlineFitnessSettings
from perception.rooms.maintenance.revision import RevisionSettings, missing_walls
from perception.rooms.maintenance.shifted_walls import ShiftSettings, shift_walls, wall_stds
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class RoomMaintenanceSettings:
    """How often a room is revised, and the stages of looking after it."""

    revisions: int = 2
    """Times that a room is taken back at most. Chosen: measuring comes to an end."""
    worth_writing: float = 0.05
    """Least change of a room's confidence that is written. Chosen: everybody who reads the graph is told of each."""
    moved_std_m: float = 0.01
    """Standard deviation of the robot's pose once walls have moved. Chosen: about their own."""
    fitness: OutlineFitnessSettings = field(default_factory=OutlineFitnessSettings)
    adjustment: AdjustmentSettings = field(default_factory=AdjustmentSettings)
    shifts: ShiftSettings = field(default_factory=ShiftSettings)
    revision: RevisionSettings = field(default_factory=RevisionSettings)


class RoomMaintenance:
    """Judges rooms by the scans taken in them. ``agent`` is who writes."""

    def __init__(
        self, agent: str, memory: WorkingMemory, settings: RoomMaintenanceSettings = RoomMaintenanceSettings()
    ) -> None:
        self._agent, self._memory, self._settings = agent, memory, settings
        self._fitness: dict[str, OutlineFitness] = {}
        self._adjustment = LocalAdjustment(settings.adjustment)
        self._revised: dict[str, int] = {}
        self._judge = False

    def observe(self, snapshot: Snapshot, model: RoomModel, scan: OutlineScan, pose: RobotPose, stamp_s: float) -> None:
        """Take in a scan taken in a room that stands, and move walls that are surely not where they are believed."""
        fitness = self._fitness.get(model.room_id)
        if fitness is None or not np.array_equal(fitness.polygon, model.polygon):
            fitness = self._fitness[model.room_id] = OutlineFitness(model.polygon, self._settings.fitness)
        self._judge |= fitness.add(scan, pose.T_parent_base)
        self._adjust(snapshot, model, scan, pose, stamp_s)

    def _adjust(self, snapshot: Snapshot, model: RoomModel, scan: OutlineScan, pose: RobotPose, stamp_s: float) -> None:
        if in_doubt(snapshot) or snapshot.room(model.room_id).status is not RoomStatus.PERMANENT:
            self._adjustment.doubt()
            return
        settings = self._settings
        if not self._adjustment.add(model, scan, pose):
            return
        shifts = self._adjustment.solve(wall_stds(snapshot, model, settings.shifts))
        if shifts is None:
            return
        self._adjustment.reset()
        with self._memory.edit(self._agent, stamp_s) as tx:
            moved = shift_walls(tx, model, shifts, stamp_s, settings.shifts)
            if moved:
                T_room_base = pose.T_parent_base @ shifts.T_base_moved
                move_robot(tx, model.room_id, T_room_base, scan.stamp_s, settings.moved_std_m)
        if moved:
            logger.info("adjusted %s: %s", model.room_id, shifts, extra={"room": model.room_id})

    def run(self, stamp_s: float) -> bool:
        """Write how well the robot's room fits, and take it back if what is seen contradicts it; whether it was."""
        snapshot = self._memory.snapshot()
        room_id = snapshot.current_room
        fitness = self._fitness.get(room_id) if room_id is not None else None
        if room_id is None or fitness is None or not self._judge:
            return False
        self._judge = False
        self._publish(snapshot.room(room_id), fitness, stamp_s)
        if self._revised.get(room_id, 0) >= self._settings.revisions:
            return False
        against = missing_walls(snapshot, room_id, fitness, self._settings.revision)
        if not against:
            return False
        self._revised[room_id] = self._revised.get(room_id, 0) + 1
        del self._fitness[room_id]
        with self._memory.edit(self._agent, stamp_s) as tx:
            take_back(tx, room_id)
        length_m = max(stretch.end_m - stretch.start_m for stretch in against)
        logger.info(
            "%.1f m of a wall of %s are not there; measuring it again", length_m, room_id, extra={"room": room_id}
        )
        return True

    def _publish(self, room: RoomNode, fitness: OutlineFitness, stamp_s: float) -> None:
        """Let the room's confidence be its running fitness: what of its walls is lately seen where it should be."""
        if abs(fitness.recent - room.confidence) > self._settings.worth_writing:
            with self._memory.edit(self._agent, stamp_s) as tx:
                tx.put(replace(room, confidence=fitness.recent))
