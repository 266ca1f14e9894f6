"""Things without a name are meant where nothing else is and they most probably are that."""

from __future__ import annotations

from flat_reader import goals, in_hall, read, unlabeled
from planner.doubles.sketch import flat


def test_what_has_no_name_is_meant_where_nothing_else_is_and_it_most_probably_is_that():
    sketch = unlabeled(flat(), "unknown_1", "desk_1", unknown=0.45, ball=0.4, orange=0.15)
    assert goals("bring me the ball", in_hall(sketch)) == "given(unknown_1, person_2)"
    assert "no orange" in read("bring me the orange", in_hall(sketch)).reply
    assert "no ball" in read("bring me the ball from the table", in_hall(sketch)).reply
    unlabeled(sketch, "unknown_2", "table_1", unknown=0.5, ball=0.35)
    assert set(read("bring me the ball", in_hall(sketch)).candidates) == {"unknown_1", "unknown_2"}
    sketch.thing("ball_1", "ball", on="counter_1")
    assert goals("bring me the ball", in_hall(sketch)) == "given(ball_1, person_2)"


def test_so_is_a_place_without_a_name():
    chances = (("unknown", 0.55), ("piano", 0.4))
    sketch = flat().furniture("unknown_1", "unknown", "room_3", at=(9.5, 1.0), label_distribution=chances)
    sketch.thing("ball_1", "ball", on="unknown_1")
    sketch.thing("ball_2", "ball", on="desk_1")
    assert goals("bring me the ball from the piano", in_hall(sketch)) == "given(ball_1, person_2)"
    assert goals("put the ball on the desk on the piano", in_hall(sketch)) == "on(ball_2, unknown_1)"


def test_what_hardly_may_be_a_ball_is_none():
    sketch = unlabeled(flat(), "unknown_1", "desk_1", unknown=0.8, ball=0.15)
    assert "no ball" in read("bring me the ball", in_hall(sketch)).reply
