"""Plans, and what a request was understood to be; plain values that the rest of the planner passes around."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from planner.forecast import NO_CHANGES, Forecast
from planner.goals import Goal
from skills.failures import FailureCode


@dataclass(frozen=True, kw_only=True)
class Step:
    """One skill with its arguments: ``PICK(bottle_1)``."""

    skill: str
    args: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.skill}({', '.join(self.args)})"


class Source(StrEnum):
    """Who named the goals: the command grammar, a language model, or the search for a missing object."""

    GRAMMAR = "grammar"
    MODEL = "model"
    SEARCH = "search"


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Steps that achieve ``goals`` when carried out from graph revision ``revision``.

    ``expected_s``, ``expected_m``: estimated time and way. ``changes``: to the graph, at its end. ``seeking``: the
    object a search plan looks for; its steps visit places, most likely first, and the rest of them is dropped as soon
    as the object is seen.
    """

    source: Source
    revision: int
    goals: tuple[Goal, ...]
    steps: tuple[Step, ...]
    expected_s: float = 0.0
    expected_m: float = 0.0
    changes: Forecast = NO_CHANGES
    seeking: str | None = None

    def __str__(self) -> str:
        return ", ".join(str(step) for step in self.steps) or "nothing to do"


@dataclass(frozen=True, kw_only=True)
class Impossible:
    """No plan exists; ``reason`` says why in one sentence, ``nodes`` are what it is about.

    ``lost``: what was looked for everywhere and not found, if that is why. ``code``: what has happened, if it was
    possible when the task began.
    """

    reason: str
    nodes: tuple[str, ...] = ()
    lost: str | None = None
    code: FailureCode | None = None


@dataclass(frozen=True, kw_only=True)
class Reinterpret:
    """No plan yet: the request is to be understood again, since what it speaks of may have been seen by now.

    ``displaced``: what was lost, and what turned up since and looks like it.
    """

    displaced: frozenset[str] = frozenset()


@dataclass(frozen=True, kw_only=True)
class Flaw:
    """What is wrong with a goal or plan: one sentence naming the fix, and the nodes it is about.

    ``code``: what has happened, when a plan has it that was sound before.
    """

    message: str
    nodes: tuple[str, ...] = ()
    code: FailureCode | None = None


class Kind(StrEnum):
    """What a request was understood to be."""

    PLAN = "plan"
    ANSWER = "answer"
    CLARIFY = "clarify"
    REFUSE = "refuse"


class QueryKind(StrEnum):
    """Closed set of questions that the graph can answer."""

    WHERE = "where"
    COUNT = "count"
    LIST = "list"
    EXISTS = "exists"
    ROBOT_ROOM = "robot_room"
    ROOM_OF = "room_of"
    HOLDING = "holding"
    SEEN = "seen"
    ROOMS = "rooms"
    COLOR = "color"
    ABILITIES = "abilities"
    DISTANCE = "distance"
    SIZE = "size"
    PATH = "path"
    LAST_SEEN = "last_seen"
    DONE = "done"
    FAILURE = "failure"
    DOING = "doing"
    BATTERY = "battery"
    NAME = "name"
    CAPABLE = "capable"
    NATURE = "nature"
    WELL_BEING = "well_being"
    SOURCE = "source"
    DURATION = "duration"
    ASKED = "asked"
    DONE_WITH = "done_with"
    EXPLORED = "explored"
    MOST = "most"
    COMPARE = "compare"
    MORE = "more"
    UNKNOWABLE = "unknowable"


@dataclass(frozen=True, kw_only=True)
class Query:
    """A question about the graph: its kind, the nodes it is about, and the words for them."""

    kind: QueryKind
    nodes: tuple[str, ...] = ()
    phrase: str = ""


@dataclass(frozen=True, kw_only=True)
class Exchange:
    """An earlier request: its words, what it was understood to be, and how it stands, in a sentence."""

    request: str
    goals: tuple[Goal, ...] = ()
    status: str = ""
    explanation: str = ""


@dataclass(frozen=True, kw_only=True)
class Lesson:
    """What a person teaches: the label of a room or object, or the name of an object or person."""

    node: str
    label: str | None = None
    name: str | None = None


@dataclass(frozen=True, kw_only=True)
class Interpretation:
    """What a request means on one revision of the graph.

    ``kind`` plan: ``goals`` are set and checked. answer: ``reply`` holds the answer, ``query`` the question. clarify:
    ``reply`` is the question to ask, ``candidates`` the identifiers to choose from, if that is the question, ``asked``
    the phrase that it is about.
    refuse: ``reply`` says why. ``lessons``: for the graph.
    ``mentioned``: identifiers that were spoken of, for later pronouns, the newest first. ``sought``: the kind of thing
    that was never seen, if that is why nothing can be done; ``closed``: the doors that are, if that is all that is why.
    """

    kind: Kind
    source: Source = Source.GRAMMAR
    goals: tuple[Goal, ...] = ()
    reply: str = ""
    candidates: tuple[str, ...] = ()
    asked: str = ""
    query: Query | None = None
    mentioned: tuple[str, ...] = ()
    lessons: tuple[Lesson, ...] = ()
    sought: str = ""
    closed: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Offer:
    """What a question gave to choose from: the phrase that it was about, and identifiers in the order of the question;
    none for a question of another kind.
    """

    asked: str = ""
    candidates: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Dialogue:
    """What was said before.

    ``answers``: the robot's questions about this very request and what was answered, oldest first. ``offers``: what
    each of them gave to choose from: *the second one* is the second of those, whatever is known by now. ``mentioned``:
    identifiers spoken of in earlier requests, the newest first. ``speaker``: the person who asks, if known.
    ``earlier``: what was asked before, the newest first. ``origins``: where things were before they were last moved.
    ``last``: identifiers that the turn before spoke of, which *them* may mean. ``displaced``: things that are no longer
    where they were when the request was made. ``task``: whose request it is, for journals.
    """

    answers: tuple[tuple[str, str], ...] = ()
    offers: tuple[Offer, ...] = ()
    mentioned: tuple[str, ...] = ()
    speaker: str | None = None
    earlier: tuple[Exchange, ...] = ()
    origins: Mapping[str, str] = field(default_factory=dict)
    last: tuple[str, ...] = ()
    displaced: frozenset[str] = frozenset()
    task: str = ""
