"""Passing from one room to another: what happens in the graph when the robot goes through a door."""

from __future__ import annotations

import logging
from dataclasses import dataclass, field

from perception.crossing import (
    DOOR_AGENT,
    door_being_crossed,
    given_up,
    in_doubt,
    is_being_crossed,
    mark_being_crossed,
    match_of,
    move_robot,
)
from perception.geometry.planar import Pose2
from perception.lidar.slice import OutlineSlicer
from perception.localization.global_localization import Sight
from perception.localization.robot_pose import RobotPose, robot_pose_at
from perception.localization.room_model import RoomModel, room_model
from perception.memory.dual_doors import place_in, root_pose, same_door, through_door, unmatched_doors
from perception.memory.joining import JoiningSettings, join, put_dual, remove_room
from perception.memory.loop_closure import LoopClosureSettings, recognize, same_room
from perception.sensing import SensorBuffer
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, RtEdge
from scene_graph.memory import Transaction, WorkingMemory
from scene_graph.nodes import AffordanceNode, CrossingStatus, DoorNode
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class TransitionSettings:
    """Where one room ends for the robot and the next begins."""

    out_m: float = 0.05
    """Beyond a room's outline, and within the next one's: errors of the pose and of both."""
    away_m: float = 0.6
    """So far beyond it the robot is behind a door, whether or not it was asked to cross one: the thickest walls."""
    near_door_m: float = 2.0
    """A door that it goes through is not farther. Chosen."""
    attempts: int = 2
    """Crossings that do not lead out of the room before the door is given up. Chosen."""
    entered_std: float = 0.03
    """Of the pose in a known room behind a door, meters: both sides of it and the wall between."""
    closed_std: float = 0.05
    """The same when two rooms turn out to be one: what their outlines differ."""
    loop_closure: LoopClosureSettings = field(default_factory=LoopClosureSettings)
    joining: JoiningSettings = field(default_factory=JoiningSettings)


class RoomTransition:
    """Follows the robot through doors and joins what it finds behind them."""

    def __init__(
        self,
        agent: str,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        *,
        settings: TransitionSettings = TransitionSettings(),
        slicer: OutlineSlicer | None = None,
    ) -> None:
        self._agent, self._settings = agent, settings
        self._memory = memory
        self._buffer = buffer
        self._slicer = slicer or OutlineSlicer()
        self._stamp_s = 0.0
        self._stayed: dict[str, int] = {}
        self._one_sided: dict[str, tuple[RtEdge | None, RtEdge | None]] = {}

    def run(self, stamp_s: float) -> None:
        """One step: the robot, a crossing that ends, doors that are the same."""
        self._stamp_s = stamp_s
        self._follow_robot()
        self._finish_crossing()
        self._match_doors()

    def _follow_robot(self) -> None:
        snapshot = self._memory.snapshot()
        pose = robot_pose_at(snapshot, self._buffer, self._stamp_s)
        room = room_model(snapshot, pose.parent) if pose is not None else None
        if pose is None or room is None or door_being_crossed(snapshot) is not None or in_doubt(snapshot):
            return
        depth_m = room.depth_m(pose.T_parent_base.position_m)
        if depth_m < -self._settings.out_m and self._enter_known(snapshot, pose):
            return
        crossed = _crossing_done(snapshot)
        if crossed is not None and crossed[0].rooms[0] != room.room_id:
            self._ended_up(snapshot, crossed[0], room.room_id)
        elif crossed is not None and depth_m > 0.0:
            self._stayed_inside(*crossed)
        elif crossed is not None:
            self._enter_unknown(pose, crossed[0])
        elif depth_m < -self._settings.away_m and not snapshot.intentions(IntentionStatus.GRANTED):
            door = _nearest_door(snapshot, room, pose.T_parent_base)
            if door is not None and door.crossing is CrossingStatus.UNCROSSED:
                self._enter_unknown(pose, door)

    def _enter_known(self, snapshot: Snapshot, pose: RobotPose) -> bool:
        """Through a door whose far side is known: predict the pose there by the door's dual coordinates."""
        for door in snapshot.of_type(DoorNode):
            other_id = match_of(snapshot, door.id)
            if door.rooms[0] != pose.parent or other_id is None:
                continue
            far = room_model(snapshot, snapshot.door(other_id).rooms[0])
            T_near_door = Pose2.from_se3(snapshot.transform(pose.parent, door.id))
            if far is None or T_near_door.distance_m(pose.T_parent_base) > self._settings.near_door_m:
                continue
            T_far_base = through_door(snapshot, door.id, other_id).inverse() @ pose.T_parent_base
            if far.depth_m(T_far_base.position_m) > self._settings.out_m:
                with self._memory.edit(self._agent, self._stamp_s) as tx:
                    newest_s, std = self._buffer.odometry[-1].stamp_s, self._settings.entered_std
                    move_robot(tx, far.room_id, T_far_base, newest_s, std)
                logger.info("entered %s through %s", far.room_id, door.id, extra={"room": far.room_id})
                return True
        return False

    def _enter_unknown(self, pose: RobotPose, door: DoorNode) -> None:
        """Behind a door that nobody crossed: a known room after all, or one to be measured."""
        scan, known = self._buffer.scan, None
        if scan is not None:
            sight = Sight(scan=scan, outline=self._slicer.cut(scan), T_odom_base=pose.T_odom_base)
            known = recognize(self._memory.building(), pose.T_parent_base, sight, door, self._settings.loop_closure)
        if known is not None:
            self._memory.load(known.room_id, agent=self._agent, stamp_s=self._stamp_s)
        with self._memory.edit(self._agent, self._stamp_s) as tx:
            if known is None:
                tx.put(mark_being_crossed(door))
            else:
                T_known_near = known.T_room_base @ pose.T_parent_base.inverse()
                self._attach(tx, door, known.room_id, T_known_near)
                move_robot(tx, known.room_id, known.T_room_base, self._buffer.odometry[-1].stamp_s)
        if known is not None:
            logger.info("closed a loop: %s leads to %s", door.id, known.room_id, extra={"room": known.room_id})

    def _ended_up(self, snapshot: Snapshot, door: DoorNode, room_id: str) -> None:
        """The crossing led into a room that was known and has taken the robot over already."""
        with self._memory.edit(self._agent, self._stamp_s) as tx:
            self._attach(tx, door, room_id, root_pose(snapshot, room_id).inverse() @ root_pose(snapshot, door.rooms[0]))

    def _stayed_inside(self, door: DoorNode, edge: HasIntentionEdge) -> None:
        """The crossing is said to be done, but the robot is still inside: let it be asked for again, once."""
        self._stayed[door.id] = self._stayed.get(door.id, 0) + 1
        with self._memory.edit(self._agent, self._stamp_s) as tx:
            tx.remove(edge.key)
            if self._stayed[door.id] >= self._settings.attempts:
                tx.put(given_up(door, "crossing it did not lead out of the room"))

    def _finish_crossing(self) -> None:
        """The room behind a door stands: give it its side of the door, unless it is a room known before."""
        snapshot = self._memory.snapshot()
        door, current = door_being_crossed(snapshot), snapshot.current_room
        if door is None or current is None or current == door.rooms[0]:
            return
        same = same_room(self._memory.building(), current, door, self._settings.loop_closure)
        if same is not None:
            snapshot = self._memory.load(same.room_id, agent=self._agent, stamp_s=self._stamp_s)
        with self._memory.edit(self._agent, self._stamp_s) as tx:
            T_new_near = root_pose(snapshot, current).inverse() @ root_pose(snapshot, door.rooms[0])
            if same is None:
                self._attach(tx, door, current, T_new_near)
                return
            pose = robot_pose_at(snapshot, self._buffer, self._stamp_s)
            if pose is not None:
                T_known_base = same.T_old_new @ pose.T_parent_base
                newest_s, std = self._buffer.odometry[-1].stamp_s, self._settings.closed_std
                move_robot(tx, same.room_id, T_known_base, newest_s, std)
            remove_room(tx, current)
            self._attach(tx, door, same.room_id, same.T_old_new @ T_new_near)
        logger.info("%s is %s; closed a loop", current, same.room_id, extra={"room": same.room_id})

    def _attach(self, tx: Transaction, door: DoorNode, room_id: str, T_room_near: Pose2) -> None:
        """Join ``door`` with its side in ``room_id``: one found there already, or a predicted one."""
        snapshot = tx.snapshot
        room = room_model(snapshot, room_id)
        T_room_door = T_room_near @ Pose2.from_se3(snapshot.transform(door.rooms[0], door.id))
        place = place_in(room, T_room_door, self._settings.loop_closure.dual) if room is not None else None
        if room is None or place is None:
            tx.put(given_up(door, "no wall of the room behind it has this door"))
            return
        joining = self._settings.joining
        dual = self._door_at(snapshot, room_id, T_room_door, door.width_m)
        dual = dual or put_dual(tx, door, room, place, self._stamp_s, joining)
        join(tx, door, dual, T_room_near.inverse(), std_m=joining.walked_std_m)

    def _door_at(self, snapshot: Snapshot, room_id: str, T_room_door: Pose2, width_m: float) -> DoorNode | None:
        """An unmatched door of the room that can be the other side of one at ``T_room_door``."""
        for door in unmatched_doors(snapshot):
            if door.rooms[0] == room_id:
                T_room_own = Pose2.from_se3(snapshot.transform(room_id, door.id))
                if same_door(T_room_door, T_room_own, (width_m, door.width_m), self._settings.loop_closure.dual):
                    return door
        return None

    def _match_doors(self) -> None:
        """Two doors found from two rooms may be the two sides of one, though nobody went through it."""
        self._bring_far_sides()
        snapshot = self._memory.snapshot()
        doors = [door for door in unmatched_doors(snapshot) if not is_being_crossed(door)]
        for index, first in enumerate(doors):
            for second in doors[index + 1 :]:
                if first.rooms[0] == second.rooms[0]:
                    continue
                poses = root_pose(snapshot, first.id), root_pose(snapshot, second.id)
                if same_door(*poses, (first.width_m, second.width_m), self._settings.loop_closure.dual):
                    T_near_far = root_pose(snapshot, first.rooms[0]).inverse() @ root_pose(snapshot, second.rooms[0])
                    with self._memory.edit(self._agent, self._stamp_s) as tx:
                        join(tx, first, second, T_near_far, std_m=self._settings.joining.unwalked_std_m)
                    logger.info("%s and %s are one door", first.id, second.id, extra={"door": first.id})
                    return

    def _bring_far_sides(self) -> None:
        """Load unloaded rooms in which a door may be the other side of one that is loaded, when that one is new."""
        snapshot = self._memory.snapshot()
        one_sided = unmatched_doors(snapshot)
        places = {door.id: (snapshot.parent(door.id), snapshot.parent(door.rooms[0])) for door in one_sided}
        new = [door for door in one_sided if self._one_sided.get(door.id) != places[door.id]]
        self._one_sided = places
        if not new or not self._memory.unloaded:
            return
        building = self._memory.building()
        stored = [door for door in unmatched_doors(building) if door.id not in snapshot]
        for door in new:
            pose = root_pose(snapshot, door.id)
            for other in stored:
                widths_m = door.width_m, other.width_m
                if same_door(pose, root_pose(building, other.id), widths_m, self._settings.loop_closure.dual):
                    self._memory.load(other.id, agent=self._agent, stamp_s=self._stamp_s)


def _crossing_done(snapshot: Snapshot) -> tuple[DoorNode, HasIntentionEdge] | None:
    """A door whose crossing the executor reports done while its far side is unknown."""
    for edge in snapshot.intentions(IntentionStatus.DONE):
        affordance = snapshot.get(edge.target)
        if (
            edge.agent != DOOR_AGENT
            or edge.action is not IntentionAction.CROSS
            or not isinstance(affordance, AffordanceNode)
        ):
            continue
        door = snapshot.door(affordance.target)
        if door.crossing is CrossingStatus.UNCROSSED:
            return door, edge
    return None


def _nearest_door(snapshot: Snapshot, room: RoomModel, T_room_base: Pose2) -> DoorNode | None:
    """The permanent door of the room nearest to the robot."""
    doors = [door for door in snapshot.of_type(DoorNode) if door.rooms[0] == room.room_id and not door.provisional]
    return min(
        doors,
        key=lambda door: Pose2.from_se3(snapshot.transform(room.room_id, door.id)).distance_m(T_room_base),
        default=None,
    )
