"""Waiting for perception while looking: fresh observations before acting, and the effect afterwards."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot

from py_trees.common import Status

from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.anchor import Anchor
from skills.arm.arm import avoid_side, is_firm
from skills.arm.kinematics import reach_band_m
from skills.failures import Failure, FailureCode
from skills.looking.looking import Gaze, aim


class Refine(Action):
    """Looks at an object until perception has seen it ``fresh`` times since the action began.

    Fails with OBJECT_GONE when it becomes missing or is not seen in time, with OBJECT_MOVED when it turns out more
    than 15 cm from ``planned`` and out of the arm's reach. Where it was not seen, other sides go first next time.
    """

    timeout_s = 30.0

    def __init__(
        self, context: RobotContext, object_id: str, planned: Anchor, *, fresh: int = 2, patience_s: float = 8.0
    ) -> None:
        super().__init__(f"look closely at {object_id}", context)
        self.object_id, self._planned = object_id, planned
        self._fresh, self._patience_s = fresh, patience_s
        self._before = 0
        self._gaze = Gaze(context)

    def begin(self) -> None:
        """Count from the observations made so far."""
        node = self.context.snapshot.get(self.object_id)
        self._before = node.observations if isinstance(node, ObjectNode) else 0

    def step(self) -> Status:
        """Keep the camera on it, and judge what perception says."""
        node = self.context.snapshot.get(self.object_id)
        if not isinstance(node, ObjectNode):
            return self._gone(f"{self.object_id} is no longer on my map.")
        if node.state is ObjectState.MISSING:
            return self._gone(f"{self.object_id} is not where it was.")
        settled = self._look()
        if node.observations - self._before >= self._fresh and node.last_seen_s > self.started_s and settled:
            return self._judge()
        if self.elapsed_s > self._patience_s:
            avoid_side(self.context, self.object_id)
            return self._gone(
                f"{self.object_id} was not seen for {self._patience_s:.0f} s although the camera looked there."
            )
        return Status.RUNNING

    def _look(self) -> bool:
        pan, tilt = aim(self.context, Anchor(self.object_id))
        pan_more, tilt_more = _glance_rad(self)
        return self._gaze.at(pan + pan_more, tilt + tilt_more)

    def _judge(self) -> Status:
        snapshot = self.context.snapshot
        if self._planned.node_id not in snapshot:
            return Status.SUCCESS
        offset = Anchor(self.object_id).position(snapshot, self._planned.node_id) - self._planned.point_m
        moved_m = hypot(offset[0], offset[1])
        if moved_m <= self.context.settings.looking.moved_m or self._within_reach():
            return Status.SUCCESS
        message = f"{self.object_id} is {moved_m:.2f} m from where it was planned to be."
        return self.fail(FailureCode.OBJECT_MOVED, message, (self.object_id,), f"moved {moved_m:.2f} m")

    def _within_reach(self) -> bool:
        x_m, y_m, _ = Anchor(self.object_id).in_base(self.context)
        _, far_m = reach_band_m(self.context.limits.wrist_pitch_rad[0], self.context.geometry, self.context.limits)
        edge_m = self.context.limits.footprint_radius_m + self.context.settings.looking.past_edge_m
        return edge_m < hypot(x_m, y_m) < far_m - 0.01

    def _gone(self, message: str) -> Status:
        node = self.context.snapshot.get(self.object_id)
        seen = f"last seen at {node.last_seen_s:.1f} s" if isinstance(node, ObjectNode) else "removed"
        return self.fail(FailureCode.OBJECT_GONE, message, (self.object_id,), seen)


Check = Callable[[Snapshot, float], Failure | None]
"""What is amiss with an effect as perception sees it since a time; ``None`` when it is confirmed."""


class Confirm(Action):
    """Looks at a place until perception confirms an effect; fails with the check's own failure when it does not in
    time.
    """

    timeout_s = 30.0

    def __init__(
        self,
        context: RobotContext,
        what: str,
        where: Anchor,
        check: Check,
        *,
        patience_s: float = 8.0,
        grip_needed: bool = False,
    ) -> None:
        super().__init__(f"confirm {what}", context)
        self._where, self._check, self._patience_s, self._grip_needed = where, check, patience_s, grip_needed
        self._gaze = Gaze(context)

    def step(self) -> Status:
        """Look and ask."""
        snapshot = self.context.snapshot
        amiss = self._check(snapshot, self.started_s)
        if amiss is None:
            return Status.SUCCESS
        if self._grip_needed and not is_firm(self.context) and self.elapsed_s > 0.5:
            self.context.grip = None
            return self.fail(FailureCode.SLIPPED, "the fingers lost what they held.", amiss.evidence.nodes)
        if self._where.node_id in snapshot:
            pan, tilt = aim(self.context, self._where)
            pan_more, tilt_more = _glance_rad(self)
            self._gaze.at(pan + pan_more, tilt + tilt_more)
        if self.elapsed_s > self._patience_s:
            self.failure, self.feedback_message = amiss, amiss.message
            return Status.FAILURE
        return Status.RUNNING


def _glance_rad(action: Action) -> tuple[float, float]:
    """Pan and tilt that are added just now."""
    settings = action.context.settings.looking
    return settings.glances_rad[int(action.elapsed_s / settings.glance_s) % len(settings.glances_rad)]
