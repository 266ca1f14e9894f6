"""On, in and beside, by geometry."""

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid
from perception.objects.furniture.surface import Box
from perception.objects.tracking.relations import over_middle, support_probability
from perception.vocabulary import category_of


def box(center, size_m, yaw_rad=0.0):
    return Box(np.array(center, dtype=float), size_m, yaw_rad)


TABLE = box((0.0, 0.0, 0.375), (1.2, 0.8, 0.75), 0.4)
CUP = (0.08, 0.08, 0.10)


def carried(thing, support, label):
    return support_probability(thing, support, category_of(label), sigma_m=0.03, rim_m=0.02)


def test_a_cup_whose_bottom_is_at_the_top_of_the_table_is_on_it():
    assert carried(box((0.1, 0.1, 0.80), CUP), TABLE, "table") == ("on", pytest.approx(0.98, abs=0.01))


def test_the_higher_it_floats_the_less_it_is_on_the_table():
    heights = [0.80, 0.83, 0.86, 0.90, 1.0]
    probabilities = [carried(box((0.0, 0.0, z), CUP), TABLE, "table")[1] for z in heights]
    assert probabilities == sorted(probabilities, reverse=True)
    assert probabilities[-1] < 0.01


def test_beside_the_footprint_nothing_is_on_the_table_even_when_the_table_is_turned():
    along = np.array((np.cos(0.4), np.sin(0.4)))
    assert carried(box((*(0.55 * along), 0.80), CUP), TABLE, "table")[1] > 0.9
    assert carried(box((*(0.75 * along), 0.80), CUP), TABLE, "table")[1] < 0.01
    assert carried(box((0.55, -0.35, 0.80), CUP), TABLE, "table")[1] < 0.1


def test_a_cup_under_the_table_is_not_on_it():
    assert carried(box((0.0, 0.0, 0.05), CUP), TABLE, "table")[1] < 0.01


def test_an_apple_in_a_bowl_is_in_it_and_one_in_a_basket_too():
    bowl = box((0.0, 0.0, 0.785), (0.16, 0.16, 0.07))
    assert carried(box((0.01, 0.0, 0.81), (0.08, 0.08, 0.08)), bowl, "bowl")[0] == "in"
    assert carried(box((0.01, 0.0, 0.81), (0.08, 0.08, 0.08)), bowl, "bowl")[1] > 0.9


def test_a_book_on_a_middle_board_of_a_shelf_is_on_the_shelf():
    shelf = box((0.0, 0.0, 0.9), (0.9, 0.35, 1.8))
    assert carried(box((0.1, 0.0, 0.95), (0.15, 0.03, 0.22)), shelf, "shelf") == ("on", pytest.approx(0.98, abs=0.01))


def test_of_two_supports_side_by_side_a_thing_is_on_the_one_over_which_it_stands_more():
    counter, stove = box((0.0, 0.0, 0.45), (1.4, 0.6, 0.9)), box((0.8, 0.0, 0.45), (0.8, 0.6, 0.9))
    for x, better, worse in ((0.45, counter, stove), (0.65, stove, counter)):
        apple = box((x, 0.1, 0.94), (0.08, 0.08, 0.08))
        assert carried(apple, counter, "counter")[1] == pytest.approx(carried(apple, stove, "stove")[1])
        assert over_middle(apple, better) > over_middle(apple, worse)


def test_a_thing_on_a_plate_is_on_the_plate_and_not_on_the_table_below():
    plate, thing = box((0.1, 0.1, 0.7625), (0.22, 0.22, 0.025)), box((0.17, 0.1, 0.815), (0.06, 0.06, 0.08))
    on_plate, on_table = carried(thing, plate, "plate")[1], carried(thing, TABLE, "table")[1]
    assert on_plate * over_middle(thing, plate) > on_table * over_middle(thing, TABLE)


def test_a_table_is_not_on_a_cup():
    assert carried(TABLE, box((0.0, 0.0, 0.0), CUP), "plate")[1] == 0.0


def test_solids_and_boxes_use_the_same_yaw():
    solid = Solid(label="table", center=(1.0, 2.0, 0.4), size_m=(1.2, 0.8, 0.8), yaw_rad=0.7)
    made = box(solid.center, solid.size_m, solid.yaw_rad)
    corner = made.place(np.array(((0.59, 0.39, 0.39),)))
    distance, _ = solid.intersect(corner[0] + (0.0, 0.0, 1.0), np.array(((0.0, 0.0, -1.0),)))
    assert np.isfinite(distance[0])
    assert made.contains(corner)[0]
    assert made.local(made.place(corner)) == pytest.approx(corner)
