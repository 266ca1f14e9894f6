"""Edge types of the scene graph (design, section 3; Concepts, Table 1)."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum, StrEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3


class EdgeType(StrEnum):
    """Closed set of edge types; the value is what JSON shows."""

    RT = "rt"
    IN = "in"
    RELATION = "relation"
    CONNECTS = "connects"
    MATCH = "match"
    HAS = "has"
    HAS_INTENTION = "has_intention"


class EdgeKey(NamedTuple):
    """Identity of an edge. ``label`` is the predicate of a relation, the agent of an intention, else empty."""

    type: EdgeType
    source: str
    target: str
    label: str = ""


class IntentionAction(StrEnum):
    """What an agent asks the robot to do with the edge's target."""

    VISIT = "visit"
    CROSS = "cross"
    LOOK = "look"
    TASK = "task"


class IntentionStatus(StrEnum):
    """Life of an intention: agents propose, the arbiter grants or revokes, the executor marks done or failed."""

    PROPOSED = "proposed"
    GRANTED = "granted"
    DONE = "done"
    FAILED = "failed"
    REVOKED = "revoked"


OPEN_INTENTION = frozenset({IntentionStatus.PROPOSED, IntentionStatus.GRANTED, IntentionStatus.REVOKED})
TASK_AGENT = "task:"
"""How the names begin under which tasks ask for the robot; all others explore."""


class Priority(IntEnum):
    """Who goes first when several intentions compete; a request outranks exploration."""

    CROSS_DOOR = 10
    LOOK_AROUND = 20
    VISIT_DOOR = 30
    MEASURE_ROOM = 40
    REQUEST = 100


@dataclass(frozen=True, kw_only=True, eq=False)
class RtEdge:
    """Rigid transform from parent (source) to child (target) frame.

    ``T_source_target`` maps child coordinates into the parent. ``covariance`` is 6x6, order (x, y, z, rot x, rot y,
    rot z), expressed in the child frame (right perturbation), read-only. ``wall_shifts_m``, of the edge from the root
    to a room: how far the layout shifts each of its walls along the normal, positive into the room, so that loops of
    doors close; empty where it shifts none. The room itself stays as it was measured.
    """

    source: str
    target: str
    T_source_target: SE3
    covariance: NDArray[np.float64] = field(default_factory=lambda: np.zeros((6, 6)))
    stamp_s: float = 0.0
    wall_shifts_m: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        matrix = np.array(self.covariance, dtype=np.float64)
        if matrix.shape != (6, 6):
            raise ValueError(f"covariance of rt {self.source} -> {self.target} must be 6x6, not {matrix.shape}")
        matrix.flags.writeable = False
        object.__setattr__(self, "covariance", matrix)

    @property
    def key(self) -> EdgeKey:
        return EdgeKey(EdgeType.RT, self.source, self.target)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, RtEdge)
            and self.key == other.key
            and self.stamp_s == other.stamp_s
            and self.T_source_target == other.T_source_target
            and self.wall_shifts_m == other.wall_shifts_m
            and np.array_equal(self.covariance, other.covariance)
        )

    def __hash__(self) -> int:
        return hash((self.key, self.stamp_s))


@dataclass(frozen=True, kw_only=True)
class InEdge:
    """An object, person or robot (source) belongs to a room (target), a room to a region; to one at most."""

    source: str
    target: str

    @property
    def key(self) -> EdgeKey:
        return EdgeKey(EdgeType.IN, self.source, self.target)


@dataclass(frozen=True, kw_only=True)
class RelationEdge:
    """Panoptic scene graph predicate between two objects, with its smoothed probability."""

    source: str
    target: str
    predicate: str
    probability: float
    stamp_s: float = 0.0

    @property
    def key(self) -> EdgeKey:
        return EdgeKey(EdgeType.RELATION, self.source, self.target, self.predicate)


@dataclass(frozen=True, kw_only=True)
class ConnectsEdge:
    """A door (source) joins a room (target); a crossed door has two such edges."""

    source: str
    target: str

    @property
    def key(self) -> EdgeKey:
        return EdgeKey(EdgeType.CONNECTS, self.source, self.target)


@dataclass(frozen=True, kw_only=True)
class MatchEdge:
    """Two door nodes in two rooms are the same physical door; stored once, source < target.

    ``walked``: (x, y, yaw) of the target's room in the frame of the source's, in meters and radians, as the robot drove
    from one into the other; ``walked_std_m`` of its translation. ``None`` where nobody has told.
    """

    source: str
    target: str
    walked: tuple[float, float, float] | None = None
    walked_std_m: float = 0.0

    @property
    def key(self) -> EdgeKey:
        return EdgeKey(EdgeType.MATCH, self.source, self.target)


@dataclass(frozen=True, kw_only=True)
class HasEdge:
    """A node (source) offers an affordance (target)."""

    source: str
    target: str

    @property
    def key(self) -> EdgeKey:
        return EdgeKey(EdgeType.HAS, self.source, self.target)


@dataclass(frozen=True, kw_only=True)
class HasIntentionEdge:
    """An agent or task asks for the robot (source) to act on a node (target).

    ``standoff_m`` is how far from the target to stop (visit, look); ``side_rad``, where given, from which side, as a
    direction in the target's frame. ``reason`` says why it ended. ``needs`` names what must be known for it besides the
    target: memory keeps the rooms of these nodes, and those on the way, at hand.
    """

    source: str
    target: str
    agent: str
    action: IntentionAction
    status: IntentionStatus = IntentionStatus.PROPOSED
    priority: int
    standoff_m: float = 0.0
    side_rad: float | None = None
    proposed_s: float = 0.0
    reason: str = ""
    needs: tuple[str, ...] = ()

    @property
    def key(self) -> EdgeKey:
        return EdgeKey(EdgeType.HAS_INTENTION, self.source, self.target, self.agent)

    @property
    def is_open(self) -> bool:
        """Whether it is neither done nor failed."""
        return self.status in OPEN_INTENTION

    @property
    def explores(self) -> bool:
        """Whether an agent asks in order to know the building better, and not a task."""
        return not self.agent.startswith(TASK_AGENT)


Edge = RtEdge | InEdge | RelationEdge | ConnectsEdge | MatchEdge | HasEdge | HasIntentionEdge
