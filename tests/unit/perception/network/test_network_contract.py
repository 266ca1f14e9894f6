"""A file that does not keep the contract is refused with one sentence that names what is wrong."""

from __future__ import annotations

import json

import pytest

from paths import DATA, ROOT
from perception.network.errors import (
    MetadataInvalid,
    MetadataMissing,
    NetworkRefused,
    NetworkUnreadable,
    TensorMismatch,
    TensorMissing,
)
from perception.network.metadata import REQUIRED, read_metadata
from perception.network.model import OnnxPanopticModel
from unit.perception.onnx_metadata import metadata_of, with_metadata

NETWORKS = DATA / "network"
COLORS = (NETWORKS / "colors.onnx").read_bytes()
METADATA = metadata_of(COLORS)


def changed(tmp_path, **changes):
    """The colors network with other metadata; None takes a key away."""
    metadata = METADATA | {key.replace("_", ".", 1): value for key, value in changes.items()}
    path = tmp_path / "changed.onnx"
    path.write_bytes(with_metadata(COLORS, {key: value for key, value in metadata.items() if value is not None}))
    return path


def refusal(path, error=NetworkRefused):
    with pytest.raises(error) as caught:
        OnnxPanopticModel.load(path)
    sentence = str(caught.value)
    assert str(path) in sentence
    assert "\n" not in sentence
    return sentence


def test_a_file_that_keeps_the_contract_loads_and_describes_itself():
    description = OnnxPanopticModel.load(NETWORKS / "colors.onnx").description
    assert description.classes == ("cup", "table", "wall")
    assert description.predicates == ("on", "beside")
    assert description.is_thing.tolist() == [True, True, False]
    assert description.version == "1"


@pytest.mark.parametrize("key", REQUIRED)
def test_each_missing_metadata_key_is_named(tmp_path, key):
    sentence = refusal(changed(tmp_path, **{key.replace(".", "_", 1): None}), MetadataMissing)
    assert f"'{key}' is missing" in sentence
    assert all(other in sentence for other in REQUIRED)


def test_a_file_without_any_metadata_names_all_keys(tmp_path):
    path = tmp_path / "bare.onnx"
    path.write_bytes(with_metadata(COLORS, {}))
    assert all(f"'{key}'" in refusal(path, MetadataMissing) for key in REQUIRED)


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"psg_classes": "[1, 2]"}, "psg.classes"),
        ({"psg_classes": "[]"}, "at least one"),
        ({"psg_classes": '["cup", "cup", "wall"]'}, "'cup' twice"),
        ({"psg_classes": '["cup", "table"'}, "not JSON"),
        ({"psg_thing_classes": '["sofa"]'}, "'sofa'"),
        ({"psg_mean": "[1, 2]"}, "three numbers"),
        ({"psg_mean": '["a", 1, 2]'}, "psg.mean"),
        ({"psg_std": "[1, 0, 1]"}, "positive"),
        ({"psg_resize": '{"rule": "stretch"}'}, "psg.resize"),
        ({"psg_resize": '{"rule": "fixed", "height": 96}'}, "width"),
        ({"psg_resize": '{"rule": "fixed", "height": 96, "width": -1}'}, "width"),
        ({"psg_resize": "96x128"}, "psg.resize"),
        ({"psg_version": "latest"}, "psg.version"),
        ({"psg_version": "2"}, "up to version 1"),
        ({"psg_thresholds": '{"masks": 0.5}'}, "masks"),
        ({"psg_thresholds": '{"mask": 1.5}'}, "mask"),
    ],
)
def test_each_unreadable_value_is_named(tmp_path, change, named):
    assert named in refusal(changed(tmp_path, **change), MetadataInvalid)


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.9, 0.99])
def test_a_truncated_file_is_refused(tmp_path, share):
    path = tmp_path / "short.onnx"
    path.write_bytes(COLORS[: int(share * len(COLORS))])
    refusal(path)


def test_every_cut_of_a_file_is_refused_and_never_crashes(tmp_path):
    path = tmp_path / "short.onnx"
    for length in range(0, len(COLORS) - 1, 37):
        path.write_bytes(COLORS[:length])
        refusal(path)


def test_a_missing_file_and_a_folder_are_told_apart_from_a_bad_one(tmp_path):
    assert "no such file" in refusal(tmp_path / "nowhere.onnx", NetworkUnreadable)
    assert "no such file" in refusal(tmp_path, NetworkUnreadable)
    path = tmp_path / "text.onnx"
    path.write_text("this is no network")
    assert "no ONNX model" in refusal(path, NetworkUnreadable)


@pytest.mark.parametrize(
    ("name", "error", "named"),
    [
        ("without_boxes", TensorMissing, "'sub_boxes', 'obj_boxes' are missing"),
        ("half_instances", TensorMissing, "'instance_masks' is missing"),
        ("few_classes", TensorMismatch, "'sub_logits' should be (1, 2, 4) and is (1, 2, 3)"),
        ("few_classes_hidden", TensorMismatch, "'sub_logits' should be (1, 2, 4) and is (1, 2, 3)"),
        ("uneven_queries", TensorMismatch, "'rel_logits' should be (1, 2, 3) and is (1, 1, 3)"),
        ("flat_boxes", TensorMismatch, "'sub_boxes' should be of rank 3"),
        ("gray", TensorMismatch, "'image' should be (1, 3, H, W) and is (?, 1, H, W)"),
        ("bytes", TensorMismatch, "'image' should be float32"),
    ],
)
def test_each_wrong_output_or_input_is_named_with_its_shape(name, error, named):
    assert named.replace("?", "1") in refusal(NETWORKS / f"{name}.onnx", error)


def test_class_and_predicate_counts_are_checked_against_the_metadata(tmp_path):
    assert "sub_logits" in refusal(changed(tmp_path, psg_classes='["cup", "table", "wall", "floor"]'), TensorMismatch)
    assert "rel_logits" in refusal(changed(tmp_path, psg_predicates='["on"]'), TensorMismatch)


def test_colors_of_0_to_1_and_of_0_to_255_mean_the_same():
    small = read_metadata("a", METADATA | {"psg.mean": "[0.485, 0.456, 0.406]", "psg.std": "[0.229, 0.224, 0.225]"})
    large = read_metadata(
        "b", METADATA | {"psg.mean": "[123.675, 116.28, 103.53]", "psg.std": "[58.395, 57.12, 57.375]"}
    )
    assert small.mean == pytest.approx(large.mean, rel=1e-4)
    assert small.std == pytest.approx(large.std, rel=1e-4)


def test_names_with_commas_between_them_are_read_as_well():
    plain = read_metadata("a", METADATA | {"psg.classes": "cup, dining table,wall", "psg.thing_classes": "cup"})
    assert plain.classes == ("cup", "dining table", "wall")
    assert plain.is_thing.tolist() == [True, False, False]


def test_thresholds_of_the_file_replace_the_defaults():
    thresholds = read_metadata("a", METADATA | {"psg.thresholds": json.dumps({"mask": 0.85})}).thresholds
    assert (thresholds.mask, thresholds.same_iou) == (0.85, 0.5)


def test_the_names_of_openpsg_are_133_classes_and_56_predicates():
    names = json.loads((ROOT / "scripts" / "openpsg_names.json").read_text())
    classes = names["things"] + names["stuff"]
    assert (len(names["things"]), len(set(classes)), len(set(names["predicates"]))) == (80, 133, 56)
    assert (classes[39], classes[-1], names["predicates"][3]) == ("bottle", "rug-merged", "on")
