"""What clients send, validated at the border; unknown fields are refused."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    StringConstraints,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from majordomo.app.http.problems import WHOLE_SENTENCE
from majordomo.planner.tasks import Approval

MAX_REQUEST_CHARACTERS = 10_000


def _sayable(text: str, info: ValidationInfo) -> str:
    said = {"what": info.field_name, "length": len(text), "most": MAX_REQUEST_CHARACTERS}
    if not text:
        raise PydanticCustomError(WHOLE_SENTENCE, "The {what} is empty. Please say in plain words what you want.", said)
    if len(text) > MAX_REQUEST_CHARACTERS:
        raise PydanticCustomError(
            WHOLE_SENTENCE,
            "The {what} has {length} characters, and I read at most {most}. Please say it in fewer words.",
            said,
        )
    return text


RequestText = Annotated[
    str,
    StringConstraints(strip_whitespace=True),
    AfterValidator(_sayable),
    WithJsonSchema({"type": "string", "minLength": 1, "maxLength": MAX_REQUEST_CHARACTERS}),
]
"""What a person says to the robot; what is wrong with it is said in the robot's own words."""


def _one_line(text: str) -> str:
    if not text.isprintable():
        raise ValueError("use printable characters on one line")
    return text


TaughtWord = Annotated[
    str, StringConstraints(strip_whitespace=True, min_length=1, max_length=80), AfterValidator(_one_line)
]


class Document(BaseModel):
    """Base of all request bodies."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class TaskRequest(Document):
    """``POST /v1/tasks``."""

    request: RequestText = Field(examples=["bring the blue bottle from the kitchen to the desk in the office"])
    approval: Approval = Approval.AUTO
    dry_run: bool = False


class Answer(Document):
    """``POST /v1/tasks/{id}/answer``."""

    answer: RequestText


class Nearness(Document):
    """Within ``radius_m`` of a node, or of a point of the map frame."""

    node: str | None = None
    point_m: tuple[float, float] | None = None
    radius_m: float = Field(gt=0)


class Relation(Document):
    """Related by ``predicate`` to ``target``."""

    predicate: str | None = None
    target: str | None = None


class SceneQuery(Document):
    """``POST /v1/scene/query``."""

    type: str | list[str] | None = None
    label: str | None = None
    attributes: dict[str, str] = Field(default_factory=dict)
    room: str | None = None
    region: str | None = None
    relation: Relation | None = None
    near: Nearness | None = None
    state: str | None = None
    max_age_s: float | None = Field(default=None, gt=0)
    order_by: str = "id"
    descending: bool = False
    limit: int = Field(default=100, ge=1, le=1000)
    offset: int = Field(default=0, ge=0)


class NodePatch(Document):
    """``PATCH /v1/scene/nodes/{id}``: what a person teaches."""

    label: TaughtWord | None = None
    name: TaughtWord | None = None
    region: TaughtWord | None = None

    @model_validator(mode="after")
    def _says_something(self) -> Self:
        if self.label is None and self.name is None and self.region is None:
            raise ValueError("tell a label, a name or a region")
        return self


class Disturbance(BaseModel):
    """``POST /v1/simulation/disturb``: one event of design section 4; the simulator checks the rest."""

    model_config = ConfigDict(extra="allow")

    do: Literal["move", "remove", "add", "close_door", "open_door", "walk"]

    def event(self) -> dict[str, Any]:
        """The event as the simulator takes it."""
        return self.model_dump()
