"""What clients send, validated at the border; unknown fields are refused."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, StrictBool, StrictFloat, StrictInt, Tag

from app.http.documents.choices import RefusedAs, by_the_first, by_the_only
from app.http.documents.examples import REQUEST
from app.http.documents.words import RequestText, TaughtWord
from planner.tasks.approval import Approval
from scene_graph.nodes import NodeType
from scene_graph.queries.queries import OrderBy

Positive = Annotated[StrictFloat, Field(gt=0)]


def _whole(value: Any) -> Any:
    return int(value) if isinstance(value, float) and value.is_integer() else value


_WHOLE = BeforeValidator(_whole)
"""54.0 is the integer 54, as it is for JSON Schema."""


def _unknown(known: Iterable[str]) -> RefusedAs:
    return RefusedAs(code="invalid_query", sentence=f"unknown; there are {', '.join(known)}")


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

    revision: Annotated[StrictInt, _WHOLE] | None = Field(default=None, examples=[412])


class Answer(Document):
    """The answer to the robot's question: words, or one of the candidates' identifiers."""

    answer: RequestText = Field(examples=["cup_2"])


class NearNode(Document):
    """Within `radius_m` of a node."""

    node: str
    point_m: None = None
    radius_m: Positive


class NearPoint(Document):
    """Within `radius_m` of a point of the map, in the plane."""

    node: None = None
    point_m: tuple[StrictFloat, StrictFloat]
    radius_m: Positive


Nearness = Annotated[
    Annotated[NearNode, Tag("by node")] | Annotated[NearPoint, Tag("by point_m")],
    by_the_only(("node", "point_m"), RefusedAs(code="invalid_query", sentence="take either a node or a point_m")),
]


class Relation(Document):
    """Related by `predicate` to `target`; what is left out may be anything."""

    predicate: str | None = None
    target: str | None = None


class Attributes(Document):
    """What an object has; `categories` is another word for `category`."""

    color: str | None = None
    name: str | None = None
    category: str | None = None
    categories: str | None = None


_SAID_OF_OBJECTS = RefusedAs(
    code="invalid_query", sentence=f"unknown, or no text; there are {', '.join(Attributes.model_fields)}"
)


class SceneQuery(Document):
    """Conditions that a node must all meet, their order, and the page of them that is wanted."""

    type: Annotated[NodeType | list[NodeType] | None, _unknown(NodeType)] = None
    label: str | None = None
    attributes: Annotated[Attributes, _SAID_OF_OBJECTS] = Attributes()
    room: str | None = Field(default=None, description="Identifier, or a label that several rooms may have.")
    region: str | None = Field(default=None, description="Identifier or label.")
    relation: Relation | None = None
    near: Nearness | None = None
    state: str | None = Field(default=None, description="Such as `present`, `held`, `missing`, `open`, `closed`.")
    max_age_s: Positive | None = Field(default=None, description="Seen at most so many seconds ago.")
    order_by: Annotated[OrderBy, _unknown(OrderBy)] = OrderBy.ID
    descending: StrictBool = False
    limit: Annotated[StrictInt, Field(ge=1, le=1000), _WHOLE] = 100
    offset: Annotated[StrictInt, Field(ge=0), _WHOLE] = 0


class TaughtLabel(Document):
    """A label, and perhaps more."""

    label: TaughtWord = Field(examples=["office"])
    name: TaughtWord | None = None
    region: TaughtWord | None = None


class TaughtName(Document):
    """A name without a label."""

    label: None = None
    name: TaughtWord
    region: TaughtWord | None = None


class TaughtRegion(Document):
    """A region and nothing else."""

    label: None = None
    name: None = None
    region: TaughtWord


NodePatch = Annotated[
    Annotated[TaughtLabel, Tag("by label")]
    | Annotated[TaughtName, Tag("by name")]
    | Annotated[TaughtRegion, Tag("by region")],
    by_the_first(
        ("label", "name", "region"), RefusedAs(code="invalid_request", sentence="tell a label, a name or a region")
    ),
]
"""What a person teaches: at least one of the three."""
