"""What the doctor finds, and what it says to do about it."""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import os
import socket
import sqlite3
import subprocess
import sys
import threading

import httpx
import pytest
from rich.console import Console

from app.doctor import files, machine
from app.doctor.examination import within
from app.doctor.finding import Finding, Health, document, healthy, tell
from app.journal.tasks import TaskJournal
from perception.network.shipped import SHA256, SHIPPED

KEY = "key-0123456789abcdef"


def listening(port=0):
    listener = socket.socket()
    listener.bind(("127.0.0.1", port))
    listener.listen()
    return contextlib.closing(listener)


def server(handler):
    return httpx.Client(transport=httpx.MockTransport(handler))


def unreachable(request):
    raise httpx.ConnectError("nobody there", request=request)


def test_a_finding_that_is_not_well_comes_with_advice_and_markup_stays_text():
    found = [
        Finding(name="disk", text="[red]fine[/]"),
        Finding(name="port", health=Health.BAD, text="taken", advice="x"),
    ]
    console = Console(file=io.StringIO(), width=100)
    tell(found, console)
    lines = console.file.getvalue().splitlines()
    assert lines[0] == "ok   disk       [red]fine[/]"
    assert lines[1].startswith("BAD  port       taken")
    assert lines[2].strip() == "→ x"
    assert not healthy(found)
    assert json.loads(json.dumps(document(found)))["findings"][1]["health"] == "bad"


def test_a_check_that_takes_too_long_is_told_and_the_others_are_made():
    hanging = threading.Event()
    [slow] = within(0.05, "disk", hanging.wait)
    hanging.set()
    assert (slow.health, slow.name) == (Health.ODD, "disk")
    assert "not done after" in slow.text
    assert within(5.0, "python", machine.python) == [machine.python()]


def test_what_goes_wrong_within_a_check_is_not_swallowed():
    with pytest.raises(ZeroDivisionError):
        within(5.0, "disk", lambda: 1 / 0)


@pytest.mark.slow
@pytest.mark.parametrize("library", ["gtsam", "cv2", "onnxruntime", "igraph"])
def test_a_library_that_does_not_load_is_named_instead_of_breaking_the_doctor_itself(tmp_path, library):
    (tmp_path / f"{library}.py").write_text('raise ImportError("broken on purpose")')
    paths = os.pathsep.join([str(tmp_path), *filter(None, sys.path)])
    outcome = subprocess.run(
        [sys.executable, "-m", "app", "doctor", "--json", "--port", "0", "--data", str(tmp_path)],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert outcome.returncode == 1, outcome.stderr
    [found] = [one for one in json.loads(outcome.stdout)["findings"] if one["name"] == "libraries"]
    assert found["text"] == f"{library} cannot be imported (broken on purpose)"


@pytest.mark.parametrize(
    ("version", "health"),
    [
        ("3.11.0", Health.WELL),
        ("3.13.4", Health.WELL),
        ("3.10.9", Health.BAD),
        ("3.14.0", Health.BAD),
        ("3.1.1", Health.BAD),
    ],
)
def test_a_python_for_which_not_every_library_has_wheels_is_told(monkeypatch, version, health):
    monkeypatch.setattr(machine.platform, "python_version", lambda: version)
    found = machine.python()
    assert (found.text, found.health) == (version, health)
    assert ("3.11 or 3.12 or 3.13" in found.advice) == (health is Health.BAD)


def test_a_library_that_is_missing_or_too_old_is_named():
    flaws = list(machine._versions(["numpy>=999", "no-such-library>=1", "rich>=1", 'pytest>=999; extra == "dev"']))
    assert len(flaws) == 2
    assert "wanted is >=999" in flaws[0]
    assert flaws[1] == "no-such-library is missing"
    assert list(machine._broken(("json", "no_such_module"))) == [
        "no_such_module cannot be imported (No module named 'no_such_module')"
    ]


def test_a_taken_port_is_told_from_one_that_the_own_service_has(tmp_path):
    with listening() as other:
        port = other.getsockname()[1]
        taken = machine.port("127.0.0.1", port, tmp_path)
        assert (taken.health, "--port 0" in taken.advice) == (Health.BAD, True)
        left = {"address": f"http://127.0.0.1:{port}", "token": "t", "pid": os.getpid()}
        (tmp_path / "service.json").write_text(json.dumps(left))
        assert machine.port("127.0.0.1", port, tmp_path).health is Health.WELL
    assert machine.port("127.0.0.1", port, tmp_path).text.endswith("is free")
    assert machine.port("203.0.113.7", port, tmp_path).health is Health.BAD
    assert machine.port("127.0.0.1", 0, tmp_path).health is Health.WELL


@pytest.mark.parametrize(
    ("llm", "handler", "health", "said"),
    [
        (None, unreachable, Health.WELL, "the grammar answers alone"),
        ("nonsense", unreachable, Health.BAD, "cannot read"),
        ("openai:qwen@http://127.0.0.1:9/v1", unreachable, Health.BAD, "does not answer"),
        ("openai:qwen", lambda _: httpx.Response(401), Health.BAD, "does not accept the key"),
        ("openai:qwen", lambda _: httpx.Response(200, json={"data": [{"id": "qwen"}]}), Health.WELL, "answers"),
        ("ollama:qwen", lambda _: httpx.Response(200, json={"models": []}), Health.ODD, "does not list qwen"),
        ("anthropic:claude", lambda _: httpx.Response(404), Health.WELL, "answers"),
    ],
)
def test_the_models_server_is_tried_and_its_key_is_never_told(llm, handler, health, said):
    found = machine.language_model(llm, None, KEY, server(handler))
    assert found.health is health
    assert said in found.text.replace("the command grammar", "the grammar")
    assert KEY not in json.dumps(document([found]))
    assert found.advice or health is Health.WELL


def test_the_key_goes_to_the_configured_server_alone_as_its_provider_wants_it():
    asked = []

    def note(request):
        asked.append(request)
        return httpx.Response(200, text="claude qwen")

    machine.language_model("anthropic:claude", "http://127.0.0.1:7/v1", KEY, server(note))
    machine.language_model("ollama:qwen", "http://127.0.0.1:8/v1", KEY, server(note))
    assert [str(request.url) for request in asked] == ["http://127.0.0.1:7/v1/models", "http://127.0.0.1:8/api/tags"]
    assert asked[0].headers["x-api-key"] == KEY
    assert asked[1].headers["authorization"] == f"Bearer {KEY}"


def test_the_shipped_network_is_the_one_whose_checksum_is_known():
    assert hashlib.sha256(SHIPPED.read_bytes()).hexdigest() == SHA256


def test_a_data_folder_that_cannot_be_one_is_told(tmp_path):
    assert files.data_folder(tmp_path).health is Health.WELL
    assert files.data_folder(tmp_path / "new" / "deep").health is Health.WELL
    assert not (tmp_path / "new").exists()
    (tmp_path / "file").write_text("")
    assert files.data_folder(tmp_path / "file").health is Health.BAD
    token = tmp_path / "token"
    token.write_text("t")
    token.chmod(0o644)
    assert "chmod 600" in files.data_folder(tmp_path).advice


def test_a_full_disk_is_told(tmp_path, monkeypatch):
    for free, health in ((10**10, Health.WELL), (10**8, Health.ODD), (10**6, Health.BAD)):
        monkeypatch.setattr(files.shutil, "disk_usage", lambda _, free=free: type("Usage", (), {"free": free}))
        assert files.disk(tmp_path / "new").health is health


@pytest.fixture
def building(tmp_path):
    folder = tmp_path / "buildings" / "flat-1"
    (folder / "rooms").mkdir(parents=True)
    return folder


def test_a_journal_that_is_well_is_told_so_also_while_a_service_writes(building, tmp_path):
    journal = TaskJournal.open(building / "tasks.sqlite3")
    [found] = files.journals(tmp_path)
    assert (found.health, found.text) == (Health.WELL, "flat-1 is well")
    journal.close()


@pytest.mark.parametrize("damage", [b"this is no database" * 99, None])
def test_a_damaged_journal_and_one_of_a_later_version_are_told(building, tmp_path, damage):
    file = building / "tasks.sqlite3"
    TaskJournal.open(file).close()
    if damage is None:
        connection = sqlite3.connect(file)
        connection.execute("PRAGMA user_version = 99")
        connection.commit()
        connection.close()
    else:
        file.write_bytes(damage)
    before = file.read_bytes()
    [found] = files.journals(tmp_path)
    assert found.health is Health.BAD
    assert "sets it aside" in found.advice
    assert file.read_bytes() == before


def test_a_journal_that_another_program_holds_is_told(building, tmp_path):
    file = building / "tasks.sqlite3"
    TaskJournal.open(file).close()
    holder = sqlite3.connect(file)
    holder.execute("PRAGMA locking_mode = EXCLUSIVE")
    holder.execute("BEGIN EXCLUSIVE")
    [found] = files.journals(tmp_path)
    holder.close()
    assert found.health is Health.BAD
    assert "is locked" in found.text


def test_rooms_that_cannot_be_read_and_what_was_set_aside_are_told(building, tmp_path):
    (building / "rooms" / "room_1.json").write_text("{")
    [found] = files.journals(tmp_path)
    assert (found.health, "1 of its rooms" in found.text) == (Health.ODD, True)
    (building / "rooms" / "room_1.json").rename(building / "rooms" / "room_1.json.broken")
    (building / "tasks.sqlite3.damaged-1").write_text("")
    [found] = files.journals(tmp_path)
    assert found.text == "flat-1 is well; set aside earlier: room_1.json.broken, tasks.sqlite3.damaged-1"
