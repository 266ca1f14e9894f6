"""Where evaluations write: refused before anything is measured, not after hours."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from majordomo.app.evaluations.commands import evaluations

WITH_JSON = ("demo", "mapping", "noise", "localization", "resources", "rates", "tracking")
WITH_PLOT = ("mapping", "noise", "localization", "resources", "tracking")


def refusal(*arguments):
    refused = CliRunner().invoke(evaluations, arguments, env={"COLUMNS": "400", "TERM": "dumb"})
    assert refused.exit_code == 2
    return refused.output


@pytest.mark.parametrize("evaluation", WITH_JSON)
def test_a_folder_is_no_file_to_write_to(evaluation, tmp_path):
    assert "is a directory" in refusal(evaluation, "--json", str(tmp_path))


@pytest.mark.parametrize("evaluation", WITH_JSON)
def test_a_file_is_no_folder_to_write_in(evaluation, tmp_path):
    (tmp_path / "file").touch()
    assert "cannot be written" in refusal(evaluation, "--json", str(tmp_path / "file" / "out.json"))


@pytest.mark.parametrize("evaluation", WITH_PLOT)
def test_a_picture_is_a_png(evaluation, tmp_path):
    assert ".png" in refusal(evaluation, "--plot", str(tmp_path / "out.gif"))
    assert list(tmp_path.iterdir()) == []
