"""Things that perception has no name for, and what they may be."""

from __future__ import annotations

from planner.language.lexicon.vocabulary import normal, singular, words_for
from scene_graph.nodes import UNKNOWN_LABEL, ObjectNode
from scene_graph.snapshot import Snapshot

LIKELY = 0.3
"""Probability from which a nameless thing may be meant by a name, where nothing of that name is known."""


def likely_label(node: ObjectNode) -> str | None:
    """What a nameless thing most probably is; None of one that has a name, and where nothing is likely enough."""
    if normal(node.label) != UNKNOWN_LABEL:
        return None
    named = ((probability, label) for label, probability in node.label_distribution if normal(label) != UNKNOWN_LABEL)
    probability, label = max(named, default=(0.0, ""))
    return normal(label) if probability >= LIKELY else None


def perhaps(head: str, snapshot: Snapshot) -> tuple[str, ...]:
    """Identifiers of nameless things that most probably are what ``head`` says, in the graph's order."""
    called = words_for(head) | {head, singular(head)}
    return tuple(node.id for node in snapshot.of_type(ObjectNode) if likely_label(node) in called)
