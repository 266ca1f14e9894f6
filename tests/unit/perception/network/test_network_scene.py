"""From hand-made logits to instances and relations: laws first, then what PSGTR's rules say of small examples."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perception.network.metadata import Description, Thresholds
from perception.network.postprocessing import Outputs, panoptic_scene
from perception.network.resize import FixedSize, Placement
from perception.vocabulary import category_of
from scene_graph.nodes import UNKNOWN_LABEL

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


SEEDS = st.integers(min_value=0, max_value=10_000)


@settings(max_examples=50)
@given(seed=SEEDS, shift=st.floats(-50, 50))
def test_a_number_added_to_all_logits_of_a_query_changes_nothing(seed, shift):
    outputs = random_outputs(seed)
    shifted = replace(
        outputs,
        sub_logits=outputs.sub_logits + np.float64(shift),
        rel_logits=outputs.rel_logits + np.float64(shift),
        instance_logits=outputs.instance_logits + np.float64(shift),
    )
    assert facts(scene_of(shifted)) == facts(scene_of(outputs))


@settings(max_examples=50)
@given(seed=SEEDS)
def test_the_order_of_queries_changes_nothing(seed):
    outputs = random_outputs(seed)
    order = np.random.default_rng(seed + 1).permutation(len(outputs.sub_logits))
    others = np.random.default_rng(seed + 2).permutation(len(outputs.instance_logits))
    names = ("sub_logits", "obj_logits", "rel_logits", "sub_masks", "obj_masks")
    shuffled = Outputs(
        **{name: getattr(outputs, name)[order] for name in names},
        instance_logits=outputs.instance_logits[others],
        instance_masks=outputs.instance_masks[others],
    )
    assert facts(scene_of(shuffled)) == facts(scene_of(outputs))


@settings(max_examples=50)
@given(seed=SEEDS)
def test_every_mask_that_counts_is_covered_by_an_instance_and_no_pixel_comes_from_nowhere(seed):
    outputs = random_outputs(seed)
    instances = scene_of(outputs).instances
    everything = np.zeros((HEIGHT, WIDTH), dtype=bool)
    covered = [i.mask for i in instances]
    sees = outputs.instance_logits.argmax(axis=1) != BACKGROUND
    for mask in outputs.instance_masks[sees & (softmax(outputs.instance_logits)[:, -1] <= 0.5)] > 0.0:
        assert not mask.any() or any((mask <= cover).all() for cover in covered)
    for masks in (outputs.sub_masks, outputs.obj_masks, outputs.instance_masks):
        everything |= (masks > 0.0).any(axis=0)
    assert all((cover <= everything).all() for cover in covered)


@settings(max_examples=50)
@given(seed=SEEDS)
def test_relations_join_two_different_instances_of_the_list_and_none_comes_twice(seed):
    scene = scene_of(random_outputs(seed, queries=30))
    said = [(t.subject, t.predicate, t.object) for t in scene.relations]
    assert len(set(said)) == len(said)
    assert all(a != b and max(a, b) < len(scene.instances) for a, _, b in said)
    assert [t.probability for t in scene.relations] == sorted((t.probability for t in scene.relations), reverse=True)


@settings(max_examples=50)
@given(seed=SEEDS)
def test_distributions_start_with_the_label_and_never_exceed_one(seed):
    for instance in scene_of(random_outputs(seed)).instances:
        assert instance.label_distribution[0][0] == instance.label
        probabilities = [p for _, p in instance.label_distribution]
        assert probabilities == sorted(probabilities, reverse=True)
        assert 0.99 < sum(probabilities) < 1.0 + 1e-9


def softmax(logits):
    exponentials = np.exp(logits.astype(np.float64))
    return exponentials / exponentials.sum(axis=1, keepdims=True)


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
