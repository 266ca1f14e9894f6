"""The SQLite file under the journal: opened for one service alone, migrated, checked, set aside when it is damaged."""

from __future__ import annotations

import contextlib
import fcntl
import logging
import os
import sqlite3
import weakref
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Self

logger = logging.getLogger(__name__)

SCHEMA = 2
"""Of the file. A later one is set aside, since nobody here knows what it would hold."""
_TASKS = """CREATE TABLE IF NOT EXISTS tasks (
    number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, ended INTEGER NOT NULL, document BLOB NOT NULL)"""
_DECISIONS = """CREATE TABLE decisions (
    seq INTEGER PRIMARY KEY AUTOINCREMENT, task TEXT NOT NULL, stamp_s REAL NOT NULL, at_s REAL NOT NULL,
    kind TEXT NOT NULL, what TEXT NOT NULL, why TEXT NOT NULL, data TEXT NOT NULL, bytes INTEGER NOT NULL)"""
_DROPPED = "CREATE TABLE dropped (task TEXT PRIMARY KEY, decisions INTEGER NOT NULL)"
MIGRATIONS: Mapping[int, tuple[str, ...]] = MappingProxyType(
    {1: (_TASKS,), 2: (_DECISIONS, "CREATE INDEX decisions_of_task ON decisions (task, seq)", _DROPPED)}
)
"""What leads from the schema before to this one."""


@dataclass(frozen=True, kw_only=True)
class JournalSettings:
    """When the write-ahead log is brought into the file; chosen."""

    checkpoint_every: int = 100
    """Commits after which it is; that waits for the disk, and so is done beside."""
    longest_log_bytes: int = 32_000_000
    """It starts anew only when a checkpoint has caught up; where writing never pauses, it is made to."""


class JournalFile:
    """An open journal: one connection that writes, and a thread that brings the write-ahead log into the file.

    What was committed survives the end of the process at any instant; only a loss of power may cost the newest.
    """

    def __init__(
        self,
        connection: sqlite3.Connection,
        file: Path | None = None,
        lock: int | None = None,
        *,
        settings: JournalSettings = JournalSettings(),
    ) -> None:
        """``file`` and ``lock`` (a descriptor) are ``None`` for a journal in the memory of the process alone."""
        self.connection, self._settings = connection, settings
        self._file = file
        self._let_go = weakref.finalize(self, _let_go, connection, lock)
        self._commits = 0
        self._beside = ThreadPoolExecutor(max_workers=1, thread_name_prefix="journal")

    @classmethod
    def in_memory(cls) -> Self:
        """A journal for a service that remembers nothing."""
        connection = sqlite3.connect(":memory:", check_same_thread=False)
        _migrate(connection)
        return cls(connection)

    @classmethod
    def open(cls, file: Path, settings: JournalSettings = JournalSettings()) -> Self:
        """Open or begin a journal; no other service can until it is closed.

        A file that is damaged, or of a later version, is set aside under a name of its own and reported.

        Raises:
            OSError: another service uses it, or it cannot be written.
        """
        file.parent.mkdir(parents=True, exist_ok=True)
        lock = _locked(file)
        try:
            return cls(_opened(file), file, lock, settings=settings)
        except BaseException:
            os.close(lock)
            raise

    @contextlib.contextmanager
    def transaction(self) -> Iterator[sqlite3.Connection]:
        """All statements inside are kept, or none."""
        with self.connection:
            yield self.connection
        self._commits += 1
        if self._file is not None and self._commits % self._settings.checkpoint_every == 0:
            self._shorten_log(self._file)

    def _shorten_log(self, file: Path) -> None:
        log = file.with_name(f"{file.name}-wal")
        if log.exists() and log.stat().st_size > self._settings.longest_log_bytes:
            self.connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
        else:
            self._beside.submit(_checkpoint, file)

    def close(self) -> None:
        """Let go of the file."""
        self._beside.shutdown()
        self._let_go()


def read_only(file: Path) -> sqlite3.Connection:
    """A connection that only reads, also beside a service that writes.

    Raises:
        sqlite3.Error: there is no such file, or it is no journal of a known version.
    """
    connection = sqlite3.connect(f"{file.absolute().as_uri()}?mode=ro", uri=True, timeout=1.0)
    try:
        (version,) = connection.execute("PRAGMA user_version").fetchone()
        if version not in MIGRATIONS:
            raise sqlite3.DatabaseError(f"it is of version {version}, and this program reads up to {SCHEMA}")
    except sqlite3.Error:
        connection.close()
        raise
    return connection


def check(connection: sqlite3.Connection) -> None:
    """Look through a file for damage.

    Raises:
        sqlite3.DatabaseError: it is damaged, or no database.
    """
    (verdict,) = connection.execute("PRAGMA quick_check(1)").fetchone()
    if verdict != "ok":
        raise sqlite3.DatabaseError(str(verdict))


def _locked(file: Path) -> int:
    """Descriptor of a file that no two services have locked; the lock ends with the process, whatever ends that."""
    lock = os.open(file.with_name(f"{file.name}.lock"), os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as problem:
        os.close(lock)
        raise _in_use(file, "it is locked") from problem
    return lock


def _let_go(connection: sqlite3.Connection, lock: int | None) -> None:
    """Close what a journal holds, also for one that nobody has any more and nobody closed."""
    connection.close()
    if lock is not None:
        os.close(lock)


def _opened(file: Path) -> sqlite3.Connection:
    try:
        return _connected(file)
    except sqlite3.OperationalError as problem:
        if "locked" in str(problem):
            raise _in_use(file, str(problem)) from problem
        raise OSError(f"the journal of tasks {file} cannot be used: {problem}") from problem
    except sqlite3.DatabaseError as problem:
        aside = _set_aside(file)
        logger.warning("the journal of tasks is damaged (%s); it was set aside as %s", problem, aside.name)
        return _connected(file)


def _in_use(file: Path, problem: str) -> OSError:
    advice = "stop the other service, or give this one another --data"
    return OSError(f"the journal of tasks {file} cannot be used: {problem}; {advice}")


def _connected(file: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(file, timeout=1.0, check_same_thread=False)
    try:
        check(connection)
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = NORMAL")
        connection.execute("PRAGMA wal_autocheckpoint = 0")
        _migrate(connection)
    except sqlite3.DatabaseError:
        connection.close()
        raise
    return connection


def _migrate(connection: sqlite3.Connection) -> None:
    """Bring the tables to this program's schema, in one transaction.

    Raises:
        sqlite3.DatabaseError: the file is of a later one.
    """
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    if not 0 <= version <= SCHEMA:
        raise sqlite3.DatabaseError(f"it is of version {version}, and this program writes version {SCHEMA}")
    with connection:
        connection.execute("BEGIN")
        for step in range(version + 1, SCHEMA + 1):
            for statement in MIGRATIONS[step]:
                connection.execute(statement)
        connection.execute(f"PRAGMA user_version = {SCHEMA}")


def _checkpoint(file: Path) -> None:
    """Bring the log into the file, on a connection of its own, so that nobody who writes waits for the disk."""
    connection = sqlite3.connect(file, timeout=1.0)
    try:
        connection.execute("PRAGMA wal_checkpoint(PASSIVE)")
    except sqlite3.Error as problem:
        logger.warning("the journal's log stays beside the file for now: %s", problem)
    finally:
        connection.close()


def _set_aside(file: Path) -> Path:
    """Rename a file and what belongs to it, under the first free number."""
    number = next(n for n in range(1, 1_000_000) if not file.with_name(f"{file.name}.damaged-{n}").exists())
    aside = file.with_name(f"{file.name}.damaged-{number}")
    for suffix in ("", "-wal", "-shm"):
        part = file.with_name(file.name + suffix)
        if part.exists():
            part.rename(aside.with_name(aside.name + suffix))
    return aside
