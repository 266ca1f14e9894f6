"""The search against brute force: cheapest on small problems, sound on all, honest when it gives up."""

from __future__ import annotations

import heapq
from itertools import count, product

from hypothesis import HealthCheck, assume, example, given, settings
from hypothesis import strategies as st

from majordomo.planner.flaws import goal_flaws
from majordomo.planner.goals import PLACING, goal, holds
from majordomo.planner.plan import Step
from majordomo.planner.search import Exhausted, Found, Search
from majordomo.planner.sketch import Sketch
from majordomo.skills.registry import load_registry
from majordomo.skills.state import PlanState

SKILLS = load_registry([])


def too_early(goals, before, after, ticked, now):
    """Whether a step that serves no goal whose turn it is brings about a later one for another object."""
    if now > ticked:
        return False
    mine = goals[ticked].args[0] if ticked < len(goals) else None
    later = [g for g in goals[ticked + 1 :] if g.predicate in PLACING and g.args[0] != mine]
    return any(holds(g, after) and not holds(g, before) for g in later)


def brute_force_s(goals, start):
    """Uniform-cost search over every skill with every argument, with the same meaning of *in order*."""
    search = Search(goals, SKILLS)
    things = [thing.id for thing in start.world.things.values() if thing.kind != "door"]
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
            mine = goals[ticked].args[0] if ticked < len(goals) else step.args[0]
            if skill.conditions(state, step.args) or (step.skill == "PICK" and step.args[0] != mine):
                continue
            after = skill.effects(state, step.args)
            now = search.tick(after, ticked)
            total_s = cost_s + skill.cost_s(state, step.args)
            if not too_early(goals, state, after, ticked, now) and total_s < best.get((after, now), float("inf")):
                best[(after, now)] = total_s
                heapq.heappush(queue, (total_s, next(tie), after, now))
    return None


def small_world(*, tables=((0.0, 1.5), (0.0, 1.5)), cups_on=(1, 1), person=(0.0, 0.0), robot_in=1, holding=None):
    """Two rooms, a table in each, two cups, a person in the second room. Places are meters from the room's middle."""
    middle_x = {1: 0.0, 2: 4.2}
    sketch = (
        Sketch().room("room_1", at=(0.0, 0.0)).room("room_2", at=(4.2, 0.0)).door("room_1", "room_2", at=(2.1, 0.0))
    )
    for number, (x, y) in enumerate(tables, start=1):
        sketch.furniture(f"table_{number}", "table", f"room_{number}", at=(middle_x[number] + x, y))
    for number, table in enumerate(cups_on, start=1):
        sketch.thing(f"cup_{number}", "cup", on=f"table_{table}")
    sketch.person("person_1", "Anna", "room_2", at=(middle_x[2] + person[0], person[1]))
    return sketch.snapshot(robot_in=f"room_{robot_in}", at=(middle_x[robot_in], 0.0), holding=holding)


def small_worlds(in_hand=(None, None, "cup_1", "cup_2")):
    """Small worlds of all kinds; the robot in the middle of a room, perhaps with something in its hand."""
    coordinate = st.floats(-1.5, 1.5).map(lambda x: round(x, 2))
    place, number = st.tuples(coordinate, coordinate), st.sampled_from([1, 2])
    return st.builds(
        small_world,
        tables=st.tuples(place, place),
        cups_on=st.tuples(number, number),
        person=place,
        robot_in=number,
        holding=st.sampled_from(in_hand),
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
"""For *cup_1 near cup_2* it is cup_1 that the search moves, even where moving the other were cheaper.

*In a room* leaves the spot to the skills: the search goes to its middle, and looks for no nearer corner.
"""


@settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
@given(small_worlds(in_hand=(None,)), st.lists(pointed_goal, min_size=1, max_size=2))
@example(small_world(), [goal("holding", "cup_1"), goal("found", "cup_2")])
@example(small_world(cups_on=(2, 1)), [goal("on", "cup_1", "table_1"), goal("found", "cup_2")])
@example(small_world(), [goal("robot_at", "table_1"), goal("found", "cup_1")])
def test_with_an_empty_hand_no_way_is_cheaper_than_the_one_found(snapshot, goals):
    start = PlanState.from_snapshot(snapshot)
    assume(not goal_flaws(goals, snapshot, start))
    found, least_s = Search(goals, SKILLS).run(start), brute_force_s(goals, start)
    if isinstance(found, Exhausted):
        assert least_s is None
        return
    assert least_s is not None
    assert abs(found.cost_s - least_s) < 1e-6, (found.steps, found.cost_s, least_s)


def test_what_is_to_be_found_later_is_approached_at_once_where_the_first_thing_is_in_reach_too():
    start = PlanState.from_snapshot(small_world())
    found = Search([goal("holding", "cup_1"), goal("found", "cup_2")], SKILLS).run(start)
    assert found.steps == (Step(skill="GOTO", args=("cup_2",)), Step(skill="PICK", args=("cup_1",)))
    assert abs(found.cost_s - (6.0 + 1.5 / 0.35 + 30.0)) < 1e-6


def test_what_is_found_within_reach_and_wanted_later_is_picked_up_without_another_approach():
    sketch = Sketch().room("room_1", at=(0.0, 0.0))
    sketch.furniture("table_1", "table", "room_1", at=(1.0, 0.0)).thing("cup_1", "cup", on="table_1")
    sketch.person("person_1", "Anna", "room_1", at=(-1.2, 0.0))
    start = PlanState.from_snapshot(sketch.snapshot(robot_in="room_1", at=(0.0, 0.0)))
    near = SKILLS["GOTO"].effects(start, ("table_1",))
    found = Search([goal("found", "cup_1"), goal("given", "cup_1", "person_1")], SKILLS).run(near)
    assert [step.skill for step in found.steps] == ["PICK", "GOTO", "PLACE"]
    assert [step.skill for step in Search([goal("found", "cup_1")], SKILLS).run(near).steps] == ["GOTO"]


@settings(max_examples=80, deadline=None, suppress_health_check=list(HealthCheck))
@given(small_worlds(), st.lists(some_goal, min_size=1, max_size=4))
def test_the_steps_found_can_be_carried_out_and_reach_every_goal_in_turn(snapshot, goals):
    state = PlanState.from_snapshot(snapshot)
    search = Search(goals, SKILLS)
    found = search.run(state)
    if isinstance(found, Exhausted):
        return
    ticked = search.tick(state, 0)
    for step in found.steps:
        assert SKILLS[step.skill].conditions(state, step.args) == []
        state = SKILLS[step.skill].effects(state, step.args)
        ticked = search.tick(state, ticked)
    assert search.done(state, ticked)


@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
@given(small_worlds(), st.lists(some_goal, min_size=1, max_size=3))
@example(small_world(cups_on=(2, 1)), [goal("holding", "cup_1"), goal("on", "cup_2", "table_1")])
@example(small_world(cups_on=(1, 2)), [goal("on", "cup_2", "table_1"), goal("near", "cup_1", "cup_2")])
def test_the_estimate_never_exceeds_the_true_cost(snapshot, goals):
    state, search = PlanState.from_snapshot(snapshot), Search(goals, SKILLS)
    found = search.run(state)
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
        found = Search([goal("on", cup, "table_2") for cup in order], SKILLS).run(PlanState.from_snapshot(snapshot))
        assert isinstance(found, Found)
        assert [step.args[0] for step in found.steps if step.skill == "PLACE"] == order


def test_a_goal_may_come_twice():
    sketch = Sketch().room("room_1", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.furniture("table_2", "table", "room_1", at=(0.0, -1.0))
    sketch.thing("cup_1", "cup", on="table_1").thing("cup_2", "cup", on="table_1")
    goals = [goal("on", cup, "table_2") for cup in ("cup_1", "cup_2", "cup_1")] + [goal("holding", "cup_1")]
    found = Search(goals, SKILLS).run(PlanState.from_snapshot(sketch.snapshot(robot_in="room_1", at=(0.0, 0.0))))
    assert isinstance(found, Found)
    assert [step.args[0] for step in found.steps if step.skill == "PICK"] == ["cup_1", "cup_2", "cup_1"]


def test_out_of_budget_says_so():
    sketch = Sketch().room("room_1", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.furniture("table_2", "table", "room_1", at=(0.0, -1.0)).thing("cup_1", "cup", on="table_1")
    start = PlanState.from_snapshot(sketch.snapshot(robot_in="room_1", at=(0.0, 0.0)))
    result = Search([goal("on", "cup_1", "table_2")], SKILLS, budget=2).run(start)
    assert isinstance(result, Exhausted)
    assert result.out_of_budget
    assert result.expanded == 2
