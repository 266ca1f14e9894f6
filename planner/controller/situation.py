"""What the Controller judges: the graph now, and what the plan counted on when the step began."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from planner.plan import Step
from scene_graph.edges import RtEdge
from scene_graph.errors import FramesNotConnected
from scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState
from scene_graph.queries.topology import Topology
from scene_graph.snapshot import Snapshot

BYSTANDING = frozenset({"", "idle", "driving", "crossing", "looking"})
"""First words of what the skills announce while they touch nothing."""


@dataclass(frozen=True, kw_only=True)
class ExpectedObject:
    """Where the plan counts on an object: its room, what it stands on, and its position in the room's frame."""

    id: str
    room: str | None
    support: str | None
    position_m: tuple[float, float, float] | None


@dataclass(frozen=True, kw_only=True)
class Expectation:
    """What a plan counts on at one step.

    ``objects``: still to be picked up. ``supports``: things to be put on. ``held``: in the gripper. ``doors``: on the
    way of this step, as planned when it began.
    """

    objects: tuple[ExpectedObject, ...] = ()
    supports: tuple[str, ...] = ()
    held: str | None = None
    doors: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Situation:
    """One moment of a step.

    ``previous``: the graph at the tick before, if any. ``gripping``: the object that the fingers closed on, as the
    skills remember it. ``sensor_ages_s``: seconds since each sensor's newest data. ``active_s``: how long the step has
    acted.
    """

    snapshot: Snapshot
    stamp_s: float
    step: Step
    expected: Expectation = Expectation()
    previous: Snapshot | None = None
    gripping: str | None = None
    sensor_ages_s: Mapping[str, float] = field(default_factory=dict)
    active_s: float = 0.0
    timeout_s: float = 120.0

    @property
    def status(self) -> str:
        """What the skills announce that they are doing."""
        return self.snapshot.robot.status if self.snapshot.robot is not None else ""

    def touches(self, object_id: str) -> bool:
        """Whether the robot itself is handling an object, so that its moving is no surprise."""
        held = self.snapshot.robot is not None and self.snapshot.robot.holding == object_id
        verb, _, about = self.status.partition(" ")
        handled = self.gripping == object_id or (verb not in BYSTANDING and object_id in about.split())
        return held or (self.step.skill != "GOTO" and handled)


def expect(steps: Sequence[Step], snapshot: Snapshot) -> Expectation:
    """What carrying out ``steps``, the first of them next, counts on in the graph as it is."""
    held = snapshot.robot.holding if snapshot.robot is not None else None
    picked = [step.args[0] for step in steps if step.skill == "PICK"]
    placed_on = [step.args[1] for step in steps if step.skill == "PLACE"]
    supports = [node_id for node_id in placed_on if isinstance(snapshot.get(node_id), ObjectNode)]
    return Expectation(
        objects=tuple(expected_object(node_id, snapshot) for node_id in dict.fromkeys(picked)),
        supports=tuple(dict.fromkeys(supports)),
        held=held,
        doors=_doors_on_way(steps[0], snapshot) if steps else (),
    )


def expected_object(object_id: str, snapshot: Snapshot) -> ExpectedObject:
    """Where the graph says that an object is; nowhere, when it is not in the graph."""
    if object_id not in snapshot:
        return ExpectedObject(id=object_id, room=None, support=None, position_m=None)
    room = snapshot.room_of(object_id)
    return ExpectedObject(
        id=object_id,
        room=room,
        support=snapshot.support_of(object_id),
        position_m=position_in(object_id, room, snapshot),
    )


def position_in(object_id: str, room: str | None, snapshot: Snapshot) -> tuple[float, float, float] | None:
    """Position of an object in a room's frame, ``None`` when nothing connects them."""
    if room is None:
        return None
    try:
        x_m, y_m, z_m = snapshot.position(object_id, room)
    except FramesNotConnected:
        return None
    return float(x_m), float(y_m), float(z_m)


def way(step: Step, snapshot: Snapshot, *, only_open: bool) -> tuple[str, ...]:
    """Doors between the robot's room and the room of a GOTO's target."""
    here, target = snapshot.current_room, step.args[0] if step.skill == "GOTO" else None
    there = snapshot.room_of(target) if target is not None and target in snapshot else None
    if here is None or there is None or here == there:
        return ()
    path = Topology.from_snapshot(snapshot).path(here, there, only_open=only_open)
    return tuple(path.doors) if path is not None else ()


def robot_jump_m(before: Snapshot, now: Snapshot) -> tuple[float, float] | None:
    """How far the robot's pose moved between two snapshots (m), and in how long (s); ``None`` across rooms."""
    old, new = before.parent(ROBOT_ID), now.parent(ROBOT_ID)
    if not isinstance(old, RtEdge) or not isinstance(new, RtEdge) or old.source != new.source:
        return None
    moved = np.linalg.norm(new.T_source_target.translation_m - old.T_source_target.translation_m)
    return float(moved), new.stamp_s - old.stamp_s


def is_missing(node_id: str, snapshot: Snapshot) -> bool:
    """Whether an object is gone from the graph or not where it should be."""
    node = snapshot.get(node_id)
    return node is None or (isinstance(node, ObjectNode) and node.state is ObjectState.MISSING)


def _doors_on_way(step: Step, snapshot: Snapshot) -> tuple[str, ...]:
    return way(step, snapshot, only_open=True)
