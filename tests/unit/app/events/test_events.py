"""The event stream: numbers without gap, bounded queues, and a snapshot for who fell behind."""

from __future__ import annotations

import asyncio
import json

import pytest

from app.events.stream import EventStream, StreamSettings

STREAM = StreamSettings()

pytestmark = pytest.mark.anyio


@pytest.fixture
def anyio_backend():
    return "asyncio"


async def take(listener, count):
    events = listener.events()
    async with asyncio.timeout(2.0):
        return [await anext(events) for _ in range(count)]


async def test_a_new_client_gets_a_snapshot_and_then_events_without_gap():
    stream = EventStream(lambda: {"state": "all"})
    stream.publish("log", 0, 0.0)
    with stream.listen() as listener:
        for index in range(5):
            stream.publish("log", index, float(index))
        events = await take(listener, 1)
        assert (events[0].type, events[0].data, events[0].seq) == ("snapshot", {"state": "all"}, 6)
        stream.publish("log", 9, 9.0)
        [after] = await take(listener, 1)
        assert after.seq == 7


async def test_a_client_that_returns_soon_gets_exactly_what_it_missed():
    stream = EventStream(dict)
    for index in range(10):
        stream.publish("log", index, 0.0)
    with stream.listen(since=6) as listener:
        events = await take(listener, 4)
    assert [event.seq for event in events] == [7, 8, 9, 10]


@pytest.mark.parametrize("since", [-1, 0, 10_000_000])
async def test_a_client_that_returns_too_late_or_from_another_life_gets_a_snapshot(since):
    stream = EventStream(dict)
    for index in range(STREAM.history + 10):
        stream.publish("log", index, 0.0)
    with stream.listen(since=since) as listener:
        [event] = await take(listener, 1)
    assert event.type == "snapshot"


async def test_a_client_that_does_not_read_costs_bounded_memory_and_gets_a_snapshot_in_the_end():
    stream = EventStream(dict)
    with stream.listen(since=0) as slow:
        for index in range(STREAM.queue * 3):
            stream.publish("log", index, 0.0)
        [event] = await take(slow, 1)
        assert (event.type, event.seq) == ("snapshot", STREAM.queue * 3)
        stream.publish("log", "next", 0.0)
        [event] = await take(slow, 1)
        assert event.seq == STREAM.queue * 3 + 1


async def test_a_client_that_left_is_forgotten():
    stream = EventStream(dict)
    with stream.listen(since=0):
        pass
    stream.publish("log", 1, 0.0)
    assert stream._listeners == []


async def test_when_everything_begins_anew_everyone_gets_a_snapshot_whatever_they_have_seen():
    stream = EventStream(dict)
    stream.publish("log", 1, 0.0)
    with stream.listen(since=stream.seq) as listener:
        stream.publish("log", 2, 0.0)
        seen = stream.seq
        stream.begin_anew()
        [event] = await take(listener, 1)
        assert (event.type, event.seq) == ("snapshot", seen + 1)
    with stream.listen(since=seen) as returning:
        [event] = await take(returning, 1)
    assert event.type == "snapshot"


async def test_a_number_of_an_earlier_life_of_the_service_gets_a_snapshot():
    earlier = EventStream(dict, first_seq=1_000)
    earlier.publish("log", 1, 0.0)
    later = EventStream(dict, first_seq=9_000)
    for index in range(5):
        later.publish("log", index, 0.0)
    with later.listen(since=earlier.seq) as listener:
        [event] = await take(listener, 1)
    assert event.type == "snapshot"


async def test_an_event_is_told_in_the_same_words_to_everybody_and_a_snapshot_made_once_between_two_events():
    made = []
    stream = EventStream(lambda: made.append(1) or {"state": len(made)})
    stream.publish("log", {"message": "é"}, 1.0)
    with stream.listen() as one, stream.listen() as other:
        first = [await anext(aiter(listener.events())) for listener in (one, other)]
        assert first[0] is first[1]
        assert json.loads(first[0].text) == first[0].document()
        stream.publish("log", {"message": "two"}, 2.0)
        with stream.listen() as late:
            assert (await anext(aiter(late.events()))).data == {"state": 2}
    assert len(made) == 2
