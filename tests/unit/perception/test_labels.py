"""What a room is for, from its contents."""

import asyncio
from dataclasses import replace

import pytest

from perception.labels import ROOM_LABELS, RoomLabels, room_label
from scene_graph.edges import InEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ObjectNode, ObjectState, RoomNode, RoomStatus

SQUARE = ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))
NARROW = ((-4.0, -0.7), (4.0, -0.7), (4.0, 0.7), (-4.0, 0.7))


def things(*labels):
    return [(label, 0.97) for label in labels]


@pytest.mark.parametrize(
    ("contents", "label"),
    [
        (("fridge", "counter", "table"), "kitchen"),
        (("stove",), "kitchen"),
        (("refrigerator", "sink", "chair", "chair", "table"), "kitchen"),
        (("bed", "nightstand"), "bedroom"),
        (("bed", "desk"), "bedroom"),
        (("desk", "chair", "laptop"), "office"),
        (("sofa", "tv"), "living room"),
        (("couch", "coffee table", "shelf"), "living room"),
        (("tv stand", "shelf"), "living room"),
        (("toilet", "sink"), "bathroom"),
        (("bathtub",), "bathroom"),
        (("table", "chair", "chair", "chair"), "dining room"),
    ],
)
def test_contents_tell_the_use_of_a_room(contents, label):
    said, probability = room_label(things(*contents), polygon_m=SQUARE, doors=2)
    assert said == label
    assert 0.5 < probability <= 1.0


def test_a_name_counts_however_the_network_writes_it():
    assert room_label(things("Washing_Machine", "toilet")) == room_label(things("washing machine", "toilet"))
    assert room_label(things("toilet", "nightstand", "washing_machine"), polygon_m=SQUARE, doors=1)[0] == "bathroom"


def test_a_wardrobe_makes_no_bedroom_of_an_office_in_which_no_bed_stands():
    assert room_label(things("desk", "wardrobe"), polygon_m=SQUARE, doors=1)[0] != "bedroom"
    assert room_label(things("desk", "wardrobe", "bed"), polygon_m=SQUARE, doors=1)[0] == "bedroom"
    without, with_desk = (room_label(things(*names), doors=1)[1] for names in (("chair",), ("chair", "desk")))
    assert with_desk > without


def test_an_empty_room_says_nothing_unless_it_is_shaped_like_a_hall():
    assert room_label([], polygon_m=SQUARE, doors=1)[0] == ""
    assert room_label([], polygon_m=NARROW, doors=4)[0] == "hall"
    assert room_label(things("wardrobe", "table"), polygon_m=NARROW, doors=2)[0] == "hall"


def test_what_usually_stands_in_halls_tells_one_that_is_not_narrow_and_has_few_doors():
    assert room_label([], polygon_m=SQUARE, doors=3)[0] == ""
    assert room_label(things("bench", "cabinet", "plant"), polygon_m=SQUARE, doors=3)[0] == "hall"


BENT = ((0.0, 0.0), (6.0, 0.0), (6.0, 5.0), (4.4, 5.0), (4.4, 1.6), (1.6, 1.6), (1.6, 5.0), (0.0, 5.0))


def test_a_hall_is_told_by_its_doors_whatever_stands_in_it():
    furniture = things("wardrobe", "cabinet", "sink")
    assert room_label(furniture, polygon_m=SQUARE, doors=6)[0] == "hall"
    assert room_label(furniture, polygon_m=SQUARE, doors=1)[0] != "hall"
    chances = [room_label(things("wardrobe"), polygon_m=SQUARE, doors=doors) for doors in (4, 5, 6)]
    assert [label for label, _ in chances] == ["hall"] * 3
    assert [chance for _, chance in chances] == sorted(chance for _, chance in chances)


def test_a_kitchen_with_two_doors_is_none():
    assert room_label(things("stove", "sink", "counter"), polygon_m=SQUARE, doors=3)[0] == "kitchen"


def test_a_corridor_that_bends_is_as_narrow_as_a_straight_one():
    straight = ((0.0, 0.0), (14.4, 0.0), (14.4, 1.6), (0.0, 1.6))
    assert room_label([], polygon_m=BENT, doors=2)[0] == "hall"
    bent, unrolled = (room_label([], polygon_m=polygon, doors=2) for polygon in (BENT, straight))
    assert bent == pytest.approx(unrolled)


def test_a_bottle_or_an_unknown_thing_says_nothing():
    assert room_label(things("bottle", "gizmo"), polygon_m=SQUARE, doors=2) == room_label(
        [("x", 1.0)], polygon_m=SQUARE, doors=2
    )


def test_doubtful_contents_tell_less():
    sure = room_label([("bed", 0.99)])[1]
    doubtful = room_label([("bed", 0.3)])[1]
    assert sure > doubtful


def test_the_order_of_contents_does_not_matter():
    names = ("fridge", "sofa", "table", "chair", "tv")
    assert room_label(things(*names)) == pytest.approx(room_label(things(*reversed(names))))
    assert "kitchen" in ROOM_LABELS


def memory_with(label_taught=False):
    memory = WorkingMemory()
    room = RoomNode(
        id="room_1",
        polygon_m=SQUARE,
        status=RoomStatus.PERMANENT,
        label="den" if label_taught else "",
        label_taught=label_taught,
    )
    bed = ObjectNode(id="bed_1", label="bed", size_m=(2.0, 1.5, 0.5))
    edits = [
        PutNode(room),
        PutEdge(RtEdge(source="root", target="room_1", T_source_target=SE3.identity())),
        PutNode(bed),
        PutEdge(RtEdge(source="room_1", target="bed_1", T_source_target=SE3.identity())),
        PutEdge(InEdge(source="bed_1", target="room_1")),
    ]
    memory.commit(edits, agent="test", stamp_s=0.0)
    return memory


def step(memory):
    asyncio.run(RoomLabels(memory).step(1.0))
    return memory.snapshot()


def test_the_agent_labels_a_room_with_its_probability_and_writes_only_once():
    memory = memory_with()
    graph = step(memory)
    assert graph.room("room_1").label == "bedroom"
    assert graph.room("room_1").label_probability > 0.6
    assert step(memory).revision == graph.revision


@pytest.mark.parametrize(
    ("status", "label"), [(RoomStatus.PARTIAL, "bedroom"), (RoomStatus.TEMPORARY, "")], ids=["partial", "temporary"]
)
def test_a_room_that_was_seen_in_part_is_labelled_by_its_things_and_one_that_does_not_stand_is_not(status, label):
    memory = memory_with()
    room = memory.snapshot().room("room_1")
    memory.commit([PutNode(replace(room, status=status))], agent="test", stamp_s=0.5)
    assert step(memory).room("room_1").label == label


def test_the_agent_never_overrides_a_persons_word():
    assert step(memory_with(label_taught=True)).room("room_1").label == "den"


def test_missing_things_do_not_count():
    memory = memory_with()
    memory.commit([PutNode(ObjectNode(id="bed_1", label="bed", state=ObjectState.MISSING))], agent="test", stamp_s=0.5)
    assert step(memory).room("room_1").label == ""


def furnish(memory, *labels):
    """What stands in the room now; a name that was there and is not any more is missing."""
    standing = {node.id: node for node in memory.snapshot().of_type(ObjectNode)}
    edits = [
        PutNode(replace(node, state=ObjectState.PRESENT if node.label in labels else ObjectState.MISSING))
        for node in standing.values()
    ]
    for label in labels:
        if f"{label}_1" not in standing:
            edits += [
                PutNode(ObjectNode(id=f"{label}_1", label=label, size_m=(1.0, 0.6, 0.7))),
                PutEdge(RtEdge(source="room_1", target=f"{label}_1", T_source_target=SE3.identity())),
                PutEdge(InEdge(source=f"{label}_1", target="room_1")),
            ]
    memory.commit(edits, agent="test", stamp_s=0.5)


def test_a_room_keeps_the_name_that_people_use_while_another_is_hardly_likelier():
    memory = memory_with()
    furnish(memory, "desk", "sofa", "chair", "shelf")
    assert step(memory).room("room_1").label == "office"
    furnish(memory, "desk", "sofa", "shelf", "plant")
    assert room_label(things("desk", "sofa", "shelf", "plant"), polygon_m=SQUARE)[0] == "living room"
    graph = step(memory)
    assert graph.room("room_1").label == "office"
    assert graph.room("room_1").label_probability < 0.5


def test_a_room_is_not_nameless_again_when_what_made_it_one_was_carried_out():
    memory = memory_with()
    step(memory)
    furnish(memory)
    assert step(memory).room("room_1").label == "bedroom"


def test_a_room_gets_another_name_once_it_is_by_far_likelier():
    memory = memory_with()
    step(memory)
    furnish(memory, "stove", "fridge", "counter")
    assert step(memory).room("room_1").label == "kitchen"
