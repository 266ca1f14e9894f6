"""The Python client of a running service, synchronous (`Majordomo`) and asynchronous (`AsyncMajordomo`).

from majordomo.client import Majordomo

with Majordomo.local() as robot:
task = robot.submit("bring the blue bottle to the desk")
print(robot.wait(task.id, timeout_s=300).explanation)
"""

from majordomo.client.asynchronous import AsyncMajordomo
from majordomo.client.documents import Event, Node, Scene, Status, Task, Trace, TraceEntry
from majordomo.client.errors import (
    Forbidden,
    Invalid,
    MajordomoError,
    NoService,
    NotAllowedNow,
    NotFound,
    Refused,
    StillWaiting,
    TooManyRequests,
    Unauthorized,
    Unavailable,
)
from majordomo.client.service import Service, find_service
from majordomo.client.synchronous import Majordomo

__all__ = [
    "AsyncMajordomo",
    "Event",
    "Forbidden",
    "Invalid",
    "Majordomo",
    "MajordomoError",
    "NoService",
    "Node",
    "NotAllowedNow",
    "NotFound",
    "Refused",
    "Scene",
    "Service",
    "Status",
    "StillWaiting",
    "Task",
    "TooManyRequests",
    "Trace",
    "TraceEntry",
    "Unauthorized",
    "Unavailable",
    "find_service",
]
