"""The intentions of the door concept from proposal to end: visits that make doors permanent, and crossings."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

from perception.crossing import (
    DOOR_AGENT,
    OUTDOORS,
    cross_affordance,
    given_up,
    is_being_crossed,
    nothing_left,
    uncrossed,
)
from perception.doors.insertion import DoorNodeSettings, cross, put_permanent, visit
from perception.doors.scene import Scene
from scene_graph.edges import EdgeKey, EdgeType, HasIntentionEdge, IntentionAction, IntentionStatus
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, AffordanceNode, CrossingStatus, DoorNode, DoorState
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class IntentionSettings:
    """Patience with intentions."""

    attempts: int = 2
    """Failures before one is given up. Chosen."""
    settle_s: float = 1.5
    """How long to look after arriving in front of a door that shows only one of its posts. Chosen: fifteen scans."""


class DoorIntentions:
    """Follows own intentions: done visits make doors permanent, failures are repeated once, then given up.

    What was given up is tried once more at the end.
    """

    def __init__(
        self,
        memory: WorkingMemory,
        settings: IntentionSettings = IntentionSettings(),
        nodes: DoorNodeSettings = DoorNodeSettings(),
    ) -> None:
        self._memory = memory
        self._settings, self._nodes = settings, nodes
        self._failures: dict[str, int] = {}
        self._arrived_s: dict[str, float] = {}
        self._tried_again: set[str] = set()

    def run(self, snapshot: Snapshot, scene_of: Callable[[str], Scene | None], stamp_s: float) -> None:
        """Follow every own intention one step; ``scene_of`` gives what is known of a room's walls."""
        for edge in snapshot.intentions():
            if edge.agent != DOOR_AGENT:
                continue
            if edge.action is IntentionAction.CROSS:
                self._follow_crossing(snapshot, edge, stamp_s)
            else:
                scene = scene_of(snapshot.door(edge.target).rooms[0])
                if scene is not None:
                    self._follow_visit(scene, edge)
        self._ask_for_crossings(stamp_s)
        self._try_again(snapshot, stamp_s)

    def _follow_visit(self, scene: Scene, edge: HasIntentionEdge) -> None:
        if edge.status is IntentionStatus.FAILED and self._failed_again(edge) < self._settings.attempts:
            with self._memory.edit(DOOR_AGENT, scene.stamp_s) as tx:
                tx.put(visit(edge.target, scene.stamp_s, self._nodes))
        elif edge.status in (IntentionStatus.DONE, IntentionStatus.FAILED):
            self._establish(scene, edge)

    def _establish(self, scene: Scene, edge: HasIntentionEdge) -> None:
        """Make the visited door permanent, as it is measured now; one that cannot be reached is also given up."""
        found = next(((door, wall, span) for door, wall, span in scene.doors() if door.id == edge.target), None)
        if found is None:
            return
        door, wall, span = found
        gap = scene.evidence.gap_at(wall, span)
        if gap is None or scene.evidence.measure(wall, gap).width_m < self._nodes.sizes.narrowest_m:
            scene.evidence.checked.append((wall, span.center_m))
            with self._memory.edit(DOOR_AGENT, scene.stamp_s) as tx:
                tx.remove(door.id)
            return
        measured = scene.evidence.measure(wall, gap)
        arrived_s = self._arrived_s.setdefault(door.id, scene.stamp_s)
        if measured.posts < 2 and scene.stamp_s < arrived_s + self._settings.settle_s:
            return
        length_m = scene.wall_length_m(wall)
        with self._memory.edit(DOOR_AGENT, scene.stamp_s) as tx:
            door_id = put_permanent(
                tx,
                door.id,
                scene.room.room_id,
                wall,
                length_m,
                measured,
                scene.stamp_s,
                state=gap.state,
                settings=self._nodes,
            )
        logger.info("%s stands: %.2f m wide, %s", door_id, measured.width_m, gap.state, extra={"door": door_id})
        self._arrived_s.pop(door.id, None)
        if edge.status is IntentionStatus.FAILED:
            self._give_up(door_id, edge.reason, scene.stamp_s)

    def _follow_crossing(self, snapshot: Snapshot, edge: HasIntentionEdge, stamp_s: float) -> None:
        affordance = snapshot.get(edge.target)
        door = snapshot.get(affordance.target) if isinstance(affordance, AffordanceNode) else None
        if not isinstance(door, DoorNode):
            return
        if not _wants_crossing(door):
            with self._memory.edit(DOOR_AGENT, stamp_s) as tx:
                tx.remove(edge.key)
        elif edge.status is IntentionStatus.FAILED:
            if self._failed_again(edge) < self._settings.attempts:
                with self._memory.edit(DOOR_AGENT, stamp_s) as tx:
                    tx.put(cross(door.id, stamp_s))
            else:
                self._give_up(door.id, edge.reason, stamp_s)

    def _ask_for_crossings(self, stamp_s: float) -> None:
        """Every permanent open door whose far side is unknown asks to be crossed."""
        snapshot = self._memory.snapshot()
        for door in snapshot.of_type(DoorNode):
            key = EdgeKey(EdgeType.HAS_INTENTION, ROBOT_ID, cross_affordance(door.id), DOOR_AGENT)
            if _wants_crossing(door) and not door.provisional and key.target in snapshot and key not in snapshot.edges:
                with self._memory.edit(DOOR_AGENT, stamp_s) as tx:
                    tx.put(cross(door.id, stamp_s))

    def _try_again(self, snapshot: Snapshot, stamp_s: float) -> None:
        """When nothing else is left, doors that nobody got through get another chance, once: what stood in the way may
        be gone, and what was not understood behind them may be now.
        """
        if snapshot.root.explored or not nothing_left(snapshot):
            return
        for door in self._memory.building().of_type(DoorNode):
            if door.id in self._tried_again or not _may_lead_somewhere(door):
                continue
            self._tried_again.add(door.id)
            self._memory.load(door.id, agent=DOOR_AGENT, stamp_s=stamp_s)
            with self._memory.edit(DOOR_AGENT, stamp_s) as tx:
                tx.put(uncrossed(tx.snapshot.door(door.id)))
            logger.info("trying %s again", door.id, extra={"door": door.id})

    def _give_up(self, door_id: str, reason: str, stamp_s: float) -> None:
        logger.info("gave up on %s: %s", door_id, reason, extra={"door": door_id})
        with self._memory.edit(DOOR_AGENT, stamp_s) as tx:
            tx.put(given_up(tx.snapshot.door(door_id), reason or "could not be reached"))
            key = EdgeKey(EdgeType.HAS_INTENTION, ROBOT_ID, cross_affordance(door_id), DOOR_AGENT)
            if key in tx.snapshot.edges:
                tx.remove(key)

    def _failed_again(self, edge: HasIntentionEdge) -> int:
        """Count a failure; how many it has been."""
        self._failures[edge.target] = self._failures.get(edge.target, 0) + 1
        return self._failures[edge.target]


def _may_lead_somewhere(door: DoorNode) -> bool:
    """Whether a door was given up though there may be a room behind it that can be reached."""
    unknown = door.rooms[1] is None and door.crossing is CrossingStatus.GIVEN_UP
    return unknown and door.state is not DoorState.CLOSED and door.crossing_reason != OUTDOORS


def _wants_crossing(door: DoorNode) -> bool:
    return (
        door.crossing is CrossingStatus.UNCROSSED and door.state is not DoorState.CLOSED and not is_being_crossed(door)
    )
