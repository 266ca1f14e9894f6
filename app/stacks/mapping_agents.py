"""The agents that turn LiDAR into a map, in the order in which they take their turns: localize, measure, remember."""

from __future__ import annotations

from app.scheduler import Agent
from perception.doors.door_concept import DoorConcept
from perception.lidar.slice import OutlineSlicer
from perception.localization.energy_optimizer import EnergyOptimizer
from perception.localization.relocalization import Relocalization
from perception.memory.long_term_memory import LongTermMemory
from perception.ports import RobotShape
from perception.rooms.room_concept import RoomConcept
from perception.sensing import SensorBuffer
from scene_graph.memory import WorkingMemory


def mapping_agents(memory: WorkingMemory, buffer: SensorBuffer, shape: RobotShape) -> list[Agent]:
    """Localization, room and door concepts and long-term memory over one graph and what the sensors said last.

    They share one slicer, so that each scan is cut once. ``shape``: of the robot's body, which must fit where it goes.
    """
    slicer = OutlineSlicer()
    return [
        EnergyOptimizer(memory, buffer, slicer=slicer),
        Relocalization(memory, buffer, slicer=slicer),
        RoomConcept(memory, buffer, shape=shape, slicer=slicer),
        DoorConcept(memory, buffer),
        LongTermMemory(memory, buffer, slicer=slicer),
    ]
