"""Laws of the arbiter: one grant at most, none while stopped, requests first, the interrupted resumes."""

from __future__ import annotations

import asyncio
from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from planner.doubles.rehearsal import Stage, rehearsal_graph
from planner.executor.arbiter import Arbiter, choose
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.edits import PutEdge, RemoveEdge
from scene_graph.memory import WorkingMemory

TARGETS = ("room_1", "room_2", "table_1", "desk_1", "door_1_0_0", "robot")
GRANTED, PROPOSED, REVOKED = IntentionStatus.GRANTED, IntentionStatus.PROPOSED, IntentionStatus.REVOKED


def intention(target="table_1", *, agent="objects", priority=Priority.LOOK_AROUND, **fields):
    action = IntentionAction.TASK if target == "robot" else fields.pop("action", IntentionAction.LOOK)
    return HasIntentionEdge(source="robot", target=target, agent=agent, action=action, priority=priority, **fields)


class House:
    """A graph, its arbiter and a stop switch."""

    def __init__(self) -> None:
        self.memory = WorkingMemory(rehearsal_graph())
        self.stopped = False
        self.arbiter = Arbiter(self.memory, stopped=lambda: self.stopped)

    def put(self, *edges):
        self.memory.commit([PutEdge(edge) for edge in edges], agent="test", stamp_s=0.0)

    def step(self):
        asyncio.run(self.arbiter.step(0.0))
        return self.granted

    @property
    def granted(self):
        return self.memory.snapshot().intentions(GRANTED)

    def status(self, edge):
        return self.memory.snapshot().edge(edge.key).status


intentions = st.builds(
    lambda target, agent, priority, status, proposed_s: intention(
        target, agent=agent, priority=priority, status=status, proposed_s=proposed_s
    ),
    st.sampled_from(TARGETS),
    st.sampled_from(("a", "b", "c")),
    st.sampled_from(Priority),
    st.sampled_from(IntentionStatus),
    st.sampled_from((0.0, 1.0)),
)


@given(st.lists(intentions, max_size=8), st.booleans(), st.booleans())
def test_never_are_two_granted_and_never_one_while_stopped_or_an_exploration_when_that_is_off(edges, stopped, enabled):
    house = House()
    house.put(*edges)
    house.stopped, house.arbiter.exploration_enabled = stopped, enabled
    granted = house.step()
    assert len(granted) <= 1
    assert not (stopped and granted)
    assert enabled or all(edge.priority >= Priority.REQUEST for edge in granted)


@given(st.lists(intentions, max_size=8))
def test_what_is_granted_has_the_highest_priority_of_all_that_is_open(edges):
    house = House()
    house.put(*edges)
    open_ = [e for e in house.memory.snapshot().intentions() if e.status in (GRANTED, PROPOSED, REVOKED)]
    granted = house.step()
    assert bool(granted) == bool(open_)
    assert all(granted[0].priority >= edge.priority for edge in open_ if granted)


@given(st.lists(intentions, max_size=8))
def test_a_second_turn_changes_nothing(edges):
    house = House()
    house.put(*edges)
    house.step()
    revision = house.memory.snapshot().revision
    house.step()
    assert house.memory.snapshot().revision == revision


@given(st.lists(intentions, max_size=6), st.randoms())
def test_the_order_in_which_agents_propose_does_not_matter(edges, random):
    unique = list({edge.key: edge for edge in edges}.values())
    one, other = House(), House()
    one.put(*unique)
    random.shuffle(unique)
    other.put(*unique)
    chosen = [choose(house.memory.snapshot()) for house in (one, other)]
    grants = sum(edge.status is GRANTED for edge in unique)
    assert grants > 1 or chosen[0] == chosen[1]


@given(st.lists(intentions, max_size=8))
def test_ended_intentions_stay_as_the_executor_left_them(edges):
    house = House()
    house.put(*edges)
    ended = (IntentionStatus.DONE, IntentionStatus.FAILED)
    before = [edge for edge in house.memory.snapshot().intentions() if edge.status in ended]
    house.step()
    assert all(house.memory.snapshot().edge(edge.key) == edge for edge in before)


def test_a_request_interrupts_exploration_and_exploration_resumes():
    house = House()
    look, task = intention(), intention("robot", agent="task:task_1", priority=Priority.REQUEST)
    house.put(look)
    assert [edge.key for edge in house.step()] == [look.key]
    house.put(task)
    assert [edge.key for edge in house.step()] == [task.key]
    assert house.status(look) is REVOKED
    house.memory.commit([RemoveEdge(task.key)], agent="mission", stamp_s=0.0)
    assert [edge.key for edge in house.step()] == [look.key]


def test_after_the_stop_is_lifted_the_same_intention_goes_on():
    house = House()
    house.put(intention("robot", agent="task:task_1", priority=Priority.REQUEST), intention())
    before = house.step()
    house.stopped = True
    assert house.step() == ()
    house.stopped = False
    assert house.step() == before


def test_at_equal_priority_the_robots_room_comes_first_however_old_the_other_is():
    house = House()
    house.put(intention("desk_1", proposed_s=0.0), intention("shelf_1", proposed_s=9.0))
    assert [edge.target for edge in house.step()] == ["shelf_1"]


def test_in_one_room_the_nearer_comes_first_and_at_equal_distance_the_older():
    house = House()
    house.put(intention("table_1", agent="a"), intention("shelf_1", agent="a"))
    assert [edge.target for edge in house.step()] == ["shelf_1"]
    house = House()
    house.put(intention(agent="young", proposed_s=2.0), intention(agent="old", proposed_s=1.0))
    assert [edge.agent for edge in house.step()] == ["old"]


def test_nothing_but_the_stop_interrupts_a_crossing_in_the_doorway():
    house = House()
    cross = intention("door_1_0_0", agent="door_concept", priority=Priority.CROSS_DOOR, action=IntentionAction.CROSS)
    Stage(memory=house.memory).stand_at("room_1", 0.0)
    house.put(cross)
    house.step()
    task = intention("robot", agent="task:task_1", priority=Priority.REQUEST)
    far = replace(cross, status=GRANTED)
    house.put(task)
    assert choose(house.memory.snapshot()).key == task.key
    robot = house.memory.snapshot().parent("robot")
    near = replace(robot, T_source_target=house.memory.snapshot().transform("room_1", "door_1_0_0"))
    house.put(near, far)
    assert choose(house.memory.snapshot()).key == cross.key
    house.stopped = True
    assert house.step() == ()


def test_a_robot_that_does_not_know_where_it_is_looks_around_and_does_nothing_else():
    house = House()
    request = intention("robot", agent="task:1", priority=Priority.REQUEST)
    visit = intention("room_2", agent="room_concept", action=IntentionAction.VISIT)
    house.put(request, visit)
    assert house.step() == (replace(request, status=GRANTED),)
    with house.memory.edit("test", 0.0) as tx:
        tx.put(replace(tx.snapshot.robot, localized=False))
    assert house.step() == ()
    look = replace(intention("robot", agent="relocalization"), action=IntentionAction.LOOK)
    house.put(look)
    assert house.step() == (replace(look, status=GRANTED),)
    with house.memory.edit("test", 0.0) as tx:
        tx.put(replace(tx.snapshot.robot, localized=True))
        tx.remove(look.key)
    assert house.step() == (replace(request, status=GRANTED),)
