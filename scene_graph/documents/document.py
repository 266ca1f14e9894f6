"""The scene document as it is read: types, ranges and defaults of every field (design, section 9).

Only ``id`` and ``type`` of a node, and both ends and ``type`` of an edge, are required. Unknown fields are left alone,
so that a newer document can be read. ``None`` means that the reader fills the field in from what else is known.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, BeforeValidator, ConfigDict, Field

from scene_graph.edges import IntentionAction, IntentionStatus
from scene_graph.identifiers import is_well_formed
from scene_graph.nodes import AffordanceKind, CrossingStatus, DoorState, ObjectState, RoomStatus


def _identifier(text: str) -> str:
    if not is_well_formed(text):
        raise ValueError(f"{text!r} is not an identifier: use letters, digits and _ . : -")
    return text


def _on_floor(value: object) -> object:
    """Positions may leave out z."""
    if not isinstance(value, list):
        return value
    return (*value, 0.0) if len(value) == 2 else tuple(value)


DECIMALS = 6
"""Of meters and radians: coarser than rounding errors, so that reading and writing again changes nothing."""
Identifier = Annotated[str, AfterValidator(_identifier)]
Probability = Annotated[float, Field(ge=0.0, le=1.0)]
Length = Annotated[float, Field(ge=0.0)]
Point2 = tuple[float, float]
Point3 = tuple[float, float, float]
Position = Annotated[Point3, BeforeValidator(_on_floor)]


class _Record(BaseModel):
    model_config = ConfigDict(extra="ignore", strict=True, allow_inf_nan=False, frozen=True)


class _NodeRecord(_Record):
    id: Identifier
    label: str | None = None
    room: str | None = None
    position_m: Position | None = None
    yaw_rad: float = 0.0
    confidence: Probability = 1.0


class RootRecord(_NodeRecord):
    """The root; need not be listed."""

    type: Literal["root"]
    explored: bool = False


class RoomRecord(_NodeRecord):
    """A room; ``polygon_m`` is in the map."""

    type: Literal["room"]
    polygon_m: tuple[Point2, ...] = ()
    height_m: Length = 2.5
    status: RoomStatus = RoomStatus.PERMANENT
    label_probability: Probability | None = None
    label_taught: bool = False


class WallRecord(_NodeRecord):
    """A wall; its plane is in the frame of its room."""

    type: Literal["wall"]
    length_m: Length = 0.0
    normal: Point2 = (0.0, 1.0)
    offset_m: float = 0.0


class CornerRecord(_NodeRecord):
    """A corner."""

    type: Literal["corner"]


class DoorRecord(_NodeRecord):
    """A physical door; ``rooms`` holds one or two, or is told by ``connects`` edges."""

    type: Literal["door"]
    width_m: Length = 0.9
    height_m: Length = 2.0
    rooms: Annotated[tuple[str | None, ...], Field(max_length=2)] = ()
    state: DoorState = DoorState.OPEN
    provisional: bool = False
    crossing: CrossingStatus | None = None
    crossing_reason: str = ""


class Attributes(_Record):
    """What an object looks like and what it is called."""

    color: str | None = None
    accents: tuple[str, ...] | None = None
    categories: tuple[str, ...] | None = None
    name: str | None = None


class ObjectRecord(_NodeRecord):
    """An object; ``position_m`` is its center."""

    type: Literal["object"]
    attributes: Attributes = Attributes()
    label_distribution: tuple[tuple[str, Probability], ...] | None = None
    position_std_m: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)
    size_m: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)
    state: ObjectState | None = None
    first_seen_s: float = 0.0
    last_seen_s: float | None = None
    existence: Probability = 1.0
    graspable: bool | None = None
    support: bool | None = None
    inspected_s: float | None = None
    observations: Annotated[int, Field(ge=0)] = 0
    surfaces_m: tuple[Length, ...] = ()
    back_rad: float | None = None
    back_m: Length | None = None


class PersonRecord(_NodeRecord):
    """A person."""

    type: Literal["person"]
    name: str = ""
    last_seen_s: float | None = None


class RobotRecord(_NodeRecord):
    """The robot; need not be listed."""

    type: Literal["robot"]
    holding: str | None = None
    battery: Probability = 1.0
    status: str = "idle"
    localized: bool = True


class AffordanceRecord(_NodeRecord):
    """Something the robot may do with its target, which owns it unless a ``has`` edge says otherwise."""

    type: Literal["affordance"]
    kind: AffordanceKind = AffordanceKind.VISIT
    target: str


class RegionRecord(_NodeRecord):
    """A region; its rooms are listed here or told by ``in`` edges."""

    type: Literal["region"]
    rooms: tuple[str, ...] = ()


NodeRecord = (
    RootRecord
    | RoomRecord
    | WallRecord
    | CornerRecord
    | DoorRecord
    | ObjectRecord
    | PersonRecord
    | RobotRecord
    | AffordanceRecord
    | RegionRecord
)


class EdgeRecord(_Record):
    """``type`` is an edge type, or directly the predicate of a relation, such as ``on``."""

    source: str
    target: str
    type: str
    label: str = ""
    probability: Probability = 1.0
    action: IntentionAction = IntentionAction.VISIT
    status: IntentionStatus = IntentionStatus.PROPOSED
    priority: int = 0
    standoff_m: float = 0.0
    side_rad: float | None = None
    proposed_s: float = 0.0
    reason: str = ""
    needs: tuple[str, ...] = ()


class SceneDocument(_Record):
    """The whole document."""

    revision: Annotated[int, Field(ge=0)] = 0
    stamp_s: float = 0.0
    nodes: tuple[Annotated[NodeRecord, Field(discriminator="type")], ...]
    edges: tuple[EdgeRecord, ...] = ()
