"""By what numbers what is said is understood."""

from __future__ import annotations

from dataclasses import dataclass, field

from planner.answers.settings import AnswerSettings
from planner.goals import GoalSettings
from planner.grounding.settings import GroundingSettings


@dataclass(frozen=True, kw_only=True)
class DialogueSettings:
    """What counts as a short remark, and everything below it that words are understood by."""

    remark_characters: int = 200
    """A remark about the request before is no longer. Chosen: longer ones are requests."""
    choice_words: int = 14
    """A sentence in which one of several candidates is spoken of has no more words. Chosen: as above."""
    most_replaced: int = 5
    """So many last words of a request may be taken back. Chosen: a noun phrase with its place."""
    most_mentioned: int = 6
    """Of an answer so many things can be meant by *it* and *them*. Chosen: those that are named."""
    goals: GoalSettings = field(default_factory=GoalSettings)
    grounding: GroundingSettings = field(default_factory=GroundingSettings)
    answers: AnswerSettings = field(default_factory=AnswerSettings)
