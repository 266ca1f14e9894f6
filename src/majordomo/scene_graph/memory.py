"""Working memory: the one owner of the current snapshot. Agents meet here and nowhere else."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from types import TracebackType
from typing import Self

from majordomo.scene_graph.diff import Delta
from majordomo.scene_graph.draft import Draft
from majordomo.scene_graph.edges import Edge, EdgeKey, RtEdge
from majordomo.scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge, RemoveNode
from majordomo.scene_graph.errors import Conflict, InvariantBroken, RevisionConflict, edge_name
from majordomo.scene_graph.invariants import check, check_draft
from majordomo.scene_graph.nodes import ROBOT_ID, ROOT_ID, Node, RobotNode, RootNode
from majordomo.scene_graph.se3 import SE3
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.scene_graph.subscription import Subscription


def first_snapshot() -> Snapshot:
    """A graph with the root and the robot standing on it."""
    start = RtEdge(source=ROOT_ID, target=ROBOT_ID, T_source_target=SE3.identity())
    return Snapshot.of([RootNode(), RobotNode()], [start])


class WorkingMemory:
    """Holds the current snapshot; commits are atomic, numbered by one, checked and published.

    Any thread may read and commit. Reading takes no lock.
    """

    def __init__(self, snapshot: Snapshot | None = None) -> None:
        """Starts from a snapshot, or from root and robot.

        Raises:
            InvariantBroken: the snapshot is not sound.
        """
        self._snapshot = first_snapshot() if snapshot is None else snapshot
        violations = check(self._snapshot)
        if violations:
            raise InvariantBroken(violations)
        self._lock = threading.Lock()
        self._subscriptions: tuple[Subscription, ...] = ()

    def snapshot(self) -> Snapshot:
        """The current snapshot; never blocks."""
        return self._snapshot

    def commit(
        self,
        edits: Iterable[Edit],
        *,
        agent: str,
        stamp_s: float,
        expected: Mapping[str | EdgeKey, int] | None = None,
    ) -> Snapshot:
        """Applies all edits as one revision, or none of them.

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
            draft = Draft(base, edits)
            if draft.is_empty:
                return base
            after = draft.result(revision=base.revision + 1, stamp_s=max(base.stamp_s, stamp_s))
            violations = check_draft(draft, after)
            if violations:
                raise InvariantBroken(violations, agent)
            self._snapshot = after
            self._publish(draft, after, agent)
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

    def _publish(self, draft: Draft, after: Snapshot, agent: str) -> None:
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
