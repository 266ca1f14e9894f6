"""What a request took the things in the graph for, and whether a closer look has shown that they are something else."""

from __future__ import annotations

import re
from collections.abc import Sequence

from majordomo.planner.goals import Goal
from majordomo.planner.phrasing import article
from majordomo.planner.vocabulary import normal, singular, words_for
from majordomo.scene_graph.nodes import ObjectNode
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.failures import Evidence, Failure, FailureCode

SURE, RULED_OUT = 0.8, 0.05
"""Probability of the new label, and of the old one, at which the robot was mistaken; less is flicker."""


class TakenFor:
    """Remembers by which kinds a request called its objects.

    Args:
        request: in a person's words.
        goals: what they were taken to mean.
        snapshot: the graph in which that was so.
    """

    def __init__(self, request: str, goals: Sequence[Goal], snapshot: Snapshot) -> None:
        spoken = {form for word in re.findall(r"[a-z]+", request.casefold()) for form in (word, singular(word))}
        nodes = [snapshot.get(arg) for arg in dict.fromkeys(arg for goal in goals for arg in goal.args)]
        self._labels = {
            node.id: normal(node.label)
            for node in nodes
            if isinstance(node, ObjectNode) and spoken & {part for name in _names(node.label) for part in name.split()}
        }

    def mistake(self, snapshot: Snapshot) -> Failure | None:
        """The first thing that surely is of another kind than the request called it."""
        for object_id, called in self._labels.items():
            node = snapshot.get(object_id)
            if not isinstance(node, ObjectNode) or normal(node.label) in _names(called):
                continue
            chances = {normal(label): probability for label, probability in node.label_distribution}
            if chances.get(called, 0.0) < RULED_OUT and chances.get(normal(node.label), 0.0) > SURE:
                message = f"Seen from near, what I took for {article(called)} is {article(normal(node.label))}."
                saw = f"{node.label}: {chances[normal(node.label)]:.2f}, {called}: {chances.get(called, 0.0):.2f}"
                evidence = Evidence(nodes=(object_id,), revision=snapshot.revision, observation=saw)
                return Failure(code=FailureCode.OBJECT_GONE, message=message, evidence=evidence)
        return None


def _names(label: str) -> frozenset[str]:
    """A label and the other words for it."""
    return words_for(normal(label)) | {normal(label)}
