"""What the fingers feel: taken, let go, or lost (contracts, pattern 7).

Sight cannot follow a thing into the hand. The skills say what they try in the robot's status (``grasping bottle_3``,
``releasing bottle_3 table_1``), the fingers say whether it worked.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from perception.ports import JointState


class GripChange(StrEnum):
    """What has just happened to the thing in the hand."""

    TAKEN = "taken"
    RELEASED = "released"
    LOST = "lost"


@dataclass(frozen=True, kw_only=True)
class GripEvent:
    """A change of the grip. ``place``: where a released thing was meant to go, if that was said."""

    change: GripChange
    object_id: str
    place: str | None = None


@dataclass(frozen=True, kw_only=True)
class GripSettings:
    """``steady_s``: how long contact, or its loss, must last. ``memory_s``: how long an announcement holds.

    ``opening_m``: fingers farther open or closed than this hold nothing.
    """

    steady_s: float = 0.15
    memory_s: float = 4.0
    opening_m: tuple[float, float] = (0.003, 0.117)
    closed_m: float = 0.004
    """Fingers that are closer together by more than this than when they last felt something have closed on nothing."""
    off_center_m: float = 0.08
    """How far from the middle of the grip the middle of a thing may be that is held at its end."""
    released_sigma_m: float = 0.03
    """How well the place of a thing is known that was let go and not seen yet."""
    lost_sigma_m: float = 0.5
    """The same of what slipped: it may have rolled."""
    support_m: float = 0.12
    """What is let go this near above a support or in it stands on that."""


class Grip:
    """Turns announcements and finger contacts into events."""

    def __init__(self, settings: GripSettings, held_before: str | None = None) -> None:
        """``held_before``: what the hand had when the robot was switched off. Fingers that are closed on something from
        the start still have it; where they feel nothing, it is no longer there.
        """
        self._settings = settings
        self._held_before = held_before
        self._announced: tuple[str, str, str | None, float] | None = None
        self._since_s: float | None = None
        self._felt = False
        self._held_open_m = 0.0

    def update(self, joints: JointState, status: str, holding: str | None) -> GripEvent | None:
        """The event of this step, if any. ``holding``: what the graph believes to be in the hand."""
        self._listen(status, joints.stamp_s)
        low_m, high_m = self._settings.opening_m
        closed_on_something = all(joints.finger_contacts) and low_m < joints.gripper_opening_m < high_m
        free = not any(joints.finger_contacts) or joints.gripper_opening_m <= low_m
        if closed_on_something:
            self._held_open_m = joints.gripper_opening_m
        if holding is None and self._held_before is not None:
            return self._found(closed_on_something, joints.stamp_s)
        if holding is None:
            return self._taken(joints.stamp_s) if self._lasting(closed_on_something, joints.stamp_s) else None
        return self._let_go(holding, joints) if self._lasting(free, joints.stamp_s) else None

    @staticmethod
    def closing_on(status: str) -> str | None:
        """What the hand is about to close on, as the skills say."""
        said = _said(status)
        return said[1] if said is not None and said[0] == "grasping" else None

    def _listen(self, status: str, stamp_s: float) -> None:
        if (said := _said(status)) is not None:
            self._announced = (*said, stamp_s)

    def _lasting(self, condition: bool, stamp_s: float) -> bool:
        if not condition:
            self._since_s = None
            return False
        if self._since_s is None:
            self._since_s = stamp_s
        return stamp_s - self._since_s >= self._settings.steady_s

    def _found(self, closed_on_something: bool, stamp_s: float) -> GripEvent | None:
        """What the first steady feeling after a start says of the thing held before."""
        if self._since_s is None or closed_on_something is not self._felt:
            self._felt, self._since_s = closed_on_something, stamp_s
        if stamp_s - self._since_s < self._settings.steady_s or self._held_before is None:
            return None
        before, self._held_before, self._since_s = self._held_before, None, None
        return GripEvent(change=GripChange.TAKEN, object_id=before) if closed_on_something else None

    def _taken(self, stamp_s: float) -> GripEvent | None:
        announced = self._recent("grasping", stamp_s)
        return GripEvent(change=GripChange.TAKEN, object_id=announced[0]) if announced is not None else None

    def _let_go(self, holding: str, joints: JointState) -> GripEvent:
        """Fingers that release something open; where they have closed further, it slipped before it stood."""
        announced = self._recent("releasing", joints.stamp_s)
        slipped = joints.gripper_opening_m < self._held_open_m - self._settings.closed_m
        if announced is not None and announced[0] == holding and not slipped:
            return GripEvent(change=GripChange.RELEASED, object_id=holding, place=announced[1])
        return GripEvent(change=GripChange.LOST, object_id=holding)

    def _recent(self, word: str, stamp_s: float) -> tuple[str, str | None] | None:
        if self._announced is None or self._announced[0] != word:
            return None
        return self._announced[1:3] if stamp_s - self._announced[3] <= self._settings.memory_s else None


def _said(status: str) -> tuple[str, str, str | None] | None:
    """What the skills say they try: the word, the thing, and where to, if that was said."""
    words = status.split()
    if len(words) < 2 or words[0] not in {"grasping", "releasing"}:
        return None
    return words[0], words[1], words[2] if len(words) > 2 else None
