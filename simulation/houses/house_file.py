"""Reads houses and checks them on load."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path

from pydantic import ValidationError

from simulation.errors import HouseError
from simulation.houses.findings import first_problem
from simulation.houses.house import House
from simulation.houses.house_checks import check_house


def builtin_houses() -> tuple[str, ...]:
    """Names of the houses that ship with the package, sorted."""
    folder = resources.files("simulation") / "houses"
    return tuple(sorted(entry.name.removesuffix(".json") for entry in folder.iterdir() if entry.name.endswith(".json")))


def load_house(path_or_name: str | Path) -> House:
    """Read the house of that built-in name, or else the file.

    Raises:
        HouseError: no such house or file, or it is not one that can be built.
    """
    name = str(path_or_name)
    if name in builtin_houses():
        return parse_house((resources.files("simulation") / "houses" / f"{name}.json").read_text("utf-8"))
    try:
        text = Path(name).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else "not a text file"
        known = ", ".join(builtin_houses())
        raise HouseError(
            name if name.strip() else repr(name),
            f"cannot be read ({reason}), and no house has that name; built in: {known}",
        ) from error
    return parse_house(text)


def parse_house(text: str) -> House:
    """Read and check a house document.

    Raises:
        HouseError: with the path of the offending field, or line and column where it is no JSON.
    """
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise HouseError(f"line {error.lineno} column {error.colno}", f"not JSON: {error.msg}") from error
    except RecursionError as error:
        raise HouseError("", "not a house: nested too deeply") from error
    try:
        house = House.model_validate(document)
    except ValidationError as error:
        raise HouseError(*first_problem(error, document)) from error
    check_house(house)
    return house
