"""The command line: ``majordomo demo | serve | ask | trace | plan | export | replay | mcp | house | …``."""

from __future__ import annotations

import sys

import typer

from app.commands.exchange import export_graph, make_house, replay_recording, serve_mcp
from app.commands.plugins import add_installed_commands
from app.commands.requests import ask, plan_on_graph, trace
from app.commands.service import demo, doctor, serve
from app.commands.terminal import complaints

application = typer.Typer(
    name="majordomo",
    help="A robot butler that maps its building, plans on a scene graph, and checks what it did.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
add_installed_commands(application)

for command in (serve, demo, ask, trace):
    application.command()(command)
application.command("plan")(plan_on_graph)
application.command("house")(make_house)
application.command()(doctor)
application.command("export")(export_graph)
application.command("replay")(replay_recording)
application.command("mcp")(serve_mcp)


def main() -> None:
    """Entry point; expected problems end with a sentence and exit code 2, never with a stack trace."""
    try:
        application()
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:
        if not isinstance(error, _expected()):
            raise
        complaints.print(f"majordomo: {error}", style="red", markup=False, highlight=False)
        sys.exit(2)


def _expected() -> tuple[type[Exception], ...]:
    """Errors that say all there is to say. Looked up when one is there: the libraries behind them take a second."""
    from app.errors import LineError, RefusedToBind, RobotUnavailable
    from app.recording.errors import RecordingError
    from app.stacks.robot_registry import NoSuchRobot, RobotMisfit
    from drivers.rosbridge.errors import RosbridgeError
    from perception.network.errors import NetworkRefused
    from planner.errors import BadModelKey, BadModelSpec
    from scene_graph.errors import SceneFormatError
    from simulation.errors import HouseError, SimulatorError

    return (
        RefusedToBind, HouseError, SimulatorError, RobotUnavailable, SceneFormatError, BadModelKey, BadModelSpec,
        NetworkRefused, LineError, RecordingError, NoSuchRobot, RobotMisfit, RosbridgeError, OSError,
    )  # fmt: skip
