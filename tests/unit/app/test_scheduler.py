"""Laws of the two schedulers."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.scheduler import LockstepScheduler, RealTimeScheduler, Turns

pytestmark = pytest.mark.anyio


@pytest.fixture
def anyio_backend():
    return "asyncio"


class Diary:
    """An agent that writes down its turns."""

    def __init__(self, name, period_s, book, fails=False):
        self.name, self.period_s, self.book, self.fails = name, period_s, book, fails

    async def step(self, stamp_s):
        self.book.append((round(stamp_s, 6), self.name))
        if self.fails:
            raise ArithmeticError("as told")


class Simulated:
    """A body whose time moves when told."""

    def __init__(self):
        self.now_s = 0.0

    async def advance(self, duration_s):
        self.now_s += duration_s
        return self.now_s


@given(periods=st.lists(st.sampled_from([0.05, 0.1, 0.2, 0.25, 1.0]), min_size=1, max_size=4))
def test_in_lockstep_every_agent_gets_its_rate_and_the_order_never_changes(periods):
    book = []
    agents = [Diary(f"agent_{index}", period, book) for index, period in enumerate(periods)]
    scheduler = LockstepScheduler(agents, Simulated().advance)

    async def run():
        for _ in range(100):
            await scheduler.tick()

    asyncio.run(run())
    for agent in agents:
        turns = sum(name == agent.name for _, name in book)
        assert abs(turns - 5.0 / agent.period_s) <= 1
    assert book == sorted(book)


async def test_missed_turns_are_skipped_not_made_up_for():
    book = []
    body = Simulated()
    scheduler = LockstepScheduler([Diary("a", 0.1, book)], body.advance, tick_s=1.0)
    for _ in range(3):
        await scheduler.tick()
    assert [stamp for stamp, _ in book] == [1.0, 2.0, 3.0]


async def test_an_agent_that_fails_is_counted_and_goes_on_and_hurts_no_other(caplog):
    book = []
    scheduler = LockstepScheduler(
        [Diary("bad", 0.05, book, fails=True), Diary("good", 0.05, book)], Simulated().advance
    )
    for _ in range(4):
        await scheduler.tick()
    bad, good = scheduler.turns
    assert (bad.summary()["restarts"], good.summary()["restarts"]) == (4, 0)
    assert "as told" in bad.last_error
    assert sum(name == "good" for _, name in book) == 4
    assert "bad failed" in caplog.text


async def test_in_real_time_a_slow_agent_does_not_delay_a_fast_one():
    book = []
    release = asyncio.Event()

    class Slow(Diary):
        async def step(self, stamp_s):
            await super().step(stamp_s)
            await release.wait()

    now = asyncio.get_running_loop().time
    scheduler = RealTimeScheduler([Slow("slow", 0.01, book), Diary("fast", 0.01, book)], now)
    running = asyncio.create_task(scheduler.run())
    while sum(name == "fast" for _, name in book) < 5:  # noqa: ASYNC110 - the scheduler's own waits are under test
        await asyncio.sleep(0)
    running.cancel()
    with pytest.raises(asyncio.CancelledError):
        await running
    assert sum(name == "slow" for _, name in book) == 1


@pytest.mark.parametrize("kind", ["lockstep", "real"])
async def test_a_fatal_error_of_any_agent_ends_the_scheduler(kind):
    agents = [Diary("good", 0.01, []), Diary("bad", 0.01, [], fails=True)]
    if kind == "lockstep":
        scheduler = LockstepScheduler(agents, Simulated().advance, fatal=(ArithmeticError,))
    else:
        scheduler = RealTimeScheduler(agents, asyncio.get_running_loop().time, fatal=(ArithmeticError,))
    with pytest.raises(ArithmeticError, match="as told"):
        async with asyncio.timeout(5.0):
            await scheduler.run()


async def test_turns_are_counted_and_the_longest_wait_between_two_is_kept():
    turns = Turns(agent=Diary("a", 0.01, []))
    for pause_s in (0.0, 0.01, 0.2, 0.01):
        await asyncio.sleep(pause_s)
        await turns.take(0.0)
    assert turns.taken == 4
    assert 0.2 <= turns.longest_wait_s < 0.5


async def test_in_real_time_one_late_turn_costs_no_other():
    book = []

    class OnceLate(Diary):
        async def step(self, stamp_s):
            await super().step(stamp_s)
            if len(self.book) % 4 == 0:
                await asyncio.sleep(0.15)

    scheduler = RealTimeScheduler([OnceLate("a", 0.1, book)], asyncio.get_running_loop().time)
    with pytest.raises(TimeoutError):
        async with asyncio.timeout(2.05):
            await scheduler.run()
    assert len(book) >= 19, "without making up for the late ones there are 18"
