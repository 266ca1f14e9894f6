"""``majordomo ask``: submits one request to a running service, tells what becomes of it, and lets people decide."""

from __future__ import annotations

import contextlib
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import IntEnum

from rich.console import Console
from rich.text import Text

from app.commands.progress_printer import ProgressPrinter
from client import Client, Invalid, NoService, NotAllowedNow, StillWaiting, Task
from client.calls import Approval

NO_TEXT = "I cannot read this as text (UTF-8). Please type it again."


class Ending(IntEnum):
    """How ``majordomo ask`` ended; the value is its exit code."""

    SUCCEEDED = 0
    NOT_SUCCEEDED = 1
    NO_SERVICE = 2
    WAITS = 3
    GOES_ON = 4
    INTERRUPTED = 130


@dataclass(frozen=True, kw_only=True)
class Manners:
    """How to ask.

    ``approval``: ``ask`` shows the plan first. ``agree``: what to say to plans that are shown, ``None`` to let the
    person at the keyboard decide. ``answers``: to the robot's questions, in order, before the keyboard is tried.
    ``keyboard``: whether anybody is there. ``follow``: stay until the task ends, ``timeout_s`` seconds at most.
    """

    approval: Approval = "auto"
    dry_run: bool = False
    agree: bool | None = None
    answers: tuple[str, ...] = ()
    keyboard: bool = True
    follow: bool = True
    timeout_s: float | None = None


@dataclass(kw_only=True)
class Asking:
    """One request to one service.

    ``task`` is what became of it, ``None`` until the service has it.
    """

    robot: Client
    console: Console
    manners: Manners = Manners()
    task: Task | None = None
    _answers: Iterator[str] = field(init=False)
    _end_s: float | None = field(init=False, default=None)

    def __post_init__(self) -> None:
        self._answers = iter(self.manners.answers)

    def run(self, request: str) -> Ending:
        """Ask, and follow the task to its end as far as the manners go.

        Raises:
            ClientError: the service cannot be reached, or refuses.
        """
        if not _is_text(request):
            raise NoService(NO_TEXT)
        manners = self.manners
        self._end_s = None if manners.timeout_s is None else time.monotonic() + manners.timeout_s
        self.task = self.robot.submit(request, approval=manners.approval, dry_run=manners.dry_run)
        if not manners.follow:
            self.console.print(self.task.id, highlight=False)
            return Ending.SUCCEEDED
        try:
            return self._follow(self.task)
        except KeyboardInterrupt:
            return self._interrupted(self.task)
        except StillWaiting as over:
            self._say(f"{over}; 'majordomo trace {over.task_id}' shows how far it came")
            return Ending.GOES_ON

    def _follow(self, task: Task) -> Ending:
        """Tell what becomes of the task; the stream is left while a person thinks, and opened anew afterwards."""
        printer = ProgressPrinter(self.console)
        while True:
            with contextlib.closing(self.robot.follow(task.id, for_s=self._left_s)) as states:
                for state in states:
                    task = self.task = state
                    printer.tell(task)
                    if task.undecided:
                        break
            if task.ended:
                return Ending.SUCCEEDED if task.succeeded else Ending.NOT_SUCCEEDED
            if not task.undecided:
                raise StillWaiting(task.id, task.status, self.manners.timeout_s or 0.0)
            if not self._decide(task):
                return self._left_waiting(task)

    @property
    def _left_s(self) -> float | None:
        """How long to stay yet, seconds."""
        return None if self._end_s is None else max(0.0, self._end_s - time.monotonic())

    def _decide(self, task: Task) -> bool:
        """Answer or approve, as the manners or the person at the keyboard say; false when nobody does."""
        try:
            return self._answer(task) if task.status == "awaiting_answer" else self._approve(task)
        except NotAllowedNow as changed:
            self._say(changed.detail)  # somebody else decided meanwhile, or the plan is another one now
            return True

    def _answer(self, task: Task) -> bool:
        while True:
            prepared = next(self._answers, None)
            answer = self._typed(f"{task.reply} > ") if prepared is None else prepared
            if answer is None:
                return False
            if prepared is not None:
                self._say(f"{task.reply} > {prepared}")
            refusal = self._refusal(task, answer)
            if refusal is None:
                return True
            self._say(refusal)

    def _refusal(self, task: Task, answer: str) -> str | None:
        """Give an answer; why it cannot be taken, if it cannot."""
        if not _is_text(answer):
            return NO_TEXT
        try:
            self.robot.answer(task.id, answer)
        except Invalid as refusal:
            return refusal.detail
        return None

    def _approve(self, task: Task) -> bool:
        agreed = self.manners.agree
        if agreed is None:
            typed = self._typed(f"{task.explanation} [y/N] ")
            if typed is None:
                return False
            agreed = _is_yes(typed)
        else:
            self._say(f"{task.explanation} {'yes' if agreed else 'no'}")
        if agreed:
            self.robot.approve(task.id, revision=task.plan.revision if task.plan is not None else None)
        else:
            self.robot.reject(task.id)
        return True

    def _left_waiting(self, task: Task) -> Ending:
        question = task.reply if task.status == "awaiting_answer" else task.explanation
        self._say(f"nobody is there to answer; the task waits, and the page shows its question: {question}")
        return Ending.WAITS

    def _interrupted(self, task: Task) -> Ending:
        """Ctrl-C ends the watching, not the task: say so, and offer to end that too."""
        task = self.task = self.robot.task(task.id)
        if task.ended:
            self._say(f"{task.id} has ended: {task.status}")
            return Ending.INTERRUPTED
        self._say(f"\n{task.id} goes on without you; it is {task.status.replace('_', ' ')}.")
        with contextlib.suppress(KeyboardInterrupt):
            if _is_yes(self._typed("Cancel it? [y/N] ") or ""):
                self.task = self.robot.cancel(task.id)
                self._say(self.task.explanation or "It is cancelled.")
                return Ending.INTERRUPTED
        self._say(f"'majordomo trace {task.id}' shows how far it came.")
        return Ending.INTERRUPTED

    def _typed(self, prompt: str) -> str | None:
        """What the person at the keyboard types, ``None`` when nobody is there."""
        if not self.manners.keyboard:
            return None
        try:
            return self.console.input(Text(prompt))
        except UnicodeDecodeError as error:
            return error.object.decode(errors="surrogateescape")
        except EOFError:
            return None

    def _say(self, text: str) -> None:
        self.console.print(text, markup=False, highlight=False, soft_wrap=True)


def _is_text(typed: str) -> bool:
    """Whether what was typed is Unicode text; Python smuggles other bytes in as lone surrogates."""
    try:
        typed.encode()
    except UnicodeEncodeError:
        return False
    return True


def _is_yes(typed: str) -> bool:
    return typed.strip().lower() in {"y", "yes"}
