"""Which room a thing belongs to."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.objects.seeing.membership import Outline, Surroundings
from unit.perception.objects.things import two_rooms

SQUARE = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))


ELL = ((0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 2.0), (2.0, 4.0), (0.0, 4.0))


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_the_signed_distance_from_a_square_has_the_right_sign_and_size(x, y):
    expected = max(abs(x), abs(y)) - 1.0
    (distance,) = Outline(SQUARE).outside_m(np.array(((x, y),)))
    if expected <= 0.0 or min(abs(x), abs(y)) <= 1.0:
        assert distance == pytest.approx(expected, abs=1e-9)
    else:
        assert distance == pytest.approx(np.hypot(abs(x) - 1.0, abs(y) - 1.0), abs=1e-9)


def test_a_room_may_have_a_corner_cut_out():
    outside_m, inside_m = Outline(ELL).outside_m(np.array(((3.0, 3.0), (1.0, 3.0))))
    assert outside_m == pytest.approx(1.0)
    assert inside_m < 0.0


def test_a_point_behind_the_door_belongs_to_the_room_behind_the_door_and_one_outside_to_none():
    surroundings = Surroundings(two_rooms(), "room_1")
    assert surroundings.room_of(np.array((1.0, 0.0, 0.5))) == "room_1"
    assert surroundings.room_of(np.array((4.5, 0.5, 0.5))) == "room_2"
    assert surroundings.room_of(np.array((3.02, 0.0, 0.5))) == "room_1"
    assert surroundings.room_of(np.array((-4.5, 0.0, 0.5))) is None


def test_a_thing_changes_its_room_only_when_it_is_clearly_outside():
    surroundings = Surroundings(two_rooms(), "room_1")
    assert surroundings.settled_room("room_1", np.array((3.1, 0.0, 0.5))) == "room_1"
    assert surroundings.settled_room("room_1", np.array((3.6, 0.0, 0.5))) == "room_2"
    assert surroundings.settled_room("room_2", np.array((-4.0, 0.0, 0.5))) == "room_1"
