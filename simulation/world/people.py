"""People in the simulated house: figures that stand, and walk when told."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import pybullet as p

from simulation.furnishing.shapes import Part, box, cylinder, sphere
from simulation.world.bodies import make_body, yaw_quaternion
from simulation.world.physics import PhysicsSettings

HEIGHT_M = 1.72
_SHIRT, _TROUSERS, _SKIN, _HAIR = (0.80, 0.25, 0.45), (0.15, 0.18, 0.35), (0.87, 0.68, 0.55), (0.25, 0.16, 0.10)

Point2 = tuple[float, float]


def person_parts() -> tuple[Part, ...]:
    """Legs, trunk, arms and head, about the point between the feet."""
    legs = tuple(box((0.0, side * 0.09, 0.42), (0.14, 0.13, 0.84), _TROUSERS) for side in (-1, 1))
    arms = tuple(box((0.0, side * 0.24, 1.12), (0.09, 0.09, 0.60), _SHIRT) for side in (-1, 1))
    trunk = box((0.0, 0.0, 1.13), (0.20, 0.38, 0.58), _SHIRT)
    neck = cylinder(1.40, 0.11, 0.10, _SKIN)
    head, hair = sphere((0.0, 0.0, 1.58), 0.22, _SKIN), sphere((-0.02, 0.0, 1.61), 0.22, _HAIR)
    return (*legs, *arms, trunk, neck, head, hair)


def person_body(client: int, physics: PhysicsSettings) -> int:
    """A person's body; it moves only by being placed."""
    return make_body(client, person_parts(), 0.0, HEIGHT_M, physics)


@dataclass(frozen=True, kw_only=True)
class WalkSettings:
    """How people walk."""

    speed_mps: float = 0.8
    """Chosen: unhurried, as at home."""
    ahead_m: float = 0.3
    """So far ahead a person looks for whoever is in the way: half a step."""
    space_m: float = 0.55
    """And stays so far away: half the width of a person and of a robot."""


class Walker:
    """A person who stands, or walks straight to a goal and waits for whoever is in the way."""

    def __init__(
        self, client: int, body: int, pose: tuple[float, float, float], *, settings: WalkSettings = WalkSettings()
    ) -> None:
        self._settings = settings
        self.body = body
        self._client = client
        self._goal: Point2 | None = None
        self._pose = pose
        self.put(pose)

    @property
    def position_m(self) -> Point2:
        """Where the person stands, house coordinates."""
        return self._pose[0], self._pose[1]

    @property
    def walks(self) -> bool:
        """Whether the person is on the way somewhere."""
        return self._goal is not None

    def put(self, pose: tuple[float, float, float]) -> None:
        """Stand somewhere else at once."""
        self._pose, self._goal = pose, None
        self._show()

    def walk_to(self, goal: Point2) -> None:
        """Set out for a point."""
        self._goal = goal

    def advance(self, dt_s: float, strangers: Sequence[Point2]) -> None:
        """Walk on for ``dt_s`` seconds."""
        if self._goal is None:
            return
        settings = self._settings
        x_m, y_m, _ = self._pose
        left_m = math.dist((x_m, y_m), self._goal)
        if left_m < 1e-6:
            self._goal = None
            return
        heading = math.atan2(self._goal[1] - y_m, self._goal[0] - x_m)
        ahead = (x_m + settings.ahead_m * math.cos(heading), y_m + settings.ahead_m * math.sin(heading))
        if any(math.dist(ahead, stranger) < settings.space_m for stranger in strangers):
            return
        step_m = min(left_m, settings.speed_mps * dt_s)
        self._pose = (x_m + step_m * math.cos(heading), y_m + step_m * math.sin(heading), heading)
        self._show()

    def _show(self) -> None:
        x_m, y_m, yaw_rad = self._pose
        center = (x_m, y_m, HEIGHT_M / 2)
        p.resetBasePositionAndOrientation(self.body, center, yaw_quaternion(yaw_rad), physicsClientId=self._client)
