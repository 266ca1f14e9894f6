"""Working memory: the one owner of the current snapshot. Agents meet here and nowhere else."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from types import TracebackType
from typing import Self

from scene_graph.checks.draft import Draft
from scene_graph.checks.edge_checks import edge_value_violations
from scene_graph.checks.invariants import check, check_draft
from scene_graph.diff import Delta
from scene_graph.edges import Edge, EdgeKey, RtEdge
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.errors import Conflict, InvariantBroken, RevisionConflict, RoomInUse, edge_name
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.building import Building
from scene_graph.long_term.demand import Demand, demand_of
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.room_parts import cut_room, keeps_in_use
from scene_graph.nodes import ROBOT_ID, ROOT_ID, Node, RobotNode, RootNode
from scene_graph.snapshot import Snapshot
from scene_graph.subscription import Subscription

LOADER = "long_term_memory"
"""Who brings back a room that an edit of somebody else needs."""


def first_snapshot() -> Snapshot:
    """A graph with the root and the robot standing on it."""
    start = RtEdge(source=ROOT_ID, target=ROBOT_ID, T_source_target=SE3.identity())
    return Snapshot.of([RootNode(), RobotNode()], [start])


class WorkingMemory:
    """Holds the current snapshot; commits are atomic, numbered by one, checked and published.

    With a long-term memory beside it, rooms can be unloaded and loaded. Edits that need an unloaded room bring it back
    by themselves, so whoever writes need not know what is loaded. Any thread may read and commit. Reading the snapshot
    takes no lock.
    """

    def __init__(self, snapshot: Snapshot | None = None, *, long_term: LongTermStore | None = None) -> None:
        """Starts from a snapshot, or from root and robot.

        Args:
            snapshot: what is loaded.
            long_term: what is known besides; ``None`` for a memory that never unloads anything.

        Raises:
            InvariantBroken: the snapshot is not sound.
        """
        self._snapshot = first_snapshot() if snapshot is None else snapshot
        self._long_term = long_term
        if long_term is not None:
            self._snapshot = self._snapshot.keeping(elsewhere=long_term)
        violations = check(self._snapshot)
        if violations:
            raise InvariantBroken(violations)
        self._building = Building()
        self._lock = threading.Lock()
        self._subscriptions: tuple[Subscription, ...] = ()

    def snapshot(self) -> Snapshot:
        """What is loaded: the robot's surroundings, for those who act in them; never blocks."""
        return self._snapshot

    def building(self) -> Snapshot:
        """Everything known, unloaded rooms included, for those who plan, answer and show."""
        if self._long_term is None:
            return self._snapshot
        with self._lock:
            return self._building.view(self._snapshot, self._long_term)

    @property
    def unloaded(self) -> tuple[str, ...]:
        """The rooms that long-term memory holds."""
        if self._long_term is None:
            return ()
        with self._lock:
            return tuple(self._long_term.rooms)

    @property
    def unfinished(self) -> tuple[str, ...]:
        """Unloaded rooms in which something is left to explore."""
        return self._long_term.unfinished if self._long_term is not None else ()

    def room_of(self, node_id: str) -> str | None:
        """The room of a node, loaded or not; ``None`` when nobody knows."""
        stored = self._long_term.room_of(node_id) if self._long_term is not None else None
        if stored is not None:
            return stored
        snapshot = self._snapshot
        return snapshot.room_of(node_id) if node_id in snapshot else None

    @property
    def can_unload(self) -> bool:
        """Whether there is a long-term memory to unload rooms to."""
        return self._long_term is not None

    def commit(
        self,
        edits: Iterable[Edit],
        *,
        agent: str,
        stamp_s: float,
        expected: Mapping[str | EdgeKey, int] | None = None,
    ) -> Snapshot:
        """Applies all edits as one revision, or none of them; rooms that they need are loaded first, as another.

        Args:
            edits: in the order in which they take effect. An empty list makes no revision.
            agent: who writes; subscribers see it.
            stamp_s: time of the belief in seconds. The snapshot keeps the latest stamp of all commits.
            expected: last-written revision of what the edits rest on, as ``revision_of`` told; ``ABSENT`` for nothing.

        Returns:
            The snapshot after the edits.

        Raises:
            RevisionConflict: something expected was written since.
            InvariantBroken: the edits would break the graph; the error lists every violation.
        """
        edits = tuple(edits)
        with self._lock:
            base = self._snapshot
            _require_expected(base, expected or {}, agent)
            demand = Demand(edits=edits) if self._long_term is None else demand_of(self._long_term, edits)
            self._bring(demand.rooms, LOADER, base.stamp_s)
            return self._apply(demand, agent, stamp_s)

    def load(self, *node_ids: str, agent: str, stamp_s: float) -> Snapshot:
        """Bring back the unloaded rooms that hold these nodes; what is loaded or unknown is passed over."""
        with self._lock:
            homes = (self._long_term.room_of(node_id) for node_id in node_ids) if self._long_term is not None else ()
            self._bring(tuple(dict.fromkeys(home for home in homes if home is not None)), agent, stamp_s)
            return self._snapshot

    def unload(self, *rooms: str, agent: str, stamp_s: float) -> Snapshot:
        """Hand rooms with everything in them over to long-term memory.

        Raises:
            RoomInUse: the robot, what it holds, or a room still being measured depends on one of them.
            NodeNotFound: one of them is not loaded.
        """
        with self._lock:
            base = self._snapshot
            if self._long_term is None or not rooms:
                return base
            for room in rooms:
                if (user := keeps_in_use(base, room)) is not None:
                    raise RoomInUse(room, user)
            cut = [cut_room(base, room) for room in rooms]
            draft = Draft(base, [RemoveNode(node.id) for parts in cut for node in parts.nodes])
            after = self._checked(draft, agent, stamp_s)
            for parts in cut:
                self._long_term.store(parts)
            self._put_in_force(draft, after, agent, unloaded=rooms)
            return after

    def edit(self, agent: str, stamp_s: float, *, expected: Mapping[str | EdgeKey, int] | None = None) -> Transaction:
        """Collects edits in a ``with`` block and commits them at its end, or none of them if it raises."""
        return Transaction(self, agent=agent, stamp_s=stamp_s, expected=expected)

    def subscribe(self, capacity: int = 256) -> Subscription:
        """Deltas of all commits from now on; see ``Subscription`` for what a slow reader is told."""
        subscription = Subscription(capacity, self._forget)
        with self._lock:
            self._subscriptions = (*self._subscriptions, subscription)
        return subscription

    def _forget(self, subscription: Subscription) -> None:
        with self._lock:
            self._subscriptions = tuple(other for other in self._subscriptions if other is not subscription)

    def _bring(self, rooms: tuple[str, ...], agent: str, stamp_s: float) -> None:
        """Load rooms, as a revision of its own."""
        if self._long_term is None or not rooms:
            return
        nodes, edges = self._long_term.peek(rooms)
        draft = Draft(self._snapshot, [*map(PutNode, nodes), *map(PutEdge, edges)])
        after = self._checked(draft, agent, stamp_s)
        self._long_term.load(*rooms)
        self._put_in_force(draft, after, agent, loaded=rooms)

    def _apply(self, demand: Demand, agent: str, stamp_s: float) -> Snapshot:
        draft = Draft(self._snapshot, demand.edits)
        if draft.is_empty and not demand.replaced:
            return self._snapshot
        violations = [flaw for edge in demand.replaced for flaw in edge_value_violations(edge.key, edge)]
        if violations:
            raise InvariantBroken(violations, agent)
        after = self._checked(draft, agent, stamp_s)
        if self._long_term is not None:
            self._settle(self._long_term, demand, draft)
        self._put_in_force(draft, after, agent)
        return after

    def _checked(self, draft: Draft, agent: str, stamp_s: float) -> Snapshot:
        base = draft.base
        after = draft.result(revision=base.revision + 1, stamp_s=max(base.stamp_s, stamp_s))
        violations = check_draft(draft, after)
        if violations:
            raise InvariantBroken(violations, agent)
        return after

    def _settle(self, store: LongTermStore, demand: Demand, draft: Draft) -> None:
        """Long-term memory follows an edit that is in force: what was written anew, what was torn off."""
        dropped = [key for node_id in draft.removed_nodes for key in store.forget(node_id)]
        for edge in demand.replaced:
            store.replace(edge)
        self._building.note(draft, replaced=demand.replaced, dropped=dropped)

    def _put_in_force(
        self, draft: Draft, after: Snapshot, agent: str, *, loaded: tuple[str, ...] = (), unloaded: tuple[str, ...] = ()
    ) -> None:
        self._snapshot = after
        if not self._subscriptions:
            return
        delta = Delta(
            base_revision=draft.base.revision,
            revision=after.revision,
            stamp_s=after.stamp_s,
            agent=agent,
            put_nodes=tuple(draft.put_nodes.values()),
            removed_nodes=tuple(draft.removed_nodes),
            put_edges=tuple(draft.put_edges.values()),
            removed_edges=tuple(draft.removed_edges),
            loaded=loaded,
            unloaded=unloaded,
        )
        for subscription in self._subscriptions:
            subscription.publish(delta)


class Transaction:
    """Edits on their way into the working memory.

    Attributes:
        snapshot: what the memory held when the transaction began; after the block, what it holds because of it.
    """

    def __init__(
        self, memory: WorkingMemory, *, agent: str, stamp_s: float, expected: Mapping[str | EdgeKey, int] | None
    ) -> None:
        self._memory = memory
        self._agent = agent
        self._stamp_s = stamp_s
        self._expected = dict(expected or {})
        self._edits: list[Edit] = []
        self.snapshot = memory.snapshot()

    def put(self, *elements: Node | Edge) -> None:
        """Adds or replaces nodes and edges."""
        for element in elements:
            self._edits.append(PutNode(element) if isinstance(element, Node) else PutEdge(element))

    def remove(self, *elements: str | EdgeKey) -> None:
        """Removes nodes, with their edges, by identifier, and edges by key."""
        for element in elements:
            self._edits.append(RemoveEdge(element) if isinstance(element, EdgeKey) else RemoveNode(element))

    def expect(self, element: str | EdgeKey) -> None:
        """Commits only if the element is still as it was when the transaction began."""
        self._expected[element] = self.snapshot.revision_of(element)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.snapshot = self._memory.commit(
                self._edits, agent=self._agent, stamp_s=self._stamp_s, expected=self._expected
            )


def _require_expected(base: Snapshot, expected: Mapping[str | EdgeKey, int], agent: str) -> None:
    conflicts = [
        Conflict(
            subject=edge_name(element) if isinstance(element, EdgeKey) else element,
            expected=revision,
            actual=base.revision_of(element),
        )
        for element, revision in expected.items()
        if base.revision_of(element) != revision
    ]
    if conflicts:
        raise RevisionConflict(conflicts, agent)
