"""What references may lean on, and what comes of resolving one: nodes, none, or a question."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from planner.plan import Exchange


@dataclass(frozen=True, kw_only=True)
class NoReferent:
    """A reference names nothing; ``reason`` says so, with what there is instead.

    ``unknown``: no word is known. ``misplaced``: a room was looked for in a place, as in *the kitchen on the desk*.
    ``asks``: the reason is a question, and an answer would settle it. ``sought``: the kind of thing that was never
    seen; somewhere there may be one.
    """

    reason: str
    unknown: bool = False
    misplaced: bool = False
    asks: bool = False
    sought: str = ""


@dataclass(frozen=True, kw_only=True)
class Ambiguous:
    """A reference names several nodes; ``question`` asks which, ``phrase`` is what was said."""

    question: str
    phrase: str
    candidates: tuple[str, ...]


Trouble = NoReferent | Ambiguous
Grounded = tuple[str, ...] | Trouble


@dataclass(kw_only=True)
class Context:
    """What references may lean on.

    ``mentioned``: identifiers, the newest first. ``places``: places spoken of, the newest first. ``choices``: answers
    to earlier questions, by phrase. ``focus``: the room the request has just gone to. ``noun``: for *the red one*.
    ``origins``: where things were before they were moved. ``earlier``: what was asked before, the newest first.
    ``taken``: things of the steps before, which *one more* is not.
    ``last``: what the turn before spoke of. ``displaced``: things of which words about their place were true when they
    were said.
    ``unsettled``: why *it* names nothing, when what was spoken of last is not known.
    """

    speaker: str | None = None
    mentioned: tuple[str, ...] = ()
    fresh: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    focus: str | None = None
    noun: str = ""
    origins: Mapping[str, str] = field(default_factory=dict)
    earlier: tuple[Exchange, ...] = ()
    unsettled: Trouble | None = None
    taken: frozenset[str] = frozenset()
    last: tuple[str, ...] = ()
    displaced: frozenset[str] = frozenset()
