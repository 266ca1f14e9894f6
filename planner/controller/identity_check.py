"""What a request took the things in the graph for, and whether a closer look has shown that they are something else."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot

from planner.goals import PLACING, Goal
from planner.grounding.phrasing import article
from planner.grounding.settings import GroundingSettings
from planner.grounding.unlabeled import likely_label
from planner.language.lexicon.vocabulary import normal, singular, words_for
from scene_graph.nodes import ROBOT_ID, UNKNOWN_LABEL, ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.failures import Evidence, Failure, FailureCode


@dataclass(frozen=True, kw_only=True)
class IdentityCheckSettings:
    """When a thing surely is another one than it was taken for."""

    sure: float = 0.8
    """Probability of the new label from which the robot was mistaken. Chosen: less is flicker between frames."""
    ruled_out: float = 0.1
    """Probability of the old label below which the robot was mistaken. Chosen: as above."""
    near_m: float = 1.2
    """From so near a small thing is told apart; what it looks like from farther away waits until the robot is there.
    Chosen: where the shipped network tells small kinds apart.
    """


class IdentityCheck:
    """Remembers by which kinds a request called what it is to move, and where to.

    Args:
        request: in a person's words.
        goals: what they were taken to mean.
        snapshot: the graph in which that was so.
        settings: when it is sure that they are something else.
        grounding: by what numbers words were matched to things without a name.
    """

    def __init__(
        self,
        request: str,
        goals: Sequence[Goal],
        snapshot: Snapshot,
        *,
        settings: IdentityCheckSettings = IdentityCheckSettings(),
        grounding: GroundingSettings = GroundingSettings(),
    ) -> None:
        self._settings, self._likely = settings, grounding.likely
        spoken = {form for word in re.findall(r"[a-z]+", request.casefold()) for form in (word, singular(word))}
        self._places = frozenset(goal.args[1] for goal in goals if goal.predicate in PLACING)
        things = (goal.object_id for goal in goals if goal.object_id is not None)
        nodes = [snapshot.get(node_id) for node_id in dict.fromkeys((*things, *sorted(self._places)))]
        self._labels = {
            node.id: label
            for node in nodes
            if isinstance(node, ObjectNode)
            for label in (likely_label(node, grounding) or normal(node.label),)
            if spoken & {part for name in _names(label) for part in name.split()}
        }
        self._guessed = frozenset(i for i in self._labels if likely_label(snapshot.object(i), grounding) is not None)
        self._fallen: set[str] = set()

    def fell(self, object_id: str) -> None:
        """It was in the hand and slipped: as it lies now it may look like anything, and says no more about its kind
        than it did in the hand, until everything is done.
        """
        self._fallen.add(object_id)

    def mistake(self, snapshot: Snapshot, *, at_last: bool = False) -> Failure | None:
        """The first thing that surely is of another kind than the request called it; ``at_last``, when everything is to
        be said to be done: that is more likely of another kind.
        """
        for object_id, called in self._labels.items():
            node = snapshot.get(object_id)
            if not isinstance(node, ObjectNode) or normal(node.label) in _names(called) | {UNKNOWN_LABEL}:
                continue
            if not at_last and self._is_to_be_seen(object_id, snapshot):
                continue
            chances = {normal(label): probability for label, probability in node.label_distribution}
            old, new = chances.get(called, 0.0), chances.get(normal(node.label), 0.0)
            sure = old < self._settings.ruled_out and new > self._settings.sure
            if sure or at_last:
                seen = "Seen from near," if sure else "I cannot tell for sure, but"
                message = f"{seen} what I took for {article(called)} is {article(normal(node.label))}."
                evidence = Evidence(
                    nodes=(object_id,),
                    revision=snapshot.revision,
                    observation=f"{node.label}: {new:.2f}, {called}: {old:.2f}",
                )
                gone = FailureCode.SUPPORT_GONE if object_id in self._places else FailureCode.OBJECT_GONE
                return Failure(code=gone if sure else FailureCode.NOT_CONFIRMED, message=message, evidence=evidence)
        return None

    def refuted(self, snapshot: Snapshot, *, at_last: bool = False) -> Failure | None:
        """The first thing that has no name, any more or still, and surely is not what it was taken for. ``at_last``,
        one that never had a name has to be that most probably.
        """
        for object_id, called in self._labels.items():
            node = snapshot.get(object_id)
            if not isinstance(node, ObjectNode) or normal(node.label) != UNKNOWN_LABEL:
                continue
            if not at_last and self._is_to_be_seen(object_id, snapshot):
                continue
            chance = {normal(label): p for label, p in node.label_distribution}.get(called, 0.0)
            if chance < (self._likely if at_last and object_id in self._guessed else self._settings.ruled_out):
                evidence = Evidence(
                    nodes=(object_id,), revision=snapshot.revision, observation=f"{called}: {chance:.2f}"
                )
                message = f"Seen from near, what might have been {article(called)} is something I have no name for."
                gone = FailureCode.SUPPORT_GONE if object_id in self._places else FailureCode.OBJECT_GONE
                return Failure(code=gone, message=message, evidence=evidence)
        return None

    def _is_to_be_seen(self, object_id: str, snapshot: Snapshot) -> bool:
        """Whether it is too early to say what it is: it lies as it fell, or the robot is to come nearer to it."""
        if object_id in self._fallen:
            return True
        if object_id in self._places or snapshot.object(object_id).state is ObjectState.HELD:
            return False
        if snapshot.room_of(object_id) != snapshot.room_of(ROBOT_ID):
            return True
        x_m, y_m, _ = snapshot.position(object_id, ROBOT_ID)
        return hypot(x_m, y_m) > self._settings.near_m


def _names(label: str) -> frozenset[str]:
    """A label and the other words for it."""
    return words_for(normal(label)) | {normal(label)}
