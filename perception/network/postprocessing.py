"""From the network's numbers to one instance list and one relation list, as PSGTR does it (design, section 6).

Source: OpenPSG, openpsg/models/relation_heads/psgtr_head.py, ``_get_bboxes_single``. All steps are arithmetic on whole
arrays; only what is left in the end is brought to the frame's size.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.network.merging import same_things
from perception.network.metadata import Description, Thresholds
from perception.network.recognition import UNKNOWN, DistributionSettings, Recognition, joined, recognize, softmax
from perception.network.resize import Placement
from perception.panoptic import Instance, PanopticScene, Triplet
from scene_graph.nodes import UNKNOWN_LABEL

Array = NDArray[np.float32]
_NONE = -1
"""Instance of a mask without a pixel."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Outputs:
    """What the network gives for one image, without the batch axis.

    Q triplet queries: ``sub_logits``, ``obj_logits`` (Q, C + 1), background last; ``rel_logits`` (Q, P + 1), background
    first; ``sub_masks``, ``obj_masks`` (Q, h, w) logits. N instance queries, N = 0 for networks without:
    ``instance_logits`` (N, C + 1), ``instance_masks`` (N, h, w).
    """

    sub_logits: Array
    obj_logits: Array
    rel_logits: Array
    sub_masks: Array
    obj_masks: Array
    instance_logits: Array
    instance_masks: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class _Chosen:
    """The best triplets: (K,) query, predicate index and probability of the predicate, best first."""

    query: NDArray[np.intp]
    predicate: NDArray[np.intp]
    probability: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Candidates:
    """Masks that may become instances: (N, h, w) logits, and what is recognized in them, a row each."""

    masks: Array
    seen: Recognition


def panoptic_scene(
    outputs: Outputs,
    description: Description,
    placement: Placement,
    *,
    stamp_s: float,
    settings: DistributionSettings = DistributionSettings(),
) -> PanopticScene:
    """Instances, surest first, and relations, most probable first."""
    thresholds, is_thing = description.thresholds, description.is_thing
    subjects, objects, found = (
        recognize(logits, is_thing, thresholds)
        for logits in (outputs.sub_logits, outputs.obj_logits, outputs.instance_logits)
    )
    chosen = _best_triplets(outputs.rel_logits, subjects, objects, thresholds)
    queries = np.unique(chosen.query)
    candidates = _candidates(outputs, subjects, objects, queries, found)
    seen = candidates.seen
    stuff = (seen.label != UNKNOWN) & ~is_thing[seen.label]
    shown = candidates.masks > thresholds.mask_logit
    groups = same_things(shown, seen.label, seen.score, stuff, same_iou=thresholds.same_iou)
    instance_of = np.full(len(candidates.masks), _NONE)
    for number, members in enumerate(groups):
        instance_of[members] = number
    subject = np.searchsorted(queries, chosen.query)
    return PanopticScene(
        stamp_s=stamp_s,
        instances=tuple(_instance(candidates, members, description, placement, settings) for members in groups),
        relations=_relations(instance_of[subject], instance_of[len(queries) + subject], chosen, description.predicates),
    )


def _best_triplets(rel_logits: Array, subjects: Recognition, objects: Recognition, thresholds: Thresholds) -> _Chosen:
    """Of all pairs of query and predicate those with the highest product of subject, object and relation score."""
    relation = softmax(rel_logits)[:, 1:]
    counts = (subjects.something & objects.something)[:, None] & (relation >= thresholds.relation)
    query, predicate = np.nonzero(counts)
    probability = relation[query, predicate]
    total = subjects.score[query] * objects.score[query] * probability
    best = np.argsort(-total, kind="stable")[: thresholds.triplets]
    return _Chosen(query=query[best], predicate=predicate[best], probability=probability[best])


def _candidates(
    outputs: Outputs, subjects: Recognition, objects: Recognition, queries: NDArray[np.intp], found: Recognition
) -> _Candidates:
    """Subjects, then objects of the chosen queries, then what the instance queries found."""
    rows = np.flatnonzero(found.something)
    return _Candidates(
        masks=np.concatenate((outputs.sub_masks[queries], outputs.obj_masks[queries], outputs.instance_masks[rows])),
        seen=joined((subjects.rows(queries), objects.rows(queries), found.rows(rows))),
    )


def _instance(
    candidates: _Candidates,
    members: NDArray[np.intp],
    description: Description,
    placement: Placement,
    settings: DistributionSettings,
) -> Instance:
    """What the first of ``members`` is recognized as, with the pixels of all of them."""
    founder = int(members[0])
    label = candidates.seen.label[founder]
    logits = candidates.masks[members].max(axis=0)
    return Instance(
        label=UNKNOWN_LABEL if label == UNKNOWN else description.classes[label],
        score=float(candidates.seen.score[founder]),
        mask=placement.mask_of_frame(logits, description.thresholds.mask_logit),
        label_distribution=candidates.seen.distribution(founder, description.classes, settings),
    )


def _relations(
    subject: NDArray[np.intp], target: NDArray[np.intp], chosen: _Chosen, predicates: tuple[str, ...]
) -> tuple[Triplet, ...]:
    """Each relation between two different instances once, with its highest probability."""
    best: dict[tuple[int, int, int], float] = {}
    for a, b, predicate, probability in zip(subject, target, chosen.predicate, chosen.probability, strict=True):
        if _NONE not in {a, b} and a != b:
            key = (int(a), int(predicate), int(b))
            best[key] = max(best.get(key, 0.0), float(probability))
    return tuple(
        Triplet(subject=a, predicate=predicates[p], object=b, probability=probability)
        for (a, p, b), probability in sorted(best.items(), key=lambda item: (-item[1], item[0]))
    )
