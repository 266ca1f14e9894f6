"""Writes a network of PSGTR's real dimensions with random weights, to see that such a file loads and what it costs.

    python scripts/write_psgtr_sized_network.py out/psgtr_sized.onnx      # about 180 MB; needs onnx and numpy
    majordomo doctor --model out/psgtr_sized.onnx

ResNet-50 backbone, six encoder and six decoder layers of width 256 with eight heads, 100 triplet queries, 133 classes,
56 predicates, masks at stride 4 (Yang et al. 2022; OpenPSG, configs/psgtr/psgtr_r50.py). Simplified where neither
shapes nor the contract are concerned: batch normalization is folded into the convolutions, as in any export, there is
no positional encoding, and a mask is the product of a query's embedding with a feature map, not a convolutional head.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

WIDTH, HEADS, HIDDEN, LAYERS, QUERIES = 256, 8, 2048, 6, 100
STAGES = ((64, 3, 1), (128, 4, 2), (256, 6, 2), (512, 3, 2))
"""Width of the bottleneck, number of blocks, and stride of each stage of ResNet-50."""
NAMES = json.loads((Path(__file__).parent / "openpsg_names.json").read_text())


class Graph:
    """An ONNX graph that grows a node at a time; every method returns the name of what it computes."""

    def __init__(self, seed: int) -> None:
        self.nodes: list[onnx.NodeProto] = []
        self.weights: list[onnx.TensorProto] = []
        self._random = np.random.default_rng(seed)

    def node(self, kind: str, *inputs: str, **attributes: object) -> str:
        """Any operator."""
        name = f"{kind.lower()}_{len(self.nodes)}"
        self.nodes.append(helper.make_node(kind, list(inputs), [name], **attributes))
        return name

    def weight(self, *shape: int, fan_in: int) -> str:
        """Random weights that keep the variance of what goes through them (He et al. 2015)."""
        values = self._random.standard_normal(shape, dtype=np.float32) * np.float32(np.sqrt(2.0 / fan_in))
        return self.constant(values)

    def constant(self, values: np.ndarray) -> str:
        """An array."""
        name = f"weight_{len(self.weights)}"
        self.weights.append(numpy_helper.from_array(values, name))
        return name

    def convolution(self, x: str, before: int, after: int, size: int = 1, stride: int = 1, gain: float = 1.0) -> str:
        """A convolution with bias; ``gain`` scales its variance."""
        weights = self.weight(after, before, size, size, fan_in=max(1, int(before * size * size / gain)))
        bias = self.constant(np.zeros(after, dtype=np.float32))
        pads = [size // 2] * 4
        return self.node("Conv", x, weights, bias, kernel_shape=[size] * 2, strides=[stride] * 2, pads=pads)

    def linear(self, x: str, before: int, after: int) -> str:
        """A linear layer over the last axis."""
        bias = self.constant(np.zeros(after, dtype=np.float32))
        return self.node("Add", self.node("MatMul", x, self.weight(before, after, fan_in=2 * before)), bias)

    def normalized(self, x: str) -> str:
        """Layer normalization over the last axis."""
        scale, bias = (self.constant(np.full(WIDTH, value, dtype=np.float32)) for value in (1.0, 0.0))
        return self.node("LayerNormalization", x, scale, bias, axis=-1)

    def shaped(self, x: str, *shape: int) -> str:
        """Reshape; 0 keeps a size and -1 takes the rest."""
        return self.node("Reshape", x, self.constant(np.array(shape, dtype=np.int64)))


def backbone(graph: Graph, image: str) -> list[str]:
    """The four stages of ResNet-50, at strides 4 to 32."""
    x = graph.node("Relu", graph.convolution(image, 3, 64, size=7, stride=2))
    x = graph.node("MaxPool", x, kernel_shape=[3, 3], strides=[2, 2], pads=[1] * 4)
    stages, channels = [], 64
    for width, blocks, stride in STAGES:
        for block in range(blocks):
            x = bottleneck(graph, x, channels, width, stride if block == 0 else 1)
            channels = 4 * width
        stages.append(x)
    return stages


def bottleneck(graph: Graph, x: str, channels: int, width: int, stride: int) -> str:
    """One residual block; its last convolution starts small, so that the variance stays bounded."""
    inner = graph.node("Relu", graph.convolution(x, channels, width))
    inner = graph.node("Relu", graph.convolution(inner, width, width, size=3, stride=stride))
    inner = graph.convolution(inner, width, 4 * width, gain=0.05)
    aside = x if channels == 4 * width else graph.convolution(x, channels, 4 * width, stride=stride, gain=0.5)
    return graph.node("Relu", graph.node("Add", inner, aside))


def attention(graph: Graph, queries: str, memory: str) -> str:
    """Multi-head attention with residual and normalization; (1, N, 256) each."""
    to_heads = [0, -1, HEADS, WIDTH // HEADS]
    q, k, v = (graph.shaped(graph.linear(x, WIDTH, WIDTH), *to_heads) for x in (queries, memory, memory))
    q, v = (graph.node("Transpose", x, perm=[0, 2, 1, 3]) for x in (q, v))
    k = graph.node("Transpose", k, perm=[0, 2, 3, 1])
    scale = graph.constant(np.float32(1.0 / np.sqrt(WIDTH // HEADS)).reshape(1))
    weights = graph.node("Softmax", graph.node("Mul", graph.node("MatMul", q, k), scale), axis=-1)
    mixed = graph.node("Transpose", graph.node("MatMul", weights, v), perm=[0, 2, 1, 3])
    mixed = graph.linear(graph.shaped(mixed, 0, -1, WIDTH), WIDTH, WIDTH)
    return graph.normalized(graph.node("Add", queries, mixed))


def feed_forward(graph: Graph, x: str) -> str:
    """Two linear layers with residual and normalization."""
    inner = graph.linear(graph.node("Relu", graph.linear(x, WIDTH, HIDDEN)), HIDDEN, WIDTH)
    return graph.normalized(graph.node("Add", x, inner))


def transformer(graph: Graph, features: str) -> str:
    """(1, 100, 256) queries after encoder and decoder over the coarsest features."""
    tokens = graph.shaped(graph.convolution(features, 2048, WIDTH), 0, WIDTH, -1)
    memory = graph.normalized(graph.node("Transpose", tokens, perm=[0, 2, 1]))
    for _ in range(LAYERS):
        memory = feed_forward(graph, attention(graph, memory, memory))
    queries = graph.weight(1, QUERIES, WIDTH, fan_in=2)
    for _ in range(LAYERS):
        queries = attention(graph, queries, queries)
        queries = feed_forward(graph, attention(graph, queries, memory))
    return queries


def heads(graph: Graph, queries: str, finest: str) -> dict[str, tuple[str, tuple[int | str, ...]]]:
    """Output name -> (what computes it, its shape)."""
    classes, predicates = len(NAMES["things"]) + len(NAMES["stuff"]), len(NAMES["predicates"])
    pixels = graph.convolution(finest, 256, WIDTH, gain=0.1)
    outputs: dict[str, tuple[str, tuple[int | str, ...]]] = {
        "rel_logits": (graph.linear(queries, WIDTH, predicates + 1), (1, QUERIES, predicates + 1))
    }
    for role in ("sub", "obj"):
        outputs[f"{role}_logits"] = (graph.linear(queries, WIDTH, classes + 1), (1, QUERIES, classes + 1))
        box = graph.node("Sigmoid", graph.linear(graph.node("Relu", graph.linear(queries, WIDTH, WIDTH)), WIDTH, 4))
        outputs[f"{role}_boxes"] = (box, (1, QUERIES, 4))
        embedding = graph.linear(queries, WIDTH, WIDTH)
        outputs[f"{role}_masks"] = (masks(graph, embedding, pixels), (1, QUERIES, "h", "w"))
    return outputs


def masks(graph: Graph, embedding: str, pixels: str) -> str:
    """(1, 100, h, w) products of (1, 100, 256) embeddings with a (1, 256, h, w) feature map."""
    flat = graph.node("MatMul", embedding, graph.shaped(pixels, 0, WIDTH, -1))
    size = graph.node("Slice", graph.node("Shape", pixels), *(graph.constant(np.array([i])) for i in (2, 4)))
    shape = graph.node("Concat", graph.constant(np.array([1, QUERIES])), size, axis=0)
    return graph.node("Reshape", flat, shape)


def metadata() -> dict[str, str]:
    """What OpenPSG's test pipeline says, in the words of the contract."""
    return {
        "psg.classes": json.dumps(NAMES["things"] + NAMES["stuff"]),
        "psg.predicates": json.dumps(NAMES["predicates"]),
        "psg.thing_classes": json.dumps(NAMES["things"]),
        "psg.mean": json.dumps([123.675, 116.28, 103.53]),
        "psg.std": json.dumps([58.395, 57.12, 57.375]),
        "psg.resize": json.dumps({"rule": "shorter_side", "size": 800, "longest": 1333}),
        "psg.version": "1",
        "psg.thresholds": json.dumps({"mask": 0.85, "relation": 0.4}),
    }


def network(seed: int) -> onnx.ModelProto:
    """The whole file."""
    graph = Graph(seed)
    image = helper.make_tensor_value_info("image", TensorProto.FLOAT, (1, 3, "H", "W"))
    stages = backbone(graph, "image")
    outputs = heads(graph, transformer(graph, stages[-1]), stages[0])
    for name, (computed, _) in outputs.items():
        graph.nodes.append(helper.make_node("Identity", [computed], [name]))
    declared = [helper.make_tensor_value_info(n, TensorProto.FLOAT, shape) for n, (_, shape) in outputs.items()]
    body = helper.make_graph(graph.nodes, "psgtr_sized", [image], declared, graph.weights)
    model = helper.make_model(body, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)
    helper.set_model_props(model, metadata())
    return model


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    arguments.file.parent.mkdir(parents=True, exist_ok=True)
    onnx.save(network(arguments.seed), arguments.file)


if __name__ == "__main__":
    main()
