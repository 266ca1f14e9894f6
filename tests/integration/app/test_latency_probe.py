"""The client of evaluations that asks a service how fast it answers."""

from __future__ import annotations

import pytest

from evaluations.service.latency import PATHS, api_probe

pytestmark = pytest.mark.anyio


async def test_the_probe_asks_for_everything_in_turn_and_says_what_failed(served, token):
    port = int(served.address.rpartition(":")[2])
    async with api_probe() as probe:
        well = await probe.ask(port, token, 0.8)
        foreign = await probe.ask(port, "another-token-for-tests", 0.4)
    assert len(well.latencies_ms) == 8
    assert well.failures == ()
    assert min(well.latencies_ms) > 0.0
    assert {failure.partition(":")[0] for failure in foreign.failures} == set(PATHS) - {"/healthz"}
    assert all(failure.endswith("401 Unauthorized") for failure in foreign.failures)
