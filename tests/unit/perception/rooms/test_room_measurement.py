"""Rooms measured on the way into them, and their place in the graph."""

from __future__ import annotations

import numpy as np
import pytest

from perception.geometry.planar import Pose2
from perception.geometry.polygon import signed_area, wall_lengths
from perception.rooms.survey.instance import MeasuredRoom, measured_room, room_elements
from scene_graph.edges import RtEdge
from scene_graph.nodes import RoomStatus, WallNode
from unit.perception.lidar_house import Array, l_shape, rectangle
from unit.perception.rooms.viewed_rooms import Approach, approach


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize(
    ("polygon", "start", "end"),
    [
        (rectangle(8.0, 6.0), (1.0, 1.0), (4.0, 3.0)),
        (l_shape(), (5.0, 1.5), (1.5, 1.5)),
        (rectangle(14.0, 1.2), (1.0, 0.6), (7.0, 0.6)),
        (rectangle(30.0, 30.0), (3.0, 3.0), (12.0, 12.0)),
    ],
    ids=["room", "L", "corridor", "great hall"],
)
def test_odometry_errors_of_the_approach_do_not_reach_the_room(
    polygon: Array, start: tuple[float, float], end: tuple[float, float], seed: int
) -> None:
    measured = approach(polygon, start, end, seed)
    assert measured.fit.outline.closed
    assert measured.error_m() < 0.012


def room_from(measured: Approach) -> MeasuredRoom:
    return measured_room(measured.fit, np.zeros((3, 3)), Pose2.identity(), least_matched=0.3)


def test_the_room_frame_is_centered_and_corner_zero_is_left_of_the_heading() -> None:
    measured = approach(rectangle(8.0, 6.0), (1.0, 1.0), (4.0, 3.0), 0)
    room = room_from(measured)
    assert np.abs(room.polygon.min(axis=0) + room.polygon.max(axis=0)).max() < 1e-9
    assert signed_area(room.polygon) > 0.0
    assert abs(room.T_room_base.yaw_rad) < np.pi / 4 + 0.01
    seen = room.T_room_base.inverse().apply(room.polygon)
    bearings = np.arctan2(seen[:, 1], seen[:, 0]) % (2 * np.pi)
    assert bearings[0] == bearings.min()
    robot = measured.last
    assert np.linalg.norm(room.T_room_base.position_m) == pytest.approx(
        np.linalg.norm(robot.position_m - np.array([4.0, 3.0])), abs=0.015
    )


def test_wall_frames_look_into_the_room_and_carry_their_corner_at_the_start() -> None:
    room = room_from(approach(l_shape(), (5.0, 1.5), (1.5, 1.5), 0))
    elements = room_elements(room, "room_7", status=RoomStatus.PERMANENT, height_m=2.5, stamp_s=0.0)
    walls = {node.id: node for node in elements if isinstance(node, WallNode)}
    edges = {edge.target: edge for edge in elements if isinstance(edge, RtEdge)}
    assert list(walls) == [f"wall_7_{k}" for k in range(6)]
    for k, length_m in enumerate(wall_lengths(room.polygon)):
        T_room_wall = edges[f"wall_7_{k}"].T_source_target
        T_wall_corner = edges[f"corner_7_{k}"].T_source_target
        wall = walls[f"wall_7_{k}"]
        assert np.allclose((T_room_wall @ T_wall_corner).translation_m[:2], room.polygon[k])
        assert np.allclose(T_room_wall.rotation()[:2, 1], wall.normal)
        assert float(np.dot(wall.normal, room.polygon[k])) == pytest.approx(wall.offset_m)
        assert wall.length_m == pytest.approx(length_m)


def test_of_a_partial_room_only_the_walls_that_were_seen_stand() -> None:
    room = room_from(approach(rectangle(8.0, 6.0), (1.0, 1.0), (4.0, 3.0), 0))
    room.wall_seen[2] = 0.1
    elements = room_elements(room, "room_1", status=RoomStatus.PARTIAL, height_m=2.5, stamp_s=0.0)
    assert [node.id for node in elements if isinstance(node, WallNode)] == ["wall_1_0", "wall_1_1", "wall_1_3"]
