"""The MCAP file that moments are written to, by a thread of its own."""

from __future__ import annotations

import json
import logging
import queue
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mcap.well_known import MessageEncoding, SchemaEncoding
from mcap.writer import Writer

from app.recording.errors import RecordingExists
from app.recording.messages import messages_of, nanoseconds
from app.recording.moment import Moment
from app.recording.topics import PROFILE, SCHEMAS
from app.version import __version__

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class RecordingSettings:
    """How a recording is written; chosen."""

    chunk_bytes: int = 1 << 20
    """What is not yet in a whole chunk is lost when the process is killed."""
    waiting_moments: int = 64
    """So many may wait for the disk: some seconds."""
    points_period_s: float = 0.5
    """How often a scan is also told as a point cloud, which only people look at."""


def free_path(path: Path) -> Path:
    """``path``, or the first of ``NAME.2.mcap``, ``NAME.3.mcap``, … that is no file yet."""
    number, free = 1, path
    while free.exists():
        number += 1
        free = path.with_name(f"{path.stem}.{number}{path.suffix}")
    return free


class McapWriter:
    """Writes moments to a new file. ``put`` never waits for the disk, ``put_patiently`` does.

    The thread ends itself, and says so, when the file has ``limit_bytes`` or cannot be written; what is in it then is
    sound.

    Attributes:
        dropped: how many moments found no room.
        written: how many are in the file.
    """

    def __init__(
        self,
        path: Path,
        profile: Mapping[str, str],
        *,
        limit_bytes: int,
        settings: RecordingSettings = RecordingSettings(),
    ) -> None:
        """Begin the file.

        Raises:
            RecordingExists: there is such a file.
            OSError: it cannot be made.
        """
        try:
            self._file = path.open("xb")
        except FileExistsError:
            raise RecordingExists(path) from None
        self._path, self._limit_bytes, self._settings = path, limit_bytes, settings
        self.dropped = self.written = 0
        self._waiting: queue.Queue[Moment | None] = queue.Queue(maxsize=settings.waiting_moments)
        self._points_due_s = float("-inf")
        self._writer = Writer(self._file, chunk_size=settings.chunk_bytes)
        self._writer.start(profile="", library=f"majordomo {__version__}")
        self._writer.add_metadata(PROFILE, dict(profile))
        self._channels = {topic: self._channel(topic) for topic in SCHEMAS}
        self._sequence = 0
        self._thread = threading.Thread(target=self._write_all, name="recording", daemon=True)
        self._thread.start()

    @property
    def running(self) -> bool:
        """Whether what is put is still written."""
        return self._thread.is_alive()

    def put(self, moment: Moment) -> bool:
        """Have ``moment`` written; false if too many wait, or the file has come to its end."""
        if self.running:
            try:
                self._waiting.put_nowait(moment)
            except queue.Full:
                self.dropped += 1
                if self.dropped == 1:
                    logger.warning("the recording falls behind: moments are left out")
            else:
                return True
        return False

    def put_patiently(self, moment: Moment) -> bool:
        """As ``put``, but wait for room. To be called from a thread."""
        while self.running:
            try:
                self._waiting.put(moment, timeout=0.5)
            except queue.Full:
                continue
            return True
        return False

    def close(self) -> None:
        """Write what waits, and the summary by which readers find their way."""
        while self.running:
            try:
                self._waiting.put(None, timeout=0.5)
            except queue.Full:
                continue
            break
        self._thread.join()
        if self.dropped:
            logger.warning("%d of %d moments were left out", self.dropped, self.dropped + self.written)

    def _channel(self, topic: str) -> int:
        name, schema = SCHEMAS[topic]
        document = json.dumps({"title": name, **schema}).encode()
        schema_id = self._writer.register_schema(name, SchemaEncoding.JSONSchema, document)
        return self._writer.register_channel(topic, MessageEncoding.JSON, schema_id)

    def _write_all(self) -> None:
        try:
            while (moment := self._waiting.get()) is not None:
                self._write(moment)
                if self._file.tell() > self._limit_bytes:
                    megabytes = self._limit_bytes / 1e6
                    logger.warning(
                        "the recording ends here: %s has reached its limit of %.0f MB", self._path, megabytes
                    )
                    break
            self._writer.finish()  # type: ignore[no-untyped-call]
            self._file.close()
        except OSError as error:
            logger.error("the recording ends here: %s cannot be written: %s", self._path, error)  # noqa: TRY400
        except Exception:
            logger.exception("the recording ends here: a moment could not be told")

    def _write(self, moment: Moment) -> None:
        with_points = moment.now_s >= self._points_due_s
        if with_points and moment.scan is not None:
            self._points_due_s = moment.now_s + self._settings.points_period_s
        log_time = nanoseconds(moment.now_s)
        for topic, message in messages_of(moment, with_points=with_points):
            data = json.dumps(message, separators=(",", ":"), default=_plain).encode()
            self._sequence += 1
            self._writer.add_message(self._channels[topic], log_time, data, log_time, self._sequence)
        self._file.flush()
        self.written += 1


def _plain(number: object) -> object:
    """A number of numpy's as one of Python's."""
    if isinstance(number, np.generic):
        return number.item()
    raise TypeError(f"{number!r} cannot be told in JSON")
