"""The house in physics: things stay where they are put, walls and doors are where the file says, people interfere."""

from __future__ import annotations

import math

import numpy as np
import pybullet as p
import pytest

from simulation.errors import DisturbError
from simulation.houses.disturbances import parse_disturbance
from simulation.houses.house_file import builtin_houses, load_house
from simulation.robot.description import LidarDescription
from simulation.robot.lidar import Lidar
from simulation.world.world import World

LIDAR = Lidar(LidarDescription())


@pytest.fixture
def client():
    client = p.connect(p.DIRECT)
    yield client
    p.disconnect(client)


def build(client, name="flat"):
    return World(load_house(name), client=client, rng=np.random.default_rng(0))


def objects(world):
    truth = world.truth(stamp_s=0.0, robot_pose=(0.0, 0.0, 0.0), holding=None, collisions=0)
    return {item["id"]: item for item in truth["objects"]}


def blocked(client, start, end):
    return p.rayTest(start, end, physicsClientId=client)[0][0] >= 0


@pytest.mark.parametrize("name", builtin_houses())
def test_things_still_stand_where_they_were_put_after_two_seconds(client, name):
    world = build(client, name)
    before = objects(world)
    for _ in range(480):
        p.stepSimulation(physicsClientId=client)
    after = objects(world)
    for item in world.house.objects:
        assert math.dist(before[item.id]["position_m"], after[item.id]["position_m"]) < 0.01, item.id
        assert after[item.id]["on"] == item.on, item.id


def test_an_open_door_lets_rays_through_below_its_lintel_and_a_closed_one_does_not(client):
    world = build(client)
    door = world.house.doors[0]
    x, y = door.center

    def through(z):
        return not blocked(client, (x - 0.3, y, z), (x + 0.3, y, z))

    assert through(1.0)
    assert not through(2.2)
    world.apply(parse_disturbance({"do": "close_door", "id": door.id}))
    assert not through(1.0)
    world.apply(parse_disturbance({"do": "open_door", "id": door.id}))
    assert through(1.0)


@pytest.mark.parametrize("name", builtin_houses())
def test_the_lidar_agrees_with_the_physics_library_ray_by_ray(client, name):
    world = build(client, name)
    x, y, yaw = world.house.robot.pose
    origin = np.array([x, y, 1.6])
    ranges = LIDAR.scan_ranges(world.solids.now(()), (x, y, 1.6), yaw)
    elevation, azimuth = np.meshgrid(LIDAR.elevations_rad, LIDAR.azimuths_rad + yaw, indexing="ij")
    flat = np.cos(elevation)
    directions = np.stack((flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)), -1).reshape(-1, 3)
    ends = origin + 29.9 * directions
    hits = p.rayTestBatch([origin.tolist()] * len(ends), ends.tolist(), physicsClientId=client)
    expected = np.array([hit[2] * 29.9 if hit[0] >= 0 else np.inf for hit in hits]).reshape(ranges.shape)
    seen = np.isfinite(ranges)
    assert seen.mean() > 0.7
    with np.errstate(invalid="ignore"):
        differs = ~(np.abs(ranges - expected) < 5e-3)
    assert (differs & seen).sum() < 0.01 * seen.sum(), "only grazing rays may differ"


def test_the_walls_let_no_ray_out_of_the_house(client):
    world = build(client, "loft")
    for door in world.house.doors:
        world.apply(parse_disturbance({"do": "close_door", "id": door.id}))
    x, y, yaw = world.house.robot.pose
    ranges = LIDAR.scan_ranges(world.solids.now(()), (x, y, 1.6), yaw)
    assert np.isfinite(ranges[(LIDAR.elevations_rad > 0) & (LIDAR.elevations_rad < 0.12)]).all()


def test_disturbances_show_in_the_truth(client):
    world = build(client)
    apply = lambda **event: world.apply(parse_disturbance(event))
    apply(do="move", id="bottle_1", to={"on": "table_2"})
    apply(do="remove", id="cup_1")
    apply(do="add", object={"id": "new", "category": "cup", "color": "green", "on": "desk_1"})
    for _ in range(240):
        p.stepSimulation(physicsClientId=client)
    now = objects(world)
    assert now["bottle_1"]["on"] == "table_2"
    assert now["bottle_1"]["room"] == "hall"
    assert "cup_1" not in now
    assert (now["new"]["on"], now["new"]["color"]) == ("desk_1", "green")


def test_a_person_walks_to_where_they_are_told(client):
    world = build(client)
    world.apply(parse_disturbance({"do": "walk", "id": "user", "to": {"pose": [3.0, 5.0]}}))
    for _ in range(40):
        world.advance(0.1, 0.0)
    truth = world.truth(stamp_s=0.0, robot_pose=(0.0, 0.0, 0.0), holding=None, collisions=0)
    assert truth["people"][0]["position_m"] == pytest.approx([3.0, 5.0])


@pytest.mark.parametrize(
    "event",
    [
        {"do": "move", "id": "unicorn", "to": {"on": "table_1"}},
        {"do": "move", "id": "bottle_1", "to": {"on": "unicorn"}},
        {"do": "close_door", "id": "unicorn"},
        {"do": "walk", "id": "unicorn", "to": {"pose": [0, 0]}},
        {"do": "add", "object": {"id": "bottle_1", "category": "cup", "on": "table_1"}},
    ],
)
def test_what_cannot_happen_is_refused_with_what_there_is(client, event):
    world = build(client)
    with pytest.raises(DisturbError):
        world.apply(parse_disturbance(event))


def test_things_at_rest_still_tell_what_they_stand_on_and_fall_when_it_goes(client):
    world = build(client)
    before = objects(world)
    settle(client, 6.0)
    after = objects(world)
    assert {name: item["on"] for name, item in after.items()} == {name: item["on"] for name, item in before.items()}
    name, item = next((name, item) for name, item in after.items() if item["on"] and item["position_m"][2] > 0.5)
    world.apply(parse_disturbance({"do": "remove", "id": item["on"]}))
    settle(client, 2.0)
    fallen = objects(world)[name]
    assert fallen["on"] != item["on"]
    assert fallen["position_m"][2] < item["position_m"][2] - 0.3


def settle(client, seconds):
    for _ in range(round(seconds * 240)):
        p.stepSimulation(physicsClientId=client)
