"""What a sentence is made of: steps without a verb of their own, conditions, and what comes first."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from planner.language.grammar.syntax import Destination, Reference
from planner.language.parsing.chart import Packed


@dataclass(frozen=True, kw_only=True)
class Elliptic:
    """*… then to the office*, *… the book too*: a step whose verb is that of the step before."""

    things: tuple[Reference, ...] = ()
    destination: Destination | None = None


@dataclass(frozen=True, kw_only=True)
class Branching:
    """*If …, do this, otherwise that.* ``condition`` None: ``otherwise`` is for when ``then`` has no referent, or the
    condition is the question before.
    """

    condition: Packed | None
    negated: bool
    then: tuple[Any, ...]
    otherwise: tuple[Any, ...] = ()
    before: bool = False


@dataclass(frozen=True, kw_only=True)
class Unable:
    """A step by a verb that the robot has no skill for."""

    verb: str


@dataclass(frozen=True, kw_only=True)
class First:
    """*But first …*: what comes before the step before."""

    then: tuple[Any, ...]
