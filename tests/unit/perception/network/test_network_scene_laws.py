"""Laws of the scene that outputs of a network become, whatever they are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from perception.network.postprocessing import Outputs
from unit.perception.network.network_outputs import BACKGROUND, HEIGHT, WIDTH, facts, random_outputs, scene_of, softmax

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
