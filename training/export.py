"""Writes a trained network as an ONNX file that keeps the contract of docs/network.md."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np
import onnx
import torch
from torch import Tensor, nn

from perception.network.contract import INPUT, INSTANCE_OUTPUTS, TRIPLET_OUTPUTS
from training.classes import CLASSES, PREDICATES, THINGS
from training.network import HEIGHT, QUERIES, TRIPLETS, WIDTH, Network

_LARGE = 1024
_HALF = "_half"
_PREFIX = "network."
MEAN, STD = (123.675, 116.28, 103.53), (58.395, 57.12, 57.375)


THRESHOLDS: Mapping[str, float] = MappingProxyType({"something": 0.5, "relation": 0.1, "known": 0.2})


class _Contract(nn.Module):
    """Image in; the best triplets and all instances out."""

    def __init__(self, network: Network) -> None:
        super().__init__()
        self.network = network

    def forward(self, image: Tensor) -> tuple[Tensor, ...]:
        features = self.network.features(image)
        found = self.network.answers(features, self.network.peaks(features))
        something = 1.0 - torch.softmax(found.classes, dim=-1)[0, :, -1]
        related = 1.0 - torch.softmax(found.relations, dim=-1)[0, :, :, 0]
        score = related * something[:, None] * something[None, :] * (1.0 - torch.eye(QUERIES))
        best = score.flatten().topk(TRIPLETS).indices
        subject, target = best // QUERIES, best % QUERIES
        return (
            found.classes[:, subject], found.classes[:, target],
            found.relations.reshape(1, QUERIES * QUERIES, -1)[:, best],
            found.boxes[:, subject], found.boxes[:, target],
            found.masks[:, subject], found.masks[:, target],
            found.classes, found.masks,
        )  # fmt: skip


def export(network: Network, file: Path, *, thresholds: Mapping[str, float] = THRESHOLDS) -> None:
    """Write ``network`` with its metadata to ``file``.

    Weights keep their names, so that ``weights_of`` finds them; runtimes fold what can be folded when they load it.
    """
    network.eval()
    names = [*TRIPLET_OUTPUTS, *INSTANCE_OUTPUTS]
    with torch.no_grad():
        torch.onnx.export(
            _Contract(network).eval(), (torch.zeros(1, 3, HEIGHT, WIDTH),), str(file), input_names=[INPUT],
            output_names=names, opset_version=17, dynamo=False, training=torch.onnx.TrainingMode.PRESERVE,
            do_constant_folding=False,
        )  # fmt: skip
    model = onnx.load(str(file))
    onnx.helper.set_model_props(
        model,
        {
            "psg.classes": json.dumps(CLASSES),
            "psg.predicates": json.dumps(PREDICATES),
            "psg.thing_classes": json.dumps(THINGS),
            "psg.mean": json.dumps(MEAN),
            "psg.std": json.dumps(STD),
            "psg.resize": json.dumps({"rule": "fixed", "height": HEIGHT, "width": WIDTH}),
            "psg.version": "1",
            "psg.thresholds": json.dumps(dict(thresholds)),
        },
    )
    _halve(model)
    onnx.checker.check_model(model)
    onnx.save(model, str(file))


def weights_of(file: Path) -> dict[str, Tensor]:
    """Weights of a file that ``export`` wrote, by their names in ``Network``, to train on from."""
    found = {}
    for weights in onnx.load(str(file)).graph.initializer:
        if weights.name.startswith(_PREFIX):
            name = weights.name.removeprefix(_PREFIX).removesuffix(_HALF)
            found[name] = torch.from_numpy(onnx.numpy_helper.to_array(weights).astype(np.float32))
    return found


def _halve(model: onnx.ModelProto) -> None:
    """Keep large weights in half precision, and widen them first thing: the file is half as large, nothing is slower.

    Runtimes fold the widening into the weights when they load the file.
    """
    widened = []
    for weights in model.graph.initializer:
        values = onnx.numpy_helper.to_array(weights)
        if values.dtype == np.float32 and values.size >= _LARGE:
            name = weights.name
            weights.CopyFrom(onnx.numpy_helper.from_array(values.astype(np.float16), f"{name}{_HALF}"))
            widened.append(onnx.helper.make_node("Cast", [f"{name}{_HALF}"], [name], to=onnx.TensorProto.FLOAT))
    nodes = [*widened, *model.graph.node]
    del model.graph.node[:]
    model.graph.node.extend(nodes)
