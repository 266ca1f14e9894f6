"""The search and the PDDL export against a planner that knows only the text."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from importlib.util import find_spec

import numpy as np
import pytest

from pddl_planner import Task, cheapest
from planner.doubles.sketch import flat
from planner.goals import goal
from planner.skill_planner.flaws import goal_flaws
from planner.skill_planner.pddl import UNITS_PER_S, export
from planner.skill_planner.search import Found, Search
from random_problems import random_problem
from skills.facts import read_state
from skills.registry import load_registry

SKILLS = load_registry([])


def sound_problems(count):
    """(seed, snapshot, goals) of the first problems whose goals make sense."""
    seed = 0
    while count:
        snapshot, goals = random_problem(seed)
        if not goal_flaws(goals, snapshot, read_state(snapshot)):
            count -= 1
            yield seed, snapshot, goals
        seed += 1


def compared(snapshot, goals):
    """Seconds that the search and the independent planner took; both must find a plan of one cost, or neither."""
    started_s = time.process_time()
    found = Search(goals, SKILLS, read_state(snapshot)).run()
    searched_s = time.process_time() - started_s
    text = export(goals, read_state(snapshot), SKILLS)
    started_s = time.process_time()
    plan = cheapest(Task(text.domain, text.problem))
    planned_s = time.process_time() - started_s
    assert isinstance(found, Found) == (plan is not None)
    if isinstance(found, Found) and plan is not None:
        cost, steps = plan
        rounding = 0.5 * (len(steps) + len(found.steps))
        assert cost == pytest.approx(UNITS_PER_S * found.cost_s, abs=rounding), (found.cost_s, cost, found.steps, steps)
    return searched_s, planned_s


def test_on_random_problems_the_search_costs_what_an_optimal_planner_says():
    for seed, snapshot, goals in sound_problems(15):
        print(f"seed {seed}: {', '.join(map(str, goals))}")
        compared(snapshot, goals)


@pytest.mark.benchmark
def test_on_200_random_problems_the_search_is_optimal_and_20_times_faster(record_property):
    times = np.array([compared(snapshot, goals) for _, snapshot, goals in sound_problems(200)])
    ratios = times[:, 1] / times[:, 0]
    figures = {
        "problems": len(times),
        "search p50 ms": round(1000 * float(np.median(times[:, 0])), 2),
        "independent p50 ms": round(1000 * float(np.median(times[:, 1])), 2),
        "times faster p50": round(float(np.median(ratios)), 1),
        "times faster p10": round(float(np.percentile(ratios, 10)), 1),
    }
    for name, value in figures.items():
        record_property(name, value)
    print(f"\n{json.dumps(figures)}")
    assert np.median(ratios) >= 20.0


def test_a_problem_reads_as_what_it_is_about():
    state = read_state(flat().snapshot(robot_in="room_2", at=(4.2, 0.0)))
    text = export([goal("on", "cup_1", "desk_1")], state, SKILLS)
    assert "(upon cup_1 table_1)" in text.problem
    assert "(precondition" not in text.problem
    assert "couch_1" not in text.domain + text.problem
    cost, steps = cheapest(Task(text.domain, text.problem))
    assert [step[0] for step in steps] == ["goto", "pick", "goto", "place", "goal-1-1", "finish-1"]
    assert cost == pytest.approx(
        UNITS_PER_S * Search([goal("on", "cup_1", "desk_1")], SKILLS, state).run().cost_s, abs=4
    )


@pytest.mark.skipif(find_spec("up_fast_downward") is None, reason="pip install up-fast-downward")
@pytest.mark.benchmark
def test_fast_downward_finds_the_same_costs(tmp_path):
    driver = find_spec("up_fast_downward").submodule_search_locations[0] + "/downward/fast-downward.py"
    for seed, snapshot, goals in sound_problems(20):
        state = read_state(snapshot)
        text, found = export(goals, state, SKILLS), Search(goals, SKILLS, state).run()
        (tmp_path / "domain.pddl").write_text(text.domain)
        (tmp_path / "problem.pddl").write_text(text.problem)
        command = [sys.executable, driver, "--plan-file", "plan", "domain.pddl", "problem.pddl"]
        command += ["--search", "astar(lmcut())"]
        subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
        cost = int((tmp_path / "plan").read_text().rpartition("cost = ")[2].split()[0])
        assert cost == pytest.approx(UNITS_PER_S * found.cost_s, abs=20), seed
