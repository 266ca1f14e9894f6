"""How long a request takes from its words to a verified plan, in a building whose graph has just changed."""

from __future__ import annotations

import time
from dataclasses import replace
from itertools import cycle, islice

import numpy as np
import pytest

from hospital import hospital
from planner.dialogue.interpreter import Interpreter
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Kind, Plan
from planner.skill_planner.replanner import Replanner
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from scene_graph.nodes import ObjectNode
from skills.registry import load_registry

REQUESTS = 300
STAGES = ("read", "parse and ground", "plan", "verify", "all")


def requests(snapshot):
    """Typical requests about things all over the building."""
    objects = snapshot.of_type(ObjectNode)
    cups, tables = ([node.id for node in objects if node.label == label] for label in ("cup", "table"))
    yield f"bring {cups[-1]} to {tables[0]}"
    yield "go to the nearest kitchen"
    yield f"put {cups[0]} and {cups[1]} on {tables[-1]}"
    yield "bring the nearest red cup to Anna"
    yield f"put {cups[0]}, {cups[-1]} and {cups[len(cups) // 2]} on {tables[len(tables) // 2]}"
    yield "give me the nearest bottle"
    yield f"take {cups[-2]} to the nearest office and come back to me"
    yield "how many cups are there?"


def moved_on(snapshot, number):
    """The next revision: the robot's status has changed, as it does all the time."""
    robot = replace(snapshot.robot, status=f"idle {number}")
    return snapshot.evolve(
        put_nodes={robot.id: robot}, revision=snapshot.revision + number, stamp_s=snapshot.stamp_s + number
    )


def stages_ms(text, snapshot, planner, interpreter, verifier):
    """Milliseconds of each stage for one request."""
    marks = [time.perf_counter()]
    verifier.state(snapshot), interpreter.lexicon(snapshot)
    marks.append(time.perf_counter())
    reading = planner.read(text, snapshot, Dialogue())
    marks.append(time.perf_counter())
    goals = reading.interpretation.goals
    plan = Replanner(verifier).first_plan(goals, snapshot, 0.0) if goals else None
    marks.append(time.perf_counter())
    assert reading.interpretation.kind in (Kind.PLAN, Kind.ANSWER), reading
    assert plan is None or (isinstance(plan, Plan) and verifier.check_plan(plan, snapshot) == [])
    marks.append(time.perf_counter())
    return [*np.diff(marks) * 1000.0, 1000.0 * (marks[-1] - marks[0])]


@pytest.mark.benchmark
@pytest.mark.parametrize(("nodes", "limit_ms"), [(200, 50.0), (5000, 250.0)])
def test_from_words_to_a_verified_plan(nodes, limit_ms, record_property):
    snapshot, grammar, verifier = hospital(nodes), CommandGrammar(), Verifier(load_registry([]))
    planner, interpreter = TaskPlanner(grammar, verifier), Interpreter(grammar, verifier)
    texts = list(requests(snapshot))
    for text in texts:
        stages_ms(text, moved_on(snapshot, 0), planner, interpreter, verifier)
    rows = [
        stages_ms(text, moved_on(snapshot, number), planner, interpreter, verifier)
        for number, text in enumerate(islice(cycle(texts), REQUESTS), start=1)
    ]
    print(f"\n{nodes} nodes, {REQUESTS} requests (ms)")
    for stage, times in zip(STAGES, zip(*rows, strict=True), strict=True):
        p50, p99 = (float(value) for value in np.percentile(times, [50, 99]))
        print(f"{stage:>18}: p50 {p50:6.1f}, p99 {p99:6.1f}, max {max(times):6.1f}")
        record_property(f"{stage} p99_ms", round(p99, 1))
    assert p99 < limit_ms
