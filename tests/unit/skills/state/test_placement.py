"""Placements against plain dictionaries, and how little of a large graph is read for a plan."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from hospital import hospital
from planner.goals import goal
from planner.plan import Plan
from planner.skill_planner.verifier import Verifier
from scene_graph.nodes import ObjectNode
from skills.registry import load_registry
from skills.state.placement import Placement, PlaceRelation

things = st.sampled_from(["cup_1", "cup_2", "tray_1"])
places = st.one_of(
    st.none(), st.tuples(st.sampled_from(list(PlaceRelation)), st.sampled_from(["table_1", "tray_1", "room_1"]))
)
held = st.dictionaries(things, places.filter(lambda place: place is not None))


@given(held, st.lists(st.tuples(things, places)), st.lists(st.tuples(things, places)))
def test_a_placement_is_the_dictionary_it_stands_for(base, moves, others):
    def at(place):
        return tuple(thing for thing, (_, where) in base.items() if where == place)

    def moved(moves):
        expected, placement = dict(base), Placement(base, at, {})
        for thing, place in moves:
            placement = placement.with_moved(thing, place)
            expected = {**expected, thing: place}
        return {thing: place for thing, place in expected.items() if place is not None}, placement

    expected, placement = moved(moves)
    assert placement == expected
    for place in ("table_1", "tray_1", "room_1"):
        assert sorted(placement.at(place)) == sorted(thing for thing, (_, at) in expected.items() if at == place)
    other, other_placement = moved(others)
    assert (placement.key == other_placement.key) == (expected == other)
    assert placement.like(other).key == other_placement.key


def test_of_a_large_building_only_what_a_plan_is_about_is_read():
    snapshot = hospital(1500)
    verifier = Verifier(load_registry([]))
    cup = next(node.id for node in snapshot.of_type(ObjectNode) if node.label == "cup")
    table = [node.id for node in snapshot.of_type(ObjectNode) if node.label == "table"][-1]
    assert isinstance(verifier.plan_for([goal("on", cup, table)], snapshot), Plan)
    things = verifier.state(snapshot).world.things
    doors = 2 * len(verifier.state(snapshot).world.doors)
    assert len(things._read) <= doors + 40
    assert set(things) == {node_id for node_id in snapshot.nodes if node_id in things}
