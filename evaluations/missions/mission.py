"""One mission: a request in a house, what is to come of it, and what a person does meanwhile."""

from __future__ import annotations

from dataclasses import dataclass

from evaluations.missions.outcome import Outcome


@dataclass(frozen=True, kw_only=True)
class Mission:
    """``house``: as ``evaluate perception`` takes it. ``kind``: of request, for the tables.

    ``outcomes``: any of them will do; none where only what the robot reports is recorded. ``disturbance``: the name of
    what happens meanwhile, ``""`` for nothing.
    """

    house: str
    kind: str
    request: str
    outcomes: tuple[Outcome, ...] = ()
    disturbance: str = ""
    seed: int = 0

    @property
    def things(self) -> tuple[str, ...]:
        """Everything that it moves, in the order of its words."""
        return tuple(dict.fromkeys(thing for outcome in self.outcomes for thing in outcome.things))

    @property
    def places(self) -> tuple[str, ...]:
        """Everywhere that may go."""
        return tuple(dict.fromkeys(place for outcome in self.outcomes for place in outcome.places))

    @property
    def rooms(self) -> tuple[str, ...]:
        """Every room that the robot itself may be sent to."""
        return tuple(dict.fromkeys(room for outcome in self.outcomes for room in outcome.rooms))
