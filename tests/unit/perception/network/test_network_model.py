"""The network from its file: pixels in, instances out, off the event loop, and faults that pass."""

from __future__ import annotations

import asyncio
import threading
import time
from dataclasses import replace

import numpy as np
import pytest

from paths import DATA
from perception.errors import PerceptionError
from perception.network.model import OnnxPanopticModel
from perception.network.resize import FixedSize, ShorterSide, input_tensor, place
from perception.objects.agent import ObjectMemory
from perception.objects.doubles.raycast import Solid
from perception.objects.doubles.scripted import NoSensors, ScriptedRoom, furnished_memory
from perception.objects.errors import InferenceFailed
from perception.ports import Intrinsics, RgbdFrame
from perception.sensing import SensorBuffer
from scene_graph.geometry.se3 import SE3

NETWORKS = DATA / "network"
HEIGHT, WIDTH = 240, 320
RED_AT, GREEN_AT, BLUE_AT = ((slice(60, 120), slice(40, 120)), (slice(60, 180), slice(180, 280)),
                             (slice(0, 40), slice(0, 320)))  # fmt: skip
CUP_SOLID = Solid(label="cup", center=(0.0, 0.0, 0.80), size_m=(0.4, 0.4, 0.4), color=(230.0, 30.0, 30.0))


@pytest.fixture(scope="module")
def model():
    return OnnxPanopticModel.load(NETWORKS / "colors.onnx")


@pytest.fixture(scope="module")
def fragile():
    """Gives no numbers in dark images."""
    return OnnxPanopticModel.load(NETWORKS / "fragile.onnx")


def frame_of(rgb, depth_m=None, size=(HEIGHT, WIDTH)):
    return RgbdFrame(
        stamp_s=3.0,
        rgb=rgb,
        depth_m=np.ones(size, dtype=np.float32) if depth_m is None else depth_m,
        intrinsics=Intrinsics(fx=277.0, fy=277.0, cx=159.5, cy=119.5, width=size[1], height=size[0]),
        T_base_camera=SE3.identity(),
    )


def picture(height=HEIGHT, width=WIDTH):
    rgb = np.full((height, width, 3), 20, dtype=np.uint8)
    rgb[RED_AT], rgb[GREEN_AT], rgb[BLUE_AT] = (250, 20, 20), (20, 250, 20), (20, 20, 250)
    return rgb


def iou(mask, place):
    truth = np.zeros_like(mask)
    truth[place] = True
    return (mask & truth).sum() / (mask | truth).sum()


def test_red_green_and_blue_arrive_where_they_are_in_the_frame():
    scene = OnnxPanopticModel.load(NETWORKS / "instances.onnx").understand(frame_of(picture()))
    found = {i.label: i.mask for i in scene.instances}
    assert sorted(found) == sorted(i.label for i in scene.instances) == ["cup", "table", "wall"]
    for label, place_in_frame in (("cup", RED_AT), ("table", GREEN_AT), ("wall", BLUE_AT)):
        assert found[label].shape == (HEIGHT, WIDTH)
        assert found[label].dtype == np.bool_
        assert iou(found[label], place_in_frame) > 0.9
    [relation] = scene.relations
    assert scene.instances[relation.subject].label == "cup"
    assert (relation.predicate, scene.instances[relation.object].label) == ("on", "table")
    assert scene.stamp_s == 3.0


@pytest.mark.parametrize("size", [(240, 320), (480, 640), (120, 400), (61, 47)])
def test_masks_have_the_size_of_the_frame_whatever_it_is(model, size):
    rgb = np.full((*size, 3), 20, dtype=np.uint8)
    rgb[size[0] // 4 : 3 * size[0] // 4, : size[1] // 2] = (250, 20, 20)
    [cup] = model.understand(frame_of(rgb, size=size)).instances
    assert cup.mask.shape == size
    assert iou(cup.mask, (slice(size[0] // 4, 3 * size[0] // 4), slice(0, size[1] // 2))) > 0.85


def test_colors_are_normalized_per_channel_in_the_order_red_green_blue():
    rgb = np.zeros((4, 6, 3), dtype=np.uint8)
    rgb[...] = (100, 150, 200)
    placement = place((4, 6), FixedSize(rule="fixed", height=8, width=9), (None, None))
    mean, std = np.array([90, 140, 190], np.float32), np.array([10, 5, 2], np.float32)
    tensor = input_tensor(rgb, placement, mean, std)
    assert (tensor.shape, tensor.dtype) == ((1, 3, 8, 9), np.float32)
    for channel, value in enumerate((1.0, 2.0, 5.0)):
        assert tensor[0, channel] == pytest.approx(value)


@pytest.mark.parametrize(
    ("frame", "expected"),
    [((480, 640), (800, 1067)), ((640, 480), (1067, 800)), ((400, 1000), (533, 1333)), ((800, 1333), (800, 1333))],
)
def test_psgtrs_resize_keeps_the_aspect_as_mmdetection_does(frame, expected):
    rule = ShorterSide(rule="shorter_side", size=800, longest=1333)
    assert rule.size_for(frame) == expected


def test_where_the_inputs_size_is_fixed_the_frame_is_fitted_in_and_padded():
    placement = place((480, 640), ShorterSide(rule="shorter_side", size=800, longest=1333), (400, 800))
    assert placement.canvas == (400, 800)
    assert placement.resized == (400, 533)
    tensor = input_tensor(
        np.full((480, 640, 3), 9, np.uint8), placement, np.zeros(3, np.float32), np.ones(3, np.float32)
    )
    assert tensor.shape == (1, 3, 400, 800)
    assert (tensor[..., :533] == 9).all()
    assert (tensor[..., 533:] == 0).all()


@pytest.mark.parametrize(
    ("frame", "named"),
    [
        (frame_of(picture().astype(np.float32)), "uint8"),
        (frame_of(picture()[..., 0]), "(H, W, 3)"),
        (frame_of(np.zeros((0, 0, 3), np.uint8), size=(0, 0)), "(H, W, 3)"),
        (frame_of(picture()[:100]), "depth"),
        (frame_of(picture(), depth_m=np.ones((10, 10), np.float32)), "depth"),
        (frame_of(np.zeros((HEIGHT, WIDTH, 3), np.uint8)), "black"),
        (frame_of(np.full((HEIGHT, WIDTH, 3), 255, np.uint8)), "saturated"),
    ],
)
def test_a_frame_that_cannot_be_understood_is_refused_with_the_reason(model, frame, named):
    with pytest.raises(InferenceFailed, match=r"no panoptic scene for the frame at 3\.00 s") as caught:
        asyncio.run(model.infer(frame))
    assert named in str(caught.value)


def test_outputs_that_are_no_numbers_are_an_error_and_the_next_frame_is_understood(fragile):
    bright = frame_of(np.full((HEIGHT, WIDTH, 3), 200, np.uint8))
    with pytest.raises(InferenceFailed, match="no finite numbers in sub_masks, obj_masks"):
        fragile.understand(frame_of(np.full((HEIGHT, WIDTH, 3), 60, np.uint8)))
    assert fragile.understand(bright).instances


def test_shapes_that_go_wrong_later_are_an_error_that_the_agent_expects(model):
    class Uneven:
        def run(self, names, feed, options):
            arrays = dict(zip(names, model._session.run(names, feed), strict=True))
            return [arrays[name][..., :-1] if name == "obj_masks" else arrays[name] for name in names]

    uneven = OnnxPanopticModel("uneven.onnx", Uneven(), model.description, model._signature)
    with pytest.raises(PerceptionError, match=r"uneven.*'obj_masks' should be"):
        uneven.understand(frame_of(picture()))


def test_the_event_loop_goes_on_while_the_network_works(model):
    threads = []

    class Slow:
        def run(self, names, feed, options):
            threads.append(threading.current_thread())
            time.sleep(0.2)
            return model._session.run(names, feed, options)

    async def story():
        slow = OnnxPanopticModel("slow", Slow(), model.description, model._signature)
        waiting = asyncio.create_task(slow.infer(frame_of(picture())))
        turns = 0
        while not waiting.done():
            turns += 1
            await asyncio.sleep(0.005)
        return turns, await waiting

    turns, scene = asyncio.run(story())
    assert turns > 5
    assert len(scene.instances) == 2
    assert threads[0] is not threading.main_thread()


def test_who_stops_waiting_ends_the_run_too(model):
    started, ended = threading.Event(), threading.Event()

    class Endless:
        def run(self, names, feed, options):
            started.set()
            while not options.terminate:
                time.sleep(0.001)
            ended.set()
            return model._session.run(names, feed)

    async def story():
        endless = OnnxPanopticModel("endless", Endless(), model.description, model._signature)
        waiting = asyncio.create_task(endless.infer(frame_of(picture())))
        await asyncio.to_thread(started.wait, 5.0)
        waiting.cancel()
        with pytest.raises(asyncio.CancelledError):
            await waiting
        return await asyncio.to_thread(ended.wait, 5.0)

    assert asyncio.run(story())


def test_many_frames_at_once_each_get_their_own_answer(model):
    async def story():
        return await asyncio.gather(*(model.infer(replace(frame_of(picture()), stamp_s=float(i))) for i in range(8)))

    scenes = asyncio.run(story())
    assert [scene.stamp_s for scene in scenes] == [float(i) for i in range(8)]
    assert all(np.array_equal(scene.instances[0].mask, scenes[0].instances[0].mask) for scene in scenes)


def test_the_same_frame_gives_the_same_scene(model):
    first, second = (model.understand(frame_of(picture())) for _ in range(2))
    assert [i.score for i in first.instances] == [i.score for i in second.instances]
    assert first.relations == second.relations


def test_the_objects_agent_survives_bad_frames_and_bad_numbers_and_recovers(fragile):
    room, memory, buffer = ScriptedRoom([CUP_SOLID]), furnished_memory(), SensorBuffer(NoSensors())
    agent = ObjectMemory(memory, buffer, fragile, random=np.random.default_rng(3))

    def look(stamp_s, color):
        room.locate(memory, stamp_s)
        room.fill(buffer, stamp_s)
        rgb = np.full_like(buffer.frame.rgb, color)
        rgb[::3, ::3] += np.uint8(1 if color < 255 else 0)
        buffer.frame = replace(buffer.frame, rgb=rgb)
        asyncio.run(agent.step(stamp_s))
        return agent.degraded

    assert look(0.2, 200) is None
    assert "no finite numbers" in look(0.4, 60)
    assert look(0.6, 200) is None
    assert "black" in look(0.8, 0)
    assert "saturated" in look(1.0, 255)
    assert look(1.2, 200) is None
