"""The demonstration from outside: it succeeds in truth, and the same seed writes the same log."""

from __future__ import annotations

import json

import pytest
from service_process import majordomo


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Two runs with one seed, each in processes of its own."""
    folder = tmp_path_factory.mktemp("demo")
    outcomes = []
    for name in ("first", "second"):
        figures, logs = folder / f"{name}.json", folder / name
        done = majordomo(
            "evaluate", "demo", "--seeds", "1", "--jobs", "1", "--json", str(figures), "--logs", str(logs)
        )
        [log] = logs.iterdir()
        outcomes.append((done, json.loads(figures.read_text())["runs"][0], log.read_bytes()))
    return outcomes


@pytest.mark.slow
def test_the_demonstration_succeeds_in_truth_after_a_replan(runs):
    done, figures, _ = runs[0]
    assert done.returncode == 0, done.stdout + done.stderr
    assert figures["reported"]
    assert figures["true"]
    assert figures["disturbed"]
    assert figures["replans"] >= 1
    assert {"seed", "reported", "true", "replans", "sim_seconds", "wall_seconds"} <= figures.keys()


@pytest.mark.slow
def test_the_same_seed_gives_the_same_event_log_byte_for_byte(runs):
    (_, _, first), (_, _, second) = runs
    assert first == second
    assert len(first.splitlines()) > 100
