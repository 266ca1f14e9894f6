"""What a request should lead to; plain values, one class a kind."""

from __future__ import annotations

from dataclasses import dataclass

HAND = "hand"
ROBOT = "robot"

Words = tuple[tuple[str, ...], ...]
"""All of these must be said, each in one of its wordings."""


@dataclass(frozen=True, kw_only=True)
class Condition:
    """``count`` of ``subjects`` are at one of ``places``: furniture, persons, rooms, or ``hand``.

    The only subject may be ``robot``. When there are more subjects than are counted, the others stay where they are.
    """

    subjects: tuple[str, ...]
    count: int
    places: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class EndState:
    """``stages`` come true in this order, and what they say of a subject last holds in the end; nothing else moves.

    ``aside``: objects that may be put anywhere on the way.
    """

    stages: tuple[tuple[Condition, ...], ...]
    aside: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Seek:
    """The robot looks for an object that is not where it was."""

    object_id: str


@dataclass(frozen=True, kw_only=True)
class Answered:
    """A reply with these words and without those in ``never``; nothing moves."""

    words: Words
    never: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class Asked:
    """A question, with exactly these candidates when some are given."""

    candidates: frozenset[str] = frozenset()


@dataclass(frozen=True, kw_only=True)
class Refused:
    """A refusal with these words in it."""

    words: Words = ()


@dataclass(frozen=True, kw_only=True)
class Declined:
    """A refusal or a question that names the part of the request that cannot be done."""

    words: Words


@dataclass(frozen=True, kw_only=True)
class Controlled:
    """A control word: ``stop``, ``pause``, ``resume`` or ``cancel``."""

    word: str


@dataclass(frozen=True, kw_only=True)
class Taught:
    """A node has this label or name from now on."""

    node_id: str
    name: str


Expectation = EndState | Seek | Answered | Asked | Refused | Declined | Controlled | Taught


@dataclass(frozen=True, kw_only=True)
class Turn:
    """What is said, and what may come of it: any one of ``expected``."""

    text: str
    expected: tuple[Expectation, ...]


@dataclass(frozen=True, kw_only=True)
class Request:
    """One request, or a dialogue of several turns, about a building; ``half`` and ``line`` say where it is written."""

    half: str
    line: int
    category: str
    building: str
    turns: tuple[Turn, ...]

    @property
    def name(self) -> str:
        """Such as ``held_out:17``."""
        return f"{self.half}:{self.line}"
