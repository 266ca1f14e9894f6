"""The network learns, and its file keeps the contract. For where PyTorch and onnx are: ``pip install '.[train]'``."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("torch")
pytest.importorskip("onnx")

import torch

from perception.network.model import OnnxPanopticModel
from training.classes import CLASSES, STUFF
from training.dataset import MOST, Lessons, batch_of
from training.export import export, weights_of
from training.fit import Course, fit, trained
from training.losses import assigned, losses
from training.muon import orthogonal
from training.network import HEIGHT, PEAKS, QUERIES, WIDTH, Network
from training.rooms.photographs import photographs
from training.shards import Examples, save_shard

pytestmark = pytest.mark.filterwarnings("ignore")
"""PyTorch's exporter warns of its own parts."""


@pytest.fixture(scope="module", autouse=True)
def one_thread():
    """Threads that wait for each other cost more than they give beside other work."""
    torch.set_num_threads(1)


@pytest.fixture(scope="module")
def shard(tmp_path_factory):
    file = tmp_path_factory.mktemp("shards") / "one.npz"
    rng = np.random.default_rng(5)
    save_shard(file, [picture for _ in range(4) for picture in photographs(rng)])
    return file


def test_answers_are_of_the_stated_shapes():
    network = Network().eval()
    with torch.no_grad():
        features = network.features(torch.zeros(2, 3, HEIGHT, WIDTH))
        found = network.answers(features, network.peaks(features))
    assert found.classes.shape == (2, QUERIES, len(CLASSES) + 1)
    assert found.masks.shape == (2, QUERIES, HEIGHT // 4, WIDTH // 4)
    assert found.relations.shape[:3] == (2, QUERIES, QUERIES)


def test_every_thing_is_answered_for_once(shard):
    batch = batch_of([Lessons(Examples([shard]), vary=False)[k] for k in range(6)])
    network = Network().eval()
    with torch.no_grad():
        cells, row_of = assigned(network.peaks(network.features(batch.image)), batch)
    assert [cell.shape[1] for cell in cells] == list(PEAKS)
    for b in range(6):
        rows = row_of[b][row_of[b] >= 0].tolist()
        assert len(rows) == len(set(rows))
        things = int(batch.there[b, len(STUFF) :].sum())
        assert sum(row >= len(STUFF) for row in rows) >= min(things, 5)


def test_a_few_steps_make_the_losses_smaller(shard):
    torch.manual_seed(0)
    batch = batch_of([Lessons(Examples([shard]), vary=False)[k] for k in range(6)])
    network = Network()
    optimizer = torch.optim.AdamW(network.parameters(), lr=1e-3)
    totals = []
    for _ in range(12):
        total = torch.stack([part.float() for part in losses(network, batch).values()]).sum()
        optimizer.zero_grad()
        total.backward()
        optimizer.step()
        totals.append(float(total.detach()))
    assert np.isfinite(totals).all()
    assert totals[-1] < 0.8 * totals[0]


def test_training_leaves_a_checkpoint_from_which_a_file_is_written_that_the_product_reads(shard, tmp_path):
    checkpoint = tmp_path / "checkpoint.pt"
    fit(lambda: [shard], checkpoint=checkpoint, course=Course(steps=2, batch=4, workers=0), tell=lambda line: None)
    export(trained(checkpoint), tmp_path / "network.onnx")
    model = OnnxPanopticModel.load(tmp_path / "network.onnx")
    assert model.description.classes == CLASSES
    assert (tmp_path / "network.onnx").stat().st_size < 12e6


def test_a_new_course_begins_where_an_exported_network_ended(shard, tmp_path):
    course = Course(steps=3, batch=4, workers=0)
    first = fit(lambda: [shard], checkpoint=tmp_path / "first.pt", course=course, tell=lambda line: None)
    export(first, tmp_path / "first.onnx")
    kept = weights_of(tmp_path / "first.onnx")
    told_by_hand = {"hints.0.weight", "hints.0.bias", "hints.1.weight", "hints.1.bias"}
    trained_names = {name for name, _ in first.named_parameters()} - told_by_hand
    moved = {name for name in trained_names if float(first.state_dict()[name].std(correction=0)) > 0.0}
    assert moved <= kept.keys()
    for name in moved:
        assert torch.allclose(kept[name], first.state_dict()[name], atol=2e-3), name
    still = Course(steps=1, batch=4, workers=0, rate=0.0)
    begun = fit(
        lambda: [shard],
        checkpoint=tmp_path / "second.pt",
        course=still,
        tell=lambda line: None,
        begin=tmp_path / "first.onnx",
    )
    assert torch.allclose(begun.kind[0].weight, first.kind[0].weight, atol=2e-3)


def test_steps_are_orthogonal_whatever_the_gradients_shape():
    generator = torch.Generator().manual_seed(0)
    for shape in ((2, 16, 40), (1, 40, 16), (3, 8, 8)):
        found = orthogonal(torch.randn(shape, generator=generator), rounds=5).float()
        singular = torch.linalg.svdvals(found)
        assert float(singular.min()) > 0.4
        assert float(singular.max()) < 1.4


def test_a_mosaic_shows_parts_of_four_pictures_with_all_that_is_true_of_them(shard):
    lessons = Lessons(Examples([shard]), vary=True, mosaics=1.0)
    rows = [lessons[k] for k in range(6)]
    plain = [Lessons(Examples([shard]), vary=True)[k] for k in range(6)]
    assert sum(row["there"][len(STUFF) :].sum() for row in rows) > sum(row["there"][2:].sum() for row in plain)
    for row in rows:
        shown = np.unique(row["ids"])
        assert set(shown[shown != 255]) <= set(range(len(STUFF) + MOST))
        for number in np.nonzero(row["there"])[0][len(STUFF) :]:
            ys, xs = np.nonzero(row["ids"] == number)
            x, y, w, h = row["boxes"][number]
            assert (xs.min(), xs.max() + 1) == (x - w / 2, x + w / 2)
            assert (ys.min(), ys.max() + 1) == (y - h / 2, y + h / 2)
        subjects, objects = np.nonzero(row["relations"])
        assert row["there"][subjects].all() or not len(subjects)
        assert row["there"][objects].all() or not len(objects)
    batch_of(rows)
