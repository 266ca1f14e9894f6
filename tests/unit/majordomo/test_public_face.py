"""The public face: nobody else's package takes our names, others import nothing but ``majordomo``, and it is told."""

from __future__ import annotations

import ast
import re
from importlib.metadata import distributions, packages_distributions

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import majordomo
from paths import ROOT

OURS = frozenset(
    [
        "app",
        "client",
        "drivers",
        "evaluations",
        "majordomo",
        "perception",
        "planner",
        "prompts",
        "scene_graph",
        "simulation",
        "skills",
        "training",
    ]
)
BLOCK = re.compile(r"^```python\n(.*?)^```", re.MULTILINE | re.DOTALL)
FOR_OTHERS = sorted((*ROOT.glob("docs/*.md"), *ROOT.glob("examples/**/*.py"), *ROOT.glob("tests/packages/**/*.py")))


def constraints():
    text = (ROOT / "constraints.txt").read_text(encoding="utf-8").replace("\\\n", " ")
    lines = (re.sub(r"--hash=\S+|#.*", "", line).strip() for line in text.splitlines())
    return [Requirement(line) for line in lines if line]


def imported(source):
    """Top-level names of everything that a program imports."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            yield from (alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module:
            yield node.module.partition(".")[0]


def programs(file):
    text = file.read_text(encoding="utf-8")
    return BLOCK.findall(text) if file.suffix == ".md" else [text]


def test_our_packages_are_those_at_the_top_of_the_repository():
    assert {file.parent.name for file in ROOT.glob("*/__init__.py")} == OURS


def test_what_the_constraints_name_is_installed_and_no_package_of_others_takes_a_name_of_ours():
    there = {canonicalize_name(each.metadata["Name"]): each.version for each in distributions()}
    wanted = [each for each in constraints() if each.marker is None or each.marker.evaluate()]
    missing = [
        str(each) for each in wanted if not each.specifier.contains(there.get(canonicalize_name(each.name), "0"))
    ]
    assert len(wanted) > 50
    assert not missing
    takers = {name: set(packages_distributions().get(name, ())) - {"majordomo"} for name in OURS}
    assert not {name: by for name, by in takers.items() if by}


@pytest.mark.parametrize("file", FOR_OTHERS, ids=lambda file: file.relative_to(ROOT).as_posix())
def test_what_others_read_and_copy_imports_nothing_of_ours_but_the_public_face(file):
    names = {name for program in programs(file) for name in imported(program)}
    assert names & OURS <= {"majordomo"}


def test_the_list_of_public_names_is_sorted_and_complete():
    public = [name for name in majordomo.__all__ if name != "__version__"]
    kinds = [0 if name.isupper() else 1 if name[0].isupper() else 2 for name in public]
    assert public == [name for _, name in sorted(zip(kinds, public, strict=True))]
    assert {name for name in vars(majordomo) if not name.startswith("_")} == set(public)


@pytest.mark.parametrize("name", [name for name in majordomo.__all__ if name != "__version__"])
def test_every_public_name_says_what_it_is(name):
    told = vars(majordomo)[name].__doc__
    assert told
    assert not told.startswith(f"{name}("), "what dataclasses write themselves says nothing"
