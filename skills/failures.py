"""The closed set of reasons for which a skill can fail, and the evidence that goes with one."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class FailureCode(StrEnum):
    """Why an action or step failed; the value appears in the API."""

    OBJECT_MOVED = "object_moved"
    OBJECT_GONE = "object_gone"
    GRASP_EMPTY = "grasp_empty"
    SLIPPED = "slipped"
    DROPPED = "dropped"
    SUPPORT_FULL = "support_full"
    SUPPORT_GONE = "support_gone"
    WAY_BLOCKED = "way_blocked"
    DOOR_CLOSED = "door_closed"
    PERSON_IN_WAY = "person_in_way"
    ROBOT_MOVED = "robot_moved"
    LOCALIZATION_LOST = "localization_lost"
    SENSOR_SILENT = "sensor_silent"
    TIMEOUT = "timeout"
    UNREACHABLE = "unreachable"
    NOT_CONFIRMED = "not_confirmed"
    BODY_SILENT = "body_silent"


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """What the failure rests on: graph nodes, the revision they were read at, and the observation in words."""

    nodes: tuple[str, ...] = ()
    revision: int = 0
    observation: str = ""


@dataclass(frozen=True, kw_only=True)
class Failure:
    """One failure: its code, one sentence a person understands, and the evidence."""

    code: FailureCode
    message: str
    evidence: Evidence = Evidence()
