"""Looks on while the robot explores: what it came near to, and whether the graph keeps calling things the same.

It reads the graph and the simulator's truth, for scoring, and changes neither.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.runtime import Runtime
from evaluations.perception.belief_scores import Sightings
from evaluations.perception.inventory import GraphThing, Size3, graph_contents, sizes_of, true_things
from evaluations.perception.matching import Identities
from scene_graph.nodes import ObjectNode
from simulation.houses.house import House, room_at
from simulation.robot.description import RobotDescription


class VisibilityMonitor:
    """An agent that takes the last turn twice a simulated second.

    Attributes:
        sizes: extent of every thing that can be moved; what is brought in later is added from outside.
    """

    name = "visibility"
    period_s = 0.5

    def __init__(self, runtime: Runtime, house: House, *, identities_every: int = 4) -> None:
        """``identities_every``: turns between two comparisons of identities."""
        self._runtime, self._house, self._identities_every = runtime, house, identities_every
        self._identities = Identities()
        self._in_view_m: dict[str, float] = {}
        self._renewed_m: dict[str, float] = {}
        self._renewed_s: dict[str, float] = {}
        self._turns = 0
        self.sizes: dict[str, Size3] = sizes_of(house)

    async def step(self, stamp_s: float) -> None:  # noqa: ARG002 - every agent takes the time
        """See what is in view, what was renewed, and now and then who is who."""
        robot = self._runtime.require_robot()
        truth, joints = await robot.truth(), await robot.joints()
        things = true_things(self._house, truth, self.sizes)
        pose = truth["robot"]["pose"]
        camera = (pose[0], pose[1], pose[2] + joints.pan_rad, joints.tilt_rad)
        here = room_at(self._house, pose[0], pose[1])
        for thing in things:
            if thing.room == here and in_view(thing.position_m, camera):
                _nearest(self._in_view_m, thing.id, _distance_m(thing.position_m, pose))
        self._see_renewed()
        if self._turns % self._identities_every == 0:
            self._identities.update(things, self._graph())
        self._turns += 1

    def sightings(self) -> Sightings:
        """What was seen so far."""
        return Sightings(
            in_view_m={name: round(value, 3) for name, value in self._in_view_m.items()},
            renewed_m={name: round(value, 3) for name, value in self._renewed_m.items()},
            seconds=self._runtime.now_s,
            switches=self._identities.switches,
        )

    def _see_renewed(self) -> None:
        """From how near the robot, as it believes to stand, renewed its nodes just now."""
        snapshot = self._runtime.memory.snapshot()
        room = snapshot.current_room
        robot = snapshot.robot
        if room is None or robot is None:
            return
        for node in snapshot.of_type(ObjectNode):
            if node.last_seen_s > self._renewed_s.get(node.id, -1.0) and snapshot.room_of(node.id) == room:
                self._renewed_s[node.id] = node.last_seen_s
                x_m, y_m, _ = snapshot.position(node.id, robot.id)
                _nearest(self._renewed_m, node.id, math.hypot(float(x_m), float(y_m)))

    def _graph(self) -> Sequence[GraphThing]:
        return graph_contents(self._runtime.views.scene.document(), self._house, lay=False).things


def in_view(
    point_m: NDArray[np.float64],
    camera: tuple[float, float, float, float],
    robot: RobotDescription = RobotDescription(),
    margin_rad: float = 0.04,
) -> bool:
    """Whether a point (3,) is in the picture of a camera at (x, y) that looks along a yaw and up by a tilt, radians.

    ``margin_rad``: what is nearer to the edge of the picture is not counted: most of it may be outside.
    """
    x_m, y_m, yaw_rad, tilt_rad = camera
    dx, dy, dz = point_m - (x_m, y_m, robot.geometry.camera_height_m)
    aside_rad = math.remainder(math.atan2(dy, dx) - yaw_rad, math.tau)
    up_rad = math.atan2(dz, math.hypot(dx, dy)) - tilt_rad
    half_width_rad = robot.camera.horizontal_fov_rad / 2.0
    half_height_rad = math.atan(math.tan(half_width_rad) * robot.camera.height_px / robot.camera.width_px)
    return abs(aside_rad) <= half_width_rad - margin_rad and abs(up_rad) <= half_height_rad - margin_rad


def _nearest(nearest: dict[str, float], name: str, distance_m: float) -> None:
    nearest[name] = min(distance_m, nearest.get(name, math.inf))


def _distance_m(point_m: NDArray[np.float64], pose: Sequence[float]) -> float:
    return math.hypot(float(point_m[0]) - pose[0], float(point_m[1]) - pose[1])
