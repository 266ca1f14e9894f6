"""Fills the texts of this package. A missing variable is an error, and so is one that the text does not use."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from importlib import resources

_VARIABLE = re.compile(r"\{\{\s*([a-z_]+)\s*\}\}")


class PromptError(Exception):
    """Base of this package's errors."""


class PromptNotFound(PromptError):
    """No text of this name; ``available`` lists those there are."""

    def __init__(self, name: str, available: Iterable[str]) -> None:
        self.name, self.available = name, tuple(sorted(available))
        super().__init__(f"there is no prompt {name!r}; available: {', '.join(self.available)}")


class WrongVariables(PromptError):
    """The variables given are not those that the text needs."""

    def __init__(self, name: str, missing: Iterable[str], unused: Iterable[str]) -> None:
        self.name, self.missing, self.unused = name, tuple(sorted(missing)), tuple(sorted(unused))
        super().__init__(f"prompt {name!r}: missing {list(self.missing)}, not used {list(self.unused)}")


def available() -> tuple[str, ...]:
    """Names of all texts."""
    files = resources.files(__package__).iterdir()
    return tuple(sorted(file.name.removesuffix(".md") for file in files if file.name.endswith(".md")))


def variables(name: str) -> frozenset[str]:
    """Variables that a text needs."""
    return frozenset(_VARIABLE.findall(_text(name)))


def render(name: str, **values: str) -> str:
    """The text with every ``{{variable}}`` filled in, once: what a value contains is never filled again.

    Raises:
        PromptNotFound: there is no such text.
        WrongVariables: a variable is missing, or one is given that the text does not use.
    """
    needed = variables(name)
    if needed != values.keys():
        raise WrongVariables(name, needed - values.keys(), values.keys() - needed)
    return _VARIABLE.sub(lambda match: values[match.group(1)], _text(name))


@cache
def _text(name: str) -> str:
    if name not in available():
        raise PromptNotFound(name, available())
    return resources.files(__package__).joinpath(f"{name}.md").read_text(encoding="utf-8").strip()
