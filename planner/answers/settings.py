"""By what numbers answers are given."""

from __future__ import annotations

from dataclasses import dataclass

from planner.goals import GoalSettings
from planner.skill_planner.settings import ObjectSearchSettings


@dataclass(frozen=True, kw_only=True)
class AnswerSettings:
    """What counts as now, and how long answers get."""

    now_s: float = GoalSettings.fresh_s
    """What was seen this long ago or less is seen now."""
    speed_mps: float = ObjectSearchSettings.speed_mps
    """Expected average speed of driving, for *how long would you need*."""
    handling_s: float = 60.0
    """Picking one thing up and putting it down. Chosen: rough, and said to be so."""
    most_named: int = 6
    """So many things are told one by one. Chosen: nobody listens to the end of a longer list."""
    most_told: int = 3
    """So many of the latest requests are told. Chosen: as above, since each is a sentence of its own."""
