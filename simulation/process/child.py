"""The simulator's process: answers requests, and in real mode follows the wall clock between them.

The physics library is loaded in this process only: it greets on standard output, which belongs to the service.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from multiprocessing.connection import Connection
from multiprocessing.sharedctypes import Synchronized
from typing import TYPE_CHECKING

from simulation.errors import DisturbError, HouseError
from simulation.houses.house_file import parse_house
from simulation.process.messages import Mode, Reply, Request, Start

if TYPE_CHECKING:
    from simulation.process.engine import Engine

MAX_BURST_S = 0.05
"""Most simulated time between two looks at the requests; beyond it simulated time falls behind the wall clock."""
ADVANCE, CLOSE = "advance", "close"


def run(connection: Connection, stop_latch: Synchronized[int], start: Start) -> None:
    """Serve until told to close or the parent is gone. The first reply says whether the house could be built."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.dup2(sys.stderr.fileno(), sys.__stdout__.fileno() if sys.__stdout__ else 1)
    from simulation.process.engine import Engine

    try:
        engine = Engine(
            parse_house(start.house),
            start.seed,
            lambda: bool(stop_latch.value),
            robot=start.robot,
            physics=start.physics,
        )
    except HouseError as error:
        connection.send(Reply(problem=str(error)))
        return
    connection.send(Reply(now_s=engine.now_s))
    try:
        _serve(connection, engine, start)
    except (EOFError, BrokenPipeError, ConnectionResetError):
        pass
    finally:
        engine.close()


def _serve(connection: Connection, engine: Engine, start: Start) -> None:
    pace = _Pace(start.speed, start.physics.step_s) if start.mode is Mode.REAL else None
    while True:
        if pace is not None:
            engine.advance(pace.due_s())
        if not connection.poll(None if pace is None else start.physics.step_s):
            continue
        request: Request = connection.recv()
        if request.method == CLOSE:
            return
        connection.send(_answer(engine, request))


def _answer(engine: Engine, request: Request) -> Reply:
    for command in request.before:
        getattr(engine, command.method)(*command.args)
    try:
        value = getattr(engine, request.method)(*request.args)
    except DisturbError as error:
        return Reply(problem=str(error), now_s=engine.now_s)
    return Reply(value=value, now_s=engine.now_s, readings=engine.readings() if request.method == ADVANCE else None)


class _Pace:
    """How much simulated time is due to follow the wall clock; time that cannot be kept up with is given up."""

    def __init__(self, speed: float, step_s: float) -> None:
        self._speed, self._step_s = speed, step_s
        self._wall_s = time.monotonic()
        self._owed_s = 0.0

    def due_s(self) -> float:
        """Simulated seconds to step now, in whole physics steps."""
        wall_s = time.monotonic()
        self._owed_s = min(self._owed_s + (wall_s - self._wall_s) * self._speed, MAX_BURST_S)
        self._wall_s = wall_s
        due_s = int(self._owed_s / self._step_s) * self._step_s
        self._owed_s -= due_s
        return due_s
