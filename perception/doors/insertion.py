"""The edits of the door concept: provisional and permanent doors, affordances, intentions (Concepts, figure 6)."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from perception.crossing import CLOSED_REASON, DOOR_AGENT, cross_affordance, given_up
from perception.doors.posts import MeasuredGap
from perception.doors.wall_evidence import Gap
from perception.geometry.planar import diagonal_covariance, spatial_covariance
from perception.localization.doorways import DoorSizes
from scene_graph.edges import ConnectsEdge, HasEdge, HasIntentionEdge, IntentionAction, Priority, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import room_number, wall_id_of
from scene_graph.memory import Transaction
from scene_graph.nodes import ROBOT_ID, AffordanceKind, AffordanceNode, DoorNode, DoorState
from scene_graph.snapshot import Snapshot

SUSPICION = 0.1
"""Confidence that marks a stretch of wall that nobody has seen; every door that was seen has more."""
_SUFFIX = "_pre"


@dataclass(frozen=True, kw_only=True)
class DoorNodeSettings:
    """What is written about doors, by how well they are measured."""

    standoff_m: float = 1.0
    """From a door that is looked at from the front. Chosen: rays meet both its posts."""
    hidden_width_m: float = 0.9
    """Of a door that nobody has seen: a usual one's."""
    seen: float = 0.4
    """Confidence of a provisional door. Chosen: less than a half."""
    seen_post: float = 0.2
    """And for each of its posts that is measured. Chosen."""
    measured: tuple[float, float, float] = (0.6, 0.75, 0.95)
    """Confidence of a permanent door with none, one and both of its posts measured. Chosen: in this order."""
    well_measured: float = 0.9
    """Confidence from which on both posts are measured: between the last two above."""
    predicted_std_m: float = 0.03
    """Of a place that the layout of the rooms predicts. Chosen."""
    narrower_m: float = 0.03
    """By so much a gap may seem wider than the same one from the other side: errors of four posts."""
    sizes: DoorSizes = field(default_factory=DoorSizes)


def free_door_id(snapshot: Snapshot, room_id: str, wall: int) -> str:
    """``door_<room>_<wall>_<k>`` with the first number that neither a provisional nor a permanent door has."""
    stem = f"door_{room_number(room_id)}_{wall}_"
    number = 0
    while f"{stem}{number}" in snapshot or f"{stem}{number}{_SUFFIX}" in snapshot:
        number += 1
    return f"{stem}{number}"


def hang(door_id: str, wall_id: str, wall_length_m: float, gap: MeasuredGap, stamp_s: float) -> RtEdge:
    """The edge from a wall to a door in it; the wall's frame has its origin in the wall's middle."""
    std_m = float(np.hypot(gap.std_m, 0.003))
    return RtEdge(
        source=wall_id,
        target=door_id,
        T_source_target=SE3.from_xyz_yaw(gap.center_m - wall_length_m / 2.0, 0.0, 0.0, 0.0),
        covariance=spatial_covariance(diagonal_covariance(std_m, 0.003, 0.002)),
        stamp_s=stamp_s,
    )


def put_provisional(
    tx: Transaction,
    door_id: str,
    room_id: str,
    wall: int,
    wall_length_m: float,
    gap: MeasuredGap,
    stamp_s: float,
    *,
    state: DoorState = DoorState.OPEN,
    settings: DoorNodeSettings = DoorNodeSettings(),
) -> str:
    """A provisional door and the wish to look at it from the front; its identifier."""
    provisional_id = door_id + _SUFFIX
    tx.put(
        DoorNode(
            id=provisional_id,
            label=door_label(gap.width_m, settings),
            rooms=(room_id, None),
            width_m=gap.width_m,
            state=state,
            confidence=seen_confidence(gap, settings),
        ),
        hang(provisional_id, wall_id_of(room_id, wall), wall_length_m, gap, stamp_s),
        visit(provisional_id, stamp_s, settings),
    )
    return provisional_id


def put_suspected(
    tx: Transaction,
    door_id: str,
    room_id: str,
    wall: int,
    wall_length_m: float,
    stretch: Gap,
    stamp_s: float,
    settings: DoorNodeSettings = DoorNodeSettings(),
) -> str:
    """A door that may be hidden in an unseen stretch of wall, and the wish to look, last of all wishes."""
    provisional_id = door_id + _SUFFIX
    width_m = min(stretch.width_m, settings.hidden_width_m)
    gap = MeasuredGap(center_m=stretch.center_m, width_m=width_m, std_m=stretch.width_m / 2.0, posts=0)
    tx.put(
        DoorNode(
            id=provisional_id,
            label="unseen wall",
            rooms=(room_id, None),
            width_m=width_m,
            state=DoorState.UNKNOWN,
            confidence=SUSPICION,
        ),
        hang(provisional_id, wall_id_of(room_id, wall), wall_length_m, gap, stamp_s),
        replace(visit(provisional_id, stamp_s, settings), priority=Priority.CROSS_DOOR),
    )
    return provisional_id


def put_permanent(
    tx: Transaction,
    provisional_id: str,
    room_id: str,
    wall: int,
    wall_length_m: float,
    gap: MeasuredGap,
    stamp_s: float,
    *,
    state: DoorState = DoorState.OPEN,
    settings: DoorNodeSettings = DoorNodeSettings(),
) -> str:
    """The provisional door becomes permanent, offers to be crossed, and asks for it when open; its identifier."""
    door_id = provisional_id.removesuffix(_SUFFIX)
    affordance_id = cross_affordance(door_id)
    tx.remove(provisional_id)
    door = DoorNode(
        id=door_id,
        label=door_label(gap.width_m, settings),
        rooms=(room_id, None),
        width_m=gap.width_m,
        confidence=measured_confidence(gap, settings),
        state=state,
        provisional=False,
    )
    closed = state is DoorState.CLOSED
    tx.put(
        given_up(door, CLOSED_REASON) if closed else door,
        hang(door_id, wall_id_of(room_id, wall), wall_length_m, gap, stamp_s),
        ConnectsEdge(source=door_id, target=room_id),
        AffordanceNode(id=affordance_id, kind=AffordanceKind.CROSS, target=door_id),
        HasEdge(source=door_id, target=affordance_id),
        *([] if closed else [cross(door_id, stamp_s)]),
    )
    return door_id


def seen_confidence(gap: MeasuredGap, settings: DoorNodeSettings) -> float:
    """Confidence of a provisional door by how many of its posts were measured."""
    return settings.seen + settings.seen_post * gap.posts


def measured_confidence(gap: MeasuredGap, settings: DoorNodeSettings) -> float:
    """Confidence of a permanent door by how many of its posts were measured."""
    return settings.measured[gap.posts]


def is_suspicion(door: DoorNode) -> bool:
    """Whether the provisional door only stands for a stretch of wall that nobody has seen."""
    return door.provisional and door.confidence <= SUSPICION


def door_label(width_m: float, settings: DoorNodeSettings) -> str:
    """A gap wider than any door is an opening."""
    return "door" if width_m <= settings.sizes.widest_m else "opening"


def visit(door_id: str, stamp_s: float, settings: DoorNodeSettings) -> HasIntentionEdge:
    """The wish to stand in front of a door."""
    return HasIntentionEdge(
        source=ROBOT_ID,
        target=door_id,
        agent=DOOR_AGENT,
        action=IntentionAction.VISIT,
        priority=Priority.VISIT_DOOR,
        standoff_m=settings.standoff_m,
        proposed_s=stamp_s,
    )


def cross(door_id: str, stamp_s: float) -> HasIntentionEdge:
    """The wish to go through a permanent door."""
    return HasIntentionEdge(
        source=ROBOT_ID,
        target=cross_affordance(door_id),
        agent=DOOR_AGENT,
        action=IntentionAction.CROSS,
        priority=Priority.CROSS_DOOR,
        proposed_s=stamp_s,
    )
