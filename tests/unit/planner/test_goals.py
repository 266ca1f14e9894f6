"""Goals in symbolic states and in the believed world, and how later goals supersede earlier ones."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.doubles.sketch import flat
from planner.errors import WrongArity
from planner.goals import ARITY, Goal, Predicate, goal, holds, holds_in, lasting, superseded
from scene_graph.edges import EdgeKey, EdgeType, InEdge, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState
from skills.facts import read_state
from skills.registry import load_registry

SKILLS = load_registry([])
SNAPSHOT = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))
names = st.sampled_from(["cup_1", "cup_2", "table_1", "room_1", "person_1"])
any_goal = st.sampled_from(Predicate).flatmap(
    lambda p: st.tuples(*[names] * ARITY[p]).map(lambda args: Goal(predicate=p, args=args))
)


def after(*steps, state=None):
    state = state or read_state(SNAPSHOT)
    for skill, *args in steps:
        assert SKILLS[skill].conditions(state, args) == []
        state = SKILLS[skill].effects(state, args)
    return state


CUP_ON_DESK = (("GOTO", "cup_1"), ("PICK", "cup_1"), ("GOTO", "desk_1"), ("PLACE", "cup_1", "desk_1"))


@pytest.mark.parametrize("predicate", list(Predicate))
def test_a_goal_with_the_wrong_number_of_arguments_is_refused(predicate):
    with pytest.raises(WrongArity) as error:
        Goal(predicate=predicate, args=("cup_1",) * (ARITY[predicate] + 1))
    assert str(ARITY[predicate]) in str(error.value)


def test_a_goal_reads_like_a_predicate():
    assert str(goal("on", "cup_1", "desk_1")) == "on(cup_1, desk_1)"


def test_placing_makes_the_goals_of_the_new_place_true_and_of_the_old_one_false():
    before, now = after(), after(*CUP_ON_DESK)
    for true_before, true_now in (
        (goal("on", "cup_1", "table_1"), goal("on", "cup_1", "desk_1")),
        (goal("in", "cup_1", "room_1"), goal("in", "cup_1", "room_4")),
        (goal("near", "cup_1", "bottle_1"), goal("near", "cup_1", "laptop_1")),
    ):
        assert (holds(true_before, before), holds(true_before, now)) == (True, False)
        assert (holds(true_now, before), holds(true_now, now)) == (False, True)


def test_what_is_held_is_nowhere_else():
    held = after(*CUP_ON_DESK[:2])
    assert holds(goal("holding", "cup_1"), held)
    assert not holds(goal("on", "cup_1", "table_1"), held)
    assert not holds(goal("in", "cup_1", "room_1"), held)


def test_giving_is_not_putting_near():
    state = after(*CUP_ON_DESK[:2], ("GOTO", "person_1"), ("PLACE", "cup_1", "person_1"))
    assert holds(goal("given", "cup_1", "person_1"), state)
    assert not holds(goal("given", "cup_1", "person_2"), state)


def test_something_is_found_only_by_going_to_it():
    assert not holds(goal("found", "cup_1"), after())
    assert holds(goal("found", "cup_1"), after(("GOTO", "cup_1")))


def test_being_in_a_room_counts_as_being_at_the_room():
    state = after(("GOTO", "cup_1"))
    assert holds(goal("robot_at", "room_1"), state)
    assert not holds(goal("robot_at", "room_2"), state)


def test_the_believed_world_agrees_with_the_graph():
    assert holds_in(goal("on", "cup_1", "table_1"), SNAPSHOT)
    assert holds_in(goal("in", "cup_1", "room_1"), SNAPSHOT)
    assert holds_in(goal("robot_at", "room_2"), SNAPSHOT)
    assert holds_in(goal("near", "cup_1", "bottle_1"), SNAPSHOT)
    assert not holds_in(goal("near", "cup_1", "laptop_1"), SNAPSHOT)
    assert not holds_in(goal("given", "cup_1", "person_1"), SNAPSHOT)
    assert not holds_in(goal("on", "nothing_1", "table_1"), SNAPSHOT)


def test_something_given_lies_close_to_the_person_and_out_of_the_hand():
    memory = flat().memory(robot_in="room_3", at=(8.0, 0.0))
    with memory.edit("test", 101.0) as tx:
        tx.remove(EdgeKey(EdgeType.RT, "room_1", "cup_1"))
        tx.remove(EdgeKey(EdgeType.IN, "cup_1", "room_1"))
        tx.put(RtEdge(source="room_3", target="cup_1", T_source_target=SE3.from_xyz_yaw(0.5, -1.0, 0.7, 0.0)))
        tx.put(InEdge(source="cup_1", target="room_3"))
    assert holds_in(goal("given", "cup_1", "person_1"), memory.snapshot())
    assert not holds_in(goal("given", "cup_1", "person_2"), memory.snapshot())


def test_a_missing_object_satisfies_nothing():
    sketch = flat().thing("cup_9", "cup", on="desk_1", state=ObjectState.MISSING)
    snapshot = sketch.snapshot(robot_in="room_4", at=(4.2, 4.2))
    for wish in (goal("on", "cup_9", "desk_1"), goal("found", "cup_9"), goal("in", "cup_9", "room_4")):
        assert not holds_in(wish, snapshot)


def test_found_asks_for_an_observation_that_is_new_enough():
    assert not holds_in(goal("found", "cup_1"), SNAPSHOT)
    assert holds_in(goal("found", "cup_1"), SNAPSHOT, since_s=80.0)


def test_what_is_held_is_held_in_the_believed_world():
    held = flat().snapshot(robot_in="room_1", at=(0.0, 0.0), holding="cup_1")
    assert holds_in(goal("holding", "cup_1"), held)
    assert not holds_in(goal("on", "cup_1", "table_1"), held)


def test_a_relation_that_is_less_probable_than_another_does_not_count():
    memory = flat().memory(robot_in="room_1", at=(0.0, 0.0))
    with memory.edit("test", 101.0) as tx:
        tx.put(RelationEdge(source="cup_1", target="counter_1", predicate="on", probability=0.3))
    assert holds_in(goal("on", "cup_1", "table_1"), memory.snapshot())
    assert not holds_in(goal("on", "cup_1", "counter_1"), memory.snapshot())


@given(st.lists(any_goal, max_size=6))
def test_the_last_goal_always_lasts(goals):
    if goals:
        assert not superseded(goals, len(goals) - 1)
        assert goals[-1] in lasting(goals)


@given(st.lists(any_goal, max_size=6))
def test_lasting_goals_keep_their_order(goals):
    remaining = iter(goals)
    assert all(kept in remaining for kept in lasting(goals))


def test_a_new_place_supersedes_the_old_one_for_the_same_object_only():
    goals = [goal("on", "cup_1", "desk_1"), goal("on", "cup_2", "desk_1"), goal("in", "cup_1", "room_1")]
    assert lasting(goals) == tuple(goals[1:])
