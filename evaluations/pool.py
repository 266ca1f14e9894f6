"""Many independent runs in processes of their own, with a progress bar."""

from __future__ import annotations

import multiprocessing
import os
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import Any, TypeVar

from rich.console import Console
from rich.progress import track

R = TypeVar("R")


def run_all(
    function: Callable[..., R], arguments: Sequence[tuple[Any, ...]], *, jobs: int, console: Console, what: str = "runs"
) -> list[R]:
    """``function(*arguments[i])`` for all i, ``jobs`` at a time, each in a fresh process; results in order of i."""
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(
        max_workers=jobs, mp_context=context, max_tasks_per_child=1, initializer=_end_with, initargs=(os.getpid(),)
    ) as pool:
        futures = [pool.submit(function, *each) for each in arguments]
        for _ in track(as_completed(futures), total=len(futures), description=what, console=console):
            pass
        return [future.result() for future in futures]


def tell(line: str) -> None:
    """One line of progress from within a run; to standard error, since many processes may say something."""
    Console(stderr=True).print(line, markup=False, highlight=False)


def _end_with(parent: int) -> None:
    """End this process when its parent does, however that came about: nobody would read the result."""

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(1.0)
        os._exit(1)

    threading.Thread(target=watch, name="parent watch", daemon=True).start()
