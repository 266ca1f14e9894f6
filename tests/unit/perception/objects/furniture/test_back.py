"""Where the back of a seat is."""

import numpy as np
import pytest

from perception.objects.furniture.back import back_of
from perception.objects.furniture.surface import Box
from perception.objects.publishing.publication import node_of
from perception.objects.tracking.track import Track, TrackSettings
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode
from unit.perception.objects.things import filled


@pytest.mark.parametrize("turn", [0.0, 0.7])
@pytest.mark.parametrize(
    ("high", "side"),
    [
        (filled((-0.22, 0.22), (0.2, 0.23), (0.5, 0.9), step_m=0.04), 1),
        (filled((-0.22, -0.2), (-0.2, 0.23), (0.5, 0.9), step_m=0.04), 2),
        (filled((-0.22, 0.22), (0.2, 0.23), (0.5, 0.6), step_m=0.04), None),  # an arm is lower
        (filled((-0.22, 0.22), (-0.22, 0.22), (0.5, 0.9), step_m=0.04), None),
        (np.zeros((0, 3)), None),
    ],
)
def test_the_back_of_a_chair_is_on_the_side_that_is_higher(high, side, turn):
    """Counted in quarter turns from its own x axis."""
    box = Box(np.array((2.0, 1.0, 0.45)), (0.45, 0.46, 0.9), turn)
    seat = filled((-0.22, 0.22), (-0.22, 0.22), (0.4, 0.45), step_m=0.04)
    c, s = np.cos(turn), np.sin(turn)
    points = np.vstack((seat, high)) @ np.array(((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))) + (2.0, 1.0, 0.0)
    back = back_of(points, box)
    if side is None:
        assert back is None
    else:
        assert np.angle(np.exp(1j * (back.toward_rad - turn - side * np.pi / 2))) == pytest.approx(0.0, abs=1e-6)
        assert back.face_m == pytest.approx(0.21, abs=0.015)


def test_where_the_back_of_a_chair_is_outlives_a_restart_and_a_change_of_frame():
    node = ObjectNode(id="chair_1", label="chair", size_m=(0.45, 0.46, 0.9), back_rad=np.pi / 2, back_m=0.19)
    track = Track(1, "room_1", settings=TrackSettings(), random=np.random.default_rng(0))
    track.adopt(node, SE3.from_xyz_yaw(1.0, 0.0, 0.45, 0.3), np.eye(3) * 1e-4)
    assert node_of("chair_1", track, node, None).back_rad == pytest.approx(np.pi / 2, abs=1e-3)
    track.change_room("room_2", SE3.from_xyz_yaw(0.0, 0.0, 0.0, 1.0))
    moved = node_of("chair_1", track, node, None)
    assert (moved.back_rad, moved.back_m) == (pytest.approx(np.pi / 2, abs=1e-3), 0.19)
