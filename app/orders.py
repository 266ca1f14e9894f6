"""What people tell the robot: requests, the stop that overrides them all, and what is to be remembered."""

from __future__ import annotations

from collections.abc import Callable

from app.counters import Counters
from app.events.event_log import EventLog
from app.events.stream import EventStream
from app.journal.audit import NotKept
from app.stacks.robot import RobotStack
from app.stacks.stack import Stack
from planner.language.sentences.control import Control, control_word
from planner.mission.control_words import apply_control
from planner.tasks.approval import Approval
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import Task


class Orders:
    """Takes orders for one running stack. ``now``: robot time in seconds."""

    def __init__(
        self,
        stack: Stack,
        queue: TaskQueue,
        stream: EventStream,
        log: EventLog,
        counters: Counters,
        *,
        now: Callable[[], float],
    ) -> None:
        self._stack, self._queue, self._stream = stack, queue, stream
        self._log, self._counters, self._now = log, counters, now

    def submit(
        self, request: str, *, approval: Approval = Approval.AUTO, dry_run: bool = False, key: str | None = None
    ) -> Task:
        """Queue a request; *stop*, *wait*, *go on* and *cancel* act at once instead. ``key``: the client's name for it.

        Raises:
            QueueFull: too many tasks are open.
        """
        control = None if dry_run else control_word(request)
        task = self._queue.submit(
            request, stamp_s=self._now(), approval=approval, dry_run=dry_run, key=key, urgent=control is not None
        )
        if control is None:
            return task
        if control is Control.STOP:
            self.stop()
        elif control is Control.RESUME and self._stack.stopped:
            self.release_stop()
        return apply_control(control, task, self._queue, self._now())

    def stop(self) -> None:
        """Latch the stop; never waits for anything."""
        self._stack.stop()
        self._counters.stopped()
        self._log.write(self._now(), "stop", {})
        self._stream.publish("log", {"message": "stopped by a person"}, self._now())

    def release_stop(self) -> None:
        """Lift the latched stop."""
        self._stack.release_stop()
        self._log.write(self._now(), "resume", {})
        self._stream.publish("log", {"message": "stop released"}, self._now())

    def keep_taught(self) -> None:
        """Write down what a person has just taught, so that it survives the end of the process at any instant.

        Raises:
            NotKept: it cannot be written.
        """
        if isinstance(self._stack, RobotStack):
            try:
                self._stack.keep_taught()
            except OSError as problem:
                raise NotKept(f"I know it now, but cannot write it down: {problem}") from problem
