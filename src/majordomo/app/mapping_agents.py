"""The agents that turn LiDAR into a map, in the order in which they take their turns: localize, measure, remember."""

from __future__ import annotations

from majordomo.app.scheduler import Agent
from majordomo.perception.doors.door_concept import DoorConcept
from majordomo.perception.localization.energy_optimizer import EnergyOptimizer
from majordomo.perception.localization.recovery import Relocalization
from majordomo.perception.memory.long_term_memory import LongTermMemory
from majordomo.perception.rooms.room_concept import RoomConcept
from majordomo.perception.rooms.slice import OutlineSlicer
from majordomo.perception.sensing import SensorBuffer
from majordomo.scene_graph.memory import WorkingMemory


def mapping_agents(memory: WorkingMemory, buffer: SensorBuffer) -> list[Agent]:
    """Localization, room and door concepts and long-term memory over one graph and what the sensors said last.

    They share one slicer, so that each scan is cut once.
    """
    slicer = OutlineSlicer()
    return [
        EnergyOptimizer(memory, buffer, slicer=slicer),
        Relocalization(memory, buffer, slicer=slicer),
        RoomConcept(memory, buffer, slicer=slicer),
        DoorConcept(memory, buffer),
        LongTermMemory(memory, buffer, slicer=slicer),
    ]
