"""All that was tuned of the skills in one value; its parts stand with what they are of."""

from __future__ import annotations

from dataclasses import dataclass, field

from skills.arm.hand import HandSettings
from skills.arm.settings import ApproachSettings, ArmSettings, ReachSettings
from skills.goto.settings import GotoSettings
from skills.looking.settings import LookSettings
from skills.navigation.settings import NavigationSettings
from skills.obstacles.settings import ObstacleSettings
from skills.place.settings import PlaceSettings


@dataclass(frozen=True, kw_only=True)
class SkillSettings:
    """What the actions of all skills go by."""

    hand: HandSettings = field(default_factory=HandSettings)
    arm: ArmSettings = field(default_factory=ArmSettings)
    reach: ReachSettings = field(default_factory=ReachSettings)
    approach: ApproachSettings = field(default_factory=ApproachSettings)
    goto: GotoSettings = field(default_factory=GotoSettings)
    looking: LookSettings = field(default_factory=LookSettings)
    navigation: NavigationSettings = field(default_factory=NavigationSettings)
    obstacles: ObstacleSettings = field(default_factory=ObstacleSettings)
    place: PlaceSettings = field(default_factory=PlaceSettings)
    blocked_s: float = 120.0
    """So long what stopped base or arm is expected to be there. Chosen."""
