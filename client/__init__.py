"""The Python client of a running service, synchronous (`Client`) and asynchronous (`AsyncClient`).

from majordomo import Client

with Client.local() as robot:
task = robot.submit("bring the blue bottle to the desk")
print(robot.wait(task.id, timeout_s=300).explanation)
"""

from client.asynchronous import AsyncClient
from client.documents import Event, Node, Scene, Status, Task, Trace, TraceEntry
from client.errors import (
    ClientError,
    Forbidden,
    Invalid,
    NoService,
    NotAllowedNow,
    NotFound,
    Refused,
    StillWaiting,
    TooManyRequests,
    Unauthorized,
    Unavailable,
)
from client.service import Service, find_service
from client.synchronous import Client

__all__ = [
    "AsyncClient",
    "Client",
    "ClientError",
    "Event",
    "Forbidden",
    "Invalid",
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
