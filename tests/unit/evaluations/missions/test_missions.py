"""Missions: what they are to come to, who interferes how, what files may say, and how the outcome is judged."""

from __future__ import annotations

import io
import math
from dataclasses import replace
from itertools import combinations

import matplotlib.image
import numpy as np
import pytest
from rich.console import Console

from evaluations.missions.attempts import Attempts
from evaluations.missions.clutter import boxes_over
from evaluations.missions.disturbances import DISTURBANCES, Moment
from evaluations.missions.episodes import OUT_OF_REACH, Verdict, impossible_as_told, is_within_reach, touched_last
from evaluations.missions.evaluation import evaluate, met, summarize
from evaluations.missions.filmstrip import MOST, Still, draw_filmstrip
from evaluations.missions.mission import Mission
from evaluations.missions.mission_file import MissionFileError, load_missions
from evaluations.missions.outcome import HAND, Outcome, Placed, RobotIn, Scene, stirred
from evaluations.missions.request_generator import invent
from evaluations.missions.simulated_user import meant
from evaluations.missions.ways import Ways
from evaluations.perception.inventory import GraphContents, GraphThing
from perception.network.shipped import SHIPPED
from planner.tasks.tasks import PlanReport, StepReport, StepStatus, Task, TaskStatus, TaskTimes
from simulation.furnishing.catalog import category_named
from simulation.houses.house import Door, Furniture, Object, Person, Room
from simulation.houses.house_file import load_house, parse_disturbance
from simulation.world.blocks import Block, overlapping
from skills.failures import Evidence, Failure, FailureCode

FLAT = load_house("flat")
CUP = {"id": "cup_1", "category": "cup", "color": "red", "position_m": [1.0, 1.0, 0.8], "room": "kitchen", "in": None}
CUP_ON_TABLE = {**CUP, "on": "table_1"}


def scene(*objects, holding=None, pose=None, shut=()):
    doors = [{"id": door.id, "state": "closed" if door.id in shut else "open"} for door in FLAT.doors]
    people = [{"id": person.id, "position_m": list(person.pose[:2])} for person in FLAT.people]
    robot = {"pose": list(pose or FLAT.robot.pose), "holding": holding}
    truth = {"objects": list(objects), "robot": robot, "people": people, "doors": doors, "collisions": 0}
    return Scene(house=FLAT, truth=truth)


def task(status=TaskStatus.SUCCEEDED, reply=""):
    return Task(id="task_1", request="", times=TaskTimes(received_s=0.0), status=status, reply=reply)


@pytest.mark.parametrize(
    ("place", "there"), [("table_1", True), ("kitchen", True), ("desk_1", False), ("office", False), (HAND, False)]
)
def test_a_thing_is_where_the_truth_has_it(place, there):
    assert scene(CUP_ON_TABLE).is_at("cup_1", place) is there


def test_what_is_in_the_hand_is_nowhere_else_and_what_is_on_a_tray_is_on_the_table_too():
    assert scene(CUP_ON_TABLE, holding="cup_1").is_at("cup_1", HAND)
    assert not scene(CUP_ON_TABLE, holding="cup_1").is_at("cup_1", "kitchen")
    tray = {**CUP_ON_TABLE, "id": "tray_1"}
    assert scene({**CUP, "on": "tray_1"}, tray).is_at("cup_1", "table_1")


def test_a_thing_is_with_a_person_when_they_can_reach_it():
    x_m, y_m, _ = FLAT.people[0].pose
    person = FLAT.people[0].id
    assert scene({**CUP, "on": None, "position_m": [x_m + 1.5, y_m, 0.0]}).is_at("cup_1", person)
    assert not scene({**CUP, "on": None, "position_m": [x_m + 2.5, y_m, 0.0]}).is_at("cup_1", person)


def test_an_outcome_needs_state_and_words_and_a_refusal_needs_an_honest_end():
    placed = Outcome(states=(Placed(things=("cup_1",), places=("table_1",)),))
    assert placed.met(scene(CUP_ON_TABLE), task())
    assert not placed.met(scene({**CUP, "on": "desk_1"}), task())
    assert Outcome(words=("kitchen",)).met(scene(), task(reply="It is in the Kitchen."))
    assert not Outcome(words=("kitchen",)).met(scene(), task(reply="It is in the hall."))
    assert Outcome(refused=True).met(scene(), task(TaskStatus.REFUSED))
    assert not Outcome(refused=True).met(scene(), task())
    room = scene().robot_room
    assert RobotIn(rooms=(room,)).met(scene())
    assert not RobotIn(rooms=("nowhere",)).met(scene())


def test_things_that_nobody_asked_for_and_that_moved_are_counted():
    there = {**CUP_ON_TABLE, "position_m": [2.0, 1.0, 0.8]}
    assert stirred(scene(CUP_ON_TABLE), scene(there), frozenset()) == ("cup_1",)
    assert stirred(scene(CUP_ON_TABLE), scene(there), frozenset({"cup_1"})) == ()
    assert stirred(scene(CUP_ON_TABLE), scene(there), frozenset({"table_1"})) == ()
    assert stirred(scene(CUP_ON_TABLE), scene(CUP_ON_TABLE), frozenset()) == ()


def test_the_shortest_way_is_no_shorter_than_the_line_and_a_shut_door_lengthens_or_ends_it():
    ways = Ways(scene())
    start, goal = ways.middle_of("kitchen"), ways.middle_of("office")
    length_m = ways.length_m(start, goal)
    assert math.dist(start, goal) - 0.8 <= length_m < 4.0 * math.dist(start, goal)
    doors = [door.id for door in ways.doors_between(start, goal)]
    assert doors
    assert Ways(scene(), shut=doors[:1]).length_m(start, goal) > length_m
    assert Ways(scene(shut=[door.id for door in FLAT.doors])).length_m(start, goal) == math.inf
    assert ways.is_free(start)


def test_a_way_into_a_room_ends_behind_its_door_and_lengthens_what_goes_before():
    ways = Ways(scene())
    start, goal = ways.middle_of("kitchen"), ways.middle_of("office")
    into_m = ways.length_m(start, "office")
    assert ways.length_m(start, "hall") < into_m < ways.length_m(start, goal) + 0.8
    assert ways.length_m(start, "kitchen") == 0.0
    there_and_back_m = ways.length_m(start, goal, "kitchen")
    assert there_and_back_m > ways.length_m(start, goal) + into_m - 2.0
    assert Ways(scene(shut=[door.id for door in FLAT.doors])).length_m(start, "office") == math.inf
    assert ways.length_m(start, (-50.0, 0.0)) == math.inf
    assert not ways.is_free((-50.0, 0.0))


def test_a_room_behind_shut_doors_is_out_of_reach_for_the_robot_as_for_what_it_brings():
    there, here = scene(CUP_ON_TABLE), scene(CUP_ON_TABLE, shut=[door.id for door in FLAT.doors])
    away = next(room.id for room in FLAT.rooms if room.id != here.robot_room)
    sent = [Mission(house="flat", kind="go", request="", outcomes=(Outcome(states=(state,)),)) for state in (
        RobotIn(rooms=(away,)), RobotIn(rooms=(here.robot_room,)), RobotIn(rooms=(away, here.robot_room)),
        Placed(things=(), places=(away,)), Placed(things=(), places=(HAND,)),
    )]  # fmt: skip
    assert [is_within_reach(mission, there, Ways(there)) for mission in sent] == [True] * 5
    assert [is_within_reach(mission, here, Ways(here)) for mission in sent] == [False, True, True, False, True]


@pytest.mark.parametrize(
    ("codes", "near", "right"),
    [
        (["unreachable", "object_gone"], True, True),
        (["unreachable", "object_gone"], False, True),
        (["object_gone", "unreachable"], False, True),
        (["object_gone", "unreachable"], True, False),
        (["support_full"], False, False),
        ([], True, False),
    ],
)
def test_what_was_removed_from_out_of_reach_may_be_called_either(codes, near, right):
    evidence = Evidence(revision=1)
    failures = tuple(Failure(code=FailureCode(code), message="", evidence=evidence) for code in codes)
    reasons = DISTURBANCES["removed"].reasons | (frozenset() if near else OUT_OF_REACH)
    told = impossible_as_told(replace(task(TaskStatus.FAILED), failures=failures), reasons, within_reach=near)
    assert told is (Verdict.RIGHTLY_IMPOSSIBLE if right else Verdict.OTHER_REASON)


@pytest.mark.parametrize(("near", "verdict"), [(True, Verdict.OTHER_REASON), (False, Verdict.RIGHTLY_IMPOSSIBLE)])
def test_what_is_out_of_reach_need_not_be_known(near, verdict):
    assert impossible_as_told(task(TaskStatus.REFUSED), OUT_OF_REACH, within_reach=near) is verdict


def test_nobody_reaches_through_a_wall():
    rooms = [
        Room(id=name, polygon=((x_m, 0.0), (x_m + 4.0, 0.0), (x_m + 4.0, 3.0), (x_m, 3.0)))
        for name, x_m in (("west", 0.0), ("east", 4.2))
    ]
    door = Door(id="door_1", rooms=("west", "east"), center=(4.1, 2.0), width=0.9)
    house = FLAT.model_copy(update={"rooms": tuple(rooms), "doors": (door,), "furniture": (), "objects": ()})
    truth = {"doors": [{"id": "door_1", "state": "open"}], "objects": [], "robot": {"holding": None}}
    ways = Ways(Scene(house=house, truth=truth))
    west, by_the_wall = (3.6, 0.5), (4.3, 0.5)
    assert math.dist(west, by_the_wall) < 0.8
    assert [each.id for each in ways.doors_between(west, by_the_wall)] == ["door_1"]
    assert ways.length_m(west, by_the_wall) > 2.0
    box = {"id": "box_1", "category": "box", "position_m": [4.1, 2.0, 0.1], "on": None, "in": None}
    in_the_door = Scene(house=house, truth={**truth, "objects": [box]})
    assert Ways(in_the_door).length_m(west, by_the_wall) == math.inf
    assert Ways(in_the_door, spared=["box_1"]).length_m(west, by_the_wall) < math.inf
    people = [{"id": "person_1", "position_m": (4.1, 2.0, 0.9)}]
    stays = house.model_copy(update={"people": (Person(id="person_1", pose=(4.1, 2.0, 0.0)),)})
    leaves = stays.model_copy(update={"people": (Person(id="person_1", pose=(1.0, 2.0, 0.0)),)})
    assert Ways(Scene(house=stays, truth={**truth, "people": people})).length_m(west, by_the_wall) == math.inf
    assert Ways(Scene(house=leaves, truth={**truth, "people": people})).length_m(west, by_the_wall) < math.inf
    on_the_bed = Scene(house=house, truth={**truth, "objects": [{**box, "on": "bed_1"}]})
    assert Ways(on_the_bed).length_m(west, by_the_wall) < math.inf


def test_invented_requests_are_the_same_for_a_seed_and_ask_for_every_thing_once():
    missions = invent("flat", FLAT, count=20, seed=3)
    assert missions == invent("flat", FLAT, count=20, seed=3)
    assert missions != invent("flat", FLAT, count=20, seed=4)
    asked = [thing for mission in missions for thing in mission.things]
    assert len(asked) == len(set(asked)) >= 4
    for mission in missions:
        assert not any(outcome.met(scene(*FLAT_THINGS), task()) for outcome in mission.outcomes if outcome.things)


def test_a_house_in_which_words_fit_nothing_alone_is_named_as_left_out(tmp_path):
    things = FLAT.model_copy(update={"rooms": tuple(r.model_copy(update={"label": "hall"}) for r in FLAT.rooms)})
    assert invent("halls", things, count=5, seed=0) == []
    (tmp_path / "halls.json").write_text(things.model_dump_json(by_alias=True))
    console = Console(file=io.StringIO(), width=200)
    all_met = evaluate(
        houses=[str(tmp_path / "halls.json")], commands=None, requests=5, disturb=(), seeds=(0,), model=SHIPPED, jobs=1,
        json_file=None, console=console,
    )  # fmt: skip
    assert not all_met
    assert "halls.json: left out" in console.file.getvalue()


@pytest.mark.parametrize(("x_m", "asked"), [(0.0, True), (0.85, False)])
def test_what_was_put_into_the_arm_of_a_sofa_is_not_asked_for_as_it_slips_off(x_m, asked):
    room = next(room for room in FLAT.rooms if room.label == "office")
    x, y = np.array(room.polygon).mean(axis=0).tolist()
    sofa = Furniture(id="sofa_9", category="sofa", size=(1.84, 0.87, 0.85), pose=(x, y, 0.0))
    bottle = Object(id="bottle_9", category="bottle", on="sofa_9", offset=(x_m, -0.1))
    house = FLAT.model_copy(update={"furniture": (sofa,), "objects": (bottle,), "people": ()})
    missions = [mission for seed in range(6) for mission in invent("flat", house, count=9, seed=seed)]
    assert any("bottle" in mission.request for mission in missions) is asked


def contents(rooms=None, **at):
    things = tuple(
        GraphThing(id=name, label="cup", position_m=np.array(place), size_m=(0.1, 0.1, 0.1))
        for name, place in at.items()
    )
    return GraphContents(things=things, relations=(), rooms=rooms or {}, labels={})


def test_who_is_asked_back_says_which_thing_or_room_is_meant_and_nothing_where_it_is_not_offered():
    known = contents({"office": "room_3"}, cup_7=(3.0, 1.0, 0.8), cup_8=(1.1, 1.0, 0.8), cup_9=(1.3, 1.0, 0.8))
    here = scene(CUP_ON_TABLE)
    cup = Mission(
        house="flat", kind="", request="", outcomes=(Outcome(states=(Placed(things=("cup_1",), places=("office",)),)),)
    )
    assert meant(("cup_7", "cup_9", "cup_8"), cup, here, known) == 2
    assert meant(("cup_7",), cup, here, known) is None
    assert meant(("room_1", "room_3"), cup, here, known) == 1
    assert meant(("cup_7", "cup_2"), cup, scene(CUP_ON_TABLE, holding="cup_1"), known, held="cup_2") == 1


def test_a_thing_is_called_by_its_kind_or_a_plain_color_or_its_place_never_by_words_that_fit_two():
    bottle = {"category": "bottle", "on": "table_1"}
    things = [
        Object(id="bottle_1", color="blue", **bottle), Object(id="bottle_2", color="dark cream", **bottle),
        Object(id="bottle_3", color="blue", category="bottle", on="desk_1"),
        Object(id="cup_1", color="red", category="cup", on="table_1"),
        Object(id="cup_2", color="white", category="cup", on="table_1"),
        Object(id="book_1", color="light teal", category="book", on="table_1"),
    ]  # fmt: skip
    house = FLAT.model_copy(update={"objects": tuple(things)})
    requests = [mission.request for seed in range(8) for mission in invent("flat", house, count=20, seed=seed)]
    said = " | ".join(requests)
    for words in ("the bottle from the desk in the office", "the red cup", "the white cup", "the book"):
        assert words in said
    for words in ("cream", "the blue bottle", "the bottle from the table"):
        assert words not in said


def test_where_a_thing_of_its_kind_is_asked_for_by_its_place_no_other_is_brought_before():
    furniture = {item.id for item in FLAT.furniture if item.id in ("desk_1", "table_1", "table_2", "shelf_1")}
    cups = [Object(id=f"cup_{k}", category="cup", on=on) for k, on in enumerate(sorted(furniture))]
    house = FLAT.model_copy(update={"objects": tuple(cups)})
    stands_on = {cup.id: cup.on for cup in cups}
    asked = [mission for seed in range(8) for mission in invent("flat", house, count=20, seed=seed) if mission.things]
    assert any(" from " in mission.request for mission in asked)
    for mission in asked:
        assert not {*mission.places} & {*stands_on.values()}, mission.request


FLAT_THINGS = [{**CUP_ON_TABLE, "id": thing.id, "on": thing.on} for thing in FLAT.objects]


def moment(name, **where):
    mission = Mission(
        house="flat", kind="to a place", request="", disturbance=name,
        outcomes=(Outcome(states=(Placed(things=("cup_1",), places=("desk_1",)),)),),
    )  # fmt: skip
    now = scene(CUP_ON_TABLE, **where)
    running = task(TaskStatus.RUNNING)
    rng = np.random.default_rng(0)
    return Moment(scene=now, mission=mission, task=running, ways=Ways(now), since_s=5.0, rng=rng)


@pytest.mark.parametrize("name", [*DISTURBANCES])
def test_every_disturbance_has_its_time_and_deeds_that_the_simulator_understands(name):
    carrying = name in ("slipped", "support_full", "support_gone")
    pose = (1.4, 1.6, 0.0) if name == "moved_in_view" else None
    now = moment(name, holding="cup_1" if carrying else None, pose=pose)
    assert DISTURBANCES[name].due(now)
    deeds = DISTURBANCES[name].deeds(now)
    assert deeds
    for events in deeds:
        for event in events:
            parse_disturbance(event)


def test_a_thing_is_moved_only_to_where_the_robot_can_be_asked_to_go():
    doors, in_kitchen = [door.id for door in FLAT.doors], (1.4, 1.6, 0.0)
    assert DISTURBANCES["moved_unseen"].deeds(moment("moved_unseen", pose=in_kitchen))
    assert not DISTURBANCES["moved_unseen"].deeds(moment("moved_unseen", pose=in_kitchen, shut=doors))
    assert DISTURBANCES["moved_in_view"].deeds(moment("moved_in_view", pose=in_kitchen, shut=doors))


@pytest.mark.parametrize("name", ["kidnapped", "pushed"])
@pytest.mark.parametrize("what", ["people", "objects"])
def test_the_robot_is_never_set_down_on_somebodys_feet_nor_on_what_lies_on_the_floor(name, what):
    def spots(now):
        return [event["to"]["pose"][:2] for events in DISTURBANCES[name].deeds(now) for event in events]

    now, same = moment(name), moment(name)
    crowded = spots(now)[0]
    same.scene.truth[what].append({"id": "guest", "position_m": crowded, "on": None, "in": None})
    left = spots(same)
    assert left
    assert len(left) < len(spots(moment(name)))
    assert all(math.dist(spot, crowded) > 0.4 for spot in left)


@pytest.mark.parametrize("item", [item for item in FLAT.furniture if item.id in ("desk_1", "shelf_1", "sofa_1")])
def test_boxes_fill_every_level_around_what_stands_there_and_touch_nothing(item):
    kind = category_named(item.category, static=True)
    width_m, depth_m, height_m = item.size or kind.size_m
    alone = boxes_over(item, scene())
    *at, z_m = alone[0].center_m
    around = Block(center_m=(*at, z_m), size_m=(0.08, 0.08, 0.1), yaw_rad=item.pose[2])
    beside = boxes_over(item, scene({**CUP, "on": item.id, "position_m": [*at, z_m]}))
    for boxes in (alone, beside):
        bottoms_m = [box.center_m[2] - box.size_m[2] / 2 for box in boxes]
        for level in kind.levels:
            assert any(0.0 < bottom_m - level * height_m < 0.01 for bottom_m in bottoms_m)
        apart = [(a, b) for a, b in combinations(boxes, 2) if abs(a.center_m[2] - b.center_m[2]) < 0.2]
        assert not any(overlapping(a, b) for a, b in apart)
    met = [box for box in beside if overlapping(box, around) and abs(box.center_m[2] - z_m) < 0.2]
    assert not met
    covered = sum(box.size_m[0] * box.size_m[1] for box in beside) / (width_m * depth_m * len(kind.levels))
    assert covered > (0.4 if item.category == "sofa" else 0.6)


def test_a_mission_gets_only_what_can_happen_to_it():
    def fitting(*places):
        placed = Placed(things=("cup_1",), places=places)
        mission = Mission(house="flat", kind="", request="", outcomes=(Outcome(states=(placed,)),))
        return {name for name, each in DISTURBANCES.items() if each.fits(mission, FLAT)}

    assert fitting("desk_1") == {*DISTURBANCES}
    assert fitting("office") == {*DISTURBANCES} - {"support_full", "support_gone"}
    assert fitting(HAND) == {*DISTURBANCES} - {"support_full", "support_gone", "slipped"}
    assert not any(each.fits(Mission(house="flat", kind="", request=""), FLAT) for each in DISTURBANCES.values())


def test_nothing_is_moved_before_the_robot_is_under_way_and_nothing_slips_from_an_empty_hand():
    early = moment("moved_unseen")
    early = Moment(**{**vars(early), "since_s": 0.0})
    assert not DISTURBANCES["moved_unseen"].due(early)
    assert not DISTURBANCES["slipped"].due(moment("slipped"))


def test_a_file_of_missions_is_read_with_outcomes_and_disturbances(tmp_path):
    file = tmp_path / "missions.txt"
    file.write_text(
        "# mine\n@flat\n== to a place\nput the cup on the desk\n  > cup_1 -> desk_1|table_1\n  ! slipped\n"
        "two of them\n  > 1 of cup_1 bottle_1 -> hand; robot -> office\nwhere is it?\n  > answer kitchen, table\n",
        encoding="utf-8",
    )
    first, second, third = load_missions(file)
    assert (first.kind, first.disturbance, first.places) == ("to a place", "slipped", ("desk_1", "table_1"))
    placed, robot = second.outcomes[0].states
    assert placed == Placed(things=("cup_1", "bottle_1"), places=("hand",), count=1)
    assert robot == RobotIn(rooms=("office",))
    assert third.outcomes == (Outcome(words=("kitchen", "table")),)


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("put it there", "line 1: say '@house'"),
        ("@nowhere", "line 1: house 'nowhere'"),
        ("@flat\n> refuse", "line 2: comes before any request"),
        ("@flat\ngo\n  ! earthquake", "line 3: no disturbance 'earthquake'"),
        ("@flat\ngo\n  > cup_9 -> desk_1", "line 3: the house has no cup_9"),
        ("@flat\ngo\n  > cup_1 -> desk_1; robot -> desk_1", "line 3: the robot ends in a room, and desk_1 is none"),
        ("@flat\ngo\n  > somewhere", "line 3: 'somewhere' is no outcome"),
    ],
)
def test_what_a_mission_file_may_not_say_is_named_with_its_line(tmp_path, text, complaint):
    file = tmp_path / "missions.txt"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(MissionFileError, match=complaint):
        load_missions(file)


def row(verdict, disturbance="", *, possible=True, near=True, collisions=0, driven_m=5.0, shortest_m=4.5, attempts=()):
    return {
        "verdict": verdict, "disturbance": disturbance, "made": bool(disturbance), "possible": possible,
        "within_reach": near,
        "collisions": collisions, "driven_m": driven_m, "shortest_m": shortest_m, "attempts": attempts,
    }  # fmt: skip


def test_what_was_touched_is_told_of_the_newest_collisions_only():
    truth = {"collisions": 5, "touched": ["wall", "chair_1", "cup_1"]}
    assert touched_last(truth, 2) == ["chair_1", "cup_1"]
    assert touched_last(truth, 5) == ["wall", "chair_1", "cup_1"]
    assert touched_last(truth, 0) == []


def test_one_phantom_or_one_collision_is_one_too_many():
    good = [row(Verdict.DONE)] * 9 + [row(Verdict.HONEST_FAILURE)]
    assert met(summarize(good))
    assert not met(summarize([*good, row(Verdict.PHANTOM)]))
    assert not met(summarize([*good[:-1], row(Verdict.DONE, collisions=1)]))
    assert not met(summarize([*good, row(Verdict.HONEST_FAILURE)]))
    assert not met(summarize([]))


def test_what_was_impossible_counts_for_its_reason_and_not_as_a_failure():
    rows = [row(Verdict.RIGHTLY_IMPOSSIBLE, "removed", possible=False), row(Verdict.DONE, "pushed")]
    summary = summarize(rows)
    assert (summary["success_disturbed"], summary["right_reason"], summary["impossible"]) == (1.0, 1.0, 1)
    assert met(summary)
    rows.append(row(Verdict.RIGHTLY_IMPOSSIBLE, possible=False))
    summary = summarize(rows)
    assert (summary["success_undisturbed"], summary["impossible"], summary["out_of_reach"]) == (None, 1, 1)
    rows.append(row(Verdict.OTHER_REASON, "removed", possible=False))
    assert not met(summarize(rows))


def test_what_was_carried_out_was_possible_whatever_had_been_thought():
    rows = [row(Verdict.DONE, "pushed", possible=False), row(Verdict.OTHER_REASON, "removed", possible=False)]
    summary = summarize([*rows, row(Verdict.DONE, possible=False)])
    assert (summary["success_disturbed"], summary["right_reason"], summary["impossible"]) == (1.0, 0.0, 1)
    assert (summary["success_undisturbed"], summary["out_of_reach"]) == (1.0, 0)


def test_what_ended_before_anybody_interfered_counts_as_undisturbed():
    early = {**row(Verdict.HONEST_FAILURE, "removed"), "made": False}
    summary = summarize([row(Verdict.DONE), early, {**early, "verdict": Verdict.DONE}, row(Verdict.DONE, "removed")])
    assert (summary["success_undisturbed"], summary["success_disturbed"]) == (pytest.approx(2 / 3), 1.0)
    assert (summary["not_made"], summary["disturbed"], summary["out_of_reach"]) == (2, 1, 0)


def test_the_way_is_compared_where_nobody_interfered():
    rows = [row(Verdict.DONE, driven_m=9.0), row(Verdict.DONE, "pushed", driven_m=90.0)]
    assert summarize(rows)["way_over_shortest"] == 2.0


def plan_of(*steps):
    reports = tuple(StepReport(skill=skill, args=("cup_1",), status=status) for skill, status in steps)
    return PlanReport(source="grammar", revision=1, goals=(), steps=reports)


def test_a_go_counts_once_it_has_begun_and_ended_and_a_failed_one_stays_failed_after_a_new_plan():
    attempts = Attempts()
    pending, running, failed, done = StepStatus.PENDING, StepStatus.RUNNING, StepStatus.FAILED, StepStatus.SUCCEEDED
    for steps in (
        (("GOTO", done), ("PICK", failed)),
        (("GOTO", done), ("PICK", running)),
        (("GOTO", done), ("PICK", failed)),
        (("GOTO", running), ("PICK", pending)),
        (("GOTO", done), ("PICK", running)),
        (("GOTO", running), ("PICK", pending)),
        (("GOTO", done), ("PICK", running)),
        (("GOTO", done), ("PICK", done)),
        (("GOTO", done), ("PICK", done)),
    ):
        attempts.follow(replace(task(TaskStatus.RUNNING), plan=plan_of(*steps)))
    found = attempts.check(scene(CUP_ON_TABLE, holding="cup_1"), calm=True)
    assert [(attempt.step, attempt.done) for attempt in found] == [("PICK(cup_1)", False), ("PICK(cup_1)", True)]
    assert attempts.check(scene(CUP_ON_TABLE), calm=True) == []


@pytest.mark.parametrize(("skill", "holding"), [("PICK", None), ("PLACE", "cup_1")])
def test_a_go_that_the_robot_takes_for_done_and_the_truth_does_not_is_none(skill, holding):
    attempts = Attempts()
    for status in (StepStatus.RUNNING, StepStatus.SUCCEEDED):
        attempts.follow(replace(task(TaskStatus.RUNNING), plan=plan_of((skill, status))))
    (attempt,) = attempts.check(scene(CUP_ON_TABLE, holding=holding), calm=True)
    assert not attempt.done


def test_goes_count_until_somebody_interferes():
    goes = [{"skill": "PICK", "done": True, "calm": True}, {"skill": "PICK", "done": False, "calm": False}]
    summary = summarize([row(Verdict.DONE, "pushed", attempts=goes)])
    assert (summary["picks"], summary["places"]) == (1.0, None)
    bad = [{"skill": "PLACE", "done": False, "calm": True}]
    assert not met(summarize([row(Verdict.DONE, attempts=bad)]))


def test_goes_at_what_was_out_of_reach_from_the_start_are_counted_by_themselves():
    came, failed = ({"skill": "PICK", "done": done, "calm": True} for done in (True, False))
    rows = [
        row(Verdict.RIGHTLY_IMPOSSIBLE, possible=False, near=False, attempts=[failed]),
        row(Verdict.RIGHTLY_IMPOSSIBLE, "removed", possible=False, attempts=[came, failed]),
        row(Verdict.DONE, possible=False, near=False, attempts=[came]),
    ]
    summary = summarize(rows)
    assert summary["attempts"] == {"PICK": 3, "PLACE": 0}
    assert (summary["picks"], summary["attempts_out_of_reach"]) == (pytest.approx(2 / 3), 1)


def test_a_filmstrip_shows_the_first_and_the_last_of_many_pictures(tmp_path):
    jpeg = io.BytesIO()
    matplotlib.image.imsave(jpeg, np.zeros((24, 32, 3), np.uint8), format="jpeg")
    stills = [
        Still(stamp_s=float(n), at=(1.0 + n / 10, 1.0), caption=f"picture {n}", jpeg=jpeg.getvalue() if n else None)
        for n in range(MOST + 5)
    ]
    few, many = tmp_path / "few.png", tmp_path / "new" / "many.png"
    draw_filmstrip(FLAT, [(1.0, 1.0), (2.0, 1.5)], stills[:3], "done: put the cup on the desk", few)
    draw_filmstrip(FLAT, [], stills, "done: put the cup on the desk", many)
    assert matplotlib.image.imread(many).shape[0] > matplotlib.image.imread(few).shape[0] > 0
