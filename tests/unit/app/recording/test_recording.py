"""Moments go into a file and come out bit for bit; what is cut off, damaged or foreign is told apart."""

from __future__ import annotations

import io
import json
import threading
from dataclasses import fields, replace
from functools import lru_cache

import numpy as np
import pytest

pytest.importorskip("mcap")
from mcap.reader import make_reader
from mcap.writer import Writer

from app.recording.errors import NoRecording, RecordingDamaged, RecordingExists
from app.recording.mcap_writer import McapWriter, RecordingSettings, free_path
from app.recording.messages import messages_of
from app.recording.moment import Moment
from app.recording.playback import Playback
from app.recording.profile import profile_of, settings_of
from app.recording.recorder import Recorder
from app.recording.topics import SCHEMAS
from app.settings import Settings
from perception.geometry.planar import Pose2
from perception.ports import Intrinsics, Odometry
from perception.sensing import SensorBuffer
from recorded_drive import ROOM, frame, joints
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from skills.ports import ArmTarget, BodyState
from unit.perception.lidar_house import cast

PROFILE = {"seed": "3", "explore": "False", "camera": "True", "camera_hz": "5.0", "house": "flat"}
GIGABYTE = 1_000_000_000
CHUNK_BYTES = 1 << 17
SMALL = RecordingSettings(chunk_bytes=CHUNK_BYTES)
HEIGHT, WIDTH = 48, 64


def body(stamp_s):
    told = joints(stamp_s)
    return BodyState(
        stamp_s=stamp_s,
        linear_mps=0.1,
        angular_radps=-0.2,
        arm=ArmTarget(lift_m=0.6, extension_m=1 / 3),
        gripper_opening_m=0.1,
        finger_contacts=(True, False),
        pan_rad=told.pan_rad,
        tilt_rad=told.tilt_rad,
        bumped=False,
        stopped=True,
        T_base_gripper=SE3.from_xyz_yaw(0.1, 1 / 7, 0.3, 0.7),
    )


@lru_cache(maxsize=64)
def moment(index, seen=False):
    now_s = 0.05 * index + 1e-13
    rng = np.random.default_rng(index)
    picture = replace(
        frame(now_s),
        rgb=rng.integers(0, 255, (HEIGHT, WIDTH, 3), dtype=np.uint8),
        depth_m=rng.uniform(0.0, 8.0, (HEIGHT, WIDTH)).astype(np.float32),
        intrinsics=Intrinsics(fx=55.0, fy=55.0, cx=31.5, cy=23.5, width=WIDTH, height=HEIGHT),
        T_base_camera=SE3.from_xyz_yaw(0.1, 0.2, 1.4, 1 / 3),
    )
    return Moment(
        now_s=now_s,
        body=body(now_s),
        odometry=Odometry(stamp_s=now_s, x_m=1 / 3, y_m=0.1, yaw_rad=-2.0, linear_mps=0.0, angular_radps=1e-17),
        scan=cast(ROOM, Pose2(1.0, 1.0, 0.1), rng, stamp_s=now_s),
        joints=joints(now_s),
        frame=picture if seen else None,
        T_map_base=SE3.identity(),
        building=WorkingMemory().building() if index == 0 else None,
    )


def same(one, other):
    """Whether all fields of two measurements are equal, arrays and transforms bit for bit."""
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other)
    if hasattr(one, "__dataclass_fields__"):
        return all(same(getattr(one, f.name), getattr(other, f.name)) for f in fields(one))
    return one == other


def recorded(path, moments):
    writer = McapWriter(path, PROFILE, limit_bytes=GIGABYTE, settings=SMALL)
    for one in moments:
        assert writer.put_patiently(one)
    writer.close()
    return path


@pytest.fixture(scope="module")
def tape_file(tmp_path_factory):
    return recorded(tmp_path_factory.mktemp("recording") / "drive.mcap", [moment(i, i % 4 == 0) for i in range(24)])


def test_what_is_recorded_comes_back_bit_for_bit(tape_file):
    with Playback(tape_file) as playback:
        again = list(playback.moments())
        assert playback.profile == PROFILE
        assert not playback.truncated
        assert [node["id"] for node in playback.graph["nodes"]] == ["root", "robot"]
    assert len(again) == 24
    for index, told in enumerate(again):
        before = moment(index, index % 4 == 0)
        for name in ("now_s", "body", "odometry", "scan", "joints", "frame"):
            assert same(getattr(told, name), getattr(before, name)), (index, name)


def test_any_reader_of_the_format_finds_its_topics_and_schemas(tape_file):
    with tape_file.open("rb") as file:
        reader = make_reader(file, validate_crcs=True)
        summary = reader.get_summary()
        counts = {summary.channels[key].topic: n for key, n in summary.statistics.channel_message_counts.items()}
        known = {schema.name: json.loads(schema.data) for schema in summary.schemas.values()}
        messages = [(schema.name, json.loads(told.data)) for schema, _, told in reader.iter_messages()]
    assert counts["/lidar"] == counts["/body"] == 24
    assert counts["/camera/color"] == counts["/camera/depth"] == counts["/camera/calibration"] == 6
    assert 2 <= counts["/lidar/points"] <= 4
    for name, content in messages:
        assert content.keys() >= {"now_s"} if name == "majordomo.BodyState" else content
        assert known[name]["properties"].keys() <= content.keys(), name


def test_a_recording_that_was_cut_off_is_played_up_to_there(tape_file, tmp_path):
    whole = tape_file.read_bytes()
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(whole[: int(0.7 * len(whole))])
    with Playback(cut) as playback:
        again = list(playback.moments())
    assert playback.truncated
    assert 0 < len(again) < 24
    assert same(again[-1].scan, moment(len(again) - 1).scan)


def test_what_was_written_when_the_process_is_killed_is_whole_chunks(tmp_path):
    path = tmp_path / "killed.mcap"
    writer = McapWriter(path, PROFILE, limit_bytes=GIGABYTE, settings=SMALL)
    for index in range(24):
        writer.put_patiently(moment(index, True))
    while writer.written < 24:
        threading.Event().wait(0.01)
    left = tmp_path / "left.mcap"
    left.write_bytes(path.read_bytes())  # what the disk has while nothing has been closed
    writer.close()
    with Playback(left) as playback:
        again = list(playback.moments())
    assert playback.truncated
    sizes = [
        sum(len(json.dumps(message)) for _, message in messages_of(moment(index, True), with_points=False))
        for index in range(24)
    ]
    assert len(again) > 0
    assert sum(sizes[len(again) :]) < CHUNK_BYTES + 2 * max(sizes)


@pytest.mark.parametrize("share", [0.3, 0.6])
def test_a_damaged_recording_is_told_with_how_far_it_is_sound(tape_file, tmp_path, share):
    data = bytearray(tape_file.read_bytes())
    at = int(share * len(data))
    data[at : at + 64] = bytes(64)
    damaged = tmp_path / "damaged.mcap"
    damaged.write_bytes(data)
    with pytest.raises(RecordingDamaged, match=r"damaged after [0-9.]+ s") as caught, Playback(damaged) as playback:
        list(playback.moments())
    assert 0.0 <= caught.value.sound_s < 1.2


def test_what_is_no_recording_is_refused(tmp_path):
    text, foreign, empty = tmp_path / "notes.txt", tmp_path / "other.mcap", tmp_path / "empty.mcap"
    text.write_text("not a recording at all")
    empty.write_bytes(b"")
    with foreign.open("wb") as file:
        writer = Writer(file)
        writer.start()
        schema = writer.register_schema("std_msgs/String", "ros2msg", b"string data")
        channel = writer.register_channel("/chatter", "cdr", schema)
        writer.add_message(channel, 0, b"1234", 0)
        writer.finish()
    with pytest.raises(NoRecording, match="no MCAP file"):
        Playback(text)
    with pytest.raises(NoRecording, match="nothing under /odometry"):
        Playback(empty)
    with pytest.raises(NoRecording, match=r"nothing under /odometry, .*; it holds /chatter"):
        Playback(foreign)
    with pytest.raises(FileNotFoundError):
        Playback(tmp_path / "nowhere.mcap")


def test_a_wrong_message_is_named(tmp_path):
    path = tmp_path / "wrong.mcap"
    buffer, odometry = io.BytesIO(), 0
    writer = Writer(buffer)
    writer.start()
    for topic, (name, schema) in SCHEMAS.items():
        schema_id = writer.register_schema(name, "jsonschema", json.dumps(schema).encode())
        channel = writer.register_channel(topic, "json", schema_id)
        odometry = channel if topic == "/odometry" else odometry
    writer.add_message(odometry, 0, b'{"stamp_s": "soon"}', 0)
    writer.finish()
    path.write_bytes(buffer.getvalue())
    with pytest.raises(RecordingDamaged, match="a message of /odometry is wrong: stamp_s"), Playback(path) as playback:
        list(playback.moments())


def test_no_file_is_written_over(tape_file):
    before = tape_file.read_bytes()
    with pytest.raises(RecordingExists, match="exists already"):
        McapWriter(tape_file, PROFILE, limit_bytes=GIGABYTE, settings=SMALL)
    assert tape_file.read_bytes() == before
    assert free_path(tape_file).name == "drive.2.mcap"


def test_a_recording_ends_soundly_at_its_limit(tmp_path, caplog):
    path = tmp_path / "small.mcap"
    writer = McapWriter(path, PROFILE, limit_bytes=2 * CHUNK_BYTES, settings=SMALL)
    index = 0
    while writer.put_patiently(moment(index % 8, True)):
        index += 1
        assert index < 200
    writer.close()
    assert not writer.running
    assert path.stat().st_size < 4 * CHUNK_BYTES
    assert "has reached its limit" in caplog.text
    with Playback(path) as playback:
        assert len(list(playback.moments())) == writer.written
    assert not playback.truncated


class FullWriter:
    """Takes every second moment."""

    running = True

    def __init__(self):
        self.taken, self.offered = [], 0

    def put(self, told):
        self.offered += 1
        if self.offered % 2:
            return False
        self.taken.append(told)
        return True

    put_patiently = put


class StillBody:
    async def state(self):
        return body(0.0)


@pytest.mark.anyio
@pytest.mark.parametrize("patient", [False, True])
async def test_what_found_no_room_is_told_with_the_next_moment(patient):
    writer, buffer = FullWriter(), SensorBuffer(port=None)
    recorder = Recorder(writer, WorkingMemory(), buffer, StillBody(), patient=patient, period_s=0.1)
    buffer.add_scan(moment(1).scan)
    for stamp_s in (0.1, 0.2, 0.3, 0.4):
        await recorder.step(stamp_s)
    assert [told.now_s for told in writer.taken] == [0.2, 0.4]
    assert writer.taken[0].scan is buffer.scan
    assert writer.taken[0].building is not None
    assert writer.taken[1].scan is writer.taken[1].building is None


def test_who_comes_too_fast_is_counted_and_never_waits(tmp_path, caplog):
    writer = McapWriter(tmp_path / "fast.mcap", PROFILE, limit_bytes=GIGABYTE, settings=SMALL)
    one = moment(0, True)
    taken = sum(writer.put(one) for _ in range(6 * SMALL.waiting_moments))
    writer.close()
    assert taken == writer.written
    assert taken + writer.dropped == 6 * SMALL.waiting_moments
    assert writer.dropped > 0
    assert "falls behind" in caplog.text


def test_a_replay_is_set_up_as_the_recording_was():
    made = Settings(seed=7, explore=False, camera_hz=2.5, house="office")
    again = settings_of(profile_of(made))
    assert (again.seed, again.explore, again.camera, again.camera_hz) == (7, False, True, 2.5)
    assert settings_of({"unheard": "of"}).seed == 0
