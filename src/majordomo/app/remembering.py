"""The building on disk: taken up at start, written now and then and at the end."""

from __future__ import annotations

import asyncio
import hashlib
import logging
import threading
from collections.abc import Callable
from pathlib import Path

from majordomo.perception.crossing import lose_robot
from majordomo.scene_graph.identifiers import slug
from majordomo.scene_graph.long_term.keeping import rooms_to_keep, take_up
from majordomo.scene_graph.long_term.long_term_store import LongTermStore
from majordomo.scene_graph.long_term.room_files import RoomFiles
from majordomo.scene_graph.memory import WorkingMemory
from majordomo.scene_graph.nodes import RegionNode
from majordomo.simulation.house import load_house

logger = logging.getLogger(__name__)

AGENT = "remembering"


def building_folder(data: Path, house: str) -> Path:
    """Where the building of a house is kept: by its name, and by its walls, which a map must not outlive.

    Raises:
        HouseError: there is no such house.
    """
    plan = load_house(house)
    walls = plan.model_dump_json(include={"rooms", "doors"})
    return data / "buildings" / f"{slug(plan.name or 'house')}-{hashlib.sha256(walls.encode()).hexdigest()[:8]}"


class Remembering:
    """Agent that writes the known building to its folder when it has changed.

    Attributes:
        memory: with everything that the folder held at the start. If that is anything, the robot does not know where
            it is. What cannot be read, or contradicts the rest, is reported and left out.
    """

    name = AGENT

    def __init__(
        self, folder: Path, *, wall_time: Callable[[], float], anew: bool = False, period_s: float = 20.0
    ) -> None:
        """Reads the folder.

        Args:
            folder: of this building alone.
            wall_time: seconds since 1970. A constant makes a run with a given folder repeatable.
            anew: begin with nothing; what the folder holds is replaced once a room stands.
            period_s: robot time between two writings.
        """
        self.period_s = period_s
        self._files = RoomFiles(folder)
        self._wall_time = wall_time
        self._writing = threading.Lock()
        self.memory = WorkingMemory(long_term=LongTermStore()) if anew else self._remembered()

    def _remembered(self) -> WorkingMemory:
        stored = self._files.read()
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
        """Write what has changed, while others go on."""
        await asyncio.to_thread(self.write, stamp_s)

    def write(self, stamp_s: float) -> None:
        """Write what has changed since the last time."""
        building = self.memory.building()
        rooms = rooms_to_keep(building)
        if rooms:
            regions = building.of_type(RegionNode)
            with self._writing:
                self._files.write(rooms, shared=regions, stamp_s=stamp_s, saved_s=self._wall_time())
