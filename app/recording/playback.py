"""A recording read moment by moment, in bounded memory."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any, BinaryIO, Self, cast

from mcap.exceptions import EndOfFile, InvalidMagic, McapError
from mcap.records import Channel, McapRecord, Message, Metadata
from mcap.stream_reader import CRCValidationError, StreamReader
from pydantic import BaseModel, ValidationError
from zstandard import ZstdError

from app.recording import topics
from app.recording.errors import NoRecording, RecordingDamaged
from app.recording.measurements import (
    BodyMessage,
    FrameMessage,
    ImageMessage,
    JointsMessage,
    LidarMessage,
    OdometryMessage,
)
from app.recording.moment import Moment
from perception.ports import RgbdFrame

LARGEST_RECORD_BYTES = 256 << 20
_UNREADABLE = (McapError, CRCValidationError, ZstdError, struct.error, ValueError, RuntimeError)
_MODELS: dict[str, type[BaseModel]] = {
    topics.ODOMETRY: OdometryMessage,
    topics.LIDAR: LidarMessage,
    topics.JOINTS: JointsMessage,
    topics.FRAME: FrameMessage,
    topics.COLOR: ImageMessage,
    topics.DEPTH: ImageMessage,
    topics.BODY: BodyMessage,
}


class Playback:
    """Moments of one file, oldest first. Use it as a context.

    Attributes:
        profile: how the recording was made.
        truncated: whether the file ended before its end was written, as after a crash; known at the end.
        graph: the newest graph that the recording held so far, as a document; empty if none.
        played_s: robot time of the newest moment, in seconds.
    """

    def __init__(self, path: Path) -> None:
        """Open the file and read how it begins.

        Raises:
            NoRecording: it is no MCAP file, or nobody's whom we know.
            OSError: it cannot be read.
        """
        self.path = path
        self.profile: dict[str, str] = {}
        self.truncated = False
        self.graph: dict[str, Any] = {}
        self.played_s = 0.0
        self._topics: dict[int, str] = {}
        self._file: BinaryIO = path.open("rb")
        self._records = self._read()
        try:
            self._begin()
        except BaseException:
            self._file.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def moments(self) -> Iterator[Moment]:
        """The moments; a body's message ends each.

        Raises:
            RecordingDamaged: the file cannot be read on.
        """
        told: dict[str, BaseModel] = {}
        for record in self._records:
            topic = self._topics.get(record.channel_id) if isinstance(record, Message) else None
            if topic == topics.GRAPH and isinstance(record, Message):
                self.graph = self._document(record)
            elif topic in _MODELS and isinstance(record, Message):
                told[topic] = self._parsed(topic, record)
                if topic == topics.BODY:
                    yield self._moment(told)
                    told.clear()

    def _begin(self) -> None:
        """Read until the first message; by then all channels of ours have been announced."""
        before: list[McapRecord] = []
        for record in self._records:
            before.append(record)
            if isinstance(record, Message):
                break
        if missing := [topic for topic in topics.NEEDED if topic not in self._topics.values()]:
            raise NoRecording(self.path, f"there is nothing under {', '.join(missing)}", self._topics.values())
        self._records = _chained(before, self._records)

    def _read(self) -> Iterator[McapRecord]:
        """All records; ends early, and remembers it, where the file does."""
        whole = cast("IO[bytes]", _WholeReads(self._file))
        reader = StreamReader(whole, validate_crcs=True, record_size_limit=LARGEST_RECORD_BYTES)
        try:
            for record in reader.records:
                if isinstance(record, Channel):
                    self._topics[record.id] = record.topic
                elif isinstance(record, Metadata) and record.name == topics.PROFILE:
                    self.profile = dict(record.metadata)
                yield record
        except EndOfFile:
            self.truncated = True
        except InvalidMagic:
            if not self._topics:
                raise NoRecording(self.path, "it is no MCAP file") from None
            raise RecordingDamaged(self.path, "it does not end as an MCAP file does", self.played_s) from None
        except _UNREADABLE as error:
            raise RecordingDamaged(self.path, f"{type(error).__name__}: {error}", self.played_s) from error

    def _document(self, record: Message) -> dict[str, Any]:
        try:
            document = json.loads(record.data)
        except ValueError as error:
            raise RecordingDamaged(self.path, f"{topics.GRAPH} holds no JSON: {error}", self.played_s) from error
        return document if isinstance(document, dict) else {}

    def _parsed(self, topic: str, record: Message) -> BaseModel:
        try:
            return _MODELS[topic].model_validate_json(record.data)
        except ValidationError as error:
            first = error.errors(include_url=False)[0]
            where = ".".join(str(part) for part in first["loc"])
            problem = f"a message of {topic} is wrong: {where}: {first['msg']}"
            raise RecordingDamaged(self.path, problem, self.played_s) from error

    def _moment(self, told: dict[str, BaseModel]) -> Moment:
        body = cast("BodyMessage", told[topics.BODY])
        try:
            moment = Moment(
                now_s=body.now_s,
                body=body.measurement,
                odometry=getattr(told.get(topics.ODOMETRY), "measurement", None),
                scan=getattr(told.get(topics.LIDAR), "measurement", None),
                joints=getattr(told.get(topics.JOINTS), "measurement", None),
                frame=_frame(told),
            )
        except ValueError as error:
            raise RecordingDamaged(self.path, str(error), self.played_s) from error
        self.played_s = body.now_s
        return moment


def _frame(told: dict[str, BaseModel]) -> RgbdFrame | None:
    """The frame, if all three of its messages were there."""
    frame, color, depth = (told.get(topic) for topic in (topics.FRAME, topics.COLOR, topics.DEPTH))
    if isinstance(frame, FrameMessage) and isinstance(color, ImageMessage) and isinstance(depth, ImageMessage):
        return frame.measurement(color, depth)
    return None


class _WholeReads:
    """A file that gives all the bytes that are asked for, or says that it ends; the reader takes less for more."""

    def __init__(self, file: BinaryIO) -> None:
        self._file = file

    def read(self, length: int) -> bytes:
        """``length`` bytes.

        Raises:
            EndOfFile: there are not as many.
        """
        data = self._file.read(length)
        if len(data) < length:
            raise EndOfFile
        return data


def _chained(before: list[McapRecord], after: Iterator[McapRecord]) -> Iterator[McapRecord]:
    yield from before
    before.clear()
    yield from after
