"""``evaluate network``: how pictures are scored."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from evaluations.perception.recognition import Tally
from perception.panoptic import Instance, PanopticScene, Triplet
from simulation.pictures.photographs import Photograph

H, W = 60, 80
CUP, DESK, THING = 2, 3, 4


def picture():
    ids = np.zeros((H, W), dtype=np.uint8)
    ids[40:] = 1
    ids[10:30, 10:30] = CUP
    ids[30:55, 5:60] = DESK
    ids[5:25, 60:78] = THING
    return Photograph(
        rgb=np.zeros((H, W, 3), np.uint8),
        ids=ids,
        categories=("wall", "floor", "cup", "desk", "gadget"),
        distances_m=np.ones(5, np.float32),
        relations=((CUP, "on", DESK),),
    )


def instance(index, label, score=0.9):
    return Instance(label=label, score=score, mask=picture().ids == index, label_distribution={label: score})


def scene(*instances, relations=()):
    return PanopticScene(stamp_s=0.0, instances=tuple(instances), relations=tuple(relations))


def score(*scenes):
    tally = Tally()
    for each in scenes:
        tally.add(picture(), each, scale=1.0)
    return tally.report()


def on(subject, other):
    return Triplet(subject=subject, predicate="on", object=other, probability=0.8)


def test_a_network_that_sees_everything_scores_one():
    report = score(
        scene(instance(CUP, "cup"), instance(DESK, "desk"), instance(THING, "unknown"), relations=[on(0, 1)])
    )
    assert report["recall"] == report["precision"] == report["mask_iou"] == 1.0
    assert report["relation_recall_at_20"] == report["support_recall_at_20"] == 1.0
    assert report["strangers"] == {"unknown": 1}


def test_a_wrong_name_costs_recall_and_precision_and_is_listed():
    report = score(scene(instance(CUP, "can"), instance(DESK, "desk")))
    assert report["recall"] == report["precision"] == 0.5
    assert ["cup", "can", 1] in report["confusions"]
    assert report["classes"]["cup"]["recall"] == 0.0
    assert report["classes"]["cup"]["found_under_any_name"] == 1.0
    assert report["least_class"] == 0.0


def test_a_second_claim_of_the_same_thing_costs_precision_alone():
    report = score(scene(instance(CUP, "cup"), instance(CUP, "cup"), instance(DESK, "desk")))
    assert report["recall"] == 1.0
    assert report["precision"] == pytest.approx(2 / 3)


def test_a_mask_that_covers_too_little_finds_nothing():
    half = instance(DESK, "desk")
    mask = half.mask.copy()
    mask[:, 30:] = False
    report = score(scene(replace(half, mask=mask), instance(CUP, "cup")))
    assert report["classes"]["desk"]["recall"] == 0.0
    assert report["recall"] == 0.5


def test_a_relation_counts_only_in_its_direction_and_between_the_right_things():
    seen = instance(CUP, "cup"), instance(DESK, "desk")
    assert score(scene(*seen, relations=[on(1, 0)]))["relation_recall_at_20"] == 0.0
    misnamed = instance(CUP, "cup"), instance(DESK, "bed")
    assert score(scene(*misnamed, relations=[on(0, 1)]))["relation_recall_at_20"] == 0.0


def test_what_has_no_name_and_is_named_is_counted():
    report = score(scene(instance(THING, "cup")))
    assert report["strangers"] == {"named": 1}
    assert report["precision"] == 0.0


def test_nothing_of_nothing_has_no_figure():
    report = Tally().report()
    assert report["recall"] is None
    assert report["mask_iou"] is None
