"""Outputs of a network that sees cups, tables and walls, made up query by query."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from perception.network.metadata import Description, Thresholds
from perception.network.postprocessing import Outputs, panoptic_scene
from perception.network.resize import FixedSize, Placement

CLASSES = ("cup", "table", "wall")
CUP, TABLE, WALL, BACKGROUND = range(4)
PREDICATES = ("on", "beside")
ON, BESIDE = 1, 2
HEIGHT, WIDTH = 12, 16
SAME_SIZE = Placement(frame=(HEIGHT, WIDTH), resized=(HEIGHT, WIDTH), canvas=(HEIGHT, WIDTH))
DESCRIPTION = Description(
    classes=CLASSES,
    predicates=PREDICATES,
    is_thing=np.array([True, True, False]),
    mean=np.zeros(3, dtype=np.float32),
    std=np.ones(3, dtype=np.float32),
    resize=FixedSize(rule="fixed", height=HEIGHT, width=WIDTH),
    version="1",
    thresholds=Thresholds(),
)
LEFT, RIGHT = (slice(2, 8), slice(1, 7)), (slice(2, 8), slice(9, 15))
NEARLY_LEFT = (slice(2, 8), slice(2, 8))
HALF_LEFT = (slice(5, 11), slice(1, 7))


def logits_of(winner, count, height=6.0):
    row = np.zeros(count, dtype=np.float32)
    row[winner] = height
    return row


def mask_of(place):
    mask = np.full((HEIGHT, WIDTH), -8.0, dtype=np.float32)
    if place is not None:
        mask[place] = 8.0
    return mask


def triplet(sub, rel, obj, sub_at, obj_at, height=6.0):
    """One query: class indices, predicate (0: none), and where the masks are."""
    logits = (logits_of(sub, 4, height), logits_of(obj, 4, height), logits_of(rel, 3, height))
    return (*logits, mask_of(sub_at), mask_of(obj_at))


def outputs_of(*queries, found=()):
    sub, obj, rel, sub_masks, obj_masks = (
        (np.stack(part) for part in zip(*queries, strict=True)) if queries else empty_queries()
    )
    return Outputs(
        sub_logits=sub,
        obj_logits=obj,
        rel_logits=rel,
        sub_masks=sub_masks,
        obj_masks=obj_masks,
        instance_logits=np.array([logits for logits, _ in found], dtype=np.float32).reshape(-1, 4),
        instance_masks=np.array([mask_of(at) for _, at in found], dtype=np.float32).reshape(-1, HEIGHT, WIDTH),
    )


def empty_queries():
    nobody = [np.zeros((0, size), np.float32) for size in (4, 4, 3)]
    return (*nobody, *[np.zeros((0, HEIGHT, WIDTH), np.float32)] * 2)


def scene_of(outputs, **thresholds):
    description = replace(DESCRIPTION, thresholds=Thresholds(**thresholds))
    return panoptic_scene(outputs, description, SAME_SIZE, stamp_s=1.0)


def facts(scene):
    """Everything of a scene that matters, comparable."""
    return (
        [(i.label, round(i.score, 5), i.mask.tobytes()) for i in scene.instances],
        [(t.subject, t.predicate, t.object, round(t.probability, 5)) for t in scene.relations],
    )


def random_outputs(seed, queries=10, instances=4):
    random = np.random.default_rng(seed)
    blocks = np.repeat(np.repeat(random.normal(0, 4, (2 * queries + instances, 3, 4)), 4, axis=1), 4, axis=2)
    masks = blocks.astype(np.float32)
    return Outputs(
        sub_logits=random.normal(0, 3, (queries, 4)).astype(np.float32),
        obj_logits=random.normal(0, 3, (queries, 4)).astype(np.float32),
        rel_logits=random.normal(0, 3, (queries, 3)).astype(np.float32),
        sub_masks=masks[:queries],
        obj_masks=masks[queries : 2 * queries],
        instance_logits=random.normal(0, 3, (instances, 4)).astype(np.float32),
        instance_masks=masks[2 * queries :],
    )


def softmax(logits):
    exponentials = np.exp(logits.astype(np.float64))
    return exponentials / exponentials.sum(axis=1, keepdims=True)
