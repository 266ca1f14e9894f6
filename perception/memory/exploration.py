"""When is the building explored?"""

from __future__ import annotations

from dataclasses import dataclass, replace

from perception.crossing import in_doubt, nothing_left
from perception.geometry.planar import Pose2
from perception.localization.room_model import room_model
from scene_graph.edges import HasIntentionEdge, IntentionAction, Priority
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID
from scene_graph.snapshot import Snapshot


@dataclass(frozen=True, kw_only=True)
class ExplorationSettings:
    """When nothing is left to explore."""

    quiet_s: float = 4.0
    """For so long nobody has asked for more: every agent has had its turn often. Chosen."""
    out_m: float = 0.3
    """Beyond a room's outline, farther than in a doorway, in which the robot may well stand."""


class ExplorationJudge:
    """Sets ``explored`` on the root when nothing has been left for a while, and takes it back when something turns up.

    The while gives every agent the time to ask for more after a room or a door was finished. Rooms with something left
    are never unloaded, so that working memory tells it all. A robot that the last door has led outdoors is asked to
    come back in first, once.
    """

    def __init__(self, memory: WorkingMemory, settings: ExplorationSettings = ExplorationSettings()) -> None:
        self._memory, self._settings = memory, settings
        self._quiet_since_s: float | None = None
        self._called_in = False

    def update(self, agent: str, stamp_s: float) -> None:
        """Judge the graph as it is now."""
        self._forget_call(agent, stamp_s)
        snapshot = self._memory.snapshot()
        if not nothing_left(snapshot):
            self._quiet_since_s = None
        elif self._quiet_since_s is None:
            self._quiet_since_s = stamp_s
        quiet = self._quiet_since_s is not None and stamp_s >= self._quiet_since_s + self._settings.quiet_s
        if quiet and not snapshot.root.explored and self._call_in(agent, stamp_s):
            return
        if quiet != snapshot.root.explored:
            with self._memory.edit(agent, stamp_s) as tx:
                tx.put(replace(snapshot.root, explored=quiet))

    def _call_in(self, agent: str, stamp_s: float) -> bool:
        """Ask for the robot to come back into its room, if it is not there and has not been asked before."""
        snapshot = self._memory.snapshot()
        room = _left_room(snapshot, self._settings.out_m)
        if room is None or self._called_in:
            return False
        self._called_in = True
        with self._memory.edit(agent, stamp_s) as tx:
            tx.put(
                HasIntentionEdge(
                    source=ROBOT_ID,
                    target=room,
                    agent=agent,
                    action=IntentionAction.VISIT,
                    priority=Priority.CROSS_DOOR,
                    proposed_s=stamp_s,
                )
            )
        return True

    def _forget_call(self, agent: str, stamp_s: float) -> None:
        """Take back what was asked once the robot came, or could not."""
        ended = [edge.key for edge in self._memory.snapshot().intentions() if edge.agent == agent and not edge.is_open]
        if ended:
            with self._memory.edit(agent, stamp_s) as tx:
                tx.remove(*ended)


def _left_room(snapshot: Snapshot, out_m: float) -> str | None:
    """The room that the robot hangs from, if it stands outside of it."""
    edge = snapshot.parent(ROBOT_ID)
    room = room_model(snapshot, edge.source) if edge is not None else None
    if edge is None or room is None or in_doubt(snapshot):
        return None
    depth_m = room.depth_m(Pose2.from_se3(edge.T_source_target).position_m)
    return room.room_id if depth_m < -out_m else None
