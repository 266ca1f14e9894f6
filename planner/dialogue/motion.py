"""What *go to the kitchen*, *wait there* and *open the door* mean on a graph."""

from __future__ import annotations

from planner.dialogue.meaning import Meaning
from planner.goals import Goal, Predicate
from planner.grounding.context import Ambiguous, Context, NoReferent, Trouble
from planner.grounding.grounding import Grounding
from planner.grounding.phrasing import parts_unseen
from planner.language.grammar.syntax import Go, Operate
from planner.naming import at, name_of
from scene_graph.nodes import DoorNode, ObjectNode, RegionNode, RoomNode


class Motion:
    """Gives steps about the robot's own place, and about doors, their meaning on one graph."""

    def __init__(self, grounding: Grounding) -> None:
        self._grounding, self._snapshot, self._state = grounding, grounding.snapshot, grounding.state

    def to(self, step: Go, context: Context) -> Meaning | Trouble:
        """Being at a place, and what comes of waiting there."""
        before = context.places[:1] or ((self._state.robot_room,) if self._state.robot_room is not None else ())
        found = self._grounding.place(step.target, context) if step.target is not None else before
        if not isinstance(found, tuple):
            return found
        if not found:
            return NoReferent(reason="I do not know which room I am in.")
        found = tuple(room for i in found for room in self._rooms_of(i))
        if len(found) > 1:
            return Ambiguous(question="I can be in one place only. Which one?", phrase="", candidates=found)
        (place,) = found
        focus = place if isinstance(self._snapshot.get(place), RoomNode) else self._state.room_of(place)
        things = (place,) if self._is_object(place) else ()
        stays_on = step.stays and context.places[:1] == (place,)
        goals = () if stays_on else (Goal(predicate=Predicate.ROBOT_AT, args=(place,)),)
        waiting = self._waiting(place) if step.stays else ""
        return Meaning(goals=goals, places=(place,), things=things, focus=focus, waiting=waiting)

    def _waiting(self, place: str) -> str:
        """What comes of *wait there*: nothing takes the robot away but exploring, if that is not over."""
        where = f"at {name_of(place, self._snapshot)}" if self._is_object(place) else at(place, self._snapshot)
        if parts_unseen(self._snapshot):
            return f"I cannot wait {where}: there is more of the building to explore, and I go on with that."
        return f"I stay {where} until I am asked for something else."

    def operated(self, step: Operate, context: Context) -> Meaning | Trouble:
        """A door that is open, by the skill of an installed package."""
        found = self._grounding.place(step.thing, context)
        if not isinstance(found, tuple):
            return found
        other = next((i for i in found if not isinstance(self._snapshot.get(i), DoorNode)), None)
        if other is not None:
            return NoReferent(reason=f"I can {step.verb} doors only, and not {name_of(other, self._snapshot)}.")
        return Meaning(goals=tuple(Goal(predicate=Predicate.OPEN, args=(i,)) for i in found), places=found)

    def _rooms_of(self, node_id: str) -> tuple[str, ...]:
        """A region's rooms; any other node itself."""
        return self._snapshot.rooms_in(node_id) if isinstance(self._snapshot.get(node_id), RegionNode) else (node_id,)

    def _is_object(self, node_id: str) -> bool:
        return isinstance(self._snapshot.get(node_id), ObjectNode)
