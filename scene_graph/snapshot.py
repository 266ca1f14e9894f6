"""One immutable revision of the scene graph, and how to read it."""

from __future__ import annotations

from typing import TypeVar, cast

import numpy as np
from numpy.typing import NDArray

from scene_graph.edges import Edge, EdgeKey, EdgeType, HasIntentionEdge, IntentionStatus, RelationEdge, RtEdge
from scene_graph.errors import EdgeNotFound, NodeNotFound, WrongNodeType
from scene_graph.frames import chain_up, chains_to_common_ancestor, covariance_between, transform_between
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import natural_key
from scene_graph.nodes import (
    NODE_CLASSES,
    ROBOT_ID,
    ROOT_ID,
    AffordanceNode,
    CornerNode,
    DoorNode,
    Node,
    NodeType,
    ObjectNode,
    PersonNode,
    RegionNode,
    RobotNode,
    RoomNode,
    RootNode,
    WallNode,
    node_type,
)
from scene_graph.tables.store import Store

ABSENT = -1
SUPPORTING_PREDICATES = ("on", "in")

N = TypeVar("N", bound=Node)
_TYPES: dict[type, NodeType] = {cls: kind for kind, cls in NODE_CLASSES.items()}


class Snapshot(Store):
    """The graph at one revision. Readers may keep it as long as they like, in any thread."""

    __slots__ = ()

    def __contains__(self, node_id: object) -> bool:
        return node_id in self._nodes

    def get(self, node_id: str) -> Node | None:
        """The node, or None."""
        return self._nodes.get(node_id)

    def node(self, node_id: str) -> Node:
        """The node.

        Raises:
            NodeNotFound: there is none; the error lists what there is.
        """
        node = self._nodes.get(node_id)
        if node is None:
            raise NodeNotFound(node_id, self._nodes)
        return node

    def of_type(self, cls: type[N]) -> tuple[N, ...]:
        """All nodes of a class in natural order of their identifiers; computed once per change of the type."""
        kind = _TYPES[cls]
        nodes = self._by_type.get(kind)
        if nodes is None:
            nodes = tuple(self._nodes[node_id] for node_id in self._catalog.ids(kind))
            self._by_type[kind] = nodes
        return cast("tuple[N, ...]", nodes)

    def typed(self, node_id: str, cls: type[N]) -> N:
        """The node, which must be of the class.

        Raises:
            NodeNotFound: there is no such node; the error lists those of the class.
            WrongNodeType: there is one, of another type.
        """
        node = self._nodes.get(node_id)
        if isinstance(node, cls):
            return node
        available = self._catalog.ids(_TYPES[cls])
        if node is None:
            raise NodeNotFound(node_id, available)
        raise WrongNodeType(node_id, actual=node_type(node), expected=_TYPES[cls], available=available)

    def room(self, node_id: str) -> RoomNode:
        """The room of this identifier; raises as ``typed``, like all lookups below."""
        return self.typed(node_id, RoomNode)

    def wall(self, node_id: str) -> WallNode:
        """The wall of this identifier."""
        return self.typed(node_id, WallNode)

    def corner(self, node_id: str) -> CornerNode:
        """The corner of this identifier."""
        return self.typed(node_id, CornerNode)

    def door(self, node_id: str) -> DoorNode:
        """The door of this identifier."""
        return self.typed(node_id, DoorNode)

    def object(self, node_id: str) -> ObjectNode:
        """The object of this identifier."""
        return self.typed(node_id, ObjectNode)

    def person(self, node_id: str) -> PersonNode:
        """The person of this identifier."""
        return self.typed(node_id, PersonNode)

    def affordance(self, node_id: str) -> AffordanceNode:
        """The affordance of this identifier."""
        return self.typed(node_id, AffordanceNode)

    @property
    def robot(self) -> RobotNode | None:
        """The robot; every graph in a working memory has one."""
        node = self._nodes.get(ROBOT_ID)
        return node if isinstance(node, RobotNode) else None

    @property
    def root(self) -> RootNode:
        """The root."""
        return self.typed(ROOT_ID, RootNode)

    def edge(self, key: EdgeKey) -> Edge:
        """The edge.

        Raises:
            EdgeNotFound: there is none; the error lists the edges that leave its source.
        """
        edge = self._edges.get(key)
        if edge is None:
            raise EdgeNotFound(key, [other.key for other in self.edges_from(key.source)])
        return edge

    def edges_from(self, node_id: str, kind: EdgeType | None = None) -> tuple[Edge, ...]:
        """Edges whose source is the node, of one type or of all."""
        kinds = EdgeType if kind is None else (kind,)
        return tuple(self._edges[key] for k in kinds for key in self._adjacency.outgoing(node_id, k))

    def edges_to(self, node_id: str, kind: EdgeType | None = None) -> tuple[Edge, ...]:
        """Edges whose target is the node, of one type or of all."""
        kinds = EdgeType if kind is None else (kind,)
        return tuple(self._edges[key] for k in kinds for key in self._adjacency.incoming(node_id, k))

    def edges_at(self, node_id: str) -> tuple[Edge, ...]:
        """All edges that leave or enter the node."""
        return tuple(self._edges[key] for key in self._adjacency.touching(node_id))

    def revision_of(self, element: str | EdgeKey) -> int:
        """Revision that last wrote a node (identifier) or an edge (key); ``ABSENT`` when it does not exist."""
        if isinstance(element, EdgeKey):
            return self._edge_revisions.of(element) if element in self._edges else ABSENT
        return self._node_revisions.of(element) if element in self._nodes else ABSENT

    def parent(self, node_id: str) -> RtEdge | None:
        """The rt edge from the parent frame."""
        keys = self._adjacency.incoming(node_id, EdgeType.RT)
        return cast("RtEdge", self._edges[keys[0]]) if keys else None

    def children(self, node_id: str) -> tuple[str, ...]:
        """Identifiers of the frames that hang from this one, in the order in which they were hung there."""
        return tuple(key.target for key in self._adjacency.outgoing(node_id, EdgeType.RT))

    def transform(self, target: str, source: str) -> SE3:
        """``T_target_source``: maps coordinates in frame ``source`` to frame ``target``.

        Raises:
            NodeNotFound: one of the two does not exist.
            FramesNotConnected: no chain of rt edges joins them.
        """
        self.node(target), self.node(source)
        return transform_between(*chains_to_common_ancestor(self.parent, target, source))

    def transform_with_covariance(self, target: str, source: str) -> tuple[SE3, NDArray[np.float64]]:
        """``T_target_source`` and its covariance (6, 6), expressed in the source frame (right perturbation).

        Order (x, y, z, rx, ry, rz); the errors of different rt edges are taken as independent.
        """
        self.node(target), self.node(source)
        chains = chains_to_common_ancestor(self.parent, target, source)
        return transform_between(*chains), covariance_between(*chains)

    def position(self, node_id: str, frame: str) -> NDArray[np.float64]:
        """Origin (3,) of a node in a frame, in meters; read-only."""
        return self.transform(frame, node_id).translation_m

    def room_of(self, node_id: str) -> str | None:
        """The room a node belongs to.

        A room is its own; an ``in`` edge says it for objects, persons and the robot; otherwise it is the first room
        among the parent frames. An affordance is where its owner is.
        """
        node = self.node(node_id)
        if isinstance(node, RoomNode):
            return node_id
        if isinstance(node, AffordanceNode):
            owners = self._adjacency.incoming(node_id, EdgeType.HAS)
            return self.room_of(owners[0].source) if owners else None
        stated = self._adjacency.outgoing(node_id, EdgeType.IN)
        if stated:
            return stated[0].target
        above = (edge.source for edge in chain_up(self.parent, node_id))
        return next((frame for frame in above if isinstance(self._nodes.get(frame), RoomNode)), None)

    def region(self, node_id: str) -> RegionNode:
        """The region of this identifier."""
        return self.typed(node_id, RegionNode)

    def region_of(self, node_id: str) -> str | None:
        """The region of the room that a node belongs to; a region is its own."""
        if isinstance(self.node(node_id), RegionNode):
            return node_id
        room = self.room_of(node_id)
        stated = self._adjacency.outgoing(room, EdgeType.IN) if room is not None else ()
        return stated[0].target if stated else None

    def rooms_in(self, region_id: str) -> tuple[str, ...]:
        """The rooms of a region, in natural order."""
        self.region(region_id)
        members = (key.source for key in self._adjacency.incoming(region_id, EdgeType.IN))
        return tuple(sorted(members, key=natural_key))

    @property
    def current_room(self) -> str | None:
        """The room the robot is in."""
        return self.room_of(ROBOT_ID) if ROBOT_ID in self._nodes else None

    def intentions(self, status: IntentionStatus | None = None) -> tuple[HasIntentionEdge, ...]:
        """What agents and tasks ask of the robot, in the order in which they first asked."""
        edges = cast("tuple[HasIntentionEdge, ...]", self.edges_from(ROBOT_ID, EdgeType.HAS_INTENTION))
        return edges if status is None else tuple(edge for edge in edges if edge.status is status)

    def relations(
        self, source: str | None = None, predicate: str | None = None, target: str | None = None
    ) -> tuple[RelationEdge, ...]:
        """Relations with this source, predicate and target; None matches all."""
        if source is not None:
            keys = self._adjacency.outgoing(source, EdgeType.RELATION)
        elif target is not None:
            keys = self._adjacency.incoming(target, EdgeType.RELATION)
        else:
            keys = self._adjacency.of_type(EdgeType.RELATION)
        wanted = (key for key in keys if predicate in (None, key.label) and target in (None, key.target))
        return tuple(cast("RelationEdge", self._edges[key]) for key in wanted)

    def support_of(self, object_id: str) -> str | None:
        """What an object is most probably on or in; ties go to the first in natural order."""
        supports = [edge for edge in self.relations(source=object_id) if edge.predicate in SUPPORTING_PREDICATES]
        ranked = sorted(supports, key=lambda edge: (-edge.probability, natural_key(edge.target)))
        return ranked[0].target if ranked else None
