"""Where evaluations write: refused before anything is measured, not after hours."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

from app.errors import LineError
from evaluations.commands import evaluations
from perception.network.errors import NetworkRefused
from simulation.errors import HouseError

WITH_JSON = (
    *("demo", "mapping", "noise", "localization", "resources", "rates", "tracking"),
    *("perception", "changes", "planning"),
)
WITH_PLOT = ("mapping", "noise", "localization", "resources", "tracking", "perception", "changes")


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


WITH_MODEL = ("perception", "changes")


@pytest.mark.parametrize("evaluation", [*WITH_MODEL, "rates", "network"])
def test_a_network_that_is_not_there_is_refused_by_name(evaluation, tmp_path):
    missing = tmp_path / "none.onnx"
    refused = CliRunner().invoke(evaluations, [evaluation, "--model", str(missing)])
    assert isinstance(refused.exception, NetworkRefused)
    assert f"'{missing}': there is no such file" in str(refused.exception)


@pytest.mark.parametrize("evaluation", WITH_MODEL)
def test_at_least_one_house_is_looked_at(evaluation):
    assert "there is no house to look at" in refusal(evaluation, "--houses", "0")


@pytest.mark.parametrize("evaluation", WITH_MODEL)
def test_what_is_no_house_and_what_is_no_network_is_said_before_anything_is_measured(evaluation, tmp_path):
    file = tmp_path / "file"
    file.write_text("nothing of the kind", encoding="utf-8")
    no_house = CliRunner().invoke(evaluations, [evaluation, "--house", str(file)])
    assert isinstance(no_house.exception, HouseError)
    no_network = CliRunner().invoke(evaluations, [evaluation, "--house", "flat", "--model", str(file)])
    assert isinstance(no_network.exception, NetworkRefused)


def test_requests_that_cannot_be_read_are_named_by_line_and_field(tmp_path):
    (tmp_path / "mine.txt").write_text("@studio\n== go\ngo\n> robot -> attic\n", encoding="utf-8")
    refused = CliRunner().invoke(evaluations, ["planning", "--commands", str(tmp_path / "mine.txt")])
    assert isinstance(refused.exception, LineError)
    assert "mine, line 4, attic" in str(refused.exception)


def test_a_share_of_slips_is_at_most_all():
    assert "less than or equal to 1" in refusal("planning", "--corrupt", "1.5")
