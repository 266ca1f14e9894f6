"""Who gets the robot: the ``mission_monitoring`` agent of Concepts, over ``has_intention`` edges (design, section 8).

Agents propose. The arbiter grants at most one intention, revokes it for one of higher priority, and lets what it
revoked compete again when that one has ended. While the stop is latched it grants nothing; while the robot does not
know where it is, nothing but a look around from where it stands.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import hypot, inf

from planner.executor.settings import ExecutorSettings
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.edits import PutEdge
from scene_graph.errors import FramesNotConnected, NodeNotFound
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, AffordanceNode
from scene_graph.queries.topology import Topology
from scene_graph.snapshot import Snapshot


class Arbiter:
    """Grants, revokes and resumes. Ties are broken by way, age and name, so that the same graph gives the same grant.

    Args:
        memory: the graph that holds the intentions.
        stopped: whether the software stop is latched.
        exploration_enabled: what ``exploration_enabled`` starts as; while it is false, only requests are granted.
        settings: among them what counts as standing in a doorway.
    """

    name = "mission_monitoring"

    def __init__(
        self,
        memory: WorkingMemory,
        *,
        stopped: Callable[[], bool],
        exploration_enabled: bool = True,
        period_s: float = 0.1,
        settings: ExecutorSettings = ExecutorSettings(),
    ) -> None:
        self._settings = settings
        self.period_s = period_s
        self.exploration_enabled = exploration_enabled
        self._memory = memory
        self._stopped = stopped

    async def step(self, stamp_s: float) -> None:
        """Bring the graph's grants in line with priorities; writes only when one changes."""
        snapshot = self._memory.snapshot()
        chosen = None if self._stopped() else self._choose(snapshot)
        edits = [PutEdge(edge) for edge in changes(snapshot, chosen)]
        if edits:
            self._memory.commit(edits, agent=self.name, stamp_s=stamp_s)

    def _choose(self, snapshot: Snapshot) -> HasIntentionEdge | None:
        return choose(
            snapshot,
            exploration_enabled=self.exploration_enabled,
            building=self._memory.building,
            doorway_m=self._settings.doorway_m,
        )


def choose(
    snapshot: Snapshot,
    *,
    exploration_enabled: bool = True,
    building: Callable[[], Snapshot] | None = None,
    doorway_m: float = ExecutorSettings.doorway_m,
) -> HasIntentionEdge | None:
    """The intention that should have the robot, ``None`` if there is none.

    ``building`` gives everything known when the way to several equal ones must be compared; ``snapshot`` by default.
    ``doorway_m``: as in ``ExecutorSettings``.
    """
    robot = snapshot.robot
    lost = robot is not None and not robot.localized
    candidates = [
        edge
        for edge in snapshot.intentions()
        if edge.is_open and (looks_around(edge) if lost else exploration_enabled or edge.priority >= Priority.REQUEST)
    ]
    if not candidates:
        return None
    top = max(edge.priority for edge in candidates)
    granted = [edge for edge in candidates if edge.status is IntentionStatus.GRANTED]
    for edge in sorted(granted, key=_age):
        if edge.priority >= top or _in_doorway(snapshot, edge, doorway_m):
            return edge
    best = [edge for edge in candidates if edge.priority == top]
    return best[0] if len(best) == 1 else min(best, key=_Ways(building() if building else snapshot).rank)


def changes(snapshot: Snapshot, chosen: HasIntentionEdge | None) -> list[HasIntentionEdge]:
    """The intentions that must be rewritten so that ``chosen`` alone is granted.

    What loses its grant is revoked; what was revoked is proposed again once nothing of higher priority is open.
    """
    rewritten = []
    for edge in snapshot.intentions():
        status = edge.status
        if chosen is not None and edge.key == chosen.key:
            status = IntentionStatus.GRANTED
        elif edge.status in (IntentionStatus.GRANTED, IntentionStatus.REVOKED):
            competes = chosen is not None and edge.priority >= chosen.priority
            status = IntentionStatus.PROPOSED if competes else IntentionStatus.REVOKED
        if status is not edge.status:
            rewritten.append(replace(edge, status=status))
    return rewritten


def looks_around(edge: HasIntentionEdge) -> bool:
    """Whether an intention is to look around from where the robot stands, for which no map is needed."""
    return edge.action is IntentionAction.LOOK and edge.target == ROBOT_ID


def _age(edge: HasIntentionEdge) -> tuple[float, str, str]:
    return edge.proposed_s, edge.agent, edge.target


def _in_doorway(snapshot: Snapshot, edge: HasIntentionEdge, doorway_m: float) -> bool:
    if edge.action is not IntentionAction.CROSS:
        return False
    return _straight_m(snapshot, edge.target) < doorway_m


def place_of(snapshot: Snapshot, target: str) -> str:
    """The node that stands for an intention's target in space: an affordance is where its own target is."""
    node = snapshot.get(target)
    return node.target if isinstance(node, AffordanceNode) else target


def _straight_m(snapshot: Snapshot, target: str) -> float:
    """Horizontal distance from the robot to a target, infinite when the graph does not connect them."""
    try:
        x_m, y_m, _ = snapshot.position(place_of(snapshot, target), ROBOT_ID)
    except (FramesNotConnected, NodeNotFound):
        return inf
    return hypot(float(x_m), float(y_m))


class _Ways:
    """Orders intentions of equal priority by the way to them: this room first, then through the fewest meters."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._here = snapshot.current_room
        self._topology = Topology.from_snapshot(snapshot)

    def rank(self, edge: HasIntentionEdge) -> tuple[bool, float, float, str, str]:
        place = place_of(self._snapshot, edge.target)
        room = self._snapshot.room_of(place) if place in self._snapshot else None
        if self._here is None or room is None or room == self._here:
            return (False, _straight_m(self._snapshot, edge.target), *_age(edge))
        path = self._topology.path(
            self._here, room, start_m=self._position(ROBOT_ID, self._here), goal_m=self._position(place, room)
        )
        return (True, path.length_m if path is not None else inf, *_age(edge))

    def _position(self, node_id: str, room: str) -> tuple[float, float]:
        x_m, y_m, _ = self._snapshot.position(node_id, room)
        return float(x_m), float(y_m)
