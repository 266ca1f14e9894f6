"""What may happen in a house: each kind names what it needs, for events of house files and for the interface alike.

The models of ``house`` say what fields there are; these say which of them go together.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, Discriminator, Field, Tag, TypeAdapter, ValidationError

from simulation.errors import DisturbError, HouseError
from simulation.houses.colors import color_problem
from simulation.houses.findings import first_problem
from simulation.houses.house import Coordinate, Disturbance, Id, Object, Place, Pose3


class PlaceOn(Place):
    """On top of something."""

    on: Id
    in_: None = Field(default=None, alias="in")
    pose: None = None


class PlaceIn(Place):
    """Inside something."""

    on: None = None
    in_: Id = Field(alias="in")
    pose: None = None


class PlaceAt(Place):
    """At a pose, in house coordinates."""

    on: None = None
    in_: None = Field(default=None, alias="in")
    pose: Annotated[tuple[Coordinate, ...], Field(min_length=2, max_length=4)]
    offset: None = None


class ObjectOn(Object):
    """A thing on top of something."""

    on: Id
    in_: None = Field(default=None, alias="in")
    pose: None = None


class ObjectIn(Object):
    """A thing inside something."""

    on: None = None
    in_: Id = Field(alias="in")
    pose: None = None


class ObjectAt(Object):
    """A thing at a pose, in house coordinates."""

    on: None = None
    in_: None = Field(default=None, alias="in")
    pose: Pose3
    offset: None = None


def _placing(document: Any) -> str | None:
    if isinstance(document, BaseModel):
        document = document.model_dump(by_alias=True)
    told = [way for way in ("on", "in", "pose") if isinstance(document, Mapping) and document.get(way) is not None]
    return f"by {told[0]}" if len(told) == 1 else None


_ONE_WAY = Discriminator(
    _placing, custom_error_type="place", custom_error_message="needs exactly one of on, in and pose"
)
SomePlace = Annotated[
    Annotated[PlaceOn, Tag("by on")] | Annotated[PlaceIn, Tag("by in")] | Annotated[PlaceAt, Tag("by pose")], _ONE_WAY
]
PlacedObject = Annotated[
    Annotated[ObjectOn, Tag("by on")] | Annotated[ObjectIn, Tag("by in")] | Annotated[ObjectAt, Tag("by pose")],
    _ONE_WAY,
]


class Move(Disturbance):
    """Something, someone or the robot is elsewhere from now on."""

    do: Literal["move"]
    id: Id
    to: SomePlace
    object: None = None


class Walk(Disturbance):
    """Someone walks somewhere."""

    do: Literal["walk"]
    id: Id
    to: PlaceAt
    object: None = None


class Add(Disturbance):
    """A new thing is brought."""

    do: Literal["add"]
    id: None = None
    to: None = None
    object: PlacedObject


class Change(Disturbance):
    """Something is taken away, or a door opened or closed."""

    do: Literal["remove", "close_door", "open_door"]
    id: Id
    to: None = None
    object: None = None


Happening = Annotated[Move | Walk | Add | Change, Field(discriminator="do")]
"""What may happen, told apart by what it does."""

_HAPPENING: TypeAdapter[Happening] = TypeAdapter(Happening)
_OBJECT: TypeAdapter[PlacedObject] = TypeAdapter(PlacedObject)


def parse_disturbance(document: Any) -> Disturbance:
    """Read one event without ``at_s``; whether the house allows it shows when it is carried out.

    Raises:
        DisturbError: with the path of the offending field.
    """
    try:
        happening = _HAPPENING.validate_python(document)
    except ValidationError as error:
        raise DisturbError(*first_problem(error, document)) from error
    if happening.object is not None and (problem := color_problem(happening.object.color)) is not None:
        raise DisturbError("object.color", problem)
    return happening


def check_object(document: Mapping[str, Any]) -> None:
    """Check that a thing of a house file is at one place, in the way in which things are brought.

    Raises:
        HouseError: with the path of the offending field.
    """
    try:
        _OBJECT.validate_python(document)
    except ValidationError as error:
        raise HouseError(*first_problem(error, document)) from error
