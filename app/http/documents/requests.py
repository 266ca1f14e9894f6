"""What clients send, validated at the border; unknown fields are refused."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    StrictBool,
    StrictFloat,
    StrictInt,
    StringConstraints,
    ValidationInfo,
    WithJsonSchema,
    model_validator,
)
from pydantic_core import PydanticCustomError

from app.http.documents.examples import REQUEST
from app.http.documents.problems import WHOLE_SENTENCE
from planner.tasks.approval import Approval
from scene_graph.nodes import NodeType
from scene_graph.queries.queries import OrderBy

MAX_REQUEST_CHARACTERS = 10_000
_TYPE = {"type": "string", "enum": list(NodeType)}
_TYPES = {"anyOf": [_TYPE, {"type": "array", "items": _TYPE}, {"type": "null"}]}
_TEXT = {"type": "string"}
_ATTRIBUTES = {
    "type": "object",
    "properties": {"color": _TEXT, "name": _TEXT, "category": _TEXT, "categories": _TEXT},
    "additionalProperties": False,
}
_WORD = {
    "type": ["string", "null"],
    "minLength": 1,
    "maxLength": 80,
    "description": "Printable characters on one line.",
}


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
    """What is wanted, in plain words. `ask`: show the plan and wait for approval. `dry_run`: plan, and move nothing."""

    request: RequestText = Field(examples=[REQUEST])
    approval: Approval = Approval.AUTO
    dry_run: StrictBool = False


class SeenPlan(Document):
    """What is approved: the plan made on this `revision` of the graph; without it, whatever plan the task has."""

    revision: StrictInt | None = Field(default=None, examples=[412])


class Answer(Document):
    """The answer to the robot's question: words, or one of the candidates' identifiers."""

    answer: RequestText = Field(examples=["cup_2"])


class Nearness(Document):
    """Within `radius_m` of a node, or of a point of the map; one of the two is named."""

    model_config = ConfigDict(json_schema_extra={"anyOf": [{"required": ["node"]}, {"required": ["point_m"]}]})

    node: str | None = None
    point_m: tuple[StrictFloat, StrictFloat] | None = None
    radius_m: float = Field(gt=0, strict=True)


class Relation(Document):
    """Related by `predicate` to `target`; what is left out may be anything."""

    predicate: str | None = None
    target: str | None = None


class SceneQuery(Document):
    """Conditions that a node must all meet, their order, and the page of them that is wanted."""

    type: Annotated[str | list[str] | None, WithJsonSchema(_TYPES)] = None
    label: str | None = None
    attributes: Annotated[dict[str, str], WithJsonSchema(_ATTRIBUTES)] = Field(default_factory=dict)
    room: str | None = Field(default=None, description="Identifier, or a label that several rooms may have.")
    region: str | None = Field(default=None, description="Identifier or label.")
    relation: Relation | None = None
    near: Nearness | None = None
    state: str | None = Field(default=None, description="Such as `present`, `held`, `missing`, `open`, `closed`.")
    max_age_s: float | None = Field(default=None, gt=0, strict=True, description="Seen at most so many seconds ago.")
    order_by: Annotated[str, WithJsonSchema({"type": "string", "enum": list(OrderBy)})] = "id"
    descending: StrictBool = False
    limit: int = Field(default=100, ge=1, le=1000, strict=True)
    offset: int = Field(default=0, ge=0, strict=True)


class NodePatch(Document):
    """What a person teaches: at least one of the three."""

    model_config = ConfigDict(json_schema_extra={"anyOf": [{"required": [one]} for one in ("label", "name", "region")]})

    label: Annotated[TaughtWord | None, WithJsonSchema(_WORD)] = Field(default=None, examples=["office"])
    name: Annotated[TaughtWord | None, WithJsonSchema(_WORD)] = None
    region: Annotated[TaughtWord | None, WithJsonSchema(_WORD)] = None

    @model_validator(mode="after")
    def _says_something(self) -> Self:
        if self.label is None and self.name is None and self.region is None:
            raise ValueError("tell a label, a name or a region")
        return self


class Disturbance(BaseModel):
    """One event of a house file without its time: what happens, and to what. The simulator checks the rest."""

    model_config = ConfigDict(extra="allow")

    do: Literal["move", "remove", "add", "close_door", "open_door", "walk"]

    def event(self) -> dict[str, Any]:
        """The event as the simulator takes it."""
        return self.model_dump()
