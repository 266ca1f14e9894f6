"""``majordomo evaluate …``: one command a measurement. What a command runs is loaded when it runs."""

from __future__ import annotations

import typer

from evaluations.demo.commands import evaluate_demo
from evaluations.mapping.commands import evaluate_localization, evaluate_mapping, evaluate_noise
from evaluations.missions.commands import evaluate_endurance, evaluate_missions
from evaluations.perception.commands import evaluate_changes, evaluate_network, evaluate_perception, evaluate_tracking
from evaluations.planning.commands import evaluate_planning
from evaluations.service.commands import evaluate_clients, evaluate_rates, evaluate_resources

evaluations = typer.Typer(help="Measure something, print a table, write JSON.", no_args_is_help=True)
evaluations.command("demo")(evaluate_demo)
evaluations.command("mapping")(evaluate_mapping)
evaluations.command("noise")(evaluate_noise)
evaluations.command("localization")(evaluate_localization)
evaluations.command("resources")(evaluate_resources)
evaluations.command("rates")(evaluate_rates)
evaluations.command("clients")(evaluate_clients)
evaluations.command("tracking")(evaluate_tracking)
evaluations.command("network")(evaluate_network)
evaluations.command("perception")(evaluate_perception)
evaluations.command("changes")(evaluate_changes)
evaluations.command("missions")(evaluate_missions)
evaluations.command("endurance")(evaluate_endurance)
evaluations.command("planning")(evaluate_planning)
