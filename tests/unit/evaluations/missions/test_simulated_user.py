"""Who is asked back says what is meant."""

from __future__ import annotations

import numpy as np

from evaluations.missions.mission import Mission
from evaluations.missions.outcome import Outcome, Placed
from evaluations.missions.simulated_user import meant
from evaluations.perception.inventory import GraphContents, GraphThing
from mission_scenes import CUP_ON_TABLE, scene


def contents(rooms=None, **at):
    things = tuple(
        GraphThing(id=name, label="cup", position_m=np.array(place), size_m=(0.1, 0.1, 0.1))
        for name, place in at.items()
    )
    return GraphContents(things=things, relations=(), rooms=rooms or {}, labels={})


def test_who_is_asked_back_says_which_thing_or_room_is_meant_and_nothing_where_it_is_not_offered():
    known = contents({"office": "room_3"}, cup_7=(3.0, 1.0, 0.8), cup_8=(1.1, 1.0, 0.8), cup_9=(1.3, 1.0, 0.8))
    here = scene(CUP_ON_TABLE)
    cup = Mission(
        house="flat", kind="", request="", outcomes=(Outcome(states=(Placed(things=("cup_1",), places=("office",)),)),)
    )
    assert meant(("cup_7", "cup_9", "cup_8"), cup, here, known) == 2
    assert meant(("cup_7",), cup, here, known) is None
    assert meant(("room_1", "room_3"), cup, here, known) == 1
    assert meant(("cup_7", "cup_2"), cup, scene(CUP_ON_TABLE, holding="cup_1"), known, held="cup_2") == 1
