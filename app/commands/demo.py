"""Shows the demonstration to a person: progress while it runs, then what was asked, planned, disturbed and verified."""

from __future__ import annotations

import tempfile
from pathlib import Path

from rich.console import Console
from rich.panel import Panel
from rich.progress import BarColumn, Progress, SpinnerColumn, TaskID, TextColumn
from rich.table import Table

from app.demo import DemoOutcome, Scenario, play
from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import ClockMode, Settings
from planner.tasks.tasks import StepStatus, Task
from simulation.houses.house import furniture_places
from simulation.houses.house_file import load_house


class ProgressBars:
    """Two bars: exploration, counted in doors, and the request, counted in steps."""

    def __init__(self, console: Console) -> None:
        columns = (
            SpinnerColumn(),
            TextColumn("{task.description:<12}"),
            BarColumn(),
            TextColumn("{task.fields[note]}"),
        )
        self.bars = Progress(*columns, console=console, refresh_per_second=4)
        self._exploration: TaskID = self.bars.add_task("exploring", total=None, note="waking up")
        self._request: TaskID | None = None
        self._failures = 0

    def exploring(self, rooms: int, doors_done: int, doors: int, objects: int, stamp_s: float) -> None:
        """Show rooms, doors and objects known so far."""
        note = f"{rooms} rooms, {doors_done} of {doors} doors, {objects} objects, {stamp_s:.0f} s simulated"
        self.bars.update(self._exploration, total=doors or None, completed=doors_done, note=note)

    def explored(self, stamp_s: float, *, complete: bool) -> None:
        """Close the exploration bar."""
        word = "done" if complete else "gave up: not everything could be explored"
        self.bars.update(self._exploration, total=1, completed=1, note=f"{word} after {stamp_s:.0f} s simulated")

    def disturbed(self, scenario: Scenario, stamp_s: float) -> None:
        """Tell that the person interfered."""
        text = f"[yellow]a person moves {scenario.thing} from {scenario.old_place} to {scenario.new_place}[/]"
        self.bars.console.print(f"{stamp_s:8.1f} s  {text}")

    def working(self, task: Task) -> None:
        """Show the plan's progress, and each failure once."""
        if self._request is None:
            self.bars.console.print(f'[bold]asked[/]: "{task.request}"')
            self._request = self.bars.add_task("request", total=None, note="planning")
        for failure in task.failures[self._failures :]:
            self.bars.console.print(f"[red]{failure.code}[/]: {failure.message} [dim]{failure.suggestion}[/]")
        self._failures = len(task.failures)
        if task.plan is not None:
            done = sum(step.status is StepStatus.SUCCEEDED for step in task.plan.steps)
            running = next(
                (step.text for step in task.plan.steps if step.status is StepStatus.RUNNING), str(task.status)
            )
            self.bars.update(self._request, total=len(task.plan.steps), completed=done, note=running)


async def show_demo(*, house: str, seed: int, port: int, console: Console) -> bool:
    """Play the demonstration with the page served beside it; whether the truth agrees that it succeeded."""
    loaded = load_house(house)
    with tempfile.TemporaryDirectory(prefix="majordomo-demo-") as folder:
        settings = Settings(house=house, seed=seed, clock=ClockMode.LOCKSTEP, speed=None, port=port, data=Path(folder))
        runtime = Runtime(settings)
        token = Token.stored_in(settings.data_folder)
        with bind(settings) as listener:
            async with serving(runtime, listener, token):
                console.print(f"watch it at {page_address(listener, token)}", soft_wrap=True, highlight=False)
                progress = ProgressBars(console)
                with progress.bars:
                    outcome = await play(runtime, runtime.require_robot(), furniture_places(loaded), progress)
    console.print(_report(outcome))
    return outcome.reported and outcome.true


def _report(outcome: DemoOutcome) -> Panel:
    table = Table.grid(padding=(0, 2))
    table.add_column(style="bold")
    table.add_column(overflow="fold")
    task = outcome.task
    if task is not None:
        table.add_row("asked", task.request)
        table.add_row("planned", ", ".join(step.text for step in task.plan.steps) if task.plan else "nothing")
        table.add_row("disturbed", "a person moved the thing on the way" if outcome.disturbed else "not disturbed")
        for failure in task.failures:
            table.add_row("explained", f"{failure.message} {failure.suggestion}")
        table.add_row("replanned", f"{outcome.replans} times")
        table.add_row("reported", f"{task.status}: {task.explanation or task.reply}")
    agrees = "[green]the truth agrees[/]" if outcome.true == outcome.reported else "[red]THE TRUTH DISAGREES[/]"
    table.add_row("verified", f"in the simulator it is on {outcome.truth_place or 'nothing'}: {agrees}")
    table.add_row("time", f"{outcome.sim_seconds:.0f} s simulated in {outcome.wall_seconds:.0f} s")
    good = outcome.reported and outcome.true
    return Panel(table, title="success" if good else "no success", border_style="green" if good else "red")
