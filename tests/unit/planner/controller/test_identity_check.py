"""What turns out to be something else than the request took it for."""

from __future__ import annotations

import pytest

from flat_reader import at_desk, in_hall, read, unlabeled
from planner.controller.identity_check import IdentityCheck
from planner.doubles.sketch import flat


@pytest.mark.parametrize(("label", "mistaken"), [("unknown", False), ("ball", False), ("orange", True)])
def test_what_has_no_name_and_was_taken_for_a_ball_must_not_turn_out_to_be_something_else(label, mistaken):
    request = "bring me the ball"
    before = unlabeled(flat(), "unknown_1", "desk_1", unknown=0.45, ball=0.4, orange=0.15)
    taken = IdentityCheck(request, read(request, in_hall(before)).goals, in_hall(before))
    after = flat().thing("unknown_1", label, on="desk_1", label_distribution=((label, 0.95),))
    assert (taken.mistake(at_desk(after)) is not None) == mistaken


@pytest.mark.parametrize("label", ["orange", "unknown"])
@pytest.mark.parametrize(
    ("where", "doubted"),
    [
        ({"robot_in": "room_2", "at": (4.2, 0.0)}, False),
        ({"robot_in": "room_4", "at": (4.2, 3.0)}, False),
        ({"robot_in": "room_4", "at": (4.2, 4.4)}, True),
        ({"robot_in": "room_2", "at": (4.2, 0.0), "holding": "ball_1"}, True),
    ],
)
def test_what_a_thing_looks_like_from_afar_waits_until_the_robot_is_there(label, where, doubted):
    request, before = "bring me the ball", flat().thing("ball_1", "ball", on="desk_1")
    taken = IdentityCheck(request, read(request, in_hall(before)).goals, in_hall(before))
    after = flat().thing("ball_1", label, on="desk_1", label_distribution=((label, 0.95),)).snapshot(**where)
    assert ((taken.mistake(after) or taken.refuted(after)) is not None) == doubted
    assert (taken.mistake(after, at_last=True) or taken.refuted(after, at_last=True)) is not None


@pytest.mark.parametrize("label", ["orange", "unknown"])
def test_what_slipped_from_the_hand_is_what_it_was_until_all_is_done_however_it_looks_where_it_lies(label):
    request, before = "bring me the ball", flat().thing("ball_1", "ball", on="desk_1")
    after = at_desk(flat().thing("ball_1", label, on="desk_1", label_distribution=((label, 0.95),)))

    def doubt(**last):
        return taken.mistake(after, **last) or taken.refuted(after, **last)

    taken = IdentityCheck(request, read(request, in_hall(before)).goals, in_hall(before))
    assert doubt() is not None
    taken.fell("ball_1")
    assert doubt() is None
    assert doubt(at_last=True) is not None
