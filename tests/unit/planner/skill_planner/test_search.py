"""The search against brute force: cheapest on small problems, sound on all, honest when it gives up."""

from __future__ import annotations

import heapq
from itertools import count, product
from math import inf

import pytest
from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st

from planner.doubles.sketch import FURNITURE_SIZE_M, Sketch
from planner.goals import PLACING, goal, holds
from planner.plan import Step
from planner.skill_planner.flaws import goal_flaws
from planner.skill_planner.search import Exhausted, Found, Search
from scene_graph.nodes import DoorState
from skills.facts import read_state
from skills.registry import load_registry

SKILLS = load_registry([])


def too_early(goals, start, before, after, ticked, now):
    """Whether a step that serves no goal whose turn it is brings about a later one for another object; what is laid
    down in the room it came from changes nothing.
    """
    if now > ticked:
        return False
    mine = goals[ticked].args[0] if ticked < len(goals) else None
    later = [g for g in goals[ticked + 1 :] if g.predicate in PLACING and g.args[0] != mine]
    new = [g for g in later if holds(g, after) and not holds(g, before)]
    return any(start.room_of(g.args[0]) != g.args[1] for g in new)


def spoken_of(goals, start):
    """What the goals name or the hand holds, what that stands on, the rooms of all that, and what stands on it."""
    named = [arg for g in goals for arg in g.args] + ([start.holding] if start.holding else [])
    named += [cup for cup in start.places if any(link in named for link in start.chain(cup) if link in start.places)]
    links = [link for node in named for link in start.chain(node)]
    return list(dict.fromkeys([*links, *(start.room_of(node) for node in links), start.robot_room]))


def serves(step, goals, search, state, ticked):
    """Whether a step handles the thing whose turn it is, or what stands on it, or lays something else down in a room;
    a thing is put where its goal wants it.
    """
    if step.skill == "GOTO":
        return True
    object_id = step.args[0]
    mine = [g for g in search.pending(state, ticked) if g.object_id is not None]
    if step.skill == "PICK":
        return any(g.args[0] in state.chain(object_id) for g in mine)
    own = [g for g in mine if g.args[0] == object_id]
    if state.world.things[step.args[1]].kind == "room" and (not own or ticked == len(goals)):
        return True
    return any(step.args[1] in g.args[1:] for g in own)


def brute_force_s(goals, start):
    """Uniform-cost search over every skill with every argument, with the same meaning of *in order*."""
    search = Search(goals, SKILLS, start)
    things = spoken_of(goals, start)
    cups = [thing for thing in things if thing.startswith("cup")]
    steps = [Step(skill="GOTO", args=(x,)) for x in things] + [Step(skill="PICK", args=(x,)) for x in cups]
    steps += [Step(skill="PLACE", args=pair) for pair in product(cups, things) if pair[1] not in cups]
    tie = count()
    queue = [(0.0, next(tie), start, search.tick(start, 0))]
    best = {(start, search.tick(start, 0)): 0.0}
    while queue:
        cost_s, _, state, ticked = heapq.heappop(queue)
        if cost_s > best[(state, ticked)]:
            continue
        if search.done(state, ticked):
            return cost_s
        for step in steps:
            skill = SKILLS[step.skill]
            if not serves(step, goals, search, state, ticked) or skill.conditions(state, step.args):
                continue
            after = skill.effects(state, step.args)
            now = search.tick(after, ticked)
            total_s = cost_s + skill.cost_s(state, step.args)
            if not too_early(goals, start, state, after, ticked, now) and total_s < best.get((after, now), inf):
                best[(after, now)] = total_s
                heapq.heappush(queue, (total_s, next(tie), after, now))
    return None


def small_world(
    *,
    tables=((0.0, 1.5), (0.0, 1.5)),
    cups_on=("table_1", "table_1"),
    person=(0.0, 0.0),
    robot_in=1,
    holding=None,
    tight=False,
    closed=False,
):
    """Two rooms, a table in each, two cups, a person in the second room. Places are meters from the room's middle.
    ``tight``: a table carries no more than one cup. ``closed``: so is the door.
    """
    middle_x = {1: 0.0, 2: 4.2}
    sketch = (
        Sketch()
        .room("room_1", at=(0.0, 0.0))
        .room("room_2", at=(4.2, 0.0))
        .door("room_1", "room_2", at=(2.1, 0.0), state=DoorState.CLOSED if closed else DoorState.OPEN)
    )
    for number, (x, y) in enumerate(tables, start=1):
        size_m = (0.2, 0.2, 0.75) if tight else FURNITURE_SIZE_M
        sketch.furniture(f"table_{number}", "table", f"room_{number}", at=(middle_x[number] + x, y), size_m=size_m)
    for number, place in enumerate(cups_on, start=1):
        sketch.thing(f"cup_{number}", "cup", on="table_1" if place == holding else place)
    sketch.person("person_1", "Anna", "room_2", at=(middle_x[2] + person[0], person[1]))
    return sketch.snapshot(robot_in=f"room_{robot_in}", at=(middle_x[robot_in], 0.0), holding=holding)


def small_worlds(in_hand=(None, None, "cup_1", "cup_2")):
    """Small worlds of all kinds; the robot in the middle of a room, perhaps with something in its hand."""
    coordinate = st.floats(-1.5, 1.5).map(lambda x: round(x, 2))
    place, number = st.tuples(coordinate, coordinate), st.sampled_from([1, 2])
    on = st.sampled_from(["table_1", "table_2", "room_1", "room_2"])
    return st.builds(
        small_world,
        tables=st.tuples(place, place),
        cups_on=st.tuples(on, st.one_of(on, st.just("cup_1"))),
        person=place,
        robot_in=number,
        holding=st.sampled_from(in_hand),
        tight=st.booleans(),
        closed=st.sampled_from([False, False, False, True]),
    )


cups = st.sampled_from(["cup_1", "cup_2"])
tables = st.sampled_from(["table_1", "table_2"])
pointed_goal = st.one_of(
    st.builds(lambda a, b: goal("on", a, b), cups, tables),
    st.builds(lambda a: goal("given", a, "person_1"), cups),
    st.builds(lambda a: goal("holding", a), cups),
    st.builds(lambda a: goal("robot_at", a), st.sampled_from(["table_1", "person_1"])),
    st.builds(lambda a: goal("found", a), cups),
)
rooms = st.sampled_from(["room_1", "room_2"])
in_a_room = st.one_of(
    st.builds(lambda a, b: goal("in", a, b), cups, rooms), st.builds(lambda a: goal("robot_at", a), rooms)
)
near = st.builds(lambda a: goal("near", a, "cup_2" if a == "cup_1" else "cup_1"), cups)
some_goal = st.one_of(pointed_goal, in_a_room, near)
"""For *cup_1 near cup_2* it is cup_1 that the search moves, even where moving the other were cheaper."""


def least_that_search_and_brute_force_find(snapshot, goals):
    """Seconds of the search and of brute force; None where there is no plan."""
    start = read_state(snapshot)
    assume(not goal_flaws(goals, snapshot, start))
    found = Search(goals, SKILLS, start).run()
    return (found.cost_s if isinstance(found, Found) else None), brute_force_s(goals, start)


@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(small_worlds(), st.lists(st.one_of(pointed_goal, in_a_room), min_size=1, max_size=3))
@example(small_world(), [goal("holding", "cup_1"), goal("found", "cup_2")])
@example(small_world(cups_on=("table_2", "table_1")), [goal("on", "cup_1", "table_1"), goal("found", "cup_2")])
@example(small_world(), [goal("robot_at", "table_1"), goal("found", "cup_1")])
@example(small_world(holding="cup_2"), [goal("on", "cup_1", "table_2"), goal("in", "cup_2", "room_2")])
@example(small_world(cups_on=("room_2", "table_1")), [goal("in", "cup_2", "room_2"), goal("holding", "cup_1")])
@example(small_world(holding="cup_2"), [goal("robot_at", "room_2"), goal("on", "cup_2", "table_1")])
@example(small_world(cups_on=("table_1", "cup_1")), [goal("on", "cup_1", "table_2"), goal("on", "cup_2", "table_1")])
@example(small_world(tight=True), [goal("on", "cup_1", "table_2"), goal("on", "cup_2", "table_1")])
@example(
    small_world(tables=((0.0, 0.8), (0.0, 0.0)), holding="cup_1"), [goal("found", "cup_2"), goal("holding", "cup_2")]
)
@example(
    small_world(tables=((0.0, 0.8), (0.0, 0.0)), cups_on=("table_1", "cup_1")),
    [goal("found", "cup_1"), goal("holding", "cup_1")],
)
def test_no_way_is_cheaper_than_the_one_found(snapshot, goals):
    found_s, least_s = least_that_search_and_brute_force_find(snapshot, goals)
    assert found_s == pytest.approx(least_s, abs=1e-6)


@pytest.mark.benchmark
@settings(max_examples=3000, suppress_health_check=list(HealthCheck))
@given(small_worlds(), st.lists(st.one_of(pointed_goal, in_a_room), min_size=1, max_size=4))
def test_on_thousands_of_small_problems_no_way_is_cheaper(snapshot, goals):
    found_s, least_s = least_that_search_and_brute_force_find(snapshot, goals)
    assert found_s == pytest.approx(least_s, abs=1e-6)


def test_with_something_wanted_later_in_its_hand_the_robot_leaves_it_where_it_passes():
    """Cheaper than to lay it down here and come back for it."""
    snapshot = small_world(cups_on=("table_2", "table_2"), holding="cup_2")
    goals = [goal("on", "cup_1", "table_1"), goal("given", "cup_2", "person_1")]
    found = Search(goals, SKILLS, read_state(snapshot)).run()
    assert [str(step) for step in found.steps[:3]] == ["GOTO(table_2)", "PLACE(cup_2, room_2)", "PICK(cup_1)"]


def test_into_a_room_the_robot_goes_to_what_it_is_to_handle_there_next():
    goals = [goal("robot_at", "room_2"), goal("holding", "cup_1")]
    snapshot = small_world(cups_on=("table_2", "table_1"))
    found = Search(goals, SKILLS, read_state(snapshot)).run()
    assert [step.skill for step in found.steps] == ["GOTO", "PICK"]


def test_what_is_to_be_found_later_is_approached_at_once_where_the_first_thing_is_in_reach_too():
    start = read_state(small_world())
    found = Search([goal("holding", "cup_1"), goal("found", "cup_2")], SKILLS, start).run()
    assert found.steps == (Step(skill="GOTO", args=("cup_2",)), Step(skill="PICK", args=("cup_1",)))
    assert abs(found.cost_s - (6.0 + 1.5 / 0.35 + 30.0)) < 1e-6


def test_what_is_found_within_reach_and_wanted_later_is_picked_up_without_another_approach():
    sketch = Sketch().room("room_1", at=(0.0, 0.0))
    sketch.furniture("table_1", "table", "room_1", at=(1.0, 0.0)).thing("cup_1", "cup", on="table_1")
    sketch.person("person_1", "Anna", "room_1", at=(-1.2, 0.0))
    start = read_state(sketch.snapshot(robot_in="room_1", at=(0.0, 0.0)))
    near = SKILLS["GOTO"].effects(start, ("table_1",))
    found = Search([goal("found", "cup_1"), goal("given", "cup_1", "person_1")], SKILLS, near).run()
    assert [step.skill for step in found.steps] == ["PICK", "GOTO", "PLACE"]
    assert [step.skill for step in Search([goal("found", "cup_1")], SKILLS, near).run().steps] == ["GOTO"]


@settings(max_examples=80, suppress_health_check=list(HealthCheck))
@given(small_worlds(), st.lists(some_goal, min_size=1, max_size=4))
def test_the_steps_found_can_be_carried_out_and_reach_every_goal_in_turn(snapshot, goals):
    state = read_state(snapshot)
    search = Search(goals, SKILLS, state)
    found = search.run()
    if isinstance(found, Exhausted):
        return
    ticked = search.tick(state, 0)
    for step in found.steps:
        assert SKILLS[step.skill].conditions(state, step.args) == []
        state = SKILLS[step.skill].effects(state, step.args)
        ticked = search.tick(state, ticked)
    assert search.done(state, ticked)


@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(small_worlds(), st.lists(some_goal, min_size=1, max_size=3))
@example(small_world(cups_on=("table_2", "table_1")), [goal("holding", "cup_1"), goal("on", "cup_2", "table_1")])
@example(small_world(cups_on=("table_1", "table_2")), [goal("on", "cup_2", "table_1"), goal("near", "cup_1", "cup_2")])
def test_the_estimate_never_exceeds_the_true_cost(snapshot, goals):
    state = read_state(snapshot)
    search = Search(goals, SKILLS, state)
    found = search.run()
    if not isinstance(found, Found):
        return
    spent_s, ticked = 0.0, search.tick(state, 0)
    for step in found.steps:
        assert search.at_least_s(state, ticked) <= found.cost_s - spent_s + 1e-6
        spent_s += SKILLS[step.skill].cost_s(state, step.args)
        state = SKILLS[step.skill].effects(state, step.args)
        ticked = search.tick(state, ticked)
    assert search.at_least_s(state, ticked) == 0.0


def test_first_and_then_mean_what_they_say():
    sketch = Sketch().room("room_1", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.furniture("table_2", "table", "room_1", at=(0.0, -1.0))
    sketch.thing("cup_1", "cup", on="table_1").thing("cup_2", "cup", on="table_1")
    snapshot = sketch.snapshot(robot_in="room_1", at=(0.0, 0.0))
    for order in (["cup_1", "cup_2"], ["cup_2", "cup_1"]):
        found = Search([goal("on", cup, "table_2") for cup in order], SKILLS, read_state(snapshot)).run()
        assert isinstance(found, Found)
        assert [step.args[0] for step in found.steps if step.skill == "PLACE"] == order


def test_a_goal_may_come_twice():
    sketch = Sketch().room("room_1", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.furniture("table_2", "table", "room_1", at=(0.0, -1.0))
    sketch.thing("cup_1", "cup", on="table_1").thing("cup_2", "cup", on="table_1")
    goals = [goal("on", cup, "table_2") for cup in ("cup_1", "cup_2", "cup_1")] + [goal("holding", "cup_1")]
    found = Search(goals, SKILLS, read_state(sketch.snapshot(robot_in="room_1", at=(0.0, 0.0)))).run()
    assert isinstance(found, Found)
    assert [step.args[0] for step in found.steps if step.skill == "PICK"] == ["cup_1", "cup_2", "cup_1"]


def test_out_of_budget_says_so():
    sketch = Sketch().room("room_1", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.furniture("table_2", "table", "room_1", at=(0.0, -1.0)).thing("cup_1", "cup", on="table_1")
    start = read_state(sketch.snapshot(robot_in="room_1", at=(0.0, 0.0)))
    result = Search([goal("on", "cup_1", "table_2")], SKILLS, start, budget=2).run()
    assert isinstance(result, Exhausted)
    assert result.out_of_budget
    assert result.expanded == 2
