"""Commands about requests: ``majordomo ask | trace`` talk to a service, ``plan`` to a stored scene graph."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from app.commands.options import ClientToken, Data, Url
from app.commands.terminal import complaints, console, refused
from app.settings import DEFAULT_DATA


def ask(
    request: Annotated[str, typer.Argument(help="What you want, in plain words.")],
    url: Url = None,
    token: ClientToken = None,
    data: Data = DEFAULT_DATA,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Plan only; nothing moves.")] = False,
    confirm: Annotated[bool, typer.Option("--confirm", help="Show the plan, and ask before anything moves.")] = False,
    agree: Annotated[
        bool | None, typer.Option("--yes/--no", help="Approve plans that are shown, or turn them down, unasked.")
    ] = None,
    answer: Annotated[
        list[str] | None, typer.Option(help="Answer to the robot's next question; may be given several times.")
    ] = None,
    keyboard: Annotated[
        bool, typer.Option("--input/--no-input", help="Put questions to the keyboard; without, the task waits.")
    ] = True,
    follow: Annotated[
        bool, typer.Option("--follow/--detach", help="Stay until it ends, or only print its identifier.")
    ] = True,
    timeout: Annotated[float | None, typer.Option(min=0.0, help="Stay at most so many seconds.")] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the task as JSON at the end, and nothing else.")
    ] = False,
) -> None:
    """Ask the running service for something and follow it to its end.

    Exit codes: 0 it succeeded; 1 it failed, was refused or cancelled; 2 there is no service, or it refuses the call;
    3 the task waits for a person and nobody is there; 4 it goes on after --timeout; 130 Ctrl-C: it goes on unless you
    cancel it.
    """
    from app.commands.ask import Asking, Manners
    from client import Client, ClientError, find_service

    manners = Manners(
        approval="ask" if confirm else "auto",
        dry_run=dry_run,
        agree=agree,
        answers=tuple(answer or ()),
        keyboard=keyboard,
        follow=follow,
        timeout_s=timeout,
    )
    try:
        with Client(find_service(url, token, data)) as robot:
            asking = Asking(robot=robot, console=complaints if as_json else console, manners=manners)
            ending = asking.run(request)
    except ClientError as error:
        raise refused(str(error)) from None
    if as_json and asking.task is not None:
        typer.echo(asking.task.model_dump_json(indent=1))
    raise typer.Exit(ending)


def trace(
    task: Annotated[str, typer.Argument(help="Its identifier, such as task_3, or its number.")],
    url: Url = None,
    token: ClientToken = None,
    data: Data = DEFAULT_DATA,
    prompts: Annotated[bool, typer.Option("--prompts", help="Also every word that a language model was told.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Show what was decided about a task, when and why; when no service runs, from what the last one left."""
    from app.commands.trace import NoTrace, find_trace, show_trace
    from client import ClientError

    try:
        found = find_trace(task, url=url, token=token, data=data.expanduser())
    except (NoTrace, ClientError) as error:
        raise refused(str(error)) from None
    if as_json:
        typer.echo(found.trace.model_dump_json(indent=1))
    else:
        show_trace(found, console, prompts=prompts)


def plan_on_graph(
    request: Annotated[str, typer.Argument(help="What you want, in plain words.")],
    graph: Annotated[Path, typer.Option(help="A stored scene graph, JSON of GET /v1/scene or your own; - reads it.")],
    pddl: Annotated[Path | None, typer.Option(help="Where to write the problem as PDDL, its domain beside.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Plan for a request on a stored scene graph and print the plan, or the reason why there is none."""
    from app.commands.plan import document, plan_on, told, write_problem
    from app.exchange.stored_graph import load_graph

    snapshot = load_graph(graph)
    outcome = plan_on(snapshot, request)
    typer.echo(json.dumps(document(outcome, request), indent=1) if as_json else told(outcome, snapshot))
    if pddl is not None and outcome.problem is not None:
        domain = write_problem(outcome.problem, pddl)
        complaints.print(f"wrote {pddl} and {domain}", markup=False, highlight=False, soft_wrap=True)
    raise typer.Exit(0 if outcome.succeeded else 1)
