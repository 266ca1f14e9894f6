"""What has been seen of a piece of furniture, from all sides."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.objects.furniture.surface import Box, SurfaceBelief, SurfaceMemory, furniture_box, turned_like
from perception.vocabulary import category_of
from unit.perception.objects.things import filled, seen


@given(st.floats(0.55, 0.65), st.floats(0.55, 0.65), st.floats(-1.5, 1.5), st.floats(-1.5, 1.5), st.floats(-0.02, 0.02))
def test_a_point_on_a_stove_stays_where_it_is_whichever_of_its_sides_looks_longer(x_m, y_m, yaw_rad, before_rad, more):
    box = Box(np.array((1.0, 2.0, 0.45)), (x_m, y_m, 0.9), yaw_rad)
    first = turned_like(box, before_rad)
    assert first.contains(box.place(np.array(((0.5 * x_m, 0.5 * y_m, 0.1), (-0.5 * x_m, 0.5 * y_m, 0.1)))), 1e-6).all()
    other = Box(box.center, (y_m, x_m, 0.9), yaw_rad + more + np.pi / 2)  # the other side is the longer one
    again = turned_like(other, first.yaw_rad)
    spot = np.array(((0.2, 0.1, 0.45),))
    assert np.linalg.norm(first.place(spot) - again.place(spot)) < 0.01


def test_a_long_thing_keeps_its_length_along_its_first_axis():
    box = Box(np.zeros(3), (1.4, 0.6, 0.9), 1.5)
    assert turned_like(box, 0.0) is box


CHAIR = filled((0.0, 0.45), (0.0, 0.45))


@pytest.mark.parametrize(
    ("beside", "long_m"),
    [
        (filled((-0.45, -0.4), (0.0, 0.45)), 0.45),  # an edge of a desk, across a gap
        (filled((-0.45, -0.2), (0.0, 0.45)), 0.9),  # half of it hidden: what is large belongs to it
        (filled((-0.45, 0.0), (0.0, 0.1)), 0.9),  # no gap
        (np.zeros((0, 3)), 0.45),
    ],
)
def test_an_edge_of_what_stands_beside_a_chair_makes_it_no_longer(beside, long_m):
    memory = SurfaceMemory()
    memory.add(np.concatenate((CHAIR, beside)), frames=3.0)
    box = furniture_box(memory, category_of("chair"), np.array((0.2, -2.0, 1.3)))
    assert max(box.size_m[:2]) == pytest.approx(long_m, abs=0.06)


@pytest.mark.parametrize("size_m", [(2.6, 0.9, 0.75), (0.5, 0.5, 0.9), (1.9, 0.35, 2.0)])
def test_a_remembered_box_of_any_length_hangs_together(size_m):
    belief = SurfaceBelief.of(Box(np.array((1.0, 1.0, size_m[2] / 2)), size_m, 0.3))
    box = furniture_box(belief.memory, category_of("chair"), np.array((1.0, -2.0, 1.3)))
    assert box.size_m == pytest.approx(size_m, abs=0.08)


COUNTER = filled((0.0, 1.5), (0.0, 0.6), (0.3, 0.9), step_m=0.05)


BOXES = filled((0.2, 1.3), (0.1, 0.5), (0.9, 1.2), step_m=0.05)


CAMERA = np.array((0.7, -2.0, 1.3))


def look_at_counter(belief, points, frames, **more):
    for _ in range(frames):
        belief.observe(points, np.eye(6)[:3, :3] * 1e-6, category_of("counter"), CAMERA, **more)
    return belief.box.size_m[2]


@pytest.mark.parametrize("called", ["stove", "counter"])
@pytest.mark.parametrize("long_m", [0.66, 0.75])
def test_a_stove_in_a_row_of_counters_stays_a_stove_however_long_one_mask_shows_both(long_m, called):
    stove = seen("stove", (long_m, 0.6, 0.9), 1)
    stove.hits = 100
    row = filled((-0.33, 1.5), (-0.3, 0.3), (0.0, 0.9), step_m=0.03)
    for _ in range(300):
        own = stove._own(row, called, [])
        assert np.ptp(own[:, 0]) < 0.8
        stove.place.observe(own, np.eye(3) * 1e-6, category_of("stove"), CAMERA, top_shown=True)
    assert max(stove.box.size_m[:2]) < 0.85


def test_what_is_put_on_a_counter_does_not_make_it_higher():
    belief = SurfaceBelief()
    assert look_at_counter(belief, COUNTER, 60) == pytest.approx(0.89, abs=0.04)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 15) == pytest.approx(0.89, abs=0.06)


def test_a_counter_known_from_before_a_restart_does_not_grow_either():
    belief = SurfaceBelief.of(Box(np.array((0.75, 0.3, 0.45)), (1.5, 0.6, 0.9), 0.0), frames=200)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 60) == pytest.approx(0.9, abs=0.06)


def test_a_piece_that_was_forgotten_and_remembered_time_and_again_is_as_large_as_before():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 5)
    before = belief.box
    for _ in range(20):
        belief = SurfaceBelief.of(belief.box, frames=5)
        look_at_counter(belief, COUNTER, 5)
    assert belief.box.size_m == pytest.approx(before.size_m, abs=0.01)
    assert belief.box.center == pytest.approx(before.center, abs=0.01)


def test_a_piece_grows_to_its_height_while_that_is_not_sure():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 10)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 10) == pytest.approx(1.18, abs=0.06)


def test_a_piece_whose_top_the_picture_cut_off_grows_however_long_it_was_looked_at():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 100, top_shown=False)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 10) == pytest.approx(1.18, abs=0.06)


def test_a_height_that_frame_after_frame_denies_is_given_up():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 60)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 200) == pytest.approx(1.18, abs=0.06)


@pytest.mark.parametrize(("yields", "long_m"), [(True, 0.95), (False, 1.47)])
def test_a_counter_gives_up_what_turns_out_to_be_another_piece(yields, long_m):
    stove, counter = Box(np.array((1.25, 0.3, 0.45)), (0.6, 0.7, 0.95), 0.0), SurfaceBelief()
    look_at_counter(counter, COUNTER, 5)
    for _ in range(10):
        counter.yield_to([stove] if yields else [])
        look_at_counter(counter, COUNTER[COUNTER[:, 0] < 0.93], 1)
    assert max(counter.box.size_m[:2]) == pytest.approx(long_m, abs=0.04)
