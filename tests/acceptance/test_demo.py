"""The demonstration from outside: it succeeds in truth; and the same seed writes the same log."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from service_process import majordomo

EXPLORE = Path(__file__).parent.parent / "helpers" / "explore_briefly.py"
SECONDS = 12.0


@pytest.mark.long
def test_the_demonstration_succeeds_in_truth_after_a_change_of_plan(tmp_path):
    path = tmp_path / "figures.json"
    done = majordomo("evaluate", "demo", "--seeds", "1", "--jobs", "1", "--json", str(path))
    assert done.returncode == 0, done.stdout + done.stderr
    [run] = json.loads(path.read_text())["runs"]
    assert {"seed", "reported", "true", "replans", "sim_seconds", "wall_seconds"} <= run.keys()
    assert run["reported"]
    assert run["true"]
    assert run["disturbed"]
    assert run["replans"] >= 1


@pytest.mark.slow
def test_the_same_seed_gives_the_same_event_log_byte_for_byte_and_another_seed_does_not(tmp_path):
    logs = {name: tmp_path / f"{name}.jsonl" for name in ("first", "second", "other")}
    runs = [
        subprocess.Popen([sys.executable, EXPLORE, logs[name], str(SECONDS), seed])
        for name, seed in (("first", "4"), ("second", "4"), ("other", "5"))
    ]
    assert [run.wait(timeout=400) for run in runs] == [0, 0, 0]
    first, second, other = (events_until(path, SECONDS) for path in logs.values())
    assert len(first) > 20
    assert first == second
    assert first != other


def events_until(path, limit_s):
    """Raw lines of the events before ``limit_s``."""
    return [line for line in path.read_bytes().splitlines() if json.loads(line)["stamp_s"] < limit_s]
