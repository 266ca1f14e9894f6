"""Choices in what clients send: a name out of a set, a variant of a document. Each is checked and shown by one type."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import Discriminator, GetCoreSchemaHandler
from pydantic_core import CoreSchema, core_schema


@dataclass(frozen=True, kw_only=True)
class RefusedAs:
    """Annotates a type: a value that does not fit is refused under ``code``, in this sentence."""

    code: str
    sentence: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """The type's own schema, with this error in place of its errors."""
        return core_schema.custom_error_schema(
            handler(source), custom_error_type=self.code, custom_error_message=self.sentence
        )


@dataclass(frozen=True, kw_only=True)
class Among:
    """Annotates ``str``: one of these names, which are known only when the program runs."""

    names: tuple[str, ...]

    def __get_pydantic_core_schema__(self, _source: Any, _handler: GetCoreSchemaHandler) -> CoreSchema:
        """What ``Literal`` of the names would have."""
        return core_schema.literal_schema(list(self.names))


def by_the_only(names: Sequence[str], refused: RefusedAs) -> Discriminator:
    """Tells variants, tagged ``by NAME``, apart by the one of these fields that is given and not null."""

    def tag(value: Any) -> str | None:
        told = _told(value, names)
        return f"by {told[0]}" if len(told) == 1 else None

    return Discriminator(tag, custom_error_type=refused.code, custom_error_message=refused.sentence)


def by_the_first(names: Sequence[str], refused: RefusedAs) -> Discriminator:
    """The same by the first of the fields that is given and not null; others may be given as well."""

    def tag(value: Any) -> str | None:
        told = _told(value, names)
        return f"by {told[0]}" if told else None

    return Discriminator(tag, custom_error_type=refused.code, custom_error_message=refused.sentence)


def _told(value: Any, names: Sequence[str]) -> list[str]:
    given = value if isinstance(value, Mapping) else vars(value) if hasattr(value, "__dict__") else {}
    return [name for name in names if given.get(name) is not None]
