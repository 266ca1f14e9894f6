"""Node types of the scene graph (design, section 3; Concepts, Table 1).

A node says what a thing is. Where it is, is said by the ``rt`` edge from its parent (see ``edges.py``).
Lengths are in meters, angles in radians, times in seconds of the robot's clock.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

Point2 = tuple[float, float]
Point3 = tuple[float, float, float]

ROOT_ID = "root"
ROBOT_ID = "robot"


class NodeType(StrEnum):
    """Closed set of node types; the value is what JSON shows."""

    ROOT = "root"
    ROOM = "room"
    WALL = "wall"
    CORNER = "corner"
    DOOR = "door"
    OBJECT = "object"
    PERSON = "person"
    ROBOT = "robot"
    AFFORDANCE = "affordance"
    REGION = "region"


UNKNOWN_LABEL = "unknown"
"""Label of an object that perception sees and cannot name."""


class RoomStatus(StrEnum):
    """Stage of a room's life: temporary while being measured, permanent once it stands, partial if no concept fits."""

    TEMPORARY = "temporary"
    PERMANENT = "permanent"
    PARTIAL = "partial"


class DoorState(StrEnum):
    """Whether the robot can pass."""

    OPEN = "open"
    CLOSED = "closed"
    UNKNOWN = "unknown"


class CrossingStatus(StrEnum):
    """What exploration knows about the far side of a door."""

    UNCROSSED = "uncrossed"
    CROSSED = "crossed"
    GIVEN_UP = "given_up"


class ObjectState(StrEnum):
    """Belief about an object: where it was last seen, in the gripper, or not where it should be."""

    PRESENT = "present"
    HELD = "held"
    MISSING = "missing"


class AffordanceKind(StrEnum):
    """What a node offers the robot."""

    VISIT = "visit"
    CROSS = "cross"


@dataclass(frozen=True, kw_only=True)
class RootNode:
    """The origin of the tree of frames: the robot's pose at its very first start, x forward, z up."""

    id: str = ROOT_ID
    label: str = ""
    confidence: float = 1.0
    explored: bool = False


@dataclass(frozen=True, kw_only=True)
class RoomNode:
    """A room in its own frame.

    ``polygon_m``: inner face of the walls, counter-clockwise, room frame. ``label`` is ``""`` until contents or a
    person tell; ``label_taught`` marks a person's word, which perception never overrides.
    """

    id: str
    label: str = ""
    label_probability: float = 0.0
    label_taught: bool = False
    confidence: float = 1.0
    polygon_m: tuple[Point2, ...] = ()
    height_m: float = 2.5
    status: RoomStatus = RoomStatus.TEMPORARY


@dataclass(frozen=True, kw_only=True)
class WallNode:
    """One wall face.

    Wall frame: origin at the center of the face on the floor, x along the wall, y into the room, z up.
    ``normal`` and ``offset_m`` give its plane in the room frame: ``normal · p = offset_m``; it points into the room.
    """

    id: str
    label: str = ""
    confidence: float = 1.0
    parent_room: str
    normal: Point2
    offset_m: float
    length_m: float


@dataclass(frozen=True, kw_only=True)
class CornerNode:
    """Where two walls meet; its ``rt`` edge hangs it from the wall that starts there (counter-clockwise)."""

    id: str
    label: str = ""
    confidence: float = 1.0


@dataclass(frozen=True, kw_only=True)
class DoorNode:
    """A gap in one wall of one room, hung from that wall (origin at the gap's center on the floor, wall axes).

    A physical door that has been crossed is two nodes, one in each room, joined by a ``match`` edge. ``rooms`` is this
    door's own room first; the second is ``None`` until crossed. The identifier is ``door_<room>_<wall>_<k>``, with
    suffix ``_pre`` while provisional.
    """

    id: str
    label: str = ""
    confidence: float = 1.0
    rooms: tuple[str, str | None]
    width_m: float
    height_m: float = 2.0
    state: DoorState = DoorState.OPEN
    provisional: bool = True
    crossing: CrossingStatus = CrossingStatus.UNCROSSED
    crossing_reason: str = ""


@dataclass(frozen=True, kw_only=True)
class ObjectNode:
    """A thing: furniture or something to carry.

    Its origin is the center of its extent, its axes are those of its parent unless measured. ``size_m`` is the extent
    along its own x, y, z. ``label_distribution`` holds (label, probability), most likely first. ``existence``
    is the probability that it still is where it is said to be. ``surfaces_m``: heights above its own bottom on which
    things can stand, such as the boards of a shelf, as measured, lowest first; empty where none was measured.
    ``back_rad``: from the middle towards the back that rises over a seat, from the node's own x axis, counter-clockwise
    in (-pi, pi]; ``None`` where none was seen. ``back_m``: how far from the middle the back begins, where measured.
    ``color`` is the main color, ``accents`` are those of smaller parts, such as the case around a phone's screen.
    """

    id: str
    label: str
    confidence: float = 1.0
    label_distribution: tuple[tuple[str, float], ...] = ()
    color: str = ""
    accents: tuple[str, ...] = ()
    categories: tuple[str, ...] = ()
    name: str = ""
    size_m: Point3 = (0.0, 0.0, 0.0)
    first_seen_s: float = 0.0
    last_seen_s: float = 0.0
    state: ObjectState = ObjectState.PRESENT
    existence: float = 1.0
    graspable: bool = False
    support: bool = False
    inspected_s: float | None = None
    observations: int = 0
    surfaces_m: tuple[float, ...] = ()
    back_rad: float | None = None
    back_m: float | None = None


@dataclass(frozen=True, kw_only=True)
class PersonNode:
    """A person, standing at their ``rt`` pose; ``name`` is empty until told."""

    id: str
    label: str = "person"
    confidence: float = 1.0
    name: str = ""
    last_seen_s: float = 0.0


@dataclass(frozen=True, kw_only=True)
class RobotNode:
    """The robot itself. ``holding`` is the identifier of the object in the gripper, if any.

    ``localized`` is false while it does not know where it is: then it hangs from the root by a guess and is in no room.
    ``confidence`` falls from 1 while what it sees speaks against where it believes to be.
    """

    id: str = ROBOT_ID
    label: str = "robot"
    confidence: float = 1.0
    localized: bool = True
    holding: str | None = None
    battery: float = 1.0
    status: str = "idle"


@dataclass(frozen=True, kw_only=True)
class AffordanceNode:
    """Something the robot may do with ``target``, offered by a concept agent through a ``has`` edge."""

    id: str
    label: str = ""
    confidence: float = 1.0
    kind: AffordanceKind
    target: str


@dataclass(frozen=True, kw_only=True)
class RegionNode:
    """Rooms that belong together: a floor, a wing. An ``in`` edge leads from each of them; a room is in one at most."""

    id: str
    label: str = ""
    confidence: float = 1.0


Node = (
    RootNode
    | RoomNode
    | WallNode
    | CornerNode
    | DoorNode
    | ObjectNode
    | PersonNode
    | RobotNode
    | AffordanceNode
    | RegionNode
)

NODE_CLASSES: dict[NodeType, type[Node]] = {
    NodeType.ROOT: RootNode,
    NodeType.ROOM: RoomNode,
    NodeType.WALL: WallNode,
    NodeType.CORNER: CornerNode,
    NodeType.DOOR: DoorNode,
    NodeType.OBJECT: ObjectNode,
    NodeType.PERSON: PersonNode,
    NodeType.ROBOT: RobotNode,
    NodeType.AFFORDANCE: AffordanceNode,
    NodeType.REGION: RegionNode,
}
_TYPE_OF_CLASS = {cls: kind for kind, cls in NODE_CLASSES.items()}


def node_type(node: Node) -> NodeType:
    """The type of ``node``."""
    return _TYPE_OF_CLASS[type(node)]
