"""How a recording was made, as far as a replay must know it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from app.settings import ClockMode, Settings


def profile_of(settings: Settings) -> dict[str, str]:
    """What a replay must know of how a recording was made."""
    return {
        "house": settings.house,
        "seed": str(settings.seed),
        "explore": str(settings.explore),
        "camera": str(settings.camera),
        "camera_hz": repr(settings.camera_hz),
    }


def settings_of(profile: Mapping[str, str], **changes: Any) -> Settings:
    """Settings for a replay of a recording that was made so.

    Raises:
        ValidationError: the profile holds what no settings can.
    """
    known = {name: value for name, value in profile.items() if name in {"seed", "explore", "camera", "camera_hz"}}
    fixed = {"clock": ClockMode.LOCKSTEP, "speed": None, "remember": False}
    return Settings.model_validate({**known, **fixed, **changes})
