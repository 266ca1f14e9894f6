"""Where things are, in sentences, with the age of what is known."""

from __future__ import annotations

from planner.answers.settings import AnswerSettings
from planner.grounding.openness import not_known, undecided
from planner.grounding.phrasing import place_phrase
from planner.language.lexicon.vocabulary import ALWAYS_PLURAL, is_plural
from planner.naming import capital, name_of
from scene_graph.nodes import ROBOT_ID, DoorNode, ObjectNode, ObjectState, RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState


class Whereabouts:
    """Sentences about where nodes of one graph are."""

    def __init__(self, snapshot: Snapshot, state: PlanState, settings: AnswerSettings) -> None:
        self._snapshot, self._state, self._settings = snapshot, state, settings

    def sentence(self, node_id: str, *, rooms_only: bool, speaker: str | None = None) -> str:
        """*The red cup is on the table in the kitchen; I saw it 3 minutes ago.*"""
        node = self._snapshot.node(node_id)
        name = capital(name_of(node_id, self._snapshot))
        room = self._state.room_of(node_id)
        if isinstance(node, RoomNode):
            return f"{name} is {self._room_place(node)}."
        if isinstance(node, DoorNode):
            return not_known(undecided((node_id,), self._snapshot), self._snapshot) or f"{name} is {node.state.value}."
        if node_id == ROBOT_ID:
            here = self._state.robot_room
            return "I do not know where I am." if here is None else f"I am in {name_of(here, self._snapshot)}."
        in_room = f"in {name_of(room, self._snapshot)}" if room is not None else "at a place I do not know"
        if not isinstance(node, ObjectNode):
            return f"{'You are' if node_id == speaker else f'{name} is'} {in_room}, as far as I know."
        place = in_room if rooms_only else place_phrase(node_id, self._snapshot).removeprefix("last known ")
        if node.state is ObjectState.MISSING:
            is_it = ("are", "them", "they are") if _is_several(node) else ("is", "it", "it is")
            last = f"{name} {is_it[0]} not where I last saw {is_it[1]}, {self._age(node)}: {place}."
            return f"{last} I do not know where {is_it[2]} now."
        if node.state is ObjectState.HELD:
            return f"{name} {'are' if _is_several(node) else 'is'} in my gripper."
        name = name.removesuffix(f" {place}")
        if _is_several(node):
            return f"{name} are {place}; I saw them {self._age(node)}."
        return f"{name} is {place}; I saw it {self._age(node)}."

    def _room_place(self, room: RoomNode) -> str:
        if room.id == self._snapshot.current_room:
            return "where I am now"
        distance_m = self._state.distance_m(self._state.robot_at, room.id)
        return "where I know of no open way to" if distance_m is None else f"about {distance_m:.0f} m from me"

    def _age(self, node: ObjectNode) -> str:
        return age_phrase(self._snapshot.stamp_s - node.last_seen_s, self._settings)


def _is_several(node: ObjectNode) -> bool:
    """*The scissors are*."""
    last = node.label.replace("_", " ").rsplit(" ", maxsplit=1)[-1]
    return not node.name and (last in ALWAYS_PLURAL or is_plural(last))


def age_phrase(seconds: float, settings: AnswerSettings = AnswerSettings()) -> str:
    """*just now*, *20 seconds ago*, *3 minutes ago*, *2 hours ago*, *4 days ago*."""
    if seconds < settings.now_s:
        return "just now"
    for limit, size, unit in ((60, 1, "second"), (3600, 60, "minute"), (86400, 3600, "hour")):
        if seconds < limit:
            return _ago(round(seconds / size), unit)
    return _ago(round(seconds / 86400), "day")


def _ago(count: int, unit: str) -> str:
    return f"{count} {unit}{'' if count == 1 else 's'} ago"
