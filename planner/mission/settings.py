"""By what numbers tasks are carried out."""

from __future__ import annotations

from dataclasses import dataclass, field

from planner.controller.identity_check import IdentityCheckSettings
from planner.goals import GoalSettings
from planner.grounding.settings import GroundingSettings


@dataclass(frozen=True, kw_only=True)
class MissionSettings:
    """Limits of a mission."""

    max_failures: int = 5
    """A task that meets more than this many failures on its way ends. Chosen: minutes of trying, not hours."""
    confirm_s: float = 3.0
    """How long perception has to confirm a step before the robot looks again, and again after that. Chosen: several of
    its frames.
    """
    settle_s: float = 1.0
    """How long perception has, at a place that is searched, to notice the object. Chosen: a few of its frames."""
    interpret_s: float = 60.0
    """Deadline for understanding a request, wall time; more than all rounds with a language model take."""
    look_timeout_s: float = 60.0
    """How long another look at something may take. Chosen: to go around a table and up to it."""
    lost_patience_s: float = 120.0
    """How long what is to be done waits for a robot that does not know where it is; then it is turned down. Chosen:
    longer than looking around in a room takes.
    """
    fresh_s: float = 30.0
    """What was seen so long ago at most is still so, and not looked at a second time. Chosen: people take longer."""
    mentions: int = 20
    """Identifiers remembered for pronouns in later requests. Chosen: more than anybody keeps in mind."""
    earlier: int = 10
    """Earlier requests that can be asked about. Chosen: as above."""
    goals: GoalSettings = field(default_factory=GoalSettings)
    grounding: GroundingSettings = field(default_factory=GroundingSettings)
    identity: IdentityCheckSettings = field(default_factory=IdentityCheckSettings)
