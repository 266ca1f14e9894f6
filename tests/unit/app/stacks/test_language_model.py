"""Where the language model's key comes from."""

from __future__ import annotations

import pytest

from app.stacks.language_model import key_in


def test_a_key_stands_in_the_environment_or_in_a_file_that_it_names(tmp_path):
    (tmp_path / "key").write_text("from-a-file\n")
    file = {"MAJORDOMO_LLM_KEY_FILE": str(tmp_path / "key")}
    assert key_in({}) is None
    assert key_in(file) == "from-a-file"
    assert key_in({"MAJORDOMO_LLM_KEY": "told", **file}) == "told"


def test_a_file_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(OSError, match="nowhere"):
        key_in({"MAJORDOMO_LLM_KEY_FILE": str(tmp_path / "nowhere")})
