"""Things that perception has no name for, and what they may be."""

from __future__ import annotations

from planner.grounding.settings import GroundingSettings
from planner.language.lexicon.vocabulary import normal, singular, words_for
from scene_graph.nodes import UNKNOWN_LABEL, ObjectNode
from scene_graph.snapshot import Snapshot


def likely_label(node: ObjectNode, settings: GroundingSettings = GroundingSettings()) -> str | None:
    """What a unlabeled thing most probably is; None of one that has a name, and where nothing is likely enough."""
    if normal(node.label) != UNKNOWN_LABEL:
        return None
    named = ((probability, label) for label, probability in node.label_distribution if normal(label) != UNKNOWN_LABEL)
    probability, label = max(named, default=(0.0, ""))
    return normal(label) if probability >= settings.likely else None


def likely_named(head: str, snapshot: Snapshot, settings: GroundingSettings = GroundingSettings()) -> tuple[str, ...]:
    """Identifiers of unlabeled things that most probably are what ``head`` says, in the graph's order."""
    called = words_for(head) | {head, singular(head)}
    return tuple(node.id for node in snapshot.of_type(ObjectNode) if likely_label(node, settings) in called)
