"""What the camera sees where the arm would go."""

from __future__ import annotations

from math import cos, inf, sin

import numpy as np
import pytest

from skills.anchor import Anchor
from skills.failures import FailureCode
from skills.furniture.furniture import Entry, Surface
from skills.place.place_spot import Spot
from skills.place.seen_in_way import Seen
from skills.place.spot_choice import CheckSpot
from skills.registry import load_registry

pytestmark = pytest.mark.anyio


SKILLS = load_registry([])


@pytest.mark.parametrize(
    ("across_m", "high_m", "taken"),
    [(0.02, 0.2, "another"), (0.02, 0.02, "the same"), (0.3, 0.2, "the same"), (3.0, 0.2, "none")],
)
async def test_where_the_camera_sees_what_is_not_in_the_graph_nothing_is_put(
    kitchen, across_m, high_m, taken, carry_out
):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    check = next(action for action in actions if isinstance(action, CheckSpot))
    assert await rehearsal.run(actions[: actions.index(check)], 900.0) is None
    placement = check._placement
    assert await rehearsal.run([check]) is None
    chosen = placement.spot.anchor
    x_m, y_m, z_m = chosen.in_base(context)
    sides = np.linspace(-3.0, 3.0, 600) if taken == "none" else np.linspace(across_m, across_m + 0.05, 12)
    along, aside, up = np.meshgrid(np.linspace(-0.05, 0.05, 20), sides, [0.5, 0.9, 1.0], indexing="ij")
    turn_rad, away_m = np.arctan2(y_m, x_m), np.hypot(x_m, y_m)
    along = along.ravel() + away_m if taken != "none" else along.ravel() + 0.5
    x, y = (
        along * np.cos(turn_rad) - aside.ravel() * np.sin(turn_rad),
        along * np.sin(turn_rad) + aside.ravel() * np.cos(turn_rad),
    )
    context.seen_base = lambda: np.column_stack((x, y, z_m + high_m * up.ravel()))
    failure = await rehearsal.run([check])
    if taken == "none":
        assert failure.code is FailureCode.SUPPORT_FULL
        assert (chosen.node_id, chosen.point_m) in context.blocked_spots
    else:
        assert failure is None
        assert (placement.spot.anchor == chosen) is (taken == "the same")


@pytest.mark.parametrize(
    ("before_m", "high_m", "free_m", "met"),
    [
        (0.1, 0.15, inf, True),
        (0.1, 0.06, inf, False),  # the hand passes over it
        (0.1, 0.06, 0.4, True),  # below a board it does not
        (0.1, 0.39, 0.4, False),  # that is the board
        (-0.2, 0.15, inf, False),
        (0.0, 0.06, inf, True),
    ],
)
async def test_what_is_seen_bars_the_hand_where_it_passes_or_what_it_holds_is_to_stand(
    kitchen, before_m, high_m, free_m, met, carry_out
):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    x_m, y_m, yaw_rad = rehearsal.body.pose.x_m, rehearsal.body.pose.y_m, rehearsal.body.pose.yaw_rad
    at = (x_m + 0.75 * cos(yaw_rad), y_m + 0.75 * sin(yaw_rad), 0.75)
    surface = Surface(free_m=free_m, entry=Entry.LEVEL if free_m < inf else Entry.ABOVE)
    spot = Spot(anchor=Anchor("room_1", at), room_m=1.0, surface=surface)
    along, across = np.meshgrid(np.linspace(-0.01, 0.01, 5), np.linspace(-0.05, 0.05, 9))
    heights = np.full(along.size, 0.75 + high_m)
    context.seen_base = lambda: np.column_stack((along.ravel() + 0.75 - before_m, across.ravel(), heights))
    assert Seen(context, "room_1").is_in_way_to(spot) is met
    assert not Seen(context, "room_1").shows(spot)
    context.seen_base = lambda: np.column_stack((along.ravel() + 0.75, across.ravel(), np.full(along.size, 0.76)))
    assert Seen(context, "room_1").shows(spot)
    context.seen_base = lambda: np.zeros((0, 3))
    assert Seen(context, "room_1").shows(spot)
