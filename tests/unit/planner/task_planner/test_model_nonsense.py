"""Whatever a language model answers within its schema ends in a proven plan, an answer, a question or a refusal."""

from __future__ import annotations

import asyncio
import json
import time
from random import Random

import numpy as np
import pytest

from planner.doubles.sketch import flat
from planner.goals import ARITY, Predicate, goal, holds, lasting
from planner.language.grammar.parser import CommandGrammar
from planner.models.scripted import ScriptedModel
from planner.plan import Dialogue, Impossible, Kind, Plan
from planner.skill_planner.replanner import Replanner
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from random_problems import random_problem
from scene_graph.nodes import DoorState, ObjectState
from skills.facts import read_state
from skills.registry import load_registry

SKILLS = load_registry([])
REQUEST = "do the wibbly thing with the frumious doodah"
THINGS = ("cup", "bottle", "apple", "book", "tray", "key", "ball", "jar", "spoon", "remote")
PLACES = (
    "table",
    "desk",
    "shelf",
    "couch",
    "counter",
    "box",
    "room",
    "person",
    "door",
    "cup",
    "tray",
    "rack",
    "laptop",
)
QUESTIONS = (
    "where is the cup",
    "what is on the table",
    "stop",
    "bring the cup to the desk",
    "\x00",
    "?" * 600,
    "wo ist",
)
REPLIES = ("", "Which one?", "I cannot fly.", "x" * 1200, "\x07\ud800", '{"kind": "plan"}')


def a_home(random):
    """A flat with closed doors, things that are gone, stacks, or something in the hand; or a random building."""
    if random.random() < 0.3:
        return random_problem(random.randrange(1000))[0]
    sketch = flat().thing("tray_1", "tray", on="table_1", support=True).thing("cup_9", "cup", on="tray_1")
    sketch.thing("spoon_1", "spoon", on="box_1", relation="in").thing("key_1", "key", on="room_3")
    sketch.thing("ball_1", "ball", on="couch_1", state=ObjectState.MISSING)
    sketch.room("room_5", "cellar", at=(12.6, 0.0))
    sketch.door("room_3", "room_5", at=(10.5, 0.0), state=DoorState.CLOSED if random.random() < 0.5 else DoorState.OPEN)
    sketch.furniture("rack_1", "shelf", "room_5", at=(12.6, 1.0), size_m=(0.2, 0.2, 0.8)).thing(
        "jar_1", "jar", on="rack_1"
    )
    holding = random.choice([None, None, "cup_2", "apple_1"])
    return sketch.snapshot(robot_in="room_2", at=(4.2, 0.0), holding=holding)


def babble(schema, random):
    """A random answer that the schema allows."""
    fields = schema["properties"]
    of_goal = fields["goals"]["items"]["properties"]
    predicates, identifiers = of_goal["predicate"]["enum"], of_goal["args"]["items"]["enum"]

    wild = random.random() < 0.3
    things, places = ([i for i in identifiers if i.startswith(stems) or wild] for stems in (THINGS, PLACES))

    def a_goal():
        predicate = random.choice(predicates)
        arity = ARITY[Predicate(predicate)] if not wild else random.randrange(4)
        args = [random.choice(things if random.random() < 0.9 else identifiers) for _ in range(arity)]
        if predicate == Predicate.ROBOT_AT or arity > 1:
            args[-1:] = [random.choice(places)]
        return {"predicate": predicate, "args": args}

    many = random.choices([0, 1, 2, 3, 5, 9, 45], [5, 40, 25, 15, 10, 4, 1])[0]
    return {
        "kind": random.choices(fields["kind"]["enum"], [85, 5, 5, 5])[0],
        "goals": [a_goal() for _ in range(many)],
        "question": random.choice(QUESTIONS),
        "reply": random.choice(REPLIES),
    }


def grounding(goals, start):
    """What the goals name or the hand holds, what that stands on, is in or bears, surfaces beside, and the rooms."""
    named = {arg for each in goals for arg in each.args} | {start.holding}
    touched = {link for node in named if node for link in start.chain(node)}
    touched |= {thing for thing in start.places if touched & set(start.chain(thing))}
    near = {each.args[1] for each in goals if each.predicate is Predicate.NEAR}
    beside = {thing.id for node in near for thing in start.world.in_room(start.room_of(node)) if thing.support}
    return touched | beside | {start.room_of(node) for node in touched} | {start.robot_room}


def outcome_of(seed):
    """What becomes of one random conversation: plan, search, impossible, answer, clarify or refuse; everything on the
    way is checked.
    """
    random = Random(seed)
    snapshot = a_home(random)
    said = []

    def speak(request):
        said.append(babble(request.schema, random))
        return said[-1]

    verifier = Verifier(SKILLS)
    planner = TaskPlanner(CommandGrammar(), verifier, ScriptedModel(speak))
    meaning = asyncio.run(planner.interpret(REQUEST, snapshot, Dialogue()))
    if meaning.kind is not Kind.PLAN:
        assert meaning.reply.strip(), said
        assert not meaning.goals
        return meaning.kind.value
    proposed = [tuple(goal(each["predicate"], *each["args"]) for each in said[-1]["goals"])]
    assert [meaning.goals] == proposed
    plan = Replanner(verifier).first_plan(meaning.goals, snapshot, snapshot.stamp_s)
    if isinstance(plan, Impossible):
        assert plan.reason.strip()
        return "impossible"
    return proven(plan, meaning.goals, snapshot)


def proven(plan, goals, snapshot):
    """Carry a plan out on the facts alone; it touches nothing but what the goals speak of."""
    assert isinstance(plan, Plan)
    state = start = read_state(snapshot)
    allowed = grounding(goals, start)
    for step in plan.steps:
        assert SKILLS[step.skill].conditions(state, step.args) == [], (str(plan), str(step))
        state = SKILLS[step.skill].effects(state, step.args)
        assert plan.seeking is not None or set(step.args) <= allowed, (str(plan), str(step))
    if plan.seeking is not None:
        assert plan.seeking in {arg for each in goals for arg in each.args}
        assert {step.skill for step in plan.steps} <= {"GOTO"}
        return "search"
    assert all(holds(each, state) for each in lasting(goals)), (str(plan), goals)
    return "plan"


def counts(seeds):
    """How often each outcome came about."""
    found = {}
    for seed in seeds:
        kind = outcome_of(seed)
        found[kind] = found.get(kind, 0) + 1
    return found


def test_nonsense_within_the_schema_never_gets_past_the_verifier():
    found = counts(range(300))
    assert found.keys() >= {"plan", "search", "clarify", "refuse"}, found


@pytest.mark.benchmark
def test_ten_thousand_answers_of_nonsense_never_get_past_the_verifier(record_property):
    times_s, found = [], {}
    for seed in range(10_000):
        started_s = time.process_time()
        kind = outcome_of(seed)
        times_s.append(time.process_time() - started_s)
        found[kind] = found.get(kind, 0) + 1
    p50, p99, most = (1000.0 * float(value) for value in np.percentile(times_s, [50, 99, 100]))
    figures = {**found, "p50 ms": round(p50, 1), "p99 ms": round(p99, 1), "max ms": round(most, 1)}
    for name, value in figures.items():
        record_property(name, value)
    print(f"\n{json.dumps(figures)}")
