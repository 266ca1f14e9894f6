"""Where the rooms are relative to each other, and how large: constrained optimization with doors as shared points.

The paper leaves this to future work (Concepts, 3.6). Each physical door is one point known in two rooms: it says that
two wall faces are parallel, a wall's thickness apart, and that the gap begins and ends at the same stations. What does
not fit when a loop closes is spread over all that may be wrong, as far as it may be wrong:

- the poses of the rooms,
- the offsets of their walls: a wall with a door in it may shift along its normal, and takes its doors along,
- the thicknesses of the walls between and the stations of the doors along them; they are no variables, because each is
  seen by one door only, but part of that door's covariance.

A building without loops fits as it was measured, so no wall is shifted there. The measured rooms stay as they are; the
shifts are part of the layout, which is computed from measurements alone each time.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial

import gtsam
import numpy as np
from gtsam.symbol_shorthand import R, W
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.localization.pose_window import from_gtsam, to_gtsam

Array = NDArray[np.float64]
Wall = tuple[str, int]
"""A wall by its room and its index in the room's outline."""

_RIGID: Mapping[Wall, float] = {}


@dataclass(frozen=True, kw_only=True)
class LayoutOptimizationSettings:
    """How errors are spread, and until when."""

    huber: float = 3.0
    """Standard deviations from which on a door counts less: it may have been matched wrongly."""
    steps: int = 20
    """Of Gauss-Newton at most. Chosen."""
    converged: float = 1e-6
    """Length of a step, in meters and radians, after which no other follows. Chosen: far below what matters."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Passage:
    """One physical door between two rooms: ``T_first_second`` of the rooms' frames, expressed about the door.

    ``T_first_door`` and ``T_second_other`` are the two faces of the door, x along the wall and y into the room;
    ``T_door_other`` lies between them with (3, 3) ``covariance``. ``first_wall`` and ``second_wall``: indices of the
    walls that the faces are in, where they are known.
    """

    first: str
    second: str
    T_first_door: Pose2
    T_second_other: Pose2
    T_door_other: Pose2
    covariance: Array
    first_wall: int | None = None
    second_wall: int | None = None

    @property
    def T_first_second(self) -> Pose2:
        return self.T_first_door @ self.T_door_other @ self.T_second_other.inverse()

    def room_covariance(self) -> Array:
        """(3, 3) covariance of ``T_first_second`` in the second room's frame."""
        adjoint = self.T_second_other.adjoint()
        return np.asarray(adjoint @ self.covariance @ adjoint.T)

    def walls(self) -> tuple[Wall, Wall] | None:
        """The two walls, if both are known."""
        if self.first_wall is None or self.second_wall is None:
            return None
        return (self.first, self.first_wall), (self.second, self.second_wall)


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedRoom:
    """``T_root_room`` with its (3, 3) covariance in the room's frame.

    ``wall_shifts_m``: by wall index, how far a wall is shifted along its normal, positive into the room; walls that are
    not named stay where they were measured.
    """

    T_root_room: Pose2
    covariance: Array
    wall_shifts_m: Mapping[int, float] = field(default_factory=dict)


def lay_out(
    first_room: str,
    first: PlacedRoom,
    guesses: Mapping[str, Pose2],
    passages: Sequence[Passage],
    wall_std_m: Mapping[Wall, float] = _RIGID,
    settings: LayoutOptimizationSettings = LayoutOptimizationSettings(),
) -> dict[str, PlacedRoom]:
    """Poses and wall shifts of all rooms that passages connect with the first, which stays where it is.

    Args:
        first_room: the room measured from the root itself.
        first: its pose.
        guesses: where every room is thought to be.
        passages: the doors known from both sides.
        wall_std_m: how well the walls' offsets along their normals are known; walls that are not named do not shift.
        settings: how errors are spread.
    """
    reached = _reached(first_room, passages)
    rooms = {room: R(index) for index, room in enumerate(reached)}
    inside = [passage for passage in passages if passage.first in rooms and passage.second in rooms]
    values = gtsam.Values()
    for room, key in rooms.items():
        values.insert(key, to_gtsam(guesses[room]))
    graph = _graph(rooms[first_room], first, rooms, {}, inside, settings.huber)
    values = gtsam.LevenbergMarquardtOptimizer(graph, values).optimize()
    walls = _free_walls(inside, wall_std_m)
    if walls:
        graph = _graph(rooms[first_room], first, rooms, walls, inside, settings.huber)
        for wall, key in walls.items():
            values.insert(key, np.zeros(1))
            noise = gtsam.noiseModel.Isotropic.Sigma(1, wall_std_m[wall])
            graph.add(gtsam.PriorFactorVector(key, np.zeros(1), noise))
        values = _refined(graph, values, settings)
    return _placed(rooms, walls, values, gtsam.Marginals(graph, values))


def _graph(
    anchor: int,
    first: PlacedRoom,
    rooms: Mapping[str, int],
    walls: Mapping[Wall, int],
    passages: Sequence[Passage],
    huber: float,
) -> gtsam.NonlinearFactorGraph:
    """What the doors say, and where the first room, whose key is ``anchor``, lies."""
    graph = gtsam.NonlinearFactorGraph()
    noise = gtsam.noiseModel.Gaussian.Covariance(first.covariance)
    graph.add(gtsam.PriorFactorPose2(anchor, to_gtsam(first.T_root_room), noise))
    for passage in passages:
        graph.add(_factor(passage, rooms, walls, huber))
    return graph


def _refined(
    graph: gtsam.NonlinearFactorGraph, values: gtsam.Values, settings: LayoutOptimizationSettings
) -> gtsam.Values:
    """Gauss-Newton from rigid rooms in place, which is near enough that no step needs to be checked.

    Step by step, because GTSAM's optimizers call factors written in Python from several threads, which then wait for
    each other: a thousand rooms take half a minute instead of a second.
    """
    for _ in range(settings.steps):
        step = graph.linearize(values).optimize()
        values = values.retract(step)
        if step.norm() < settings.converged:
            break
    return values


def _reached(first_room: str, passages: Sequence[Passage]) -> list[str]:
    """Rooms connected with the first one, nearest first."""
    neighbors: dict[str, list[str]] = {first_room: []}
    for passage in passages:
        neighbors.setdefault(passage.first, []).append(passage.second)
        neighbors.setdefault(passage.second, []).append(passage.first)
    order = {first_room: None}
    queue = [first_room]
    for room in queue:  # grows while it is walked
        new = [there for there in dict.fromkeys(neighbors[room]) if there not in order]
        order.update(dict.fromkeys(new))
        queue += new
    return queue


def _free_walls(passages: Sequence[Passage], wall_std_m: Mapping[Wall, float]) -> dict[Wall, int]:
    """Keys of the walls that may shift: those with a door that is part of a loop."""
    free: dict[Wall, int] = {}
    for passage in _in_loops(passages):
        both = passage.walls()
        if both is not None and both[0] in wall_std_m and both[1] in wall_std_m:
            for wall in both:
                free.setdefault(wall, W(len(free)))
    return free


def _in_loops(passages: Sequence[Passage]) -> list[Passage]:
    """The passages that are left when dead ends are taken away, one after the other."""
    left = list(passages)
    while True:
        doors = Counter(room for passage in left for room in (passage.first, passage.second))
        kept = [passage for passage in left if min(doors[passage.first], doors[passage.second]) > 1]
        if len(kept) == len(left):
            return kept
        left = kept


def _factor(
    passage: Passage, rooms: Mapping[str, int], walls: Mapping[Wall, int], huber: float
) -> gtsam.NoiseModelFactor:
    """What a door says about two rooms, and about the two walls that it is in where these may shift."""
    first, second = rooms[passage.first], rooms[passage.second]
    both = passage.walls()
    if both is None or both[0] not in walls or both[1] not in walls:
        noise = _robust(passage.room_covariance(), huber)
        return gtsam.BetweenFactorPose2(first, second, to_gtsam(passage.T_first_second), noise)
    keys = [first, second, *(walls[wall] for wall in both)]
    return gtsam.CustomFactor(_robust(passage.covariance, huber), keys, partial(_error_at_door, passage))


def _robust(covariance: Array, huber: float) -> gtsam.noiseModel.Base:
    return gtsam.noiseModel.Robust.Create(
        gtsam.noiseModel.mEstimator.Huber.Create(huber), gtsam.noiseModel.Gaussian.Covariance(covariance)
    )


def _error_at_door(
    passage: Passage, factor: gtsam.CustomFactor, values: gtsam.Values, jacobians: gtsam.JacobianVector | None
) -> Array:
    """The error of a factor over the poses of two rooms and the shifts of two walls; GTSAM's way to ask for it."""
    first, second, wall, other = factor.keys()
    error, derivatives = door_error(
        passage,
        from_gtsam(values.atPose2(first)),
        from_gtsam(values.atPose2(second)),
        (float(values.atVector(wall)[0]), float(values.atVector(other)[0])),
    )
    if jacobians is not None:
        for index, derivative in enumerate(derivatives):
            jacobians[index] = derivative
    return error


def door_error(
    passage: Passage, T_root_first: Pose2, T_root_second: Pose2, shifts_m: tuple[float, float]
) -> tuple[Array, tuple[Array, Array, Array, Array]]:
    """(3,) x, y, yaw of the other face of a door against where it was measured, and its derivatives.

    These are (3, 3) for each room by a right perturbation (x, y, yaw) of its pose, and (3, 1) for each wall by its
    shift. A right perturbation of a pose within a product is one of the whole product, brought there by the adjoint.
    """
    T_root_door = T_root_first @ passage.T_first_door @ Pose2(0.0, shifts_m[0], 0.0)
    T_root_other = T_root_second @ passage.T_second_other @ Pose2(0.0, shifts_m[1], 0.0)
    T_other_root = T_root_other.inverse()
    error = passage.T_door_other.inverse() @ T_root_door.inverse() @ T_root_other
    turn = np.eye(3)
    turn[:2, :2] = error.rotation()
    by_first = -turn @ (T_other_root @ T_root_first).adjoint()
    by_second = turn @ (T_other_root @ T_root_second).adjoint()
    by_wall = -turn @ (T_other_root @ T_root_door).adjoint()[:, 1:2]
    by_other = turn[:, 1:2]
    return np.array([error.x_m, error.y_m, error.yaw_rad]), (by_first, by_second, by_wall, by_other)


def _placed(
    rooms: Mapping[str, int], walls: Mapping[Wall, int], result: gtsam.Values, marginals: gtsam.Marginals
) -> dict[str, PlacedRoom]:
    shifts: dict[str, dict[int, float]] = {room: {} for room in rooms}
    for (room, wall), key in walls.items():
        shifts[room][wall] = float(result.atVector(key)[0])
    return {
        room: PlacedRoom(
            T_root_room=from_gtsam(result.atPose2(key)),
            covariance=_symmetric(marginals.marginalCovariance(key)),
            wall_shifts_m=shifts[room],
        )
        for room, key in rooms.items()
    }


def _symmetric(covariance: Array) -> Array:
    return np.asarray((covariance + covariance.T) / 2.0)
