"""Reads one line of expectation; the words are those of ``docs/requests.md``."""

from __future__ import annotations

import re
from collections.abc import Callable

from evaluations.planning.judging.expectations import (
    HAND,
    ROBOT,
    Answered,
    Asked,
    Condition,
    Controlled,
    Declined,
    EndState,
    Expectation,
    Refused,
    Seek,
    Taught,
    Words,
)
from planner.language.sentences.control import Control
from scene_graph.identifiers import natural_key
from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot

_COUNTED = re.compile(r"(\d+) of (.+)")


class BadExpectation(ValueError):
    """``field`` of an expectation cannot be read; ``problem`` says why."""

    def __init__(self, field: str, problem: str) -> None:
        self.field, self.problem = field, problem
        super().__init__(f"{field}: {problem}")


def read_expectation(text: str, snapshot: Snapshot) -> Expectation:
    """The expectation that a line stands for; every node that it names is in ``snapshot``.

    Raises:
        BadExpectation: naming the field.
    """
    if "->" in text:
        return _end_state(text, snapshot)
    kind, _, rest = text.partition(" ")
    if kind not in _READERS:
        known = ", ".join(_READERS)
        raise BadExpectation(kind or "expectation", f"is none of {known}, nor an end state such as 'cup_1 -> table_1'")
    return _READERS[kind](rest.strip(), snapshot)


def _end_state(text: str, snapshot: Snapshot) -> EndState:
    stages: list[tuple[Condition, ...]] = []
    aside: tuple[str, ...] = ()
    for stage in re.split(r"\bthen\b", text):
        conditions = []
        for part in filter(None, map(str.strip, stage.split(";"))):
            if part.startswith("aside "):
                aside += _nodes(part.removeprefix("aside "), snapshot)
            else:
                conditions.append(_condition(part, snapshot))
        stages.append(tuple(conditions))
    return EndState(stages=tuple(stages), aside=aside)


def _condition(text: str, snapshot: Snapshot) -> Condition:
    left, arrow, right = (part.strip() for part in text.partition("->"))
    if not arrow or not left or not right:
        raise BadExpectation("end state", f"{text!r} is not of the form 'cup_1 -> table_1|table_2'")
    places = tuple(place.strip() for place in right.split("|"))
    for place in places:
        if place not in (HAND, *snapshot.nodes):
            raise BadExpectation(place, "is no node of the building")
    if left == ROBOT:
        return Condition(subjects=(ROBOT,), count=1, places=places)
    counted = _COUNTED.fullmatch(left)
    subjects = _nodes(counted[2] if counted else left, snapshot)
    count = int(counted[1]) if counted else len(subjects)
    if not 0 < count <= len(subjects):
        raise BadExpectation(left, f"there are {len(subjects)} of them")
    return Condition(subjects=subjects, count=count, places=places)


def _nodes(text: str, snapshot: Snapshot) -> tuple[str, ...]:
    """Identifiers, and sets such as ``red.cup@room_2``: all red cups in that room or on that piece of furniture."""
    found: dict[str, None] = {}
    for word in text.split():
        if "@" in word:
            found.update(dict.fromkeys(_set(word, snapshot)))
        elif word in snapshot:
            found[word] = None
        else:
            raise BadExpectation(word, "is no node of the building")
    if not found:
        raise BadExpectation("nodes", "none is named")
    return tuple(found)


def _set(word: str, snapshot: Snapshot) -> tuple[str, ...]:
    what, _, place = word.partition("@")
    color, _, label = what.rpartition(".")
    if place != "*" and place not in snapshot:
        raise BadExpectation(word, f"{place} is no node of the building")
    fits = [
        node.id
        for node in snapshot.of_type(ObjectNode)
        if node.label == label.replace("_", " ")
        and color in ("", node.color)
        and place in ("*", snapshot.room_of(node.id), snapshot.support_of(node.id))
    ]
    if not fits:
        raise BadExpectation(word, "there is no such thing in the building")
    return tuple(sorted(fits, key=natural_key))


def _words(text: str) -> tuple[Words, tuple[str, ...]]:
    parts = [part.strip() for part in text.split(",") if part.strip()]
    said = tuple(tuple(way.strip() for way in part.split("|")) for part in parts if not part.startswith("!"))
    return said, tuple(part[1:].strip() for part in parts if part.startswith("!"))


def _answered(text: str, snapshot: Snapshot) -> Answered:
    del snapshot
    words, never = _words(text)
    if not words and not never:
        raise BadExpectation("answer", "say which words it must have: 'answer kitchen|room_2, !office'")
    return Answered(words=words, never=never)


def _asked(text: str, snapshot: Snapshot) -> Asked:
    return Asked(candidates=frozenset(_nodes(text, snapshot)) if text else frozenset())


def _declined(text: str, snapshot: Snapshot) -> Declined:
    del snapshot
    words, _ = _words(text)
    if not words:
        raise BadExpectation("decline", "say which part cannot be done: 'decline wash|washing'")
    return Declined(words=words)


def _controlled(text: str, snapshot: Snapshot) -> Controlled:
    del snapshot
    if text not in list(Control):
        raise BadExpectation("control", f"{text!r} is none of {', '.join(Control)}")
    return Controlled(word=text)


def _taught(text: str, snapshot: Snapshot) -> Taught:
    node_id, _, name = text.partition(" ")
    (node_id,) = _nodes(node_id, snapshot)
    if not name.strip():
        raise BadExpectation("taught", "say the label or name: 'taught room_1 office'")
    return Taught(node_id=node_id, name=name.strip())


def _seek(text: str, snapshot: Snapshot) -> Seek:
    found = _nodes(text, snapshot)
    if len(found) != 1:
        raise BadExpectation("seek", "one thing is looked for at a time")
    return Seek(object_id=found[0])


_READERS: dict[str, Callable[[str, Snapshot], Expectation]] = {
    "answer": _answered,
    "ask": _asked,
    "refuse": lambda text, _: Refused(words=_words(text)[0]),
    "decline": _declined,
    "control": _controlled,
    "taught": _taught,
    "seek": _seek,
}
