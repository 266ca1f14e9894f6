"""By what numbers requests become goals."""

from __future__ import annotations

from dataclasses import dataclass, field

from planner.dialogue.settings import DialogueSettings


@dataclass(frozen=True, kw_only=True)
class OutlineSettings:
    """How much of the graph a model reads; more costs it time, and small models lose the thread."""

    most_objects: int = 64
    """Chosen: with rooms and doors about two thousand tokens, a quarter of the smallest context."""
    most_there: int = 24
    """Of what is on or in what the request names, so that it leaves room for other things. Chosen: a full table."""
    most_rooms: int = 60
    """Chosen: those with the objects in them come first."""


@dataclass(frozen=True, kw_only=True)
class TaskPlannerSettings:
    """Limits of the conversation with a language model, and how words are understood without one."""

    rounds: int = 5
    """Answers of a model to one request, corrections included (design, section 8)."""
    repeats: int = 2
    """How often the same question is asked again after a refusal or a pause. Chosen: it may pass, and must end."""
    deadline_s: float = 45.0
    """For all rounds with a language model together, in wall time; a mission waits longer than that."""
    outline: OutlineSettings = field(default_factory=OutlineSettings)
    dialogue: DialogueSettings = field(default_factory=DialogueSettings)
