"""Where the rooms are relative to each other: constrained optimization with doors as shared points (Concepts, 3.6).

The paper leaves this to future work. Rooms are rigid; each physical door says that two points, one in each room's
frame, are a wall's thickness apart and that the two wall faces are parallel. Loops distribute what does not fit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import gtsam
import numpy as np
from gtsam.symbol_shorthand import R
from numpy.typing import NDArray

from majordomo.perception.localization.planar import Pose2
from majordomo.perception.localization.window import from_gtsam, to_gtsam

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Passage:
    """One physical door between two rooms: ``T_first_second`` of the rooms' frames, expressed about the door.

    ``T_first_door`` and ``T_second_other`` are the two faces of the door; ``T_door_other`` lies between them with
    (3, 3) ``covariance``.
    """

    first: str
    second: str
    T_first_door: Pose2
    T_second_other: Pose2
    T_door_other: Pose2
    covariance: Array

    @property
    def T_first_second(self) -> Pose2:
        return self.T_first_door @ self.T_door_other @ self.T_second_other.inverse()

    def room_covariance(self) -> Array:
        """(3, 3) covariance of ``T_first_second`` in the second room's frame."""
        adjoint = self.T_second_other.adjoint()
        return np.asarray(adjoint @ self.covariance @ adjoint.T)


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedRoom:
    """``T_root_room`` with its (3, 3) covariance in the room's frame."""

    T_root_room: Pose2
    covariance: Array


def lay_out(
    first_room: str, first: PlacedRoom, guesses: Mapping[str, Pose2], passages: Sequence[Passage]
) -> dict[str, PlacedRoom]:
    """Poses of all rooms that passages connect with the first, which stays where it is.

    Args:
        first_room: the room measured from the root itself.
        first: its pose.
        guesses: where every room is thought to be.
        passages: the doors known from both sides.
    """
    reached = _reached(first_room, passages)
    keys = {room: R(index) for index, room in enumerate(reached)}
    graph, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
    graph.add(
        gtsam.PriorFactorPose2(
            keys[first_room], to_gtsam(first.T_root_room), gtsam.noiseModel.Gaussian.Covariance(first.covariance)
        )
    )
    for room in reached:
        values.insert(keys[room], to_gtsam(guesses[room]))
    for passage in passages:
        if passage.first in keys and passage.second in keys:
            noise = gtsam.noiseModel.Robust.Create(
                gtsam.noiseModel.mEstimator.Huber.Create(3.0),
                gtsam.noiseModel.Gaussian.Covariance(passage.room_covariance()),
            )
            graph.add(
                gtsam.BetweenFactorPose2(
                    keys[passage.first], keys[passage.second], to_gtsam(passage.T_first_second), noise
                )
            )
    result = gtsam.LevenbergMarquardtOptimizer(graph, values).optimize()
    marginals = gtsam.Marginals(graph, result)
    return {
        room: PlacedRoom(
            T_root_room=from_gtsam(result.atPose2(key)), covariance=_symmetric(marginals.marginalCovariance(key))
        )
        for room, key in keys.items()
    }


def _reached(first_room: str, passages: Sequence[Passage]) -> list[str]:
    """Rooms connected with the first one, nearest first."""
    order = [first_room]
    for room in order:
        for passage in passages:
            for here, there in ((passage.first, passage.second), (passage.second, passage.first)):
                if here == room and there not in order:
                    order.append(there)
    return order


def _symmetric(covariance: Array) -> Array:
    return np.asarray((covariance + covariance.T) / 2.0)
