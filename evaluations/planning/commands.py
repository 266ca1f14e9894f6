"""``majordomo evaluate planning``."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from app.commands.terminal import console
from app.settings import Settings
from evaluations.options import JsonFile


def evaluate_planning(
    commands: Annotated[
        list[Path] | None,
        typer.Option(
            exists=True, dir_okay=False, readable=True, help="Requests of your own, see docs/requests.md; repeat it."
        ),
    ] = None,
    corrupt: Annotated[
        list[float] | None,
        typer.Option(min=0.0, max=1.0, help="Ask a model that errs in this share of its answers, too; repeat it."),
    ] = None,
    llm: Annotated[
        str | None, typer.Option(help="Language model for what the grammar cannot parse, PROVIDER:MODEL.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the errors.")] = 0,
    json_file: JsonFile = None,
) -> None:
    """Put requests to the planner on stored graphs of 24 to 5,000 nodes, and compare what comes of them."""
    from app.stacks.language_model import key_in
    from evaluations.planning.evaluation import evaluate

    settings = Settings(llm=llm, llm_url=os.environ.get("MAJORDOMO_LLM_URL"), llm_key=key_in(os.environ))
    good = evaluate(
        files=commands or (), settings=settings, rates=corrupt or (), seed=seed, json_file=json_file, console=console
    )
    raise typer.Exit(0 if good else 1)
