"""What a door known from one room owes to the same door as measured from the other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from perception.crossing import match_of
from perception.doors.posts import SHARP_M, MeasuredGap
from perception.doors.room_watch import Span
from perception.doors.scene import Scene
from scene_graph.nodes import DoorNode
from scene_graph.snapshot import Snapshot

WELL_MEASURED = 0.9
"""Confidence of a door whose both posts are measured."""

_PREDICTED_STD_M = 0.03
_NARROWER_M = 0.03


def better_twin(snapshot: Snapshot, door: DoorNode) -> DoorNode | None:
    """The same door from its other room, where both posts of that one are measured and of this one are not."""
    other_id = match_of(snapshot, door.id)
    twin = snapshot.door(other_id) if other_id is not None and other_id in snapshot else None
    better = twin is not None and door.confidence < WELL_MEASURED <= twin.confidence
    return twin if better else None


def seen_through(scene: Scene, wall: int, twin: DoorNode) -> Span:
    """The twin's place in a wall of this room, as the layout of the rooms has it."""
    walls = scene.watch.walls
    x_m, y_m, _ = scene.snapshot.position(twin.id, scene.room.room_id)
    station_m = float(walls.along[wall] @ (np.array([x_m, y_m]) - walls.start[wall]))
    return Span(center_m=station_m, width_m=twin.width_m)


def completed(measured: MeasuredGap | None, twin: Span) -> MeasuredGap:
    """A gap with the twin's width: put at the post that is measured, or where the layout has the twin.

    ``measured``: what was seen from here, if anything. A gap that is wider than the twin is left as it is: then they
    are not one opening, or the twin is wrong.
    """
    if measured is None:
        return MeasuredGap(center_m=twin.center_m, width_m=twin.width_m, std_m=_PREDICTED_STD_M, posts=0)
    if measured.posts == 2 or measured.width_m > twin.width_m + _NARROWER_M:
        return measured
    aside_m = twin.width_m / 2.0
    if measured.start_std_m < SHARP_M:
        center_m = measured.center_m - measured.width_m / 2.0 + aside_m
    elif measured.end_std_m < SHARP_M:
        center_m = measured.center_m + measured.width_m / 2.0 - aside_m
    else:
        return replace(measured, center_m=twin.center_m, width_m=twin.width_m, std_m=_PREDICTED_STD_M)
    std_m = min(measured.start_std_m, measured.end_std_m)
    return replace(measured, center_m=center_m, width_m=twin.width_m, std_m=std_m, posts=2)
