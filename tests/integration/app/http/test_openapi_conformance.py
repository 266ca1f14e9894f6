"""The service does what its OpenAPI document says, on generated calls and on sequences of them (schemathesis).

Every check is made, in its usual setting. The calls are the same in every run; ``make test-long`` makes up others each
time, for ten minutes (``MAJORDOMO_FUZZ_S`` seconds), on a stored graph and on a robot.
"""

from __future__ import annotations

import os
import secrets

import pytest

from openapi_calls import call
from paths import DATA
from service_process import serving

GRAPH = ("--graph", str(DATA / "flat_graph.json"))
ROBOT = ("--house", str(DATA / "studio.json"), "--no-camera", "--simulation-api")
LONG_S = float(os.environ.get("MAJORDOMO_FUZZ_S", "600"))
OFTEN = ("--requests-per-second", "100000")


def assert_conforming(folder, arguments, *options, timeout_s):
    with serving(folder, *arguments, *OFTEN) as service:
        outcome = call(service, folder, *options, timeout_s=timeout_s)
        assert outcome.returncode == 0, outcome.stdout[-6000:] + outcome.stderr[-2000:]
        assert service.client.get("/readyz").status_code == 200
    log = (folder / "stderr.log").read_text(encoding="utf-8")
    assert "Traceback" not in log, log[-4000:]


SIMULATION = ("--include-tag", "simulation", "--phases", "coverage,fuzzing")  # no call of it leads to another


@pytest.mark.slow
@pytest.mark.parametrize(
    ("arguments", "chosen"),
    [(GRAPH, ("--max-examples", "4")), (ROBOT, ("--max-examples", "20", *SIMULATION))],
    ids=["graph", "simulation"],
)
def test_generated_calls_meet_nothing_that_the_document_does_not_say(tmp_path, arguments, chosen):
    assert_conforming(tmp_path, arguments, "--generation-deterministic", *chosen, timeout_s=300.0)


@pytest.mark.long
@pytest.mark.parametrize("arguments", [GRAPH, ROBOT], ids=["graph", "robot"])
def test_nor_do_ten_minutes_of_other_calls(tmp_path, arguments):
    seed = str(secrets.randbelow(1_000_000))
    long = ("--max-time", str(int(LONG_S)), "--seed", seed, "--generation-database", "none")
    assert_conforming(tmp_path, arguments, *long, timeout_s=4 * LONG_S)
