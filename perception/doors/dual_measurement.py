"""What a door known from one room owes to the same door as measured from the other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from perception.crossing import match_of
from perception.doors.insertion import DoorNodeSettings
from perception.doors.posts import MeasuredGap, PostSettings
from perception.doors.room_evidence import Span
from perception.doors.scene import Scene
from scene_graph.nodes import DoorNode
from scene_graph.snapshot import Snapshot


def better_dual(snapshot: Snapshot, door: DoorNode, settings: DoorNodeSettings = DoorNodeSettings()) -> DoorNode | None:
    """The same door from its other room, where both posts of that one are measured and of this one are not."""
    other_id = match_of(snapshot, door.id)
    dual = snapshot.door(other_id) if other_id is not None and other_id in snapshot else None
    better = dual is not None and door.confidence < settings.well_measured <= dual.confidence
    return dual if better else None


def seen_through(scene: Scene, wall: int, dual: DoorNode) -> Span:
    """The dual's place in a wall of this room, as the layout of the rooms has it."""
    walls = scene.evidence.walls
    x_m, y_m, _ = scene.snapshot.position(dual.id, scene.room.room_id)
    station_m = float(walls.along[wall] @ (np.array([x_m, y_m]) - walls.start[wall]))
    return Span(center_m=station_m, width_m=dual.width_m)


def completed(
    measured: MeasuredGap | None,
    dual: Span,
    settings: DoorNodeSettings = DoorNodeSettings(),
    *,
    sharp_m: float = PostSettings.sharp_m,
) -> MeasuredGap:
    """A gap with the dual's width: put at the post that is measured, or where the layout has the dual.

    ``measured``: what was seen from here, if anything. A gap that is wider than the dual is left as it is: then they
    are not one opening, or the dual is wrong. ``sharp_m``: standard deviation below which a post counts as measured.
    """
    if measured is None:
        return MeasuredGap(center_m=dual.center_m, width_m=dual.width_m, std_m=settings.predicted_std_m, posts=0)
    if measured.posts == 2 or measured.width_m > dual.width_m + settings.narrower_m:
        return measured
    aside_m = dual.width_m / 2.0
    if measured.start_std_m < sharp_m:
        center_m = measured.center_m - measured.width_m / 2.0 + aside_m
    elif measured.end_std_m < sharp_m:
        center_m = measured.center_m + measured.width_m / 2.0 - aside_m
    else:
        return replace(measured, center_m=dual.center_m, width_m=dual.width_m, std_m=settings.predicted_std_m)
    std_m = min(measured.start_std_m, measured.end_std_m)
    return replace(measured, center_m=center_m, width_m=dual.width_m, std_m=std_m, posts=2)
