"""What names alone tell."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.vocabulary import (
    CATEGORIES,
    carries_things,
    category_of,
    fits_gripper,
    is_graspable,
    is_person,
    is_too_large,
    may_grow_m,
    spans_its_kind,
)


@pytest.mark.parametrize("name", sorted(CATEGORIES))
def test_nothing_of_usual_size_is_too_large_for_its_name(name):
    assert not is_too_large(name, category_of(name).size_m)


def test_a_low_thing_as_deep_as_a_table_is_no_bench_whichever_way_it_was_measured():
    assert is_too_large("bench", (1.0, 0.62, 0.45))
    assert is_too_large("Bench", (0.62, 1.0, 0.45))
    assert not is_too_large("bench", (1.6, 0.42, 0.48))
    assert is_too_large("tv_stand", (1.4, 0.4, 1.4))
    assert not is_too_large("cup", (9.0, 9.0, 9.0))


def test_every_row_is_sound():
    for name, category in CATEGORIES.items():
        assert name == name.lower().strip()
        assert category.background or all(side > 0.0 for side in category.size_m)
        assert not (category.background and (category.graspable or category.support))
        if category.graspable:
            assert not category.furniture


@pytest.mark.parametrize(
    ("label", "tag"),
    [
        ("apple", "snack"),
        ("bottle", "drink"),
        ("hammer", "tool"),
        ("teddy bear", "toy"),
        ("plate", "tableware"),
        ("cup", "tableware"),
    ],
)
def test_people_find_things_by_category(label, tag):
    assert tag in category_of(label).tags


@pytest.mark.parametrize("name", ["Potted Plant", "potted_plant", " potted  plant"])
def test_names_are_recognized_in_any_spelling(name):
    assert category_of(name).label == "potted plant"


@given(st.floats(0.02, 2.0), st.floats(0.02, 2.0), st.floats(0.02, 2.0))
def test_an_unknown_thing_is_judged_by_its_size(x_m, y_m, z_m):
    category = category_of("gizmo", (x_m, y_m, z_m))
    assert not category.known
    assert category.furniture is (max(x_m, y_m, z_m) > 0.5)
    assert category.graspable is not category.furniture


def test_grasping_needs_the_name_and_the_geometry():
    assert is_graspable("bottle", (0.07, 0.07, 0.24))
    assert not is_graspable("bottle", (0.2, 0.2, 0.4))
    assert not is_graspable("table", (0.05, 0.05, 0.05))
    assert fits_gripper((0.3, 0.05, 0.2))
    assert not fits_gripper((0.3, 0.115, 0.2))


def test_what_looks_square_may_be_less_deep_than_wide_unless_it_is_round():
    assert is_graspable("box", (0.14, 0.14, 0.1))
    assert not is_graspable("box", (0.25, 0.14, 0.1))
    assert not is_graspable("box", (0.2, 0.2, 0.2))
    assert not is_graspable("bowl", (0.14, 0.14, 0.07))


def test_supports_are_what_things_are_put_on_or_in():
    assert carries_things("table", (1.2, 0.8, 0.75))
    assert carries_things("shelf", (0.9, 0.3, 1.8))
    assert carries_things("bowl", (0.15, 0.15, 0.07))
    assert not carries_things("cabinet", (0.9, 0.5, 1.8))
    assert not carries_things("fridge", (0.6, 0.6, 1.8))
    assert not carries_things("apple", (0.08, 0.08, 0.08))


def test_persons_and_background_are_no_objects():
    assert is_person("person")
    assert not is_person("teddy bear")
    assert category_of("wall-other-merged").background


@pytest.mark.parametrize(("long_m", "spare_m"), [(0.5, 0.22), (0.7, 0.02), (1.4, 0.0)])
def test_a_stove_grows_to_the_size_of_a_stove_and_a_counter_to_any(long_m, spare_m):
    assert may_grow_m("stove", (long_m, 0.4, 0.9)) == pytest.approx(spare_m)
    assert may_grow_m("counter", (long_m, 0.4, 0.9)) == float("inf")


def test_only_what_comes_in_one_size_shows_by_its_size_that_no_part_is_missing():
    assert spans_its_kind("stove", (0.57, 0.53, 0.3))
    assert not spans_its_kind("stove", (0.57, 0.1, 0.8)), "its front alone"
    assert not spans_its_kind("stove", (1.2, 0.6, 0.9))
    assert not spans_its_kind("table", (1.2, 0.7, 0.75))
    assert not spans_its_kind("apple", (0.08, 0.08, 0.08))
