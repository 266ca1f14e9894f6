"""Writes the tiny networks of the tests: ``python make_networks.py`` in an environment with onnx 1.18 or newer.

Masks are colors: the subject of query 0 is where the image is red, its object where it is green, and query 1 sees
nothing. Labels are constants: a red cup on a green table. Instance queries, in one of the files, see blue as wall and
red as a cup once more. Everything else is the same network with one thing wrong.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import onnx
from onnx import TensorProto, helper, numpy_helper

FOLDER = Path(__file__).parent
STRIDE = 4
METADATA = {
    "psg.classes": json.dumps(["cup", "table", "wall"]),
    "psg.predicates": json.dumps(["on", "beside"]),
    "psg.thing_classes": json.dumps(["cup", "table"]),
    "psg.mean": json.dumps([127.5, 127.5, 127.5]),
    "psg.std": json.dumps([12.75, 12.75, 12.75]),
    "psg.resize": json.dumps({"rule": "fixed", "height": 96, "width": 128}),
    "psg.version": "1",
}
CUP, TABLE, WALL = (5, 0, 0, 0), (0, 5, 0, 0), (0, 0, 5, 0)
NOTHING = (0, 0, 0, 5)
LOGITS = {
    "sub_logits": (CUP, NOTHING),
    "obj_logits": (TABLE, NOTHING),
    "rel_logits": ((0, 5, 0), (5, 0, 0)),
    "sub_boxes": ((0.5, 0.5, 1, 1),) * 2,
    "obj_boxes": ((0.5, 0.5, 1, 1),) * 2,
}
INSTANCE_LOGITS = {"instance_logits": (WALL, CUP)}
RED, GREEN, BLUE, NEVER = (1, 0, 0), (0, 1, 0), (0, 0, 1), (-1, -1, -1)
MASKS = {"sub_masks": (RED, NEVER), "obj_masks": (GREEN, NEVER)}
INSTANCE_MASKS = {"instance_masks": (BLUE, RED)}


def network(logits, masks, *, channels=3, input_type=TensorProto.FLOAT, without=(), shapes=True, brightness_root=False):
    """A model whose masks are colors at stride 4 and whose logits are constants.

    ``brightness_root``: masks are not a number in an image darker than the mean. ``shapes``: declare output shapes.
    """
    nodes, constants, outputs = [], [], []
    image = helper.make_tensor_value_info("image", input_type, (1, channels, "H", "W"))
    nodes.append(helper.make_node("Cast", ["image"], ["floats"], to=TensorProto.FLOAT))
    nodes.append(
        helper.make_node("AveragePool", ["floats"], ["coarse"], kernel_shape=(STRIDE,) * 2, strides=(STRIDE,) * 2)
    )
    if brightness_root:
        nodes.append(helper.make_node("ReduceMean", ["floats"], ["mean"], keepdims=1))
        nodes.append(helper.make_node("Sqrt", ["mean"], ["root"]))
        nodes.append(helper.make_node("Add", ["coarse", "root"], ["input"]))
    else:
        nodes.append(helper.make_node("Identity", ["coarse"], ["input"]))
    for name, rows in masks.items():
        weights = np.array([row[:channels] for row in rows], dtype=np.float32)[:, :, None, None]
        constants.append(numpy_helper.from_array(weights, f"{name}_weights"))
        nodes.append(helper.make_node("Conv", ["input", f"{name}_weights"], [name]))
        outputs.append(declared(name, (1, len(rows), "h", "w"), shapes))
    for name, rows in logits.items():
        values = np.array(rows, dtype=np.float32)[None]
        constants.append(numpy_helper.from_array(values, f"{name}_values"))
        nodes.append(helper.make_node("Identity", [f"{name}_values"], [name]))
        outputs.append(declared(name, values.shape, shapes))
    kept = [output for output in outputs if output.name not in without]
    graph = helper.make_graph(nodes, "colors", [image], kept, constants)
    return helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=9)


def declared(name, shape, shapes):
    """An output, with or without its shape."""
    return helper.make_tensor_value_info(name, TensorProto.FLOAT, shape if shapes else None)


def write(name, model, **changes):
    """Write ``model`` with its metadata; ``changes`` replace values, underscores for dots."""
    metadata = METADATA | {key.replace("_", ".", 1): value for key, value in changes.items()}
    helper.set_model_props(model, metadata)
    onnx.save(model, FOLDER / f"{name}.onnx")


def main():
    """All files."""
    flat = {**LOGITS, "sub_logits": (CUP[:3], NOTHING[1:])}
    write("colors", network(LOGITS, MASKS))
    write("instances", network({**LOGITS, **INSTANCE_LOGITS}, {**MASKS, **INSTANCE_MASKS}))
    write("fragile", network(LOGITS, MASKS, brightness_root=True))
    write("without_boxes", network(LOGITS, MASKS, without=("sub_boxes", "obj_boxes")))
    write("half_instances", network({**LOGITS, **INSTANCE_LOGITS}, MASKS))
    write("few_classes", network(flat, MASKS))
    write("few_classes_hidden", network(flat, MASKS, shapes=False))
    write("uneven_queries", network({**LOGITS, "rel_logits": LOGITS["rel_logits"][:1]}, MASKS))
    write("flat_boxes", network({**LOGITS, "sub_boxes": (0.5, 0.5, 1, 1)}, MASKS))
    write("gray", network(LOGITS, MASKS, channels=1))
    write("bytes", network(LOGITS, MASKS, input_type=TensorProto.UINT8))


if __name__ == "__main__":
    main()
