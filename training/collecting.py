"""Renders the pictures to learn from, in parallel processes, and goes on where it was interrupted."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from itertools import islice
from pathlib import Path

import numpy as np

from simulation.generation.stocking import stocked_house
from simulation.pictures.photographer import photographer
from simulation.pictures.photographs import Photograph
from training.rooms.photographs import photographs
from training.shards import save_shard

SHARD_PICTURES = 300
PICTURES_PER_HOUSE = 24
_HOUSE_SEEDS = 1 << 30


def collect(folder: Path, *, pictures: int, seed: int, jobs: int, houses: bool = False) -> Iterator[Path]:
    """Pictures of random rooms, or of generated houses as the simulator shows them.

    Yields files of ``SHARD_PICTURES`` pictures in ``folder``, each as it gets ready; those that are there are kept.
    """
    folder.mkdir(parents=True, exist_ok=True)
    files = [(folder / f"{seed}_{number:05}.npz", (seed, number)) for number in range(shards(pictures))]
    missing = [(file, of) for file, of in files if not file.exists()]
    yield from (file for file, _ in files if file.exists())
    with ProcessPoolExecutor(jobs) as pool:
        for file, done in [(file, pool.submit(_shard, file, of, houses)) for file, of in missing]:
            done.result()
            yield file


def shards(pictures: int) -> int:
    """How many files hold so many pictures."""
    return -(-pictures // SHARD_PICTURES)


def _shard(file: Path, seed: tuple[int, int], houses: bool) -> None:
    source = _of_houses if houses else _of_rooms
    save_shard(file, list(islice(source(np.random.default_rng(seed)), SHARD_PICTURES)))


def _of_rooms(rng: np.random.Generator) -> Iterator[Photograph]:
    while True:
        yield from photographs(rng)


def _of_houses(rng: np.random.Generator) -> Iterator[Photograph]:
    """Seeds of these houses are large, so that houses of everyday seeds stay unseen."""
    while True:
        seed = _HOUSE_SEEDS + int(rng.integers(_HOUSE_SEEDS))
        with photographer(stocked_house(seed=seed), seed=seed) as camera:
            yield from (picture for picture in camera.pictures(PICTURES_PER_HOUSE) if picture.relations)
