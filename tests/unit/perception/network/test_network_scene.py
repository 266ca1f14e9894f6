"""From hand-made logits to instances and relations: what PSGTR's rules say of small examples."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest

from perception.network.metadata import Thresholds
from perception.network.postprocessing import Outputs, panoptic_scene
from perception.network.resize import Placement
from perception.vocabulary import category_of
from scene_graph.nodes import UNKNOWN_LABEL
from unit.perception.network.network_outputs import (
    BACKGROUND,
    BESIDE,
    CUP,
    DESCRIPTION,
    HALF_LEFT,
    HEIGHT,
    LEFT,
    NEARLY_LEFT,
    ON,
    RIGHT,
    SAME_SIZE,
    TABLE,
    WALL,
    WIDTH,
    logits_of,
    mask_of,
    outputs_of,
    scene_of,
    triplet,
)


def test_one_query_becomes_two_instances_and_their_relation():
    scene = scene_of(outputs_of(triplet(CUP, ON, TABLE, LEFT, RIGHT)))
    assert {i.label for i in scene.instances} == {"cup", "table"}
    cup = next(i for i in scene.instances if i.label == "cup")
    assert np.array_equal(cup.mask, mask_of(LEFT) > 0)
    assert cup.score == pytest.approx(np.exp(6) / (np.exp(6) + 3))
    [relation] = scene.relations
    assert scene.instances[relation.subject].label == "cup"
    assert scene.instances[relation.object].label == "table"
    assert (relation.predicate, relation.probability) == ("on", pytest.approx(np.exp(6) / (np.exp(6) + 2)))
    assert scene.stamp_s == 1.0


def test_background_is_last_for_classes_and_first_for_predicates():
    assert scene_of(outputs_of(triplet(BACKGROUND, ON, TABLE, LEFT, RIGHT))).instances == ()
    assert scene_of(outputs_of(triplet(CUP, 0, TABLE, LEFT, RIGHT))).instances == ()
    assert scene_of(outputs_of(triplet(WALL, BESIDE, TABLE, LEFT, RIGHT))).relations[0].predicate == "beside"


def test_triplets_of_the_same_labels_whose_masks_overlap_are_one():
    scene = scene_of(
        outputs_of(
            triplet(CUP, ON, TABLE, LEFT, RIGHT),
            triplet(CUP, ON, TABLE, NEARLY_LEFT, RIGHT, height=5.0),
        )
    )
    assert len(scene.instances) == 2
    assert len(scene.relations) == 1
    cup = next(i for i in scene.instances if i.label == "cup")
    assert np.array_equal(cup.mask, (mask_of(LEFT) > 0) | (mask_of(NEARLY_LEFT) > 0))
    assert scene.relations[0].probability == pytest.approx(np.exp(6) / (np.exp(6) + 2))


def test_two_things_of_one_label_that_overlap_little_stay_two():
    scene = scene_of(
        outputs_of(triplet(CUP, ON, TABLE, LEFT, RIGHT), triplet(CUP, ON, TABLE, HALF_LEFT, RIGHT, height=5.0))
    )
    assert sorted(i.label for i in scene.instances) == ["cup", "cup", "table"]
    assert len(scene.relations) == 2


def test_the_object_of_one_triplet_and_the_subject_of_another_are_one_thing():
    scene = scene_of(outputs_of(triplet(CUP, ON, TABLE, LEFT, RIGHT), triplet(TABLE, BESIDE, CUP, RIGHT, LEFT)))
    assert len(scene.instances) == 2
    assert {(t.predicate, scene.instances[t.subject].label) for t in scene.relations} == {
        ("on", "cup"),
        ("beside", "table"),
    }


def test_stuff_of_one_class_is_one_wherever_it_is():
    scene = scene_of(outputs_of(found=[(logits_of(WALL, 4), LEFT), (logits_of(WALL, 4), RIGHT)]))
    [wall] = scene.instances
    assert np.array_equal(wall.mask, (mask_of(LEFT) > 0) | (mask_of(RIGHT) > 0))


def test_a_thing_is_in_no_relation_to_itself():
    scene = scene_of(outputs_of(triplet(CUP, BESIDE, CUP, LEFT, NEARLY_LEFT)))
    assert [i.label for i in scene.instances] == ["cup"]
    assert scene.relations == ()


def test_a_mask_without_a_pixel_is_no_instance_and_takes_its_relation_along():
    scene = scene_of(outputs_of(triplet(CUP, ON, TABLE, None, RIGHT)))
    assert [i.label for i in scene.instances] == ["table"]
    assert scene.relations == ()


def test_instance_queries_add_things_and_no_doubles():
    found = [(logits_of(CUP, 4), NEARLY_LEFT), (logits_of(CUP, 4), HALF_LEFT), (logits_of(BACKGROUND, 4), RIGHT)]
    scene = scene_of(outputs_of(triplet(CUP, ON, TABLE, LEFT, RIGHT), found=found))
    assert sorted(i.label for i in scene.instances) == ["cup", "cup", "table"]
    assert len(scene.relations) == 1


def test_a_network_that_sees_nothing_gives_an_empty_scene():
    scene = scene_of(outputs_of(triplet(BACKGROUND, 0, BACKGROUND, LEFT, RIGHT)))
    assert (scene.instances, scene.relations) == ((), ())


def test_only_the_best_triplets_are_kept():
    weak, strong = triplet(CUP, ON, TABLE, LEFT, RIGHT, height=2.5), triplet(TABLE, BESIDE, WALL, RIGHT, HALF_LEFT)
    scene = scene_of(outputs_of(weak, strong), triplets=1)
    assert [t.predicate for t in scene.relations] == ["beside"]
    assert {i.label for i in scene.instances} == {"table", "wall"}


def test_what_the_network_cannot_tell_apart_is_unknown_rather_than_the_nearest_class():
    undecided = np.array([2.1, 2.0, 2.0, -3.0], dtype=np.float32)
    [thing] = scene_of(outputs_of(found=[(undecided, LEFT)])).instances
    assert thing.label == UNKNOWN_LABEL
    assert thing.score > 0.99
    assert dict(thing.label_distribution)["cup"] < thing.label_distribution[0][1]
    assert not category_of(thing.label).known


def test_what_is_hardly_there_is_left_out_not_unknown():
    hardly = np.array([1.0, 1.0, 1.0, 4.0], dtype=np.float32)
    assert scene_of(outputs_of(found=[(hardly, LEFT)])).instances == ()


def test_what_is_certainly_stuff_is_never_an_unknown_thing():
    walls = replace(DESCRIPTION, is_thing=np.array([True, False, False]))
    wall_or_table = np.array([0.0, 4.0, 4.1, -3.0], dtype=np.float32)
    outputs = outputs_of(found=[(wall_or_table, LEFT)])
    strict = replace(walls, thresholds=Thresholds(known=0.9))
    assert [i.label for i in panoptic_scene(outputs, strict, SAME_SIZE, stamp_s=0.0).instances] == ["wall"]


def test_something_unknown_where_a_known_thing_is_seen_is_that_thing():
    undecided = np.array([2.1, 2.0, 2.0, -3.0], dtype=np.float32)
    scene = scene_of(outputs_of(found=[(undecided, NEARLY_LEFT), (logits_of(CUP, 4, 4.0), LEFT)]))
    assert [i.label for i in scene.instances] == ["cup"]


@pytest.mark.parametrize(
    ("thresholds", "label"),
    [({}, "cup"), ({"known": 0.9}, "unknown"), ({"entropy": 0.4}, "unknown"), ({"energy": -9.0}, "unknown"),
     ({"energy": -1.0}, "cup")],
)  # fmt: skip
def test_probability_entropy_and_energy_each_make_a_thing_unknown(thresholds, label):
    somewhat = np.array([2.0, 0.5, 0.0, -3.0], dtype=np.float32)
    [thing] = scene_of(outputs_of(found=[(somewhat, LEFT)]), **thresholds).instances
    assert thing.label == label


def test_masks_come_back_in_the_frames_size_without_the_padding():
    placement = Placement(frame=(60, 80), resized=(HEIGHT, WIDTH), canvas=(HEIGHT, 2 * WIDTH))
    padded = np.concatenate((mask_of(LEFT), mask_of(None)), axis=1)[None]
    outputs = replace(outputs_of(found=[(logits_of(CUP, 4), LEFT)]), instance_masks=padded)
    outputs = replace(outputs, sub_masks=padded[:0], obj_masks=padded[:0])
    [cup] = panoptic_scene(outputs, DESCRIPTION, placement, stamp_s=0.0).instances
    assert cup.mask.shape == (60, 80)
    rows, columns = np.nonzero(cup.mask)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == pytest.approx((10, 39, 5, 34), abs=1)


@pytest.mark.benchmark
@pytest.mark.parametrize("queries", [24, 100])
def test_post_processing_takes_less_than_4_ms_of_one_core(queries):
    outputs, description, placement = crowded(queries)
    durations_s = []
    for _ in range(100):
        began_s = time.process_time()
        scene = panoptic_scene(outputs, description, placement, stamp_s=0.0)
        durations_s.append(time.process_time() - began_s)
    print(f"{queries} queries, {len(scene.instances)} instances: {1e3 * np.median(durations_s):.2f} ms")
    assert np.median(durations_s) < 0.004


def test_post_processing_time_is_bounded_when_every_query_answers():
    outputs, description, placement = crowded(100)
    began_s = time.process_time()
    panoptic_scene(outputs, description, placement, stamp_s=0.0)
    assert time.process_time() - began_s < 0.2


def crowded(queries, things=20):
    """PSGTR's 133 classes and 56 predicates, masks of 48 x 64, every query sure, ``things`` places in the image."""
    random = np.random.default_rng(1)
    at = random.integers(0, (40, 56), (things, 2))
    label = random.integers(0, 133, things)
    boxes = np.full((things, 48, 64), -6.0, dtype=np.float32)
    for number, (row, column) in enumerate(at):
        boxes[number, row : row + 8, column : column + 8] = 6.0
    subject, target = random.integers(0, things, (2, queries))
    sure = 12.0 * np.eye(134, dtype=np.float32)
    outputs = Outputs(
        sub_logits=sure[label[subject]],
        obj_logits=sure[label[target]],
        rel_logits=9.0 * np.eye(57, dtype=np.float32)[random.integers(1, 57, queries)],
        sub_masks=boxes[subject] + random.normal(0, 0.5, (queries, 48, 64)).astype(np.float32),
        obj_masks=boxes[target] + random.normal(0, 0.5, (queries, 48, 64)).astype(np.float32),
        instance_logits=sure[label],
        instance_masks=boxes,
    )
    description = replace(
        DESCRIPTION,
        classes=tuple(f"class {i}" for i in range(133)),
        predicates=tuple(f"predicate {i}" for i in range(56)),
        is_thing=np.arange(133) < 80,
    )
    return outputs, description, Placement(frame=(240, 320), resized=(192, 256), canvas=(192, 256))
