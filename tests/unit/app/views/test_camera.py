"""Looks through the camera as the interface shows them, out of a scripted room."""

from __future__ import annotations

import asyncio
import math

import cv2
import numpy as np
import pytest

from app.views.camera import KEPT, CameraWindow, FrameGone, Gaze
from perception.objects.agent import ObjectMemory
from perception.objects.doubles.raycast import Solid
from perception.objects.doubles.scripted import NoSensors, ScriptedRoom, furnished_memory
from perception.preview import outline_of
from perception.sensing import SensorBuffer

SOLIDS = [
    Solid(label="table", center=(0.0, 0.0, 0.375), size_m=(0.8, 1.0, 0.75)),
    Solid(label="bottle", center=(-0.1, 0.2, 0.86), size_m=(0.07, 0.07, 0.22), cylinder=True),
    Solid(label="person", center=(1.4, 1.0, 0.85), size_m=(0.4, 0.4, 1.7), cylinder=True),
]


class Watched:
    """The agent in its room, and the window onto what it sees."""

    def __init__(self):
        self.room, self.memory, self.buffer = ScriptedRoom(list(SOLIDS)), furnished_memory(), SensorBuffer(NoSensors())
        self.agent = ObjectMemory(self.memory, self.buffer, self.room, random=np.random.default_rng(3))
        self.window = CameraWindow(lambda: self.agent.look)
        self.now_s = 0.0

    def run(self, steps):
        for _ in range(steps):
            self.now_s = round(self.now_s + 0.2, 3)
            self.room.locate(self.memory, self.now_s)
            self.room.fill(self.buffer, self.now_s)
            asyncio.run(self.agent.step(self.now_s))

    def document(self, now_s=None):
        return asyncio.run(self.window.document(self.now_s if now_s is None else now_s))

    def picture(self, **options):
        encoded = asyncio.run(self.window.jpeg(**options))
        return cv2.imdecode(np.frombuffer(encoded, np.uint8), cv2.IMREAD_COLOR)


@pytest.fixture
def watched():
    watched = Watched()
    watched.run(8)
    return watched


def test_before_the_first_frame_there_is_nothing_to_show():
    watched = Watched()
    assert watched.document() is None
    assert asyncio.run(watched.window.jpeg()) is None


def test_what_is_seen_is_told_with_its_nodes_and_its_outline_and_the_age_of_the_frame(watched):
    document = watched.document(now_s=watched.now_s + 1.5)
    assert (document["stamp_s"], document["age_s"]) == (watched.now_s, pytest.approx(1.5))
    assert {seen["node"] for seen in document["instances"]} == {"table_1", "bottle_1", "person_1"}
    for seen in document["instances"]:
        assert seen["node"] == f"{seen['label']}_1"
        assert not seen["background"]
        left, top, right, bottom = seen["box_px"]
        assert 0 <= left < right <= document["width"]
        assert 0 <= top < bottom <= document["height"]
        inside = [left <= x < right and top <= y < bottom for part in seen["outline_px"] for x, y in part]
        assert inside
        assert all(inside)


def test_large_things_come_first_so_that_small_ones_can_be_drawn_on_top(watched):
    labels = [seen["label"] for seen in watched.document()["instances"]]
    assert labels.index("table") < labels.index("bottle")


def test_what_no_node_is_known_of_yet_has_none():
    watched = Watched()
    watched.run(1)
    assert {seen["node"] for seen in watched.document()["instances"]} == {None}


def test_the_picture_of_a_look_can_be_fetched_with_and_without_outlines_until_others_follow(watched):
    document = watched.document()
    stamp_s, size = document["stamp_s"], (document["height"], document["width"], 3)
    plain = watched.picture(stamp_s=stamp_s, outlines=False)
    assert plain.shape == size
    assert watched.picture(stamp_s=stamp_s).shape == (2 * size[0], 2 * size[1], 3)
    rgb = watched.agent.look.frame.rgb.astype(int)
    assert np.abs(plain[..., ::-1].astype(int) - rgb).mean() < 8.0
    for _ in range(KEPT):
        watched.run(1)
        watched.document()
    with pytest.raises(FrameGone):
        watched.picture(stamp_s=stamp_s)
    assert watched.picture().shape == (2 * size[0], 2 * size[1], 3)


def test_the_gaze_points_where_the_camera_does(watched):
    frame = watched.buffer.frame
    gaze = Gaze.of(frame, range_m=4.5)
    assert gaze.yaw_rad == pytest.approx(0.0, abs=1e-6), "the robot faces what it looks at"
    assert gaze.width_rad == pytest.approx(2 * math.atan(frame.intrinsics.width / 2 / frame.intrinsics.fx))


def test_an_outline_goes_round_every_part_of_a_mask_and_leaves_specks_out():
    mask = np.zeros((60, 80), dtype=bool)
    mask[10:20, 10:20] = mask[10:40, 50:70] = True
    mask[50, 5] = True
    outline = outline_of(mask)
    assert outline.box_px == (10, 10, 70, 40)
    assert [len(part) for part in outline.parts_px] == [4, 4]
    assert set(outline.parts_px[0]) == {(50, 10), (69, 10), (69, 39), (50, 39)}
    assert outline_of(np.zeros((60, 80), dtype=bool)) is None
