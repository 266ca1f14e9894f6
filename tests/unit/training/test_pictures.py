"""Pictures to learn from: random rooms, kept in files."""

from __future__ import annotations

from itertools import islice

import numpy as np
import pytest

from simulation.pictures.photographs import FLOOR, WALL
from simulation.robot.description import CameraDescription
from training.classes import CLASSES, PREDICATES, STUFF, UNKNOWN
from training.collecting import SHARD_PICTURES, collect, shards
from training.rooms.photographs import photographs
from training.rooms.scenes import random_scene
from training.shards import Examples, save_shard


@pytest.fixture(scope="module")
def pictures():
    rng = np.random.default_rng(3)
    return [picture for _ in range(5) for picture in photographs(rng)]


def test_classes_cover_what_the_design_asks_for():
    assert len(CLASSES) >= 21
    assert "person" in CLASSES
    assert CLASSES[-2:] == STUFF
    assert len(PREDICATES) == 8


def test_rooms_are_the_same_for_the_same_seed_and_differ_otherwise(pictures):
    again = list(islice(photographs(np.random.default_rng(3)), 2))
    assert np.array_equal(again[0].rgb, pictures[0].rgb)
    other = next(iter(photographs(np.random.default_rng(4))))
    assert not np.array_equal(other.rgb, pictures[0].rgb)


def test_rooms_have_things_of_many_kinds_some_without_a_name():
    rng = np.random.default_rng(0)
    categories = [item.category for _ in range(30) for item in random_scene(rng).items]
    assert len({name for name in categories if name in CLASSES}) > 30
    assert any(name not in CLASSES for name in categories)


def test_what_is_on_something_touches_it():
    rng = np.random.default_rng(1)
    borne = 0
    for _ in range(20):
        scene = random_scene(rng)
        for item in scene.items:
            if item.on is not None and item.on > FLOOR:
                carrier = scene.items[item.on]
                assert item.bottom_m[2] <= carrier.bottom_m[2] + carrier.size_m[2] + 0.01
                borne += 1
    assert borne > 20


def test_pictures_show_several_things(pictures):
    camera = CameraDescription()
    assert all(picture.rgb.shape == (camera.height_px, camera.width_px, 3) for picture in pictures)
    assert np.mean([np.count_nonzero(picture.pixels()[2:] > 60) for picture in pictures]) > 3
    assert all(picture.categories[:2] == ("wall", "floor") for picture in pictures)
    assert (WALL, FLOOR) == (0, 1)


def test_a_file_gives_back_what_was_put_into_it(pictures, tmp_path):
    save_shard(tmp_path / "one.npz", pictures)
    examples = Examples([tmp_path / "one.npz"])
    assert len(examples) == len(pictures)
    for index, picture in enumerate(pictures):
        rgb, ids, classes, distances_m, relations = examples[index]
        assert np.array_equal(rgb, picture.rgb)
        assert np.array_equal(ids, picture.ids)
        assert np.allclose(distances_m, picture.distances_m)
        names = tuple(CLASSES[k] if k != UNKNOWN else None for k in classes)
        assert names == tuple(name if name in CLASSES else None for name in picture.categories)
        assert {(s, PREDICATES[k], o) for s, k, o in relations} == set(picture.relations)
    assert not list(tmp_path.glob("*.part"))


def test_a_damaged_picture_is_refused(pictures, tmp_path):
    save_shard(tmp_path / "one.npz", pictures[:1])
    with np.load(tmp_path / "one.npz") as shard:
        arrays = dict(shard)
    arrays["rgb"][:] = 0
    np.savez(tmp_path / "two.npz", **arrays)
    with pytest.raises(ValueError, match="cannot be read"):
        Examples([tmp_path / "two.npz"])[0]


def test_files_that_are_there_are_kept(tmp_path):
    there = tmp_path / "7_00000.npz"
    there.write_bytes(b"kept")
    assert list(collect(tmp_path, pictures=SHARD_PICTURES, seed=7, jobs=1)) == [there]
    assert there.read_bytes() == b"kept"
    assert (shards(0), shards(1), shards(SHARD_PICTURES), shards(SHARD_PICTURES + 1)) == (0, 1, 1, 2)
