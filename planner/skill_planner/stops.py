"""Where a request may send the robot: what it speaks of, what that stands on, and the rooms of all that.

Nothing else is gone to, though it may be nearer: who is sent to the kitchen does not stop at whatever is by its door.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from planner.goals import Goal, Predicate
from planner.skill_planner.settings import SkillPlanningSettings
from skills.state.state import PlanState


class Stops:
    """The stops of one problem; they stay where they are while things are carried.

    Args:
        nodes: what the request speaks of, and where its things can be put.
        start: the state that the plan starts from.
        most: as in ``SkillPlanningSettings.most_stops``.
    """

    def __init__(self, nodes: Iterable[str], start: PlanState, *, most: int = SkillPlanningSettings.most_stops) -> None:
        held = [start.holding] if start.holding is not None else []
        spoken_of = dict.fromkeys([*nodes, *held])
        fixed = dict.fromkeys(start.anchor(node) for node in spoken_of if node not in start.missing)
        rooms = dict.fromkeys(room for node in (*spoken_of, *fixed) if (room := start.room_of(node)) is not None)
        here = [start.robot_room] if start.robot_room is not None else []
        self._start, self._most = start, most
        self._carried = tuple(
            dict.fromkeys(link for node in spoken_of for link in start.chain(node) if link not in fixed)
        )
        self.all = tuple(node for node in dict.fromkeys([*fixed, *rooms, *here]) if node in start.world.things)
        self._inside: dict[str, list[str]] = {}
        for node in self.all:
            for room in start.world.sides.get(node, (start.room_of(node),)):
                self._inside.setdefault(room or node, []).append(node)

    def into(self, room: str, state: PlanState) -> tuple[str, ...]:
        """Where the robot can be sent to be in ``room``; the room itself first."""
        return tuple(dict.fromkeys([room, *self._inside.get(room, ()), *self._on_floor(room, state)]))

    def to_leave(self, object_id: str, goal: Goal, state: PlanState) -> tuple[str, ...]:
        """Where to go with a held object that is in the way of ``goal``, before it is put down."""
        if len(self.all) <= self._most:
            return (*self.all, *self._on_floor(None, state))
        return tuple(dict.fromkeys(state.anchor(node) for node in goal.args if node != object_id))

    def _on_floor(self, room: str | None, state: PlanState) -> list[str]:
        """What the request speaks of and lies on the floor of a room, or of any (None): it is gone to by itself."""
        lying = {node: state.places[node][1] for node in self._carried if node in state.places}
        rooms = self._inside if room is None else (room,)
        return [node for node, place in lying.items() if place in rooms]

    def may_lie_in(self, object_id: str, room: str, later: Sequence[Goal]) -> bool:
        """Whether an object may be left in a room for a while: not where only a ``later`` goal wants it, unless it
        came from there.
        """
        wanted = any(g.predicate is Predicate.IN and g.args == (object_id, room) for g in later)
        return not wanted or self._start.room_of(object_id) == room
