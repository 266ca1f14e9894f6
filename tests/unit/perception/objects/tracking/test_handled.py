"""What the hand did last to a thing."""

import numpy as np
import pytest

from perception.objects.tracking.handled import HandDid
from unit.perception.objects.things import thing


@pytest.mark.parametrize("did", list(HandDid))
def test_what_the_hand_did_last_counts_until_the_thing_is_seen(did):
    track = thing(1, seen=(0.0, 10.0))
    assert not track.unseen_since(*HandDid)
    track.note_hand(HandDid.TOUCHED, 11.0)
    track.note_hand(did, 12.0)
    assert [each for each in HandDid if track.unseen_since(each)] == [did]
    track.last_seen_s = 12.0
    assert not track.unseen_since(did)


def test_from_where_the_hand_took_a_thing_is_remembered_wherever_it_goes():
    track = thing(1)
    track.put_at("room_1", np.array((1.0, 2.0, 0.8)), 0.01)
    before = track.position
    track.note_hand(HandDid.TAKEN, 11.0)
    track.put_at("room_2", np.array((0.0, 0.0, 0.8)), 0.01)
    assert track.handled.room == "room_1"
    assert track.handled.position == pytest.approx(before)


def test_what_turns_out_to_be_elsewhere_is_where_the_hand_has_not_put_it():
    track = thing(1)
    track.note_hand(HandDid.PUT, 11.0)
    track.become(thing(2, seen=(20.0, 21.0)))
    assert track.handled is None
