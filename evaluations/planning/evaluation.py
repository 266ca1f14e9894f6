"""``evaluate planning``: requests in plain words, put to the planner of ``serve --graph`` on stored scene graphs.

Each is scored by what its plan leads to in symbolic execution, by the words of its answer, or by whether it is asked
about or refused. The graph is newly read for every request, as it is when the robot perceives.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import Sequence
from contextlib import AsyncExitStack
from pathlib import Path

import httpx
from rich.console import Console

from app.settings import Settings
from app.stacks.language_model import make_language_model
from evaluations.planning.judging.expectations import Request
from evaluations.planning.report import building_table, category_table, document, failures, figure_table, slip_table
from evaluations.planning.request_file import OWN, load_requests, own_requests
from evaluations.planning.runs import Record, run_all, run_corrupted


def evaluate(
    *,
    files: Sequence[Path],
    settings: Settings,
    rates: Sequence[float],
    seed: int,
    json_file: Path | None,
    console: Console,
) -> bool:
    """Put all requests to the planner, print tables, write JSON; whether all aims were met.

    ``files``: requests of others; none for both halves of our own. ``settings`` name the language model, if any.
    Failures are printed except those of the half that is held out.

    Raises:
        LineError: a file cannot be read; said before anything is measured.
        BadModelSpec, BadModelKey: the model cannot be asked.
    """
    requests: list[tuple[Path | None, Sequence[Request]]] = [(file.parent, load_requests(file)) for file in files]
    requests = requests or [(None, own_requests(half)) for half in OWN]
    records, corrupted = asyncio.run(_run(requests, settings, rates, seed, console))
    told = document(records, corrupted, settings.llm)
    for line in failures([record for record in records if record.request.half != OWN[1]]):
        console.print(line, markup=False, highlight=False)
    for table in (category_table(records), building_table(records)):
        console.print(table)
    if corrupted:
        console.print(slip_table(corrupted))
    console.print(figure_table(told["figures"]))
    if json_file is not None:
        json_file.write_text(json.dumps(told, indent=1) + "\n", encoding="utf-8")
    return bool(told["met"])


async def _run(
    requests: Sequence[tuple[Path | None, Sequence[Request]]],
    settings: Settings,
    rates: Sequence[float],
    seed: int,
    console: Console,
) -> tuple[list[Record], dict[float, list[Record]]]:
    records: list[Record] = []
    corrupted: dict[float, list[Record]] = {rate: [] for rate in rates}
    async with AsyncExitStack() as stack:
        http = await stack.enter_async_context(httpx.AsyncClient())
        model = make_language_model(settings, http)
        for folder, these in requests:
            records += await run_all(these, console, model, folder)
            for rate in rates:
                corrupted[rate] += await run_corrupted(these, rate, seed, console, folder)
    return records, corrupted
