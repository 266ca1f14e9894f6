"""All known things and one update per frame."""

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid, look_at, render, rgbd_frame
from perception.objects.doubles.scripted import furnished_memory
from perception.objects.furniture.surface import Box, SurfaceBelief
from perception.objects.seeing.detection import DetectionSettings, detections_of
from perception.objects.seeing.membership import Surroundings
from perception.objects.seeing.projection import View
from perception.objects.seeing.sight import Sight
from perception.objects.tracker import Tracker, TrackerSettings
from perception.objects.tracking.handled import HandDid
from perception.panoptic import Instance, PanopticScene
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState
from unit.perception.objects.things import door_between, nothing_seen, thing, two_rooms


@pytest.mark.parametrize("missing_number", [1, 2])
@pytest.mark.parametrize(("older", "newer"), [(1, 2), (2, 1)])
def test_of_two_nodes_in_one_place_of_which_one_is_missed_the_older_name_stays(missing_number, older, newer):
    """Numbers need not tell which is older: after a restart they follow the graph."""
    tracker = Tracker(settings=TrackerSettings(), random=np.random.default_rng(0))
    tracker.tracks = [thing(1), thing(2)]
    for track in tracker.tracks:
        track.node_id = f"bottle_{track.number}"
        track.state = ObjectState.MISSING if track.number == missing_number else ObjectState.PRESENT
        track.first_seen_s += 5.0 * (track.number == newer)
    tracker.update(nothing_seen("room_1", two_rooms()))
    assert [(track.node_id, track.state) for track in tracker.tracks] == [(f"bottle_{older}", ObjectState.PRESENT)]
    assert tracker.removed == {f"bottle_{newer}": tracker.tracks[0]}
    assert tracker.united == {newer: tracker.tracks[0]}


def test_what_is_in_no_known_room_goes_along_with_the_robot_until_its_room_is_known():
    tracker = Tracker(settings=TrackerSettings(), random=np.random.default_rng(0))
    track = tracker.new_track("room_1")
    track.homeless = True
    track.label.update((("stool", 0.95),))
    track.place = SurfaceBelief.of(Box(np.array((12.0, 0.5, 0.25)), (0.4, 0.4, 0.5), 0.0))

    def stand_in(room, snapshot):
        tracker.update(nothing_seen(room, snapshot))

    stand_in("room_2", two_rooms())
    assert (track.room, track.homeless) == ("room_2", True)
    assert track.position[:2] == pytest.approx((12.0 - 6.2, 0.5), abs=0.01)
    third = furnished_memory(rooms=3)
    stand_in("room_3", third.snapshot())
    assert track.room == "room_2", "nothing leads from there to here"
    stand_in("room_2", third.commit(door_between("room_2", "room_3"), agent="door_concept", stamp_s=2.0))
    assert (track.room, track.homeless) == ("room_3", False)
    assert track.position[:2] == pytest.approx((12.0 - 12.4, 0.5), abs=0.01)


@pytest.mark.parametrize(("label", "size_m"), [("wardrobe", (0.8, 0.5, 1.8)), ("unknown", (0.1, 0.1, 0.1))])
def test_what_is_not_named_yet_waits_for_it_while_the_robot_is_two_rooms_away(label, size_m):
    tracker = Tracker(settings=TrackerSettings(), random=np.random.default_rng(0))
    track = tracker.new_track("room_1")
    track.label.update(((label, 0.5),))
    track.place = SurfaceBelief.of(Box(np.array((1.0, 0.5, size_m[2] / 2)), size_m, 0.0))
    track.hits, track.last_seen_s = 20, 1.0
    track.seen_from = [np.array((float(i), 0.0, 0.0)) for i in range(8)]
    memory = furnished_memory(rooms=3)
    ways = door_between("room_1", "room_2") + door_between("room_2", "room_3")
    snapshot = memory.commit(ways, agent="door_concept", stamp_s=0.0)
    base = SE3.identity()
    view = View.of(
        rgbd_frame(render([], base), stamp_s=1.0, T_base_camera=base),
        room="room_3",
        T_room_base=base,
        pose_covariance=np.zeros((6, 6)),
    )
    somebody = np.array(((1.0, 0.5),))
    tracker.update(Sight(view=view, detections=[], surroundings=Surroundings(snapshot, "room_3"), persons=somebody))
    assert track in tracker.tracks
    assert track.node_id is None


BOOK = Solid(label="book", center=(0.0, 0.0, 0.47), size_m=(0.2, 0.09, 0.035), color=(230.0, 200.0, 20.0))


CUP = Solid(label="cup", center=(-0.02, -0.12, 0.5), size_m=(0.08, 0.08, 0.1), cylinder=True)


TOY = Solid(label="toy", center=(0.0, 0.2, 0.5), size_m=(0.1, 0.1, 0.1), color=(20.0, 200.0, 20.0))


def ends_of(mask):
    """The two ends of what has something before its middle."""
    columns = np.flatnonzero(mask.any(axis=0))
    third = len(columns) // 3
    return [mask & np.isin(np.arange(mask.shape[1]), each) for each in (columns[:third], columns[-third:])]


def look_from_all_sides(given, frames=80):
    """A tracker that has seen book, cup and toy; ``given``: what the network makes of their masks in each frame."""
    tracker = Tracker(settings=TrackerSettings(), random=np.random.default_rng(0))
    surroundings, solids = Surroundings(two_rooms(), "room_1"), [BOOK, CUP, TOY]
    for stamp_s in range(frames):
        turn_rad = 0.8 * (stamp_s // 8 % 5) - 1.6
        T_room_camera = look_at((1.2 * np.sin(turn_rad), -1.2 * np.cos(turn_rad), 1.3), (0.0, 0.0, 0.5))
        rendering = render(solids, T_room_camera)
        named = given(stamp_s, tracker, *(rendering.ids == number for number in range(3)))
        scene = PanopticScene(
            stamp_s=stamp_s, relations=(),
            instances=tuple(
                Instance(label=label, score=0.9, mask=mask, label_distribution=((label, 0.9),))
                for label, shown in named.items()
                for mask in shown
            ),
        )  # fmt: skip
        frame = rgbd_frame(rendering, stamp_s=stamp_s, T_base_camera=T_room_camera)
        view = View.of(frame, room="room_1", T_room_base=SE3.identity(), pose_covariance=np.eye(6) * 1e-8)
        things, _ = detections_of(scene, frame.rgb, view, DetectionSettings(), None, lambda points: points[:, 0] > 1e9)
        tracker.update(Sight(view=view, detections=things, surroundings=surroundings))
    return tracker


@pytest.mark.parametrize(
    ("merged", "nodes"),
    [
        (lambda book, cup, toy: {"unknown": [book | cup]}, 2),
        (lambda book, cup, toy: {"unknown": ends_of(book), "cup": [cup]}, 2),
        (lambda book, cup, toy: {"unknown": [toy], "cup": [cup], "book": [book]}, 3),
    ],
)
def test_a_known_book_and_cup_seen_as_one_or_in_bits_make_no_third_thing_but_a_toy_beside_them_does(merged, nodes):
    def given(stamp_s, tracker, book, cup, toy):
        calm = stamp_s < 40 or stamp_s % 8 == 0
        return {"book": [book], "cup": [cup]} if calm else merged(book, cup, toy)

    named = [track for track in look_from_all_sides(given).tracks if track.node_id is not None]
    assert len(named) == nodes
    assert {track.label.best for track in named[:2]} == {"book", "cup"}
    assert [track.position[:2].tolist() for track in named[:2]] == [
        pytest.approx(solid.center[:2], abs=0.02) for solid in (BOOK, CUP)
    ]


@pytest.mark.parametrize(
    ("put_there", "shown", "seen_again"),
    [
        (False, lambda book: [book], True),  # as flat as it is, it seems to take little space
        (False, ends_of, False),
        (True, lambda book: ends_of(book)[:1], True),  # half hidden by the hand
    ],
)
def test_a_book_that_nobody_can_name_for_once_is_seen_unless_only_bits_of_it_show(put_there, shown, seen_again):
    def given(stamp_s, tracker, book, cup, toy):
        if stamp_s == 48 and put_there:
            tracker.of_node("book_1").note_hand(HandDid.PUT, stamp_s)
        return {"book": [book], "cup": [cup]} if stamp_s < 48 else {"unknown": shown(book), "cup": [cup]}

    tracker = look_from_all_sides(given, frames=52)
    assert (tracker.of_node("book_1").last_seen_s >= 48.0) is seen_again
