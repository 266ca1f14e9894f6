"""What to do about each failure: how long to wait, how often to try, and how to say it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from skills.failures import FailureCode


@dataclass(frozen=True, kw_only=True)
class Recovery:
    """After ``wait_s`` seconds of standing still a new plan is made from the graph as it is then.

    ``looks``: whether the robot first looks at what it did not get to: what was in the way may long be gone.
    ``times``: how often this code may happen to the same step before the task fails. ``suggestion``: what the robot
    tries next, said to a person; ``{thing}`` stands for what the failure is about.
    """

    suggestion: str
    times: int = 3
    wait_s: float = 0.0
    looks: bool = False


RECOVERIES: Mapping[FailureCode, Recovery] = MappingProxyType(
    {
        FailureCode.OBJECT_MOVED: Recovery(suggestion="I will go where {thing} is now.", times=6),
        FailureCode.OBJECT_GONE: Recovery(suggestion="I will look for {thing} in other places.", times=6),
        FailureCode.GRASP_EMPTY: Recovery(suggestion="I will look again and try to grasp {thing} another way."),
        FailureCode.SLIPPED: Recovery(suggestion="I will look for {thing} and pick it up again."),
        FailureCode.DROPPED: Recovery(suggestion="I will pick {thing} up again."),
        FailureCode.SUPPORT_FULL: Recovery(suggestion="I will look for a free spot once more.", times=2, looks=True),
        FailureCode.SUPPORT_GONE: Recovery(suggestion="I will look for {thing}.", times=2),
        FailureCode.WAY_BLOCKED: Recovery(suggestion="I will wait a moment and look for another way.", wait_s=3.0),
        FailureCode.DOOR_CLOSED: Recovery(suggestion="I will look for another way.", wait_s=1.0),
        FailureCode.PERSON_IN_WAY: Recovery(suggestion="I will wait until the way is free.", wait_s=5.0, times=4),
        FailureCode.ROBOT_MOVED: Recovery(suggestion="I will find out where I am and go on from here.", wait_s=2.0),
        FailureCode.LOCALIZATION_LOST: Recovery(suggestion="I will stand still until I know where I am.", wait_s=5.0),
        FailureCode.SENSOR_SILENT: Recovery(suggestion="I will wait for the sensor.", wait_s=5.0),
        FailureCode.BODY_SILENT: Recovery(suggestion="I will wait for my body to answer.", wait_s=5.0),
        FailureCode.TIMEOUT: Recovery(suggestion="I will try once more.", times=2),
        FailureCode.UNREACHABLE: Recovery(suggestion="I will try from another side.", times=2, looks=True),
        FailureCode.NOT_CONFIRMED: Recovery(suggestion="I will look again and make a new plan."),
    }
)
"""One row for each code; a test keeps it complete."""


class RecoveryPolicy:
    """Counts a task's failures and says when to stop trying."""

    def __init__(self, *, max_failures: int) -> None:
        self._max_failures = max_failures
        self._counts: Counter[tuple[FailureCode, str]] = Counter()

    def after(self, code: FailureCode, step: str) -> Recovery | None:
        """What to do after one more failure, ``None`` when it is time to give up."""
        self._counts[code, step] += 1
        recovery = RECOVERIES[code]
        if self._counts[code, step] >= recovery.times or self._counts.total() > self._max_failures:
            return None
        return recovery

    def times(self, code: FailureCode, step: str) -> int:
        """How often this has happened."""
        return self._counts[code, step]
