"""Every command and program in the guides and in the README does what it says there, typed by a reader in order."""

from __future__ import annotations

import re

import pytest
import typer

from app.commands.main import application
from guide import ROOT, Reader, blocks, lay_out, own_commands
from training.__main__ import commands as training

PROGRAMS = {"majordomo": application, "training": training}
GUIDES = sorted([ROOT / "README.md", *(ROOT / "docs").glob("*.md")])
NAMES = [guide.name for guide in GUIDES]
RUN = [guide for guide in GUIDES if any(block.is_run for block in blocks(guide))]
LONG = {"README.md", "exchange.md", "network.md", "robot.md"}
"""Those that take minutes. The README runs the demonstration, as continuous integration does besides."""
RUN_OF_EACH = [pytest.param(guide, marks=pytest.mark.long if guide.name in LONG else ()) for guide in RUN]


@pytest.mark.parametrize("guide", RUN_OF_EACH, ids=lambda guide: guide.name)
def test_what_a_guide_says_can_be_done(guide, tmp_path):
    with Reader(folder=tmp_path) as reader:
        for block in blocks(guide):
            reader.follow(block)


@pytest.mark.parametrize("guide", GUIDES, ids=lambda guide: guide.name)
def test_every_command_in_a_guide_has_these_arguments_and_options(guide, tmp_path, monkeypatch):
    """Those too that take hours, which nobody types here."""
    lay_out(tmp_path)
    monkeypatch.chdir(tmp_path)
    for block in blocks(guide):
        if block.marker == "file":
            (tmp_path / block.about).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / block.about).write_text(block.text, encoding="utf-8")
    for block in blocks(guide):
        for program, arguments in own_commands(block):
            _parse(arguments, PROGRAMS[program])


def test_a_command_with_an_option_that_does_not_exist_would_be_noticed():
    with pytest.raises(Exception, match="No such option"):
        _parse(["serve", "--no-such-option"])
    with pytest.raises(Exception, match="No such command"):
        _parse(["evaluate", "nothing"])


@pytest.mark.parametrize("guide", GUIDES, ids=lambda guide: guide.name)
def test_links_of_a_guide_lead_somewhere(guide):
    for target in re.findall(r"\]\(([^)#\s]+)", guide.read_text(encoding="utf-8")):
        if "://" not in target:
            assert (guide.parent / target).exists(), f"{guide.name} links to {target}"


def _parse(arguments, program=application):
    """Let the command line read arguments, and do nothing."""
    command, rest = typer.main.get_command(program), list(arguments)
    while isinstance(command, typer.core.TyperGroup):
        with command.make_context("majordomo", rest[:1]) as context:
            command = command.resolve_command(context, rest[:1])[1]
        rest = rest[1:]
    with command.make_context(command.name, rest):
        pass
