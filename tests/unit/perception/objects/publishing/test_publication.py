"""Tracks to nodes."""

import pytest

from perception.objects.publishing.publication import node_of
from scene_graph.nodes import ObjectState
from unit.perception.objects.things import thing


@pytest.mark.parametrize(
    ("label", "size_m", "present", "missing"),
    [
        ("book", (0.2, 0.1, 0.04), True, True),
        ("book", (0.3, 0.3, 0.04), False, True),
        ("sofa", (2.0, 0.9, 0.8), False, False),
    ],
)
def test_what_is_missing_may_be_carried_if_things_of_that_name_are(label, size_m, present, missing):
    for state, graspable in ((ObjectState.PRESENT, present), (ObjectState.MISSING, missing)):
        track = thing(1, label, size_m=size_m, state=state)
        assert node_of("thing_1", track, None, None).graspable is graspable
