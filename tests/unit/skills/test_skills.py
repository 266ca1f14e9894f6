"""Conditions and effects of GOTO, PICK and PLACE, and what confirms them."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scene_graph.nodes import DoorState, ObjectState
from skills.errors import DuplicateSkill, NotASkill, SkillNotFound, WrongArguments
from skills.facts import read_state
from skills.failures import FailureCode
from skills.goto.goto import Goto
from skills.pick.pick import Pick
from skills.place.place import Place
from skills.registry import load_registry
from skills.state.state import PlaceRelation, PlanState, Thing, World

SKILLS = (Goto(), Pick(), Place())


@pytest.fixture
def state(flat):
    built = flat().table().bottle().bottle("bottle_2", 1.3, 1.2).table("table_2", 0.5, 0.0, room="room_2")
    built.person(-2.0, 1.0).thing("bowl_1", (0.7, 1.3, 0.8), (0.2, 0.2, 0.1), on="table_1", support=True)
    return read_state(built.memory.snapshot())


def message(skill, state, *args):
    (unmet,) = skill.conditions(state, args)
    return unmet.message


def test_fetching_something_is_goto_pick_goto_place(state):
    for skill, args in (
        (Goto(), ("bottle_1",)),
        (Pick(), ("bottle_1",)),
        (Goto(), ("table_2",)),
        (Place(), ("bottle_1", "table_2")),
    ):
        assert skill.conditions(state, args) == []
        state = skill.effects(state, args)
    assert state.places["bottle_1"] == (PlaceRelation.ON, "table_2")
    assert state.holding is None
    assert state.robot_room == "room_2"


def test_every_refusal_names_the_fix(state):
    assert message(Pick(), state, "bottle_1") == "the robot is not at bottle_1: GOTO bottle_1 first."
    assert message(Place(), state, "bottle_1", "table_1") == "the robot does not hold bottle_1: PICK it first."
    assert message(Goto(), state, "cup_9") == "cup_9 is not in the scene graph: name a node that is."
    holding = state.after(holding="bottle_2", places={"bottle_1": state.places["bottle_1"]}, robot_at="bottle_1")
    assert message(Pick(), holding, "bottle_1") == "the robot holds bottle_2: PLACE it somewhere first."
    assert message(Place(), holding, "bottle_2", "table_2") == "the robot is not at table_2: GOTO table_2 first."
    assert message(Goto(), holding, "bottle_2") == "bottle_2 is in the gripper: no need to go to it."
    gone = state.after(missing=frozenset({"bottle_1"}))
    assert "look for it first" in message(Goto(), gone, "bottle_1")
    stacked = state.after(robot_at="bottle_1", places={**state.places, "bottle_2": (PlaceRelation.ON, "bottle_1")})
    assert message(Pick(), stacked, "bottle_1") == "bottle_2 stands on bottle_1: move it away first."


def test_furniture_cannot_be_picked_even_when_the_robot_is_there(state):
    messages = [unmet.message for unmet in Pick().conditions(state.after(robot_at="table_1"), ("table_1",))]
    assert messages == ["table_1 cannot be grasped: choose something small."]


def test_a_thing_too_wide_for_the_fingers_is_refused_with_its_width(state):
    wide = replace(state.world.things["bottle_1"], width_m=0.2)
    world = World(things={**state.world.things, "bottle_1": wide}, doors=state.world.doors)
    assert "0.20 m wide" in message(Pick(), state.after(world=world, robot_at="bottle_1"), "bottle_1")


def test_a_thing_that_looks_a_little_too_wide_from_afar_is_not_refused(state):
    wide = replace(state.world.things["bottle_1"], width_m=0.12)
    world = World(things={**state.world.things, "bottle_1": wide}, doors=state.world.doors)
    assert Pick().conditions(state.after(world=world, robot_at="bottle_1"), ["bottle_1"]) == []


def test_a_closed_door_is_named(flat):
    built = flat(door_state=DoorState.CLOSED).table("table_2", 0.5, 0.0, room="room_2")
    state = read_state(built.memory.snapshot())
    (unmet,) = Goto().conditions(state, ("table_2",))
    assert "open door_1_1_0" in unmet.message
    assert unmet.nodes == ("door_1_1_0",)


def test_place_relation_follows_the_kind_of_target(state):
    held = state.after(holding="bottle_1", places={})
    for target, relation in (("bowl_1", "in"), ("person_1", "given"), ("room_1", "in"), ("table_1", "on")):
        assert Place().effects(held, ("bottle_1", target)).places["bottle_1"] == (PlaceRelation(relation), target)


def test_wrong_number_of_arguments_is_an_error_of_the_caller(state):
    with pytest.raises(WrongArguments, match=r"PLACE takes \(object, target\), not \(bottle_1\)"):
        Place().conditions(state, ("bottle_1",))


@settings(max_examples=60)
@given(data=st.data())
def test_no_sequence_of_permitted_steps_breaks_the_facts(data):
    state = initial()
    fixed = [node for node, thing in state.world.things.items()]
    for _ in range(12):
        skill = data.draw(st.sampled_from(SKILLS))
        args = tuple(data.draw(st.sampled_from(fixed)) for _ in skill.parameters)
        if skill.conditions(state, args):
            continue
        after = skill.effects(state, args)
        carried = {node for node, thing in state.world.things.items() if thing.graspable}
        assert set(after.places) == carried - {after.holding}
        assert after.robot_room == after.room_of(after.robot_at)
        if skill.name == "GOTO":
            assert after.robot_at == args[0]
        if skill.name == "PICK":
            assert after.holding == args[0]
            assert state.holding is None
        if skill.name == "PLACE":
            assert after.places[args[0]][1] == args[1]
            assert after.room_of(args[0]) == after.robot_room
        assert skill.cost_s(state, args) > 0
        state = after


def initial() -> PlanState:
    def thing(node_id, kind="object", room="r1", at=(0.0, 0.0), **fields):
        return Thing(id=node_id, kind=kind, label=node_id[:-1], room=room, position_m=at, **fields)

    things = [
        thing("r1", "room"),
        thing("r2", "room", "r2", (5.0, 0.0)),
        thing("d1", "door", "r1", (2.5, 0.0)),
        thing("person1", "person", "r2", (5.0, 1.0)),
        thing("table1", support=True),
        thing("table2", room="r2", at=(6.0, 0.0), support=True),
        thing("bottle1", graspable=True, width_m=0.07),
        thing("cup1", graspable=True, width_m=0.08),
    ]
    from skills.state.state import DoorLink

    world = World(things={t.id: t for t in things}, doors=(DoorLink(door="d1", rooms=("r1", "r2")),))
    places = {"bottle1": (PlaceRelation.ON, "table1"), "cup1": (PlaceRelation.ON, "bottle1")}
    return PlanState(world=world, robot_at="r1", robot_room="r1", holding=None, places=places)


def test_nearer_targets_cost_less(state):
    assert Goto().cost_s(state, ("table_1",)) < Goto().cost_s(state, ("table_2",))


def test_place_is_confirmed_only_by_a_fresh_observation_on_the_target(flat):
    memory = flat().table().bottle().memory
    with memory.edit("test", 5.0) as tx:
        tx.put(replace(memory.snapshot().object("bottle_1"), last_seen_s=5.0))
    snapshot = memory.snapshot()
    assert Place().confirmed(snapshot, ("bottle_1", "table_1"), 4.0) is None
    stale = Place().confirmed(snapshot, ("bottle_1", "table_1"), 6.0)
    assert stale.code is FailureCode.NOT_CONFIRMED
    assert "last seen at 5.0 s" in stale.evidence.observation
    assert Place().confirmed(snapshot, ("bottle_1", "room_1"), 4.0) is None
    assert Place().confirmed(snapshot, ("bottle_1", "room_2"), 4.0).code is FailureCode.NOT_CONFIRMED


def test_a_missing_object_confirms_nothing(flat):
    memory = flat().table().bottle().memory
    with memory.edit("test", 5.0) as tx:
        bottle = memory.snapshot().object("bottle_1")
        tx.put(replace(bottle, last_seen_s=5.0, state=ObjectState.MISSING))
    assert Place().confirmed(memory.snapshot(), ("bottle_1", "table_1"), 0.0).evidence.observation == "state missing"
    assert Pick().confirmed(memory.snapshot(), ("bottle_1",), 0.0).code is FailureCode.NOT_CONFIRMED


def test_goto_is_confirmed_by_the_pose(flat):
    snapshot = flat().table("table_1", 1.2, 0.0).table("table_2", 0.0, 0.0, "room_2").memory.snapshot()
    assert Goto().confirmed(snapshot, ("table_1",), 0.0) is None
    assert Goto().confirmed(snapshot, ("room_1",), 0.0) is None
    assert Goto().confirmed(snapshot, ("table_2",), 0.0).evidence.observation == "in another room"


def test_registry_knows_the_three_and_refuses_a_second_of_a_name():
    registry = load_registry([])
    assert list(registry) == ["GOTO", "PICK", "PLACE"]
    assert "GOTO(target)" in registry.described()["GOTO"]
    with pytest.raises(DuplicateSkill, match=r"'PICK' from robots\.pick is refused: majordomo already provides one"):
        load_registry([("robots.pick", Pick)])
    with pytest.raises(NotASkill, match=r"robots:thing is not a skill: it lacks name"):
        load_registry([("robots:thing", object())])
    with pytest.raises(SkillNotFound, match=r"no skill named 'OPEN'; there are GOTO, PICK, PLACE"):
        registry["OPEN"]


def test_registry_takes_skills_of_installed_packages():
    class Wave(Goto):
        """WAVE(target): wave."""

        name = "WAVE"

    assert "WAVE" in load_registry([("robots:Wave", Wave)])


def test_schema_asks_for_every_parameter_and_nothing_else():
    for skill in SKILLS:
        schema = skill.schema()
        assert schema["required"] == [parameter.name for parameter in skill.parameters]
        assert not schema["additionalProperties"]
