"""The model card takes its figures from what was measured."""

from __future__ import annotations

import json

import pytest

from training.model_card import BEGIN, END, CardError, write

REPORT = {
    "pictures": 8, "recall": 0.5, "precision": 0.75, "least_class": None, "mask_iou": 0.9,
    "relation_recall_at_20": 0.25, "relation_mean_recall_at_20": None, "support_recall_at_20": 0.125,
    "classes": {"cup": {"there": 3, "recall": 0.6, "found_under_any_name": 0.7, "precision": None, "mask_iou": 0.8}},
    "recall_by_pixels": {"30": 0.1, "200": 0.5}, "relation_recall_by_predicate": {"on": 0.3},
    "confusions": [["cup", "mug", 2]], "model": {"threads": 2, "median_ms": 9.04, "megabytes": 7.5},
}  # fmt: skip


@pytest.fixture
def report(tmp_path):
    file = tmp_path / "report.json"
    file.write_text(json.dumps(REPORT), encoding="utf-8")
    return file


def test_figures_replace_those_between_the_marks_and_nothing_else(report, tmp_path):
    card = tmp_path / "card.md"
    card.write_text(f"# Card\n{BEGIN}old\n{END}below\n", encoding="utf-8")
    write(card, report)
    text = card.read_text(encoding="utf-8")
    assert text.startswith("# Card\n")
    assert text.endswith("below\n")
    assert "old" not in text
    assert "| recall | 0.500 | ≥ 0.90 |" in text
    assert "| cup | 3 | 0.60 | 0.70 | – | 0.80 |" in text
    assert "cup as mug (2)" in text
    again = text
    write(card, report)
    assert card.read_text(encoding="utf-8") == again


def test_a_card_without_marks_is_left_as_it_is(report, tmp_path):
    card = tmp_path / "card.md"
    card.write_text("# Card\n", encoding="utf-8")
    with pytest.raises(CardError, match="has no lines"):
        write(card, report)
    assert card.read_text(encoding="utf-8") == "# Card\n"
