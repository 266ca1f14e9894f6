"""From random rooms to the network's file: ``python -m training all``, after ``pip install '.[train]'``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import track

from perception.network.shipped import SHIPPED
from training.collecting import collect, shards
from training.quantities import HOUSE_PICTURES, ROOM_PICTURES, STEPS

commands = typer.Typer(help="Make the panoptic scene graph network: pictures, training, file.", no_args_is_help=True)
console = Console()

Folder = Annotated[Path, typer.Option(help="Where pictures and checkpoint are kept; what is there is used again.")]
Seed = Annotated[int, typer.Option(min=0, help="Of everything that is random.")]
Jobs = Annotated[int, typer.Option(min=1, help="Processes that render at the same time.")]
DEFAULT = Path("build/training")


@commands.command()
def pictures(
    folder: Folder = DEFAULT,
    rooms: Annotated[int, typer.Option(min=0, help="Pictures of random rooms.")] = ROOM_PICTURES,
    houses: Annotated[int, typer.Option(min=0, help="Pictures of generated houses.")] = HOUSE_PICTURES,
    seed: Seed = 1,
    jobs: Jobs = 2,
) -> None:
    """Render what is to be learned from, about 15 pictures a second and core."""
    for name, count in (("rooms", rooms), ("houses", houses)):
        made = collect(folder / name, pictures=count, seed=seed, jobs=jobs, houses=name == "houses")
        for _ in track(made, description=name, total=shards(count), console=console):
            pass


@commands.command()
def fit(
    folder: Folder = DEFAULT,
    steps: Annotated[int, typer.Option(min=1, help="How long.")] = STEPS,
    seed: Seed = 1,
    begin: Annotated[
        Path | None, typer.Option(exists=True, dir_okay=False, help="Exported network to begin with.")
    ] = None,
) -> None:
    """Train on the pictures in the folder; an interrupted training goes on."""
    from training.fit import Course
    from training.fit import fit as train

    train(
        lambda: sorted(folder.glob("*/*.npz")),
        checkpoint=folder / "checkpoint.pt",
        course=Course(steps=steps, seed=seed),
        tell=console.print,
        begin=begin,
    )


@commands.command()
def export(
    folder: Folder = DEFAULT,
    file: Annotated[Path, typer.Option(help="The network's file.")] = SHIPPED,
) -> None:
    """Write the trained network as an ONNX file that keeps docs/network.md."""
    from training.export import export as write
    from training.fit import trained

    write(trained(folder / "checkpoint.pt"), file)
    console.print(f"{file}: {file.stat().st_size / 1e6:.1f} MB")


@commands.command()
def card(
    report: Annotated[Path, typer.Option(exists=True, help="What majordomo evaluate network --json wrote.")],
    file: Annotated[Path, typer.Option(exists=True, help="The model card.")] = Path("docs/model-card.md"),
) -> None:
    """Write the measured figures into the model card."""
    from training.model_card import write

    write(file, report)


@commands.command(name="all")
def everything(folder: Folder = DEFAULT, file: Path = SHIPPED, seed: Seed = 1, jobs: Jobs = 2) -> None:
    """Pictures, training and file, one after the other."""
    pictures(folder=folder, seed=seed, jobs=jobs)
    fit(folder=folder, seed=seed)
    export(folder=folder, file=file)


if __name__ == "__main__":
    commands()
