"""What files of missions may say."""

from __future__ import annotations

import pytest

from evaluations.missions.mission_file import MissionFileError, load_missions
from evaluations.missions.outcome import Outcome, Placed, RobotIn


def test_a_file_of_missions_is_read_with_outcomes_and_disturbances(tmp_path):
    file = tmp_path / "missions.txt"
    file.write_text(
        "# mine\n@flat\n== to a place\nput the cup on the desk\n  > cup_1 -> desk_1|table_1\n  ! slipped\n"
        "two of them\n  > 1 of cup_1 bottle_1 -> hand; robot -> office\nwhere is it?\n  > answer kitchen, table\n",
        encoding="utf-8",
    )
    first, second, third = load_missions(file)
    assert (first.kind, first.disturbance, first.places) == ("to a place", "slipped", ("desk_1", "table_1"))
    placed, robot = second.outcomes[0].states
    assert placed == Placed(things=("cup_1", "bottle_1"), places=("hand",), count=1)
    assert robot == RobotIn(rooms=("office",))
    assert third.outcomes == (Outcome(words=("kitchen", "table")),)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("put it there", "line 1: say '@house'"),
        ("@nowhere", "line 1: house 'nowhere'"),
        ("@flat\n> refuse", "line 2: comes before any request"),
        ("@flat\ngo\n  ! earthquake", "line 3: no disturbance 'earthquake'"),
        ("@flat\ngo\n  > cup_9 -> desk_1", "line 3: the house has no cup_9"),
        ("@flat\ngo\n  > cup_1 -> desk_1; robot -> desk_1", "line 3: the robot ends in a room, and desk_1 is none"),
        ("@flat\ngo\n  > somewhere", "line 3: 'somewhere' is no outcome"),
    ],
)
def test_what_a_mission_file_may_not_say_is_named_with_its_line(tmp_path, text, complaint):
    file = tmp_path / "missions.txt"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(MissionFileError, match=complaint):
        load_missions(file)
