"""Single walls of a room that stands move to where they are seen, and nothing else moves them."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import pytest

from perception.crossing import match_of
from perception.geometry.planar import Pose2, diagonal_covariance
from perception.geometry.walls import Walls
from perception.lidar.slice import OutlineSlicer
from perception.localization.energy_optimizer import EnergyOptimizer
from perception.localization.relocalization import Relocalization
from perception.localization.robot_pose import RobotPose
from perception.localization.room_model import RoomModel, room_model
from perception.memory.room_layout import RoomLayout
from perception.rooms.maintenance.adjustment import AdjustmentSettings, LocalAdjustment, WallShifts
from perception.rooms.maintenance.shifted_walls import shift_walls, shifted_outline, wall_stds
from perception.rooms.room_concept import RoomConcept
from perception.sensing import SensorBuffer
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, ROOT_ID, DoorNode, RoomStatus
from unit.perception.exploring_robot import Agent, Exploration, find_way
from unit.perception.known_house import frame_of, known_house, put_robot
from unit.perception.lidar_house import Array, Box, Door, House, cast, l_shape, rectangle, u_shape

IN_ROOM = [(x, y) for x in (0.7, 1.4, 2.1, 2.8, 3.4) for y in (0.6, 1.2, 1.8, 2.3)]
IN_L = [(x, y) for x in (0.8, 1.6, 2.4, 3.3, 4.2, 5.1) for y in (0.7, 1.6)] + [
    (x, y) for x in (0.8, 2.0) for y in (2.6, 3.6)
]
POSE_COVARIANCE = diagonal_covariance(0.004, 0.004, 0.002)


def model_of(polygon: Array) -> RoomModel:
    return RoomModel(room_id="room_1", polygon=polygon, walls=Walls.of_polygon(polygon))


def believed_at(T_room_base: Pose2) -> RobotPose:
    return RobotPose(parent="room_1", T_parent_base=T_room_base, T_odom_base=T_room_base, covariance=POSE_COVARIANCE)


def shifts_seen(
    house: House,
    believed: Array,
    places: Iterable[tuple[float, float]],
    *,
    std_m: Array | None = None,
    sigma_m: float = 0.02,
    off: Pose2 | None = None,
) -> WallShifts | None:
    """What is to be adjusted after looking from all places; the pose is believed to be ``off`` from where it is."""
    adjustment, model, rng = LocalAdjustment(), model_of(believed), np.random.default_rng(1)
    slicer = OutlineSlicer()
    for k, (x, y) in enumerate(places):
        pose = Pose2(x, y, float(rng.uniform(-3.0, 3.0)))
        scan = slicer.cut(cast(house, pose, rng, sigma_m=sigma_m, stamp_s=2.0 * k))
        noisy = Pose2(
            *(pose.position_m + rng.normal(0.0, 0.004, 2)).tolist(), pose.yaw_rad + float(rng.normal(0.0, 0.003))
        )
        T_room_base = (off or Pose2.identity()) @ noisy
        adjustment.add(model, scan, believed_at(T_room_base))
    return adjustment.solve(np.zeros(len(believed)) if std_m is None else std_m)


def room(**options: object) -> House:
    return House(rooms={"a": rectangle(4.0, 3.0)}, **options)  # type: ignore[arg-type]


@pytest.mark.parametrize("off_m", [0.02, 0.06, 0.25, -0.06, -0.2])
@pytest.mark.parametrize("sigma_m", [0.02, 0.05])
def test_a_wall_that_was_known_badly_moves_to_where_it_is_and_no_other_does(off_m: float, sigma_m: float) -> None:
    vague = np.array([0.002, 0.05, 0.002, 0.002])
    found = shifts_seen(room(), rectangle(4.0 + off_m, 3.0), IN_ROOM, std_m=vague, sigma_m=sigma_m)
    assert found is not None
    assert abs(found.shift_m[1] - off_m) < 0.006
    assert found.shift_m[[0, 2, 3]].tolist() == [0.0, 0.0, 0.0]
    assert found.std_m[1] < vague[1]


@pytest.mark.parametrize("wall", range(6))
@pytest.mark.parametrize("off_m", [0.03, 0.06])
def test_of_three_parallel_walls_known_alike_the_odd_one_moves(wall: int, off_m: float) -> None:
    believed = shifted_outline(l_shape(), -off_m * np.eye(6)[wall])
    assert believed is not None
    found = shifts_seen(House(rooms={"a": l_shape()}), believed, IN_L)
    assert found is not None
    assert np.abs(found.shift_m - off_m * np.eye(6)[wall]).max() < 0.006


def test_of_two_opposite_walls_known_alike_both_move_by_half_so_that_the_frame_stays_in_the_middle() -> None:
    found = shifts_seen(room(), rectangle(4.08, 3.0, x=-0.04), IN_ROOM)
    assert found is not None
    assert np.abs(found.shift_m - np.array([0.0, 0.04, 0.0, 0.04])).max() < 0.008


@pytest.mark.parametrize("sigma_m", [0.02, 0.05])
@pytest.mark.parametrize(("polygon", "places"), [(rectangle(4.0, 3.0), IN_ROOM), (l_shape(), IN_L)], ids=["room", "L"])
def test_a_room_that_is_right_is_left_alone(polygon: Array, places: list[tuple[float, float]], sigma_m: float) -> None:
    assert shifts_seen(House(rooms={"a": polygon}), polygon, places, sigma_m=sigma_m) is None


def test_when_all_walls_seem_shifted_alike_it_is_the_pose_that_is_off() -> None:
    assert shifts_seen(room(), rectangle(4.0, 3.0, x=0.06), IN_ROOM) is None
    assert shifts_seen(room(), rectangle(4.0, 3.0), IN_ROOM, off=Pose2(0.05, -0.04, 0.005)) is None


def test_a_pose_that_is_off_does_not_hide_a_wall_that_is() -> None:
    vague = np.array([0.002, 0.05, 0.002, 0.002])
    found = shifts_seen(room(), rectangle(4.06, 3.0), IN_ROOM, std_m=vague, off=Pose2(0.03, -0.02, 0.0))
    assert found is not None
    assert abs(found.shift_m[1] - 0.06) < 0.006
    moved = found.T_base_moved
    assert np.hypot(moved.x_m, moved.y_m) == pytest.approx(np.hypot(0.03, 0.02), abs=0.012)


@pytest.mark.parametrize(
    "box",
    [
        Box(center=(2.0, 2.97), size=(2.0, 0.06, 2.5)),
        Box(center=(2.0, 2.85), size=(2.4, 0.3, 2.5)),
        Box(center=(1.0, 2.7), size=(2.0, 0.6, 2.5)),
        Box(center=(2.5, 2.6), size=(0.5, 0.4, 2.5)),
        Box(center=(2.0, 1.5), size=(0.4, 0.3, 2.5)),
    ],
    ids=["panel", "bookcase", "wardrobe", "person by the wall", "person in the middle"],
)
def test_what_stands_before_a_wall_does_not_move_it(box: Box) -> None:
    places = [(x, y) for x, y in IN_ROOM if y < 2.0 and np.hypot(x - box.center[0], y - box.center[1]) > 0.5]
    assert shifts_seen(room(boxes=[box]), rectangle(4.0, 3.0), places) is None


def test_openings_do_not_move_a_wall() -> None:
    open_house = House(
        rooms={"a": rectangle(4.0, 3.0), "b": rectangle(4.0, 3.0, y=-3.2)},
        doors=[Door(rooms=("a", "b"), center=(1.0, -0.1)), Door(rooms=("a", "b"), center=(3.0, -0.1), height=2.5)],
    )
    assert shifts_seen(open_house, rectangle(4.0, 3.0), IN_ROOM) is None


def test_few_places_are_not_enough_and_a_wall_that_comes_nearer_needs_more_of_them() -> None:
    vague = np.array([0.002, 0.05, 0.002, 0.002])
    settings = AdjustmentSettings()
    for off_m, least in ((-0.06, settings.seen_from), (0.06, settings.nearer_from)):
        believed = rectangle(4.0 + off_m, 3.0)
        assert shifts_seen(room(), believed, IN_ROOM[:least], std_m=vague) is None
        assert shifts_seen(room(), believed, IN_ROOM[: least + 1], std_m=vague) is not None
    assert shifts_seen(room(), rectangle(4.06, 3.0), [(2.0, 1.5)] * 30, std_m=vague) is None


def test_a_view_taken_just_before_the_robot_is_found_to_be_elsewhere_does_not_count() -> None:
    rng, slicer, adjustment = np.random.default_rng(0), OutlineSlicer(), LocalAdjustment()
    model, vague = model_of(rectangle(4.0, 3.0)), np.array([0.002, 0.05, 0.002, 0.002])
    carried = House(rooms={"a": rectangle(4.2, 3.0)})
    for k, (x, y) in enumerate(IN_ROOM):
        pose = Pose2(x, y, 0.2)
        scan = slicer.cut(cast(carried, pose, rng, stamp_s=2.0 * k))
        assert adjustment.add(model, scan, believed_at(pose))
        adjustment.doubt()
    assert adjustment.solve(vague) is None


def test_shifting_walls_moves_their_planes_by_just_that_and_keeps_the_others() -> None:
    rng = np.random.default_rng(3)
    for polygon in (rectangle(4.0, 3.0), l_shape(), u_shape()):
        shift_m = rng.uniform(-0.2, 0.2, len(polygon))
        moved = shifted_outline(polygon, shift_m)
        assert moved is not None
        before, after = model_of(polygon).walls, model_of(moved).walls
        np.testing.assert_allclose(after.normal, before.normal, atol=1e-12)
        np.testing.assert_allclose(after.offset_m - before.offset_m, shift_m, atol=1e-12)
    assert shifted_outline(rectangle(0.5, 3.0), np.array([0.0, 0.3, 0.0, 0.3])) is None


def two_rooms() -> House:
    return House(
        rooms={"a": rectangle(4.0, 3.0), "b": rectangle(4.0, 3.0, y=-3.2)},
        doors=[Door(rooms=("a", "b"), center=(1.2, -0.1)), Door(rooms=("a", "outside"), center=(4.1, 2.0))],
    )


def test_a_door_keeps_its_station_on_the_wall_that_moves_and_its_place_on_those_that_grow() -> None:
    memory = known_house(two_rooms())
    before = memory.snapshot()
    model, frame = room_model(before, "room_1"), frame_of(two_rooms().rooms["a"], 1)
    assert model is not None
    shifts = WallShifts(
        shift_m=np.array([-0.05, 0.0, 0.0, 0.0]), std_m=np.full(4, 0.004), T_base_moved=Pose2.identity()
    )
    with memory.edit("test", 9.0) as tx:
        assert shift_walls(tx, model, shifts, 9.0)
    after = memory.snapshot()
    low, side = (
        next(door.id for door in after.of_type(DoorNode) if door.id.startswith(stem))
        for stem in ("door_1_0", "door_1_1")
    )
    place = {door: frame.apply(Pose2.from_se3(after.transform("room_1", door)).position_m) for door in (low, side)}
    np.testing.assert_allclose(place[low], [1.2, -0.05], atol=1e-9)
    np.testing.assert_allclose(place[side], [4.0, 2.0], atol=1e-9)
    assert match_of(after, low) == match_of(before, low) is not None
    assert after.wall("wall_1_1").length_m == pytest.approx(3.05)
    edge = after.parent("wall_1_0")
    assert edge is not None
    assert edge.covariance[1, 1] == pytest.approx(0.004**2)
    renewed = room_model(after, "room_1")
    assert renewed is not None
    for k in range(4):
        wall, T_room_wall = after.wall(f"wall_1_{k}"), Pose2.from_se3(after.transform("room_1", f"wall_1_{k}"))
        assert wall.offset_m == pytest.approx(renewed.walls.offset_m[k])
        np.testing.assert_allclose(
            T_room_wall.position_m, (renewed.polygon[k] + renewed.polygon[(k + 1) % 4]) / 2.0, atol=1e-12
        )


def test_the_frame_and_the_neighbors_stay_where_they_are() -> None:
    memory = known_house(two_rooms())
    layout = RoomLayout(memory)
    layout.update(0.0)
    before = memory.snapshot()
    model = room_model(before, "room_1")
    assert model is not None
    shifts = WallShifts(
        shift_m=np.array([-0.05, 0.0, 0.0, 0.0]), std_m=np.full(4, 0.004), T_base_moved=Pose2.identity()
    )
    with memory.edit("test", 9.0) as tx:
        shift_walls(tx, model, shifts, 9.0)
    layout.update(9.0)
    for room_id in ("room_1", "room_2"):
        T_root_room, was = (Pose2.from_se3(s.transform(ROOT_ID, room_id)) for s in (memory.snapshot(), before))
        assert T_root_room.distance_m(was) < 0.002


def agents(memory: WorkingMemory, buffer: SensorBuffer) -> list[Agent]:
    return [EnergyOptimizer(memory, buffer), Relocalization(memory, buffer), RoomConcept(memory, buffer)]


def wandering(
    actual: House,
    believed: House,
    pose: Pose2,
    places: list[tuple[float, float]],
    seconds: float,
    unlike: tuple[tuple[float, float], ...] | None = None,
) -> Exploration:
    """A robot that drives about a room that it believes to be another, until its outline is ``unlike`` this one."""
    run = Exploration.of(actual, pose, 0, agents)
    known = known_house(believed).snapshot()
    with run.memory.edit("test", 0.0) as tx:
        tx.put(*(node for node in known.nodes.values() if node.id not in tx.snapshot))
        tx.put(*(edge for edge in known.edges.values() if edge.key.target != ROBOT_ID))
    put_robot(run.memory, believed, "a", pose)
    goals = iter(places * 100)

    def drive(run: Exploration) -> bool:
        if not run.driver.way:
            run.driver.way = find_way(actual, run.port.pose.position_m, np.array(next(goals))) or []
        run.driver._drive()
        return unlike is not None and run.memory.snapshot().room("room_1").polygon_m != unlike

    run.run(seconds, until=drive)
    return run


@pytest.mark.slow
def test_a_wandering_robot_adjusts_a_wall_and_its_own_pose_within_forty_seconds() -> None:
    believed = l_shape()
    believed[1:3, 0] += 0.06
    house, wrong = House(rooms={"a": l_shape()}), House(rooms={"a": believed})
    written = known_house(wrong).snapshot().room("room_1").polygon_m
    run = wandering(house, wrong, Pose2(1.0, 1.0, 0.3), [(1.0, 1.0), (5.0, 1.0), (4.0, 1.5), (1.5, 4.2)], 40.0, written)
    run.run(2.0)
    snapshot, frame = run.memory.snapshot(), frame_of(believed, 1)
    found = frame.apply(np.array(snapshot.room("room_1").polygon_m))
    assert np.abs(found[1:3, 0] - 6.0).max() < 0.010
    assert np.abs(np.delete(found, [1, 2], axis=0) - np.delete(l_shape(), [1, 2], axis=0)).max() < 0.005
    robot = frame @ Pose2.from_se3(snapshot.transform("room_1", ROBOT_ID))
    assert robot.distance_m(run.port.pose) < 0.015
    assert snapshot.room("room_1").status is RoomStatus.PERMANENT


@pytest.mark.slow
def test_a_wandering_robot_leaves_a_room_that_is_right_alone() -> None:
    house = House(rooms={"a": rectangle(4.0, 3.0)}, boxes=[Box(center=(2.0, 2.8), size=(1.8, 0.4, 2.5))])
    run = wandering(house, room(), Pose2(1.0, 1.0, 0.3), [(1.0, 1.0), (3.2, 1.0), (3.3, 2.2), (0.7, 2.2)], 25.0)
    assert run.memory.snapshot().room("room_1") == known_house(room()).snapshot().room("room_1")


def test_what_is_known_of_a_wall_comes_from_the_graph() -> None:
    memory = known_house(two_rooms())
    snapshot = memory.snapshot()
    model = room_model(snapshot, "room_1")
    assert model is not None
    assert wall_stds(snapshot, model).tolist() == [0.0] * 4
