"""The building on disk: taken up at start, written now and then and at the end."""

from __future__ import annotations

import asyncio
import hashlib
import logging
import threading
from collections.abc import Callable
from pathlib import Path

from app.persistence.history_file import HistoryFile
from app.persistence.node_history import NodeHistory
from perception.crossing import lose_robot
from scene_graph.identifiers import slug
from scene_graph.long_term.keeping import held_in, rooms_to_keep, take_up
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.room_files import RoomFiles
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import RegionNode
from simulation.houses.house_file import load_house

logger = logging.getLogger(__name__)

AGENT = "remembering"
PERSON = "person"
"""Who teaches, as the graph's edits name their authors."""


def building_folder(data: Path, house: str, robot: str | None = None) -> Path:
    """Where the building of a house is kept: by its name, and by its walls, which a map must not outlive.

    That of a real ``robot`` is kept by how the robot is reached: who carries it elsewhere names another data folder.

    Raises:
        HouseError: there is no such house.
    """
    if robot is not None:
        return data / "buildings" / f"{slug(robot)}-{hashlib.sha256(robot.encode()).hexdigest()[:8]}"
    plan = load_house(house)
    walls = plan.model_dump_json(include={"rooms", "doors"})
    return data / "buildings" / f"{slug(plan.name or 'house')}-{hashlib.sha256(walls.encode()).hexdigest()[:8]}"


class Remembering:
    """Agent that writes the known building to its folder now and then; at once what a person taught, and what has
    come into the hand or left it.

    Attributes:
        memory: with everything that the folder held at the start. If that is anything, the robot does not know where
            it is. What cannot be read, or contradicts the rest, is reported and left out.
        history: what became of each node, also before this start. Whoever shows the graph notes in it.
        held: what was in the hand when the folder was written. It may still be, or not: the fingers will tell.
    """

    name = AGENT

    def __init__(
        self,
        folder: Path,
        *,
        wall_time: Callable[[], float],
        anew: bool = False,
        period_s: float = 20.0,
        look_s: float = 1.0,
    ) -> None:
        """Reads the folder.

        Args:
            folder: of this building alone.
            wall_time: seconds since 1970. A constant makes a run with a given folder repeatable.
            anew: begin with nothing; what the folder holds is replaced once a room stands.
            period_s: robot time between two writings.
            look_s: and between two looks whether something has happened that must not wait for the next one.
        """
        self.period_s = min(period_s, look_s)
        self._between_s, self._due_s = period_s, 0.0
        self._files = RoomFiles(folder, begun_s=wall_time())
        self._history_file = HistoryFile(folder)
        self.history = NodeHistory() if anew else self._history_file.read(wall_s=wall_time())
        self._wall_time = wall_time
        self._writing = threading.Lock()
        self.held: str | None = None
        self.memory = WorkingMemory(long_term=LongTermStore()) if anew else self._remembered()
        self._edits = self.memory.subscribe(capacity=4096)
        self._written_held: str | None = None

    def _remembered(self) -> WorkingMemory:
        stored = self._files.read()
        self.held = stored.held
        elapsed_s = max(0.0, self._wall_time() - stored.saved_s) if stored.saved_s else 0.0
        building = take_up(stored, now_s=0.0, elapsed_s=elapsed_s)
        for room, reason in building.dropped:
            logger.warning("%s is forgotten, because it does not fit the rest: %s", room, reason)
        memory = WorkingMemory(long_term=LongTermStore(building.rooms))
        if building.rooms:
            with memory.edit(AGENT, 0.0) as tx:
                tx.put(*building.shared)
                lose_robot(tx)
            logger.info("I remember %d rooms", len(building.rooms), extra={"age_s": elapsed_s})
        return memory

    async def step(self, stamp_s: float) -> None:
        """Write what has changed if it is time to, while others go on."""
        if self._taught() or held_in(self.memory.snapshot()) != self._written_held or stamp_s >= self._due_s:
            await asyncio.to_thread(self.write, stamp_s)

    def keep_taught(self, stamp_s: float) -> None:
        """Write down what a person has taught since the last writing, before anybody is told that it is known.

        Raises:
            OSError: it cannot be written.
        """
        if self._taught():
            self.write(stamp_s)

    def write(self, stamp_s: float) -> None:
        """Write what has changed since the last time.

        Raises:
            OSError: it cannot be written.
        """
        with self._writing:
            building = self.memory.building()
            rooms, held = rooms_to_keep(building), held_in(building)
            if rooms:
                now = {"stamp_s": stamp_s, "saved_s": self._wall_time()}
                self._files.write(rooms, shared=building.of_type(RegionNode), held=held, **now)
                self._history_file.write(self.history, stamp_s=stamp_s, wall_s=now["saved_s"])
            self._written_held, self._due_s = held, stamp_s + self._between_s

    def _taught(self) -> bool:
        """Whether a person has taught something since this was last asked; perhaps, where too much has happened."""
        return any(edit.agent == PERSON for edit in self._edits.poll()) or self._edits.lagged
