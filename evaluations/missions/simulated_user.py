"""The person who asks for things: says what the rooms are called when the robot has seen them, and answers when it asks
back.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.runtime import Runtime
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import Scene
from evaluations.missions.referring_expressions import room_name
from evaluations.perception.inventory import GraphContents, graph_contents
from planner.mission.teaching import teach
from planner.tasks.tasks import Task
from simulation.houses.house import House

_ORDINALS = ("first", "second", "third", "fourth", "fifth")
"""As many as the robot offers at once."""


class SimulatedUser:
    """Knows the house by its truth, and tells the robot only what its requests are about, in words.

    Attributes:
        answers: how many questions were answered so far.
    """

    def __init__(self, runtime: Runtime, house: House, *, most_answers: int = 3) -> None:
        """``most_answers``: so many questions about one request a person puts up with."""
        self._runtime, self._house, self._most_answers = runtime, house, most_answers
        self.answers = 0

    def introduce(self) -> None:
        """Say what the rooms are called: no sensor sees that a room is *the storage* and not *the pantry*."""
        contents = self._contents()
        for room in self._house.rooms:
            node = contents.rooms.get(room.id)
            if node is not None and contents.labels[node] != room_name(room):
                teach(self._runtime.memory, node, label=room_name(room), name=None, stamp_s=self._runtime.now_s)

    def answer(self, task: Task, mission: Mission, scene: Scene) -> str | None:
        """Which of the candidates is meant, *the second one*; None where none of those that the robot offers is."""
        if self.answers >= self._most_answers:
            return None
        robot = self._runtime.memory.snapshot().robot
        held = robot.holding if robot is not None else None
        number = meant(task.candidates[: len(_ORDINALS)], mission, scene, self._contents(), held=held)
        self.answers += number is not None
        return None if number is None else f"the {_ORDINALS[number]} one"

    def _contents(self) -> GraphContents:
        return graph_contents(self._runtime.views.scene.document(), self._house)


def meant(
    candidates: Sequence[str],
    mission: Mission,
    scene: Scene,
    contents: GraphContents,
    *,
    held: str | None = None,
    same_m: float = 0.4,
) -> int | None:
    """Index of the candidate that is what the mission is about.

    ``held``: the node that the robot has in its hand. ``same_m``: a node this close to a thing, and closer than the
    other candidates, is what the person means.
    """
    at = {thing.id: (float(thing.position_m[0]), float(thing.position_m[1])) for thing in contents.things}
    for name in (*mission.things, *mission.places):
        if contents.rooms.get(name) in candidates:
            return candidates.index(contents.rooms[name])
        if held in candidates and scene.holding == name:
            return candidates.index(held)
        where = scene.where(name)
        near = [(math.dist(where, at[node]), node) for node in candidates if node in at] if where is not None else []
        if near and min(near)[0] <= same_m:
            return candidates.index(min(near)[1])
    return None
