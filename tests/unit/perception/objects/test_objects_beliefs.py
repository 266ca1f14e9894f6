"""Labels, colors, identity and rooms: how single frames become beliefs."""

import os
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.objects.beliefs import AccentBelief, ColorBelief, LabelBelief, agreement, share_agreement
from perception.objects.doubles.raycast import Solid, look_at, render, rgbd_frame
from perception.objects.doubles.scripted import furnished_memory
from perception.objects.furniture.back import back_of
from perception.objects.furniture.surface import Box, SurfaceBelief, SurfaceMemory, furniture_box, turned_like
from perception.objects.identity.evidence import alike, left, likeness
from perception.objects.identity.hypotheses import Asked, Hypothesis
from perception.objects.identity.identity import Identity, IdentitySettings
from perception.objects.identity.pair import Moment, Pair, Subject
from perception.objects.publishing.publication import node_of
from perception.objects.seeing.color import PALETTE, colors_of, named_color
from perception.objects.seeing.detection import DetectionSettings, detections_of
from perception.objects.seeing.membership import Outline, Surroundings
from perception.objects.seeing.projection import View
from perception.objects.seeing.shape import Shape
from perception.objects.seeing.sight import Sight
from perception.objects.tracker import Tracker, TrackerSettings
from perception.objects.tracking.center import CenterBelief, CenterSettings
from perception.objects.tracking.handled import HandDid
from perception.objects.tracking.track import Track, TrackSettings
from perception.panoptic import Instance, PanopticScene
from perception.vocabulary import category_of, oversize
from scene_graph.edges import ConnectsEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import UNKNOWN_LABEL, DoorNode, ObjectNode, ObjectState

LABELS = ("bottle", "cup", "vase", "can")


@pytest.mark.parametrize("noise", [0.03, 0.1])
def test_wrong_labels_of_single_frames_wash_out(noise):
    random = np.random.default_rng(2)
    for _ in range(50):
        belief = LabelBelief()
        for number in range(25):
            label = random.choice(LABELS[1:]) if random.random() < noise else "bottle"
            belief.update(((str(label), 0.8), ("vase", 0.15)), view=number // 5)
        assert belief.best == "bottle"
        assert belief.confidence > 0.9


def test_what_has_not_been_looked_at_yet_is_called_unknown():
    belief = LabelBelief()
    assert belief.best == "unknown"
    assert belief.confidence == 0.0


def test_a_belief_can_be_turned_by_enough_frames():
    belief = LabelBelief()
    for _ in range(100):
        belief.update((("cup", 0.9),))
    for _ in range(20):
        belief.update((("bowl", 0.9),))
    assert belief.best == "bowl"


def test_one_view_however_long_does_not_outweigh_two_that_agree_and_three_do():
    belief = LabelBelief()
    for view in ("left", "right"):
        for _ in range(5):
            belief.update((("toilet", 0.9),), view=view)
    for _ in range(200):
        belief.update((("sink", 0.9),), view="back")
    assert belief.best == "toilet"
    for view in ("front", "near"):
        for _ in range(5):
            belief.update((("sink", 0.9),), view=view)
    assert belief.best == "sink"


def test_within_a_view_the_newest_frames_count():
    belief = LabelBelief()
    for _ in range(3):
        belief.update((("cup", 0.9),), view="front")
    for _ in range(12):
        belief.update((("mug", 0.9),), view="front")
    assert belief.best == "mug"


def test_frames_that_are_all_unsure_but_agree_give_a_name():
    belief = LabelBelief()
    for number in range(8):
        shares = (("unknown", 0.55), ("sofa", 0.45 * 0.45), ("bed", 0.45 * 0.15), ("bench", 0.45 * 0.1))
        belief.update(shares, view=number // 2)
    assert belief.best == "sofa"
    assert belief.confidence > 0.9


@pytest.mark.parametrize(("looked_before", "name"), [(100, "book"), (3, "banana")])
def test_what_was_looked_at_well_keeps_its_name_where_it_is_put_though_it_looks_like_something_else_there(
    looked_before, name
):
    belief = LabelBelief()
    for number in range(looked_before):
        belief.update((("book", 0.8), ("banana", 0.15)), view=number // 20)
    belief.start_from(belief.distribution, looked_before)
    for number in range(60):
        belief.update((("banana", 0.8), ("book", 0.13)), view=number // 12)
    assert belief.best == name


def test_what_looks_like_nothing_known_stays_unknown_and_one_lucky_frame_does_not_name_it():
    random = np.random.default_rng(0)
    belief = LabelBelief()
    for _ in range(8):
        given = random.dirichlet(np.full(4, 8.0)) * 0.3  # the rest is spread over classes that are not listed
        listed = zip(LABELS, (float(share) for share in given.max() * given), strict=True)
        belief.update((("unknown", 1.0 - float(given.max())), *listed))
    belief.update((("cup", 0.8), ("can", 0.1)))
    assert belief.best == "unknown"


IDENTITY = Identity(IdentitySettings())


def decision(sighting, known, asked=Asked.TENTATIVE, looked_before=None):
    """What a sighting is taken for, among the things that are known."""
    moment = Moment(known=known, looked_before=looked_before or {})
    return IDENTITY.decide(asked, Subject.of(sighting), moment)


def taken_for(sighting, known, looked_before=None):
    """The known thing that it is, or is a part of, if that is clear by now."""
    decided = decision(sighting, known, looked_before=looked_before)
    return None if decided.waits else decided.best.known


def turned_up(missing, others, looked_before=None):
    """The other thing that a missing one is."""
    moment = Moment(known=others, looked_before=looked_before or {})
    present = [Subject.of(other) for other in others if other.state is ObjectState.PRESENT]
    found = [(IDENTITY.decide(Asked.MISSED, it, moment, [missing]).best, it.track) for it in present]
    best, other = max(found, key=lambda pair: pair[0].score)
    return other if best.known is missing else None


def is_part(sighting, known):
    return decision(sighting, [known]).best.hypothesis is Hypothesis.PART


def are_one(one, other):
    decided = [decision(a, [b], Asked.NODE).best.hypothesis is Hypothesis.PART for a, b in ((one, other), (other, one))]
    return any(decided)


def seen(label, size_m, number):
    track = Track(number, "room_1", settings=TrackSettings(), random=np.random.default_rng(0))
    for view in range(3):
        track.label.update(((label, 0.95),), view=view)
    track.place = SurfaceBelief.of(Box(np.array((0.0, 0.0, size_m[2] / 2)), size_m, 0.0))
    track.seen_whole = True
    return track


def test_a_part_that_looks_like_something_else_from_near_is_a_part_until_it_is_seen_as_a_whole():
    toilet, part = seen("toilet", (0.7, 0.4, 0.8), 1), seen("bin", (0.3, 0.3, 0.5), 2)
    part.seen_whole = False
    assert is_part(part, toilet)
    part.seen_whole = True
    assert not is_part(part, toilet)


def test_the_same_cupboard_under_two_names_is_one_and_a_chair_under_a_table_is_not():
    cabinet, sideboard = seen("cabinet", (0.9, 0.5, 0.9), 1), seen("sideboard", (0.95, 0.48, 0.85), 2)
    assert are_one(cabinet, sideboard)
    assert is_part(sideboard, cabinet)
    table, chair = seen("table", (1.4, 0.9, 0.75), 3), seen("chair", (0.45, 0.45, 0.7), 4)
    assert not are_one(table, chair)
    assert not is_part(chair, table)


@pytest.mark.parametrize(
    ("looks_like", "part"),
    [((("shelf", 0.97),), False), ((("unknown", 0.9),), True), ((("shelf", 0.45), ("cabinet", 0.4)), True)],
)
def test_the_side_of_a_desk_that_nobody_can_name_for_sure_is_of_the_desk(looks_like, part):
    desk, side = seen("desk", (1.2, 0.7, 0.75), 1), seen("shelf", (0.66, 0.17, 0.7), 2)
    side.label = LabelBelief()
    for view in range(2):
        side.label.update(looks_like, view=view)
    assert are_one(desk, side) is part
    assert is_part(side, desk) is part


@pytest.mark.parametrize(
    ("middle_x_m", "long_m", "whole", "several"),
    [(0.3, 1.0, False, True), (0.3, 1.0, True, False), (0.0, 0.5, False, False), (1.2, 1.0, False, False)],
)
def test_what_spans_two_pieces_of_a_row_is_no_third_unless_it_reaches_beyond_or_is_seen_whole(
    middle_x_m, long_m, whole, several
):
    stove, fridge = seen("stove", (0.6, 0.6, 0.9), 1), seen("fridge", (0.6, 0.6, 1.8), 2)
    fridge.place = SurfaceBelief.of(Box(np.array((0.65, 0.0, 0.9)), (0.6, 0.6, 1.8), 0.0))
    low = seen("counter", (long_m, 0.5, 0.5), 3)
    low.place = SurfaceBelief.of(Box(np.array((middle_x_m, 0.0, 0.3)), (long_m, 0.5, 0.5), 0.0))
    low.seen_whole = whole
    low.label = LabelBelief()
    low.label.update((("counter", 0.5),))
    stove.node_id, fridge.node_id = "stove_1", "fridge_1"
    assert ("several" in decision(low, [stove, fridge]).best.way) is several
    assert decision(low, []).best.hypothesis is Hypothesis.NEW


@given(st.lists(st.tuples(st.sampled_from(LABELS), st.floats(0.0, 1.0)), min_size=1, max_size=20))
def test_a_label_distribution_is_sorted_and_sums_to_one(frames):
    belief = LabelBelief()
    for label, probability in frames:
        belief.update(((label, probability),))
    probabilities = [p for _, p in belief.distribution]
    assert 0.0 < sum(probabilities) <= 1.0 + 1e-9
    assert probabilities == sorted(probabilities, reverse=True)


def test_a_stove_two_meters_long_is_a_counter_and_one_of_the_usual_size_a_stove():
    belief = LabelBelief()
    for view in range(3):
        belief.update((("stove", 0.6), ("counter", 0.35)), view=view)
    belief.measure((0.7, 0.6, 0.9))
    assert belief.best == "stove"
    belief.measure((2.1, 0.6, 0.9))
    assert belief.best == "counter"
    belief.teach("stove")
    belief.measure((2.1, 0.6, 0.9))
    assert belief.best == "stove"


def test_what_is_too_deep_for_a_bench_is_the_table_that_the_network_thinks_of_next():
    """A coffee table is as low as a bench."""
    belief = LabelBelief()
    for view in range(3):
        for _ in range(8):
            belief.update((("bench", 0.85), ("table", 0.12), ("unknown", 0.01)), view=view)
            belief.measure((1.0, 0.4, 0.45) if view == 0 else (1.0, 0.62, 0.45))
    assert belief.best == "table"
    assert belief.confidence > 0.9


def test_what_is_too_deep_for_the_only_name_that_was_heard_keeps_no_name_to_speak_of():
    belief = LabelBelief()
    for view in range(3):
        for _ in range(8):
            belief.update((("bench", 0.98), ("chair", 0.01)), view=view)
            belief.measure((1.0, 0.62, 0.45))
    assert belief.best == UNKNOWN_LABEL


def test_the_order_of_frames_does_not_matter_while_odds_are_small():
    forward, backward = LabelBelief(), LabelBelief()
    frames = [(("cup", 0.6), ("bowl", 0.3)), (("bowl", 0.5), ("cup", 0.4))]
    for frame in frames:
        forward.update(frame)
    for frame in reversed(frames):
        backward.update(frame)
    assert dict(forward.distribution) == pytest.approx(dict(backward.distribution))


def test_a_belief_is_the_same_to_the_last_bit_in_every_process():
    """Each process orders sets in its own way: sums that follow one would round otherwise, and logs would differ."""
    program = """
from perception.objects.beliefs import LabelBelief
belief = LabelBelief()
frames = ((("cup", 0.6), ("bowl", 0.27)), (("vase", 0.5), ("can", 0.4)), (("bottle", 0.43), ("jar", 0.4)))
for number in range(30):
    belief.update(frames[number % 3], 0.3 + 0.02 * number, view=number // 7)
    print(belief.distribution)
"""
    beliefs = {
        subprocess.run(
            [sys.executable, "-c", program], env=os.environ | {"PYTHONHASHSEED": seed}, capture_output=True, check=True
        ).stdout
        for seed in "1234"
    }
    assert len(beliefs) == 1
    assert beliefs.pop()


@given(st.lists(st.floats(0.01, 1.0), min_size=4, max_size=4), st.lists(st.floats(0.01, 1.0), min_size=4, max_size=4))
def test_agreement_is_symmetric_within_zero_and_one_and_one_for_equals(p, q):
    a = tuple(zip(LABELS, np.array(p) / sum(p), strict=True))
    b = tuple(zip(LABELS, np.array(q) / sum(q), strict=True))
    assert agreement(a, b) == pytest.approx(agreement(b, a))
    assert 0.0 <= agreement(a, b) <= 1.0 + 1e-9
    assert agreement(a, a) == pytest.approx(1.0)
    assert share_agreement(dict(a), {}) == 1.0


COLORS = [
    ("red", (200, 20, 20)), ("green", (30, 160, 40)), ("blue", (20, 50, 200)), ("yellow", (230, 210, 30)),
    ("orange", (240, 130, 20)), ("purple", (130, 40, 180)), ("pink", (240, 130, 180)), ("brown", (120, 70, 30)),
    ("white", (245, 245, 245)), ("black", (20, 20, 20)), ("gray", (128, 128, 128)), ("cyan", (20, 200, 210)),
]  # fmt: skip


@pytest.mark.parametrize(("name", "rgb"), COLORS)
def test_colors_are_named_as_people_name_them(name, rgb):
    assert named_color(*rgb) == name
    assert name in PALETTE


@pytest.mark.parametrize(("name", "rgb"), COLORS)
def test_a_color_keeps_its_name_on_shaded_faces(name, rgb):
    thing = Solid(label="bottle", center=(0.0, 0.0, 0.3), size_m=(0.3, 0.3, 0.5), cylinder=True, color=rgb)
    belief = ColorBelief()
    for eye in ((-1.5, 0.0, 1.2), (0.0, -1.5, 1.2), (1.0, 1.0, 1.2)):
        rendering = render([thing], look_at(eye, (0.0, 0.0, 0.3)))
        belief.update(colors_of(rendering.rgb, rendering.ids == 0)[0])
    assert belief.best == name


def test_a_handful_of_pixels_of_the_neighbor_does_not_change_the_color():
    rgb = np.zeros((40, 40, 3), dtype=np.uint8)
    rgb[:] = (20, 50, 200)
    rgb[:, :8] = (200, 20, 20)
    votes = colors_of(rgb, np.ones((40, 40), dtype=bool))[0]
    assert max(votes, key=votes.get) == "blue"
    assert sum(votes.values()) == pytest.approx(1.0)
    assert colors_of(rgb, np.zeros((40, 40), dtype=bool))[0] == {}


def phone_on_table(case, table, rows=slice(30, 60), columns=slice(20, 80)):
    """A picture of a phone with a blue screen that fills all but the edges of its case, and the phone's mask."""
    rgb = np.zeros((90, 120, 3), dtype=np.uint8)
    rgb[:] = table
    rgb[rows, columns] = case
    rgb[rows.start + 3 : rows.stop - 3, columns.start + 3 : columns.stop - 3] = (20, 50, 200)
    mask = np.zeros(rgb.shape[:2], dtype=bool)
    mask[rows, columns] = True
    return rgb, mask


def test_the_case_around_a_screen_is_an_accent():
    rgb, mask = phone_on_table(case=(240, 130, 20), table=(245, 245, 245))
    assert colors_of(rgb, mask)[1] == {"orange"}
    rgb, mask = phone_on_table(case=(20, 20, 20), table=(120, 70, 30))
    assert colors_of(rgb, mask)[1] == {"black"}


def test_an_orange_that_lies_against_an_orange_case_does_not_hide_what_color_the_case_is():
    rgb, mask = phone_on_table(case=(240, 130, 20), table=(245, 245, 245))
    rgb[40:80, 80:] = (240, 130, 20)
    assert colors_of(rgb, mask)[1] == {"orange"}
    rgb, mask = phone_on_table(case=(20, 50, 200), table=(245, 245, 245))
    rgb[28:80, 77:] = (240, 130, 20)  # the mask reaches onto it
    assert colors_of(rgb, mask)[1] == frozenset()


def test_what_shines_in_from_around_is_no_accent():
    rgb, mask = phone_on_table(case=(20, 50, 200), table=(200, 20, 20))
    loose = np.zeros_like(mask)
    loose[26:64, 16:84] = True
    assert colors_of(rgb, mask)[1] == frozenset()
    assert colors_of(rgb, loose)[1] == frozenset()


def test_a_thing_that_is_small_in_the_picture_tells_nothing_of_accents():
    rgb, mask = phone_on_table(case=(240, 130, 20), table=(245, 245, 245), rows=slice(30, 38), columns=slice(20, 28))
    assert colors_of(rgb, mask)[1] is None
    assert colors_of(rgb, np.zeros_like(mask))[1] is None


def test_an_accent_shows_in_a_good_part_of_the_frames_that_can_tell():
    belief = AccentBelief()
    belief.update({"orange"})
    assert belief.colors == ()
    for frame in range(20):
        belief.update((None, {"orange"}, {"gray"} if frame == 2 else set())[frame % 3])
    assert belief.colors == ("orange",)
    for _ in range(40):
        belief.update(set())
    assert belief.colors == ()


def thing(number, label="bottle", color="blue", size_m=(0.07, 0.07, 0.24), seen=(0.0, 10.0), state=ObjectState.PRESENT):
    track = Track(number, "room_1", settings=TrackSettings(), random=np.random.default_rng(number))
    for _ in range(5):
        track.label.update(((label, 0.95),))
    track.color.update({color: 1.0})
    track.place = CenterBelief(
        Box(np.zeros(3), size_m, 0.0), np.eye(3) * 1e-4, settings=CenterSettings(), random=np.random.default_rng(number)
    )
    track.first_seen_s, track.last_seen_s = seen
    track.state = state
    track.log_odds = -2.0 if state is ObjectState.MISSING else 4.6
    return track


def measured(belief, width_m, *, side, frames, x_m=0.0):
    shape = Shape(
        center=np.array((x_m, 0.0, 0.8)), size_m=(width_m, width_m, 0.12), yaw_rad=0.0, oriented=False,
        covariance=np.eye(3) * 1e-4, complete=True,
    )  # fmt: skip
    for _ in range(frames):
        belief.observe(shape, SE3.identity(), np.eye(3) * 1e-6, side)


@pytest.mark.parametrize(("x_m", "width_m"), [(0.0, 0.066), (0.5, 0.15)])
def test_a_can_does_not_grow_though_from_one_side_it_is_long_taken_for_one_with_its_neighbor(x_m, width_m):
    belief = CenterBelief(
        Box(np.array((0.0, 0.0, 0.8)), (0.066, 0.066, 0.12), 0.0), np.eye(3) * 1e-4, settings=CenterSettings(),
        random=np.random.default_rng(0),
    )  # fmt: skip
    for side in range(3):
        measured(belief, 0.066, side=side, frames=15)
    measured(belief, 0.15, side=3, frames=60, x_m=x_m)
    assert belief.box.size_m[0] == pytest.approx(width_m), "only what was pushed may lie otherwise than it stood"


@pytest.mark.parametrize(
    ("middle_z_m", "high_m", "center_z_m"),
    [
        (0.65, 0.08, 0.57),  # the upper third shows over the fingers
        (0.46, 0.02, 0.57),  # its foot shows below them
        (0.75, 0.08, 0.67),  # somebody has put something below it meanwhile
    ],
)
def test_what_hides_a_part_of_a_bottle_does_not_shift_it_but_what_lifts_it_does(middle_z_m, high_m, center_z_m):
    whole = Shape(
        center=np.array((0.7, 0.0, 0.57)), size_m=(0.07, 0.07, 0.24), yaw_rad=0.0, oriented=False,
        covariance=np.eye(3) * 6e-5, complete=True,
    )  # fmt: skip
    part = replace(
        whole, center=np.array((0.7, 0.0, middle_z_m)), size_m=(0.04, 0.04, high_m), covariance=np.eye(3) * 4e-4,
        complete=False,
    )  # fmt: skip
    belief = CenterBelief(
        Box(whole.center, whole.size_m, 0.0), whole.covariance, settings=CenterSettings(),
        random=np.random.default_rng(0),
    )  # fmt: skip
    for shape in [whole] * 10 + [part] * 20:
        belief.observe(shape, SE3.identity(), np.eye(3) * 1e-6)
    assert belief.box.center[2] == pytest.approx(center_z_m, abs=0.015)
    assert belief.box.size_m == pytest.approx(whole.size_m, abs=0.001)


def moved(sighting, known, *, place_known=True):
    if not sighting.position.any():
        sighting.put_at("room_1", np.array((3.0, 1.0, 0.0)), 0.01)
    return taken_for(sighting, known, looked_before={"room_1": 0.0} if place_known else {})


def test_a_missing_thing_is_recognized_elsewhere():
    missing = thing(1, state=ObjectState.MISSING)
    assert moved(thing(2, seen=(20.0, 21.0)), [missing], place_known=False) is missing


@pytest.mark.parametrize("other", [{"label": "cup"}, {"color": "red"}, {"size_m": (0.14, 0.14, 0.4)}])
def test_a_thing_of_another_label_color_or_size_is_another_thing(other):
    assert moved(thing(2, seen=(20.0, 21.0), **other), [thing(1, state=ObjectState.MISSING)]) is None


def test_two_things_seen_at_the_same_time_are_two():
    assert moved(thing(2, seen=(9.0, 10.0)), [thing(1, seen=(0.0, 9.5))]) is None


def test_the_longer_unseen_the_likelier_it_has_moved():
    ages = [0.0, 10.0, 100.0, 1000.0, 10_000.0]
    chances = [left(Pair(Subject.of(thing(2, seen=(10.0 + age, 1e6))), thing(1), Moment())) for age in ages]
    assert chances == sorted(chances)
    assert chances[0] < 0.02
    assert chances[-1] > 0.99


def test_parts_seen_from_many_sides_do_not_outvote_the_whole():
    label = LabelBelief()
    for side in range(2):
        for _ in range(5):
            label.update((("cabinet", 0.8), ("desk", 0.1)), view=(side, "whole"))
    for side in range(4):
        for _ in range(10):
            label.update((("tv", 0.5), ("cabinet", 0.2)), 0.6, view=(side, "part"), trust=0.25)
    assert label.best == "cabinet"
    for side in range(2, 5):
        for _ in range(5):
            label.update((("tv", 0.9),), view=(side, "whole"))
    assert label.best == "tv", "whole views from three other sides turn it"


def test_what_only_ever_shows_in_part_gets_a_name_too():
    label = LabelBelief()
    for side in range(3):
        for _ in range(10):
            label.update((("cabinet", 0.7), ("desk", 0.1)), 0.6, view=side, trust=0.25)
    assert label.best == "cabinet"
    assert label.confidence > 0.6


def test_a_look_alike_in_an_unexplored_place_is_new_and_in_an_inspected_place_is_the_old_one():
    known = thing(1, seen=(0.0, 10.0))
    assert moved(thing(2, seen=(600.0, 601.0)), [known], place_known=False) is None
    assert moved(thing(2, seen=(600.0, 601.0)), [known], place_known=True) is known


def test_what_was_seen_at_its_place_a_moment_ago_is_not_what_is_seen_at_another():
    known = thing(1, seen=(0.0, 10.0))
    assert moved(thing(2, seen=(60.0, 61.0)), [known], place_known=True) is None
    known.state = ObjectState.MISSING
    assert moved(thing(2, seen=(60.0, 61.0)), [known], place_known=True) is known


def test_one_of_several_present_look_alikes_is_never_taken_for_the_moved_one():
    twins = [thing(1), thing(2)]
    assert moved(thing(3, seen=(500.0, 501.0)), twins) is None
    missing = thing(4, state=ObjectState.MISSING)
    assert moved(thing(3, seen=(500.0, 501.0)), [*twins, missing]) is missing


def test_what_the_hand_has_put_there_is_not_the_missing_thing_that_turned_up():
    missing, other = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    known = {"looked_before": {"room_1": 0.0}}
    assert turned_up(missing, [other], **known) is other
    other.note_hand(HandDid.PUT, 15.0)
    assert turned_up(missing, [other], **known) is None


def test_where_such_things_come_in_numbers_one_that_was_hidden_so_far_is_not_the_missing_one():
    missing, hidden_so_far = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    hidden_so_far.put_at("room_1", np.array((0.3, 0.0, 0.0)), 0.01)
    beside = thing(3, seen=(0.0, 21.0))
    beside.put_at("room_1", np.array((0.4, 0.0, 0.0)), 0.01)
    known = {"looked_before": {"room_1": 0.0}}
    assert turned_up(missing, [hidden_so_far], **known) is hidden_so_far
    assert turned_up(missing, [beside, hidden_so_far], **known) is None
    gone_too = thing(3, seen=(0.0, 5.0), state=ObjectState.MISSING)
    assert turned_up(missing, [gone_too, hidden_so_far], **known) is hidden_so_far


@pytest.mark.parametrize(
    ("look", "apart_m", "one"),
    [({}, 0.02, True), ({}, 0.05, False), ({"label": "cup"}, 0.02, False), ({"size_m": (0.3, 0.3, 0.5)}, 0.02, False)],
)
def test_a_missing_thing_is_the_one_like_it_that_is_seen_in_its_very_place_since_when_ever(look, apart_m, one):
    missing, seen = thing(1, state=ObjectState.MISSING), thing(2, seen=(5.0, 21.0), **look)
    seen.put_at("room_1", np.array((apart_m, 0.0, 0.0)), 0.01)
    elsewhere = thing(3, seen=(0.0, 5.0))
    elsewhere.put_at("room_1", np.array((1.0, 0.0, 0.0)), 0.01)
    assert (turned_up(missing, [elsewhere, seen]) is seen) is one
    seen.note_hand(HandDid.PUT, 15.0)
    assert turned_up(missing, [elsewhere, seen]) is None


def nothing_seen(room, snapshot):
    """One frame that shows nothing, in ``room``."""
    base = SE3.identity()
    frame = rgbd_frame(render([], base), stamp_s=1.0, T_base_camera=base)
    view = View.of(frame, room=room, T_room_base=base, pose_covariance=np.zeros((6, 6)))
    return Sight(view=view, detections=[], surroundings=Surroundings(snapshot, room))


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


@pytest.mark.parametrize(
    ("label", "size_m", "present", "missing"),
    [
        ("book", (0.2, 0.1, 0.04), True, True),
        ("book", (0.3, 0.3, 0.04), False, True),
        ("sofa", (2.0, 0.9, 0.8), False, False),
    ],
)
def test_what_is_missing_may_be_carried_if_things_of_that_name_are(label, size_m, present, missing):
    for state, graspable in ((ObjectState.PRESENT, present), (ObjectState.MISSING, missing)):
        track = thing(1, label, size_m=size_m, state=state)
        assert node_of("thing_1", track, None, None).graspable is graspable


@pytest.mark.parametrize(
    ("at", "same"),
    [((0.4, 0.3, 0.12), True), ((0.3, 0.2, 0.6), True), ((3.0, 1.0, 0.12), True), ((3.0, 1.0, 0.6), False)],
)
def test_what_fell_from_the_hand_lies_near_there_or_on_the_floor_and_a_look_alike_on_another_table_is_another(at, same):
    fallen, sighting = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    sighting.put_at("room_1", np.array(at), 0.01)
    known = {"looked_before": {"room_1": 0.0}}
    assert moved(sighting, [fallen]) is fallen, "somebody may have put it anywhere"
    assert turned_up(fallen, [sighting], **known) is sighting
    fallen.note_hand(HandDid.DROPPED, 15.0)
    assert (moved(sighting, [fallen]) is fallen) is same
    assert (turned_up(fallen, [sighting], **known) is sighting) is same


def banana_like(number, **fields):
    """What may be a book, but looks more like a banana."""
    sighting = thing(number, "banana", **fields)
    sighting.label = LabelBelief()
    for _ in range(5):
        sighting.label.update((("banana", 0.8), ("book", 0.1)))
    return sighting


@pytest.mark.parametrize("state", [ObjectState.PRESENT, ObjectState.MISSING])
@pytest.mark.parametrize(
    ("look", "at_x_m", "same"),
    [({}, 0.03, True), ({}, 0.3, False), ({"color": "red"}, 0.03, False), ({"size_m": (0.3, 0.2, 0.05)}, 0.03, False)],
)
def test_what_looks_the_same_in_the_very_place_of_a_thing_is_that_thing_whatever_it_is_called(
    state, look, at_x_m, same
):
    book = thing(1, "book", state=state)
    sighting = banana_like(2, seen=(20.0, 21.0), **look)
    sighting.put_at("room_1", np.array((at_x_m, 0.0, 0.0)), 0.01)
    assert (taken_for(sighting, [book]) is book) is same
    if state is ObjectState.MISSING:
        assert (turned_up(book, [sighting], looked_before={"room_1": 0.0}) is sighting) is same


@pytest.mark.parametrize(
    ("look", "same"),
    [
        ({}, True),
        ({"color": "red"}, False),
        ({"size_m": (0.3, 0.2, 0.05)}, False),
        ({"seen": (5.0, 21.0)}, False),
    ],
)
def test_what_slipped_is_known_by_its_looks_where_it_lies_even_if_it_is_called_otherwise_there(look, same):
    slipped, far = (thing(n, "book", state=ObjectState.MISSING) for n in (1, 2))
    far.put_at("room_1", np.array((3.0, 0.0, 0.0)), 0.01)
    slipped.put_at("room_1", np.array((0.5, 0.0, 0.0)), 0.01)
    sighting = banana_like(3, **{"seen": (20.0, 21.0), **look})
    assert not alike(Pair(Subject.of(sighting), slipped, Moment()))
    assert taken_for(sighting, [far, slipped]) is None
    for track in (far, slipped):
        track.note_hand(HandDid.DROPPED, 15.0)
    assert (taken_for(sighting, [far, slipped]) is slipped) is same


def nameless(number, size_m, color, at, **fields):
    sighting = thing(number, "unknown", color, size_m, **fields)
    sighting.put_at("room_1", np.array(at), 0.01)
    return sighting


@pytest.mark.parametrize(
    ("look", "same"),
    [
        ({}, True),
        ({"at": (2.0, 0.0, 0.04)}, False),
        ({"color": "blue"}, False),
        ({"size_m": (0.25, 0.2, 0.15)}, False),
        ({"seen": (5.0, 21.0)}, False),
    ],
)
def test_a_can_that_was_knocked_down_is_what_lies_below_as_large_and_as_red_though_nobody_can_name_it(look, same):
    can = thing(1, "can", "red", (0.066, 0.066, 0.12), state=ObjectState.MISSING)
    can.put_at("room_1", np.array((0.0, 0.0, 0.96)), 0.03)
    lying = {"size_m": (0.12, 0.068, 0.066), "color": "red", "at": (0.2, 0.3, 0.04), "seen": (20.0, 21.0)}
    sighting = nameless(2, **{**lying, **look})
    assert (taken_for(sighting, [can]) is can) is same
    assert (turned_up(can, [sighting], looked_before={"room_1": 0.0}) is sighting) is same
    can.state = ObjectState.PRESENT
    assert taken_for(sighting, [can]) is None


@pytest.mark.parametrize(("long_m", "same"), [(0.2, True), (0.14, False)])
def test_a_book_that_fell_on_its_edge_is_the_book_though_the_network_is_sure_that_it_is_a_banana(long_m, same):
    book = thing(1, "book", "yellow", (0.2, 0.09, 0.036), state=ObjectState.MISSING)
    book.put_at("room_1", np.array((0.0, 0.0, 0.02)), 0.5)
    book.note_hand(HandDid.DROPPED, 15.0)
    sighting = thing(2, "banana", "yellow", (long_m, 0.039, 0.086), seen=(20.0, 21.0))
    sighting.put_at("room_1", np.array((0.05, -0.03, 0.49)), 0.01)
    assert (taken_for(sighting, [book]) is book) is same


@pytest.mark.parametrize(
    ("touched", "at", "color", "same"),
    [
        (True, (0.6, 0.4, 0.02), "yellow", True),
        (False, (0.6, 0.4, 0.02), "yellow", False),
        (True, (1.6, 0.4, 0.02), "yellow", False),
        (True, (0.6, 0.4, 0.02), "red", False),
    ],
)
def test_what_the_hand_has_knocked_off_a_desk_is_what_lies_near_below_though_surely_called_otherwise(
    touched, at, color, same
):
    book = thing(1, "book", "yellow", (0.2, 0.085, 0.035), state=ObjectState.MISSING)
    book.put_at("room_1", np.array((0.0, 0.0, 0.77)), 0.01)
    if touched:
        book.note_hand(HandDid.TOUCHED, 15.0)
    sighting = thing(2, "banana", color, (0.195, 0.088, 0.02), seen=(20.0, 21.0))
    sighting.put_at("room_1", np.array(at), 0.01)
    assert (taken_for(sighting, [book]) is book) is same


@pytest.mark.parametrize(
    ("label", "state", "same"),
    [
        ("stove", ObjectState.PRESENT, False),
        ("stove", ObjectState.MISSING, True),
        ("chair", ObjectState.PRESENT, True),
    ],
)
def test_what_is_built_in_is_not_taken_for_moved_as_long_as_it_may_be_in_its_place(label, state, same):
    size_m = (0.6, 0.6, 0.9)
    known = thing(1, label, size_m=size_m, state=state)
    sighting = thing(2, label, size_m=size_m, seen=(600.0, 601.0))
    for track, x_m in ((known, 0.0), (sighting, 1.0)):
        track.place = SurfaceBelief.of(Box(np.array((x_m, 0.0, 0.45)), size_m, 0.0), frames=50)
    assert (moved(sighting, [known]) is known) is same


def agree(one, other):
    return likeness(Pair(Subject.of(one), other, Moment()))


def test_likeness_is_symmetric():
    a, b = thing(1), thing(2, label="vase", size_m=(0.1, 0.1, 0.2))
    assert agree(a, b) == pytest.approx(agree(b, a))
    assert agree(a, thing(3)) == pytest.approx(1.0, abs=0.01)


SQUARE = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
ELL = ((0.0, 0.0), (4.0, 0.0), (4.0, 2.0), (2.0, 2.0), (2.0, 4.0), (0.0, 4.0))


@given(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))
def test_the_signed_distance_from_a_square_has_the_right_sign_and_size(x, y):
    expected = max(abs(x), abs(y)) - 1.0
    (distance,) = Outline(SQUARE).outside_m(np.array(((x, y),)))
    if expected <= 0.0 or min(abs(x), abs(y)) <= 1.0:
        assert distance == pytest.approx(expected, abs=1e-9)
    else:
        assert distance == pytest.approx(np.hypot(abs(x) - 1.0, abs(y) - 1.0), abs=1e-9)


def test_a_room_may_have_a_corner_cut_out():
    outside_m, inside_m = Outline(ELL).outside_m(np.array(((3.0, 3.0), (1.0, 3.0))))
    assert outside_m == pytest.approx(1.0)
    assert inside_m < 0.0


def door_between(room, other):
    door = DoorNode(id=f"door_{room[5:]}_0_0", rooms=(room, other), width_m=0.9, provisional=False)
    return [
        PutNode(door),
        PutEdge(RtEdge(source=room, target=door.id, T_source_target=SE3.from_xyz_yaw(3.0, 0.0, 0.0, np.pi))),
        PutEdge(ConnectsEdge(source=door.id, target=room)),
        PutEdge(ConnectsEdge(source=door.id, target=other)),
    ]


def two_rooms():
    memory = furnished_memory(rooms=2)
    return memory.commit(door_between("room_1", "room_2"), agent="door_concept", stamp_s=0.0)


def looked_at(belief, name, other, sides, frames, weight):
    for side in sides:
        for _ in range(frames):
            belief.update(((name, 0.85), (other, 0.1)), weight, side)
    return belief


def test_glimpses_in_passing_do_not_push_out_what_was_looked_at():
    belief = looked_at(LabelBelief(), "book", "banana", range(4), 12, 1.0)
    assert looked_at(belief, "banana", "book", range(10, 18), 1, 0.4).best == "book"


def test_as_many_good_looks_that_agree_turn_a_belief():
    belief = looked_at(LabelBelief(), "book", "banana", range(4), 12, 1.0)
    assert looked_at(belief, "banana", "book", range(10, 13), 12, 1.0).best == "banana"


def test_what_was_seen_from_near_is_not_called_otherwise_because_of_how_it_looks_from_afar():
    belief = looked_at(LabelBelief(), "book", "banana", range(2), 12, 1.0)
    assert looked_at(belief, "banana", "book", range(10, 15), 60, 0.2).best == "book"


def test_what_was_only_ever_seen_from_afar_gets_its_name_from_there_until_it_is_seen_from_near():
    far, near = (looked_at(LabelBelief(), "banana", "book", range(4), 60, weight) for weight in (0.2, 1.0))
    assert far.best == "banana"
    assert far.confidence == pytest.approx(near.confidence, abs=0.01)
    assert looked_at(far, "book", "banana", [10], 12, 1.0).best == "book"


def test_a_point_behind_the_door_belongs_to_the_room_behind_the_door_and_one_outside_to_none():
    surroundings = Surroundings(two_rooms(), "room_1")
    assert surroundings.room_of(np.array((1.0, 0.0, 0.5))) == "room_1"
    assert surroundings.room_of(np.array((4.5, 0.5, 0.5))) == "room_2"
    assert surroundings.room_of(np.array((3.02, 0.0, 0.5))) == "room_1"
    assert surroundings.room_of(np.array((-4.5, 0.0, 0.5))) is None


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


def test_a_thing_changes_its_room_only_when_it_is_clearly_outside():
    surroundings = Surroundings(two_rooms(), "room_1")
    assert surroundings.settled_room("room_1", np.array((3.1, 0.0, 0.5))) == "room_1"
    assert surroundings.settled_room("room_1", np.array((3.6, 0.0, 0.5))) == "room_2"
    assert surroundings.settled_room("room_2", np.array((-4.0, 0.0, 0.5))) == "room_1"


@pytest.mark.parametrize(
    ("name", "rgb"),
    [
        ("brown", (163, 115, 66)), ("brown", (139, 69, 19)), ("blue", (15, 23, 97)), ("red", (115, 15, 26)),
        ("green", (122, 122, 31)), ("green", (140, 217, 38)), ("yellow", (204, 166, 46)), ("cyan", (26, 122, 128)),
        ("pink", (204, 26, 153)), ("beige", (224, 209, 173)), ("white", (204, 224, 235)),
    ],
)  # fmt: skip
def test_less_usual_colors_go_to_the_nearest_common_name(name, rgb):
    assert named_color(*rgb) == name


def test_a_persons_word_stands_above_what_the_network_says():
    belief = LabelBelief()
    belief.teach("vase")
    for _ in range(50):
        belief.update((("bottle", 0.9),))
    assert belief.distribution == (("vase", 1.0),)


@given(st.floats(0.55, 0.65), st.floats(0.55, 0.65), st.floats(-1.5, 1.5), st.floats(-1.5, 1.5), st.floats(-0.02, 0.02))
def test_a_point_on_a_stove_stays_where_it_is_whichever_of_its_sides_looks_longer(x_m, y_m, yaw_rad, before_rad, more):
    box = Box(np.array((1.0, 2.0, 0.45)), (x_m, y_m, 0.9), yaw_rad)
    first = turned_like(box, before_rad)
    assert first.contains(box.place(np.array(((0.5 * x_m, 0.5 * y_m, 0.1), (-0.5 * x_m, 0.5 * y_m, 0.1)))), 1e-6).all()
    other = Box(box.center, (y_m, x_m, 0.9), yaw_rad + more + np.pi / 2)  # the other side is the longer one
    again = turned_like(other, first.yaw_rad)
    spot = np.array(((0.2, 0.1, 0.45),))
    assert np.linalg.norm(first.place(spot) - again.place(spot)) < 0.01


def test_a_long_thing_keeps_its_length_along_its_first_axis():
    box = Box(np.zeros(3), (1.4, 0.6, 0.9), 1.5)
    assert turned_like(box, 0.0) is box


@pytest.mark.parametrize(
    ("awaited", "at", "color", "same"),
    [
        (True, (0.06, 0.05, 0.46), "yellow", True),  # half hidden by the hand, nameless and too short
        (True, (0.3, 0.0, 0.46), "yellow", False),
        (True, (0.06, 0.05, 0.46), "blue", False),
        (False, (0.06, 0.05, 0.46), "yellow", False),  # seen since it was put there: this is another
    ],
)
def test_what_is_seen_where_the_hand_has_just_put_something_is_that(awaited, at, color, same):
    nameless = {"label": "unknown", "size_m": (0.09, 0.07, 0.03)}
    book = thing(1, "book", "yellow", (0.2, 0.09, 0.03), seen=(0.0, 19.9))
    lost = thing(2, color="yellow", state=ObjectState.MISSING, **nameless)
    part = thing(3, color=color, seen=(20.0, 21.0), **nameless)
    if awaited:
        book.note_hand(HandDid.PUT, 20.0)
    book.put_at("room_1", np.array((0.0, 0.0, 0.46)), 0.03)
    part.put_at("room_1", np.array(at), 0.01)
    assert (taken_for(part, [lost, book]) is book) is same


@pytest.mark.parametrize(
    ("label", "size_m", "known_as", "known_m", "part_of_it"),
    [
        ("stove", (0.62, 0.6, 0.9), "counter", (2.05, 0.6, 0.9), False),  # what is left is a counter still
        ("washing machine", (0.6, 0.6, 0.85), "counter", (1.7, 0.6, 0.9), False),
        ("stove", (0.3, 0.2, 0.9), "counter", (2.05, 0.6, 0.9), True),  # no stove is as narrow
        ("bin", (0.3, 0.3, 0.4), "toilet", (0.7, 0.4, 0.8), True),
        ("washing machine", (0.6, 0.6, 0.85), "fridge", (0.65, 0.65, 1.8), True),  # nothing would be left
        ("desk", (1.0, 0.6, 0.75), "table", (2.0, 0.8, 0.75), True),  # of any size: may be the same piece
    ],
)
def test_an_appliance_in_a_row_is_a_piece_of_its_own_though_never_seen_as_a_whole(
    label, size_m, known_as, known_m, part_of_it
):
    known, part = seen(known_as, known_m, 1), seen(label, size_m, 2)
    at_the_end = np.array(((known_m[0] - size_m[0]) / 2, 0.0, size_m[2] / 2))
    for view in ("left", "right"):
        part.label.update(((label, 0.97),), view=view)
    part.place = SurfaceBelief.of(Box(at_the_end, size_m, 0.0))
    part.seen_whole = False
    assert is_part(part, known) is part_of_it


def test_fruits_are_not_as_broad_as_a_book():
    assert oversize("banana", (0.2, 0.085, 0.04)) > 2.0
    assert oversize("banana", (0.2, 0.05, 0.04)) < 1.3
    assert oversize("book", (0.3, 0.25, 0.04)) == 1.0
    assert oversize("apple", (0.09, 0.09, 0.09)) < 1.3


def test_a_yellow_book_is_no_banana_though_every_view_says_so():
    """Without a name it can be known by its looks; as a banana, nobody would look for the book there."""
    belief = LabelBelief()
    for view, frame in enumerate(((("banana", 0.93), ("book", 0.02)), (("banana", 0.96), ("book", 0.01))) * 2):
        for _ in range(8):
            belief.update(frame, view=view)
            belief.measure((0.195, 0.0883, 0.035))
    assert belief.best == UNKNOWN_LABEL
    banana = LabelBelief()
    for view in range(4):
        banana.update((("banana", 0.93), ("book", 0.02)), view=view)
        banana.measure((0.195, 0.05, 0.035))
    assert banana.best == "banana"


def test_a_yellow_thing_too_broad_for_a_banana_is_a_book_though_most_views_said_banana():
    belief = LabelBelief()
    for view in range(5):
        for _ in range(10):
            belief.update((("banana", 0.55), ("book", 0.4)), view=view)
    assert belief.best == "banana"
    belief.measure((0.2, 0.05, 0.04))
    assert belief.best == "banana"
    belief.measure((0.2, 0.087, 0.033))
    assert belief.best == "book"


def _filled(x_m, y_m, z_m=(0.4, 0.9), step_m=0.03):
    ticks = [np.arange(low, high, step_m) for low, high in (x_m, y_m, z_m)]
    return np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1).reshape(-1, 3)


CHAIR = _filled((0.0, 0.45), (0.0, 0.45))


@pytest.mark.parametrize(
    ("beside", "long_m"),
    [
        (_filled((-0.45, -0.4), (0.0, 0.45)), 0.45),  # an edge of a desk, across a gap
        (_filled((-0.45, -0.2), (0.0, 0.45)), 0.9),  # half of it hidden: what is large belongs to it
        (_filled((-0.45, 0.0), (0.0, 0.1)), 0.9),  # no gap
        (np.zeros((0, 3)), 0.45),
    ],
)
def test_an_edge_of_what_stands_beside_a_chair_makes_it_no_longer(beside, long_m):
    memory = SurfaceMemory()
    memory.add(np.concatenate((CHAIR, beside)), frames=3.0)
    box = furniture_box(memory, category_of("chair"), np.array((0.2, -2.0, 1.3)))
    assert max(box.size_m[:2]) == pytest.approx(long_m, abs=0.06)


@pytest.mark.parametrize("size_m", [(2.6, 0.9, 0.75), (0.5, 0.5, 0.9), (1.9, 0.35, 2.0)])
def test_a_remembered_box_of_any_length_hangs_together(size_m):
    belief = SurfaceBelief.of(Box(np.array((1.0, 1.0, size_m[2] / 2)), size_m, 0.3))
    box = furniture_box(belief.memory, category_of("chair"), np.array((1.0, -2.0, 1.3)))
    assert box.size_m == pytest.approx(size_m, abs=0.08)


@pytest.mark.parametrize("turn", [0.0, 0.7])
@pytest.mark.parametrize(
    ("high", "side"),
    [
        (_filled((-0.22, 0.22), (0.2, 0.23), (0.5, 0.9), step_m=0.04), 1),
        (_filled((-0.22, -0.2), (-0.2, 0.23), (0.5, 0.9), step_m=0.04), 2),
        (_filled((-0.22, 0.22), (0.2, 0.23), (0.5, 0.6), step_m=0.04), None),  # an arm is lower
        (_filled((-0.22, 0.22), (-0.22, 0.22), (0.5, 0.9), step_m=0.04), None),
        (np.zeros((0, 3)), None),
    ],
)
def test_the_back_of_a_chair_is_on_the_side_that_is_higher(high, side, turn):
    """Counted in quarter turns from its own x axis."""
    box = Box(np.array((2.0, 1.0, 0.45)), (0.45, 0.46, 0.9), turn)
    seat = _filled((-0.22, 0.22), (-0.22, 0.22), (0.4, 0.45), step_m=0.04)
    c, s = np.cos(turn), np.sin(turn)
    points = np.vstack((seat, high)) @ np.array(((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))) + (2.0, 1.0, 0.0)
    back = back_of(points, box)
    if side is None:
        assert back is None
    else:
        assert np.angle(np.exp(1j * (back.toward_rad - turn - side * np.pi / 2))) == pytest.approx(0.0, abs=1e-6)
        assert back.face_m == pytest.approx(0.21, abs=0.015)


def test_where_the_back_of_a_chair_is_outlives_a_restart_and_a_change_of_frame():
    node = ObjectNode(id="chair_1", label="chair", size_m=(0.45, 0.46, 0.9), back_rad=np.pi / 2, back_m=0.19)
    track = Track(1, "room_1", settings=TrackSettings(), random=np.random.default_rng(0))
    track.adopt(node, SE3.from_xyz_yaw(1.0, 0.0, 0.45, 0.3), np.eye(3) * 1e-4)
    assert node_of("chair_1", track, node, None).back_rad == pytest.approx(np.pi / 2, abs=1e-3)
    track.change_room("room_2", SE3.from_xyz_yaw(0.0, 0.0, 0.0, 1.0))
    moved = node_of("chair_1", track, node, None)
    assert (moved.back_rad, moved.back_m) == (pytest.approx(np.pi / 2, abs=1e-3), 0.19)


COUNTER = _filled((0.0, 1.5), (0.0, 0.6), (0.3, 0.9), step_m=0.05)
BOXES = _filled((0.2, 1.3), (0.1, 0.5), (0.9, 1.2), step_m=0.05)
CAMERA = np.array((0.7, -2.0, 1.3))


def look_at_counter(belief, points, frames, **more):
    for _ in range(frames):
        belief.observe(points, np.eye(6)[:3, :3] * 1e-6, category_of("counter"), CAMERA, **more)
    return belief.box.size_m[2]


@pytest.mark.parametrize("called", ["stove", "counter"])
@pytest.mark.parametrize("long_m", [0.66, 0.75])
def test_a_stove_in_a_row_of_counters_stays_a_stove_however_long_one_mask_shows_both(long_m, called):
    stove = seen("stove", (long_m, 0.6, 0.9), 1)
    stove.hits = 100
    row = _filled((-0.33, 1.5), (-0.3, 0.3), (0.0, 0.9), step_m=0.03)
    for _ in range(300):
        own = stove._own(row, called, [])
        assert np.ptp(own[:, 0]) < 0.8
        stove.place.observe(own, np.eye(3) * 1e-6, category_of("stove"), CAMERA, top_shown=True)
    assert max(stove.box.size_m[:2]) < 0.85


def test_what_is_put_on_a_counter_does_not_make_it_higher():
    belief = SurfaceBelief()
    assert look_at_counter(belief, COUNTER, 60) == pytest.approx(0.89, abs=0.04)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 15) == pytest.approx(0.89, abs=0.06)


def test_a_counter_known_from_before_a_restart_does_not_grow_either():
    belief = SurfaceBelief.of(Box(np.array((0.75, 0.3, 0.45)), (1.5, 0.6, 0.9), 0.0), frames=200)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 60) == pytest.approx(0.9, abs=0.06)


def test_a_piece_that_was_forgotten_and_remembered_time_and_again_is_as_large_as_before():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 5)
    before = belief.box
    for _ in range(20):
        belief = SurfaceBelief.of(belief.box, frames=5)
        look_at_counter(belief, COUNTER, 5)
    assert belief.box.size_m == pytest.approx(before.size_m, abs=0.01)
    assert belief.box.center == pytest.approx(before.center, abs=0.01)


def test_a_piece_grows_to_its_height_while_that_is_not_sure():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 10)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 10) == pytest.approx(1.18, abs=0.06)


def test_a_piece_whose_top_the_picture_cut_off_grows_however_long_it_was_looked_at():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 100, top_shown=False)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 10) == pytest.approx(1.18, abs=0.06)


def test_a_height_that_frame_after_frame_denies_is_given_up():
    belief = SurfaceBelief()
    look_at_counter(belief, COUNTER, 60)
    assert look_at_counter(belief, np.vstack((COUNTER, BOXES)), 200) == pytest.approx(1.18, abs=0.06)


@pytest.mark.parametrize(("yields", "long_m"), [(True, 0.95), (False, 1.47)])
def test_a_counter_gives_up_what_turns_out_to_be_another_piece(yields, long_m):
    stove, counter = Box(np.array((1.25, 0.3, 0.45)), (0.6, 0.7, 0.95), 0.0), SurfaceBelief()
    look_at_counter(counter, COUNTER, 5)
    for _ in range(10):
        counter.yield_to([stove] if yields else [])
        look_at_counter(counter, COUNTER[COUNTER[:, 0] < 0.93], 1)
    assert max(counter.box.size_m[:2]) == pytest.approx(long_m, abs=0.04)
