"""Global localization: right or undecided, never wrong."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest

from perception.geometry.planar import Pose2, wrap
from perception.geometry.polygon import distance_to_outline, inside
from perception.lidar.slice import OutlineSlicer
from perception.localization.doorways import doorway_fit, doorway_model
from perception.localization.global_localization import Sight, decide, hypotheses, known_rooms
from perception.localization.measurement_model import expected_ranges, fit_of, wall_ranges
from perception.localization.room_model import RoomModel, room_model
from scene_graph.memory import WorkingMemory
from unit.perception.known_house import frame_of, known_house, room_ids
from unit.perception.lidar_house import Array, Box, Door, House, cast, l_shape, rectangle, t_shape, u_shape


def offices() -> House:
    """A corridor with rooms of many shapes along it, two of which are equal."""
    return House(
        rooms={
            "corridor": rectangle(14.0, 1.8, y=3.2),
            "wide": rectangle(4.0, 3.0),
            "twin one": rectangle(3.5, 3.0, x=4.2),
            "twin two": rectangle(3.5, 3.0, x=7.9),
            "small": rectangle(2.4, 3.0, x=11.6),
            "L": l_shape() + np.array([0.0, 5.2]),
            "U": u_shape() + np.array([6.2, 5.2]),
        },
        doors=[
            Door(rooms=("wide", "corridor"), center=(1.0, 3.1)),
            Door(rooms=("twin one", "corridor"), center=(5.0, 3.1)),
            Door(rooms=("twin two", "corridor"), center=(8.7, 3.1)),
            Door(rooms=("small", "corridor"), center=(12.8, 3.1)),
            Door(rooms=("L", "corridor"), center=(4.5, 5.1)),
            Door(rooms=("U", "corridor"), center=(10.0, 5.1)),
        ],
        boxes=[
            Box(center=(1.0, 0.5), size=(1.2, 0.6, 0.75)),
            Box(center=(5.0, 0.4), size=(1.6, 0.7, 1.95)),
            Box(center=(8.7, 0.4), size=(1.6, 0.7, 1.95)),
            Box(center=(1.0, 8.5), size=(1.0, 1.0, 2.0)),
        ],
    )


def sight(house: House, pose: Pose2, rng: np.random.Generator, sigma_m: float = 0.02, *, odometry: Pose2 | None = None):
    scan = cast(house, pose, rng, sigma_m=sigma_m)
    return Sight(scan=scan, outline=OutlineSlicer().cut(scan), T_odom_base=odometry or Pose2.identity())


def places(house: House, name: str, rng: np.random.Generator, count: int) -> list[Pose2]:
    """Random poses in a room, clear of walls and furniture."""
    polygon, found = house.rooms[name], list[Pose2]()
    while len(found) < count:
        point = rng.uniform(polygon.min(axis=0), polygon.max(axis=0))
        free = all(np.abs(point - np.array(box.center)).max() > 0.9 for box in house.boxes)
        if free and inside(polygon, point) and distance_to_outline(polygon, point) > 0.35:
            found.append(Pose2(float(point[0]), float(point[1]), float(rng.uniform(-3.1, 3.1))))
    return found


def outcome(house: House, memory: WorkingMemory, name: str, pose: Pose2, views: list[Sight]) -> str:
    """``right``, ``wrong`` or ``undecided``."""
    decided = decide(hypotheses(views, known_rooms(memory.snapshot())))
    if decided is None:
        return "undecided"
    number = list(house.rooms).index(name) + 1
    truth = frame_of(house.rooms[name], number).inverse() @ pose
    near = decided.T_room_base.distance_m(truth) < 0.12
    near = near and abs(wrap(decided.T_room_base.yaw_rad - truth.yaw_rad)) < 0.03
    return "right" if near and decided.room_id == room_ids(house)[name] else "wrong"


def outcomes(house: House, memory: WorkingMemory, name: str, *, sigma_m: float = 0.02, count: int = 8) -> Counter[str]:
    rng = np.random.default_rng(3)
    return Counter(
        outcome(house, memory, name, pose, [sight(house, pose, rng, sigma_m)])
        for pose in places(house, name, rng, count)
    )


def test_the_expected_ranges_agree_with_a_cast_of_the_same_room() -> None:
    house = House(rooms={"a": u_shape()})
    model = room_model(known_house(house).snapshot(), "room_1")
    assert model is not None
    pose = frame_of(u_shape(), 1).inverse() @ Pose2(1.0, 1.0, 0.3)
    seen = sight(house, Pose2(1.0, 1.0, 0.3), np.random.default_rng(0), sigma_m=0.0)
    azimuths = seen.outline.azimuths_rad + pose.yaw_rad
    ranges, _ = wall_ranges(model.walls, pose.position_m, azimuths)
    told = np.isfinite(seen.outline.ranges_m)
    assert np.quantile(np.abs(ranges - seen.outline.ranges_m)[told], 0.99) < 0.01
    nearest, farthest, _ = expected_ranges(model.walls, pose.position_m, azimuths)
    assert (nearest <= ranges).all()
    assert (ranges <= farthest).all()


@pytest.mark.parametrize("sigma_m", [0.02, 0.05])
def test_a_scan_fits_where_it_was_taken_and_not_half_a_meter_beside(sigma_m: float) -> None:
    house, rng = offices(), np.random.default_rng(0)
    snapshot = known_house(house, error_m=0.015).snapshot()
    for number, name in enumerate(house.rooms, start=1):
        model = room_model(snapshot, f"room_{number}")
        assert model is not None
        openings = doorway_model(snapshot, model).openings
        for pose in places(house, name, rng, 4):
            if distance_to_outline(house.rooms[name], pose.position_m) < 0.6:
                continue
            seen = sight(house, pose, rng, sigma_m)
            here = frame_of(house.rooms[name], number).inverse() @ pose
            assert fit_of(seen.outline, model.walls, openings, here).explained > 0.9
            assert fit_of(seen.outline, model.walls, openings, here).passed < 0.01
            beside = here @ Pose2(0.35, 0.35, 0.0)
            assert fit_of(seen.outline, model.walls, openings, beside).explained < 0.7


@pytest.mark.parametrize(("width_m", "alarming"), [(0.9, False), (2.4, True)], ids=["a doorway", "half a wall"])
def test_a_doorway_without_lintel_that_nobody_has_noticed_yet_is_no_alarm(width_m: float, alarming: bool) -> None:
    rooms = {"a": rectangle(5.0, 4.0), "b": rectangle(5.0, 4.0, x=5.2)}
    house = House(rooms=rooms, doors=[Door(rooms=("a", "b"), center=(5.1, 2.0), width=width_m, height=2.5)])
    model = room_model(known_house(House(rooms=rooms)).snapshot(), "room_1")
    assert model is not None
    pose = Pose2(2.5, 1.8, 0.2)
    seen = sight(house, pose, np.random.default_rng(0), 0.02)
    fit = fit_of(seen.outline, model.walls, np.empty((0, 2, 2)), frame_of(rooms["a"], 1).inverse() @ pose)
    assert (fit.passed > 0.03) is alarming


def test_a_door_is_seen_open_and_its_mirror_image_is_strange() -> None:
    house, rng = offices(), np.random.default_rng(0)
    snapshot = known_house(house).snapshot()
    model = room_model(snapshot, "room_2")
    assert isinstance(model, RoomModel)
    pose = frame_of(house.rooms["wide"], 2).inverse() @ Pose2(2.2, 1.4, 0.5)
    scan = sight(house, Pose2(2.2, 1.4, 0.5), rng).scan
    here = doorway_fit(scan, doorway_model(snapshot, model), pose)
    assert (here.open, here.shut, here.strange) == (1, 0, 0)
    turned = doorway_fit(scan, doorway_model(snapshot, model), Pose2(0.0, 0.0, np.pi) @ pose)
    assert (turned.open, turned.shut, turned.strange) == (0, 1, 1)


@pytest.mark.parametrize(("sigma_m", "error_m"), [(0.02, 0.0), (0.02, 0.015), (0.05, 0.02)])
@pytest.mark.parametrize("name", ["corridor", "wide", "small", "L", "U"])
def test_in_a_room_of_its_own_shape_the_robot_is_found(name: str, sigma_m: float, error_m: float) -> None:
    house = offices()
    found = outcomes(house, known_house(house, error_m=error_m), name, sigma_m=sigma_m)
    assert found["wrong"] == 0
    assert found["right"] >= 7


@pytest.mark.parametrize("name", ["twin one", "twin two"])
@pytest.mark.parametrize("seed", range(3))
def test_between_twins_nothing_is_decided(name: str, seed: int) -> None:
    house = offices()
    memory = known_house(house, error_m=0.015, seed=seed)
    assert outcomes(house, memory, name, count=6) == Counter(undecided=6)
    rng = np.random.default_rng(3)
    found = hypotheses([sight(house, places(house, name, rng, 1)[0], rng)], known_rooms(memory.snapshot()))
    assert {one.room_id for one in found if one.weight > 0.01} == {"room_3", "room_4"}


@pytest.mark.parametrize("name", ["corridor", "wide", "L", "U"])
def test_in_a_room_that_is_not_known_nothing_is_decided(name: str) -> None:
    house = offices()
    assert outcomes(house, known_house(house, but=(name,)), name) == Counter(undecided=8)


@pytest.mark.parametrize("polygon", [rectangle(5.0, 3.0), rectangle(4.0, 4.0)], ids=["rectangle", "square"])
def test_a_symmetrical_room_without_a_door_in_view_stays_undecided(polygon: Array) -> None:
    house = House(rooms={"a": polygon})
    assert outcomes(house, known_house(house, error_m=0.01), "a") == Counter(undecided=8)


def test_a_door_that_was_closed_since_does_not_turn_a_symmetrical_room() -> None:
    """One door of two was shut meanwhile; the other, opposite, stands open where its mirror image would be."""
    doors = [Door(rooms=("a", "outside"), center=(1.2, -0.1)), Door(rooms=("a", "outside"), center=(3.8, 3.1))]
    house = House(rooms={"a": rectangle(5.0, 3.0)}, doors=doors)
    memory = known_house(house)
    house.doors[0] = Door(rooms=("a", "outside"), center=(1.2, -0.1), open=False)
    assert outcomes(house, memory, "a")["wrong"] == 0


def test_a_second_view_decides_what_the_first_left_open() -> None:
    """A screen hides the only door from the first place."""
    house = House(rooms={"a": rectangle(6.0, 4.0)}, doors=[Door(rooms=("a", "outside"), center=(1.0, 4.1))])
    house.boxes.append(Box(center=(1.2, 2.2), size=(2.0, 0.1, 1.99)))
    memory, rng = known_house(house), np.random.default_rng(0)
    first, second = Pose2(1.0, 1.5, 0.0), Pose2(3.0, 2.8, 2.0)
    views = [
        sight(house, first, rng),
        sight(house, second, rng, odometry=first.inverse() @ second),
    ]
    assert outcome(house, memory, "a", first, views[:1]) == "undecided"
    assert outcome(house, memory, "a", second, views) == "right"


def test_a_room_without_symmetry_is_found_by_its_walls_alone() -> None:
    house = House(rooms={"a": l_shape()})
    assert outcomes(house, known_house(house, error_m=0.01), "a") == Counter(right=8)


@pytest.mark.parametrize("polygon", [t_shape(), u_shape()], ids=["T", "U"])
def test_a_room_that_is_its_own_mirror_image_is_no_trap(polygon: Array) -> None:
    """Mirrored is not turned: T and U look the same in a mirror, and only there."""
    house = House(rooms={"a": polygon})
    found = outcomes(house, known_house(house, error_m=0.01), "a")
    assert found["wrong"] == 0
    assert found["right"] >= 6


def test_a_tall_cupboard_hides_walls_and_nothing_else() -> None:
    house = offices()
    memory = known_house(house)
    house.boxes.append(Box(center=(3.5, 1.5), size=(0.6, 1.4, 2.3)))
    found = outcomes(house, memory, "wide")
    assert found["wrong"] == 0
