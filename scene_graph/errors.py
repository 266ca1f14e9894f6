"""What can go wrong with the scene graph; every error carries its data and lists what was available."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scene_graph.edges import EdgeKey
    from scene_graph.nodes import NodeType

_LISTED = 12
"""Names that a message lists: one line or two of text."""


def _list_names(wanted: str, available: Sequence[str]) -> str:
    """The available names, or, of more than a dozen, those closest to the wanted one first."""
    if not available:
        return "there are none"
    if len(available) <= _LISTED:
        return ", ".join(available)
    close = get_close_matches(wanted, available[:2000], n=_LISTED, cutoff=0.5)
    listed = [*close, *[name for name in available[:_LISTED] if name not in close]][:_LISTED]
    return f"{', '.join(listed)} and {len(available) - len(listed)} more"


class SceneGraphError(Exception):
    """Base of everything this package raises on purpose."""


class NodeNotFound(SceneGraphError, LookupError):
    """No node has this identifier."""

    def __init__(self, node_id: str, available: Iterable[str]) -> None:
        self.node_id = node_id
        self.available = tuple(available)
        super().__init__(f"no node {node_id!r}; available: {_list_names(node_id, self.available)}")


class WrongNodeType(SceneGraphError, TypeError):
    """The node exists but is of another type than the one asked for."""

    def __init__(self, node_id: str, *, actual: NodeType, expected: NodeType, available: Iterable[str]) -> None:
        self.node_id = node_id
        self.actual = actual
        self.expected = expected
        self.available = tuple(available)
        names = _list_names(node_id, self.available)
        super().__init__(f"{node_id!r} is of type {actual}, not {expected}; of that type: {names}")


class EdgeNotFound(SceneGraphError, LookupError):
    """No edge has this key."""

    def __init__(self, key: EdgeKey, available: Iterable[EdgeKey]) -> None:
        self.key = key
        self.available = tuple(available)
        listed = ", ".join(edge_name(other) for other in self.available[:_LISTED]) or "none"
        super().__init__(f"no edge {edge_name(key)}; edges that leave {key.source!r}: {listed}")


class FramesNotConnected(SceneGraphError):
    """No chain of rt edges joins two frames."""

    def __init__(self, target: str, source: str, *, target_chain: Sequence[str], source_chain: Sequence[str]) -> None:
        self.target = target
        self.source = source
        self.target_chain = tuple(target_chain)
        self.source_chain = tuple(source_chain)
        super().__init__(
            f"no chain of rt edges joins {source!r} to {target!r}: "
            f"{' < '.join(self.source_chain)} and {' < '.join(self.target_chain)} never meet"
        )


class ViolationKind(StrEnum):
    """Closed set of the invariants of the graph, named by how they are broken."""

    ROOT_MISSING = "root_missing"
    ROBOT_MISSING = "robot_missing"
    MALFORMED_ID = "malformed_id"
    UNKNOWN_ELEMENT = "unknown_element"
    NOT_FINITE = "not_finite"
    NOT_A_PROBABILITY = "not_a_probability"
    NEGATIVE_LENGTH = "negative_length"
    NO_PARENT = "no_parent"
    TWO_PARENTS = "two_parents"
    FRAME_CYCLE = "frame_cycle"
    AFFORDANCE_WITHOUT_OWNER = "affordance_without_owner"
    TWO_ROOMS = "two_rooms"
    DANGLING_EDGE = "dangling_edge"
    WRONG_END_TYPE = "wrong_end_type"
    COVARIANCE = "covariance"
    MATCH_ORDER = "match_order"
    MATCH_SAME_ROOM = "match_same_room"
    TWO_HELD = "two_held"
    HELD_INCONSISTENT = "held_inconsistent"


@dataclass(frozen=True, kw_only=True, order=True)
class Violation:
    """One broken invariant: which one, on what node or edge, and a sentence that says how."""

    kind: ViolationKind
    subject: str
    message: str


class TransactionRejected(SceneGraphError):
    """The transaction was not applied; the graph is as it was."""


class InvariantBroken(TransactionRejected):
    """The edits would have broken the graph."""

    def __init__(self, violations: Iterable[Violation], agent: str = "") -> None:
        self.violations = tuple(violations)
        self.agent = agent
        who = f"transaction of {agent!r} rejected: " if agent else ""
        super().__init__(who + "; ".join(violation.message for violation in self.violations))


@dataclass(frozen=True, kw_only=True)
class Conflict:
    """A node or edge was written since it was read. Revisions of something absent are ``ABSENT`` (-1)."""

    subject: str
    expected: int
    actual: int


class RevisionConflict(TransactionRejected):
    """What the writer had read has changed meanwhile; read again and decide again."""

    def __init__(self, conflicts: Iterable[Conflict], agent: str = "") -> None:
        self.conflicts = tuple(conflicts)
        self.agent = agent
        listed = "; ".join(f"{c.subject} is at revision {c.actual}, not {c.expected}" for c in self.conflicts)
        super().__init__(f"transaction of {agent!r} rejected: {listed}")


class DeltaMismatch(SceneGraphError):
    """A delta was applied to another revision than the one it starts from."""

    def __init__(self, *, base_revision: int, revision: int) -> None:
        self.base_revision = base_revision
        self.revision = revision
        super().__init__(f"the delta starts from revision {base_revision}, the snapshot is at {revision}")


class SubscriptionClosed(SceneGraphError):
    """The subscription was closed while someone waited on it, or before."""


class UnknownRoom(SceneGraphError, LookupError):
    """No room has this identifier or label."""

    def __init__(self, room: str, available: Iterable[str]) -> None:
        self.room = room
        self.available = tuple(available)
        super().__init__(f"no room {room!r}; rooms: {_list_names(room, self.available)}")


class UnknownRegion(SceneGraphError, LookupError):
    """No region has this identifier or label."""

    def __init__(self, region: str, available: Iterable[str]) -> None:
        self.region = region
        self.available = tuple(available)
        super().__init__(f"no region {region!r}; regions: {_list_names(region, self.available)}")


class RoomNotStored(SceneGraphError, LookupError):
    """Long-term memory holds no room of this identifier."""

    def __init__(self, room: str, available: Iterable[str]) -> None:
        self.room = room
        self.available = tuple(available)
        super().__init__(f"no stored room {room!r}; stored: {_list_names(room, self.available)}")


class RoomInUse(SceneGraphError):
    """A room cannot leave working memory because of what is in it."""

    def __init__(self, room: str, by: str) -> None:
        self.room = room
        self.by = by
        super().__init__(f"{room} cannot be unloaded: {by} is in it or hangs from it")


class UnknownLayer(SceneGraphError, LookupError):
    """No node type has this name."""

    def __init__(self, layer: str, available: Iterable[str]) -> None:
        self.layer = layer
        self.available = tuple(available)
        super().__init__(f"no layer {layer!r}; layers: {', '.join(self.available)}")


class SceneFormatError(SceneGraphError, ValueError):
    """A scene document cannot be read; ``path`` names the offending field, such as ``nodes[3].width_m``."""

    def __init__(self, path: str, problem: str) -> None:
        self.path = path
        self.problem = problem
        super().__init__(f"{path}: {problem}")


def edge_name(key: EdgeKey) -> str:
    """A short readable name of an edge, such as ``relation bottle_1 -on-> table_1``."""
    arrow = f"-{key.label}->" if key.label else "->"
    return f"{key.type} {key.source} {arrow} {key.target}"
