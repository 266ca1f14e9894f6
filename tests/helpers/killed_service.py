"""Lives of a service that end by ``kill -9``: what it acknowledged, and what the next life has to know of it."""

from __future__ import annotations

import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path

import httpx

from scene_graph.long_term.room_files import unreadable_rooms
from service_process import wait_until

ENDED = {"succeeded", "failed", "cancelled", "refused"}
UNDER_WAY = {"running", "paused"}
START_TIMEOUT_S = 120.0
END_TIMEOUT_S = 30.0
PAUSE_S = 0.2
MOST_OPEN = 3


@dataclass
class Account:
    """What all lives together acknowledged, and how they fared.

    ``asked``: words of each acknowledged task. ``newest``: documents as last seen. ``taught``: labels of nodes.
    ``carried``: what was in the hand when the newest life ended. ``flaws``: what went wrong, a sentence each.
    """

    asked: dict[str, str] = field(default_factory=dict)
    newest: dict[str, dict] = field(default_factory=dict)
    taught: dict[str, str] = field(default_factory=dict)
    rooms: set[str] = field(default_factory=set)
    carried: str | None = None
    ready_s: list[float] = field(default_factory=list)
    flaws: list[str] = field(default_factory=list)
    kills: int = 0
    before_ready: int = 0
    under_way: int = 0
    carrying: int = 0
    interrupted: int = 0

    def summary(self) -> str:
        """Figures of all lives."""
        ready = sorted(self.ready_s) or [0.0]
        median_s = ready[len(ready) // 2]
        return (
            f"{self.kills} kills ({self.before_ready} before ready, {self.under_way} with a task under way, "
            f"{self.carrying} with something in the hand), {len(self.asked)} tasks acknowledged, {self.interrupted} "
            f"marked as cut off, {len(self.ready_s)} restarts ready after {median_s:.1f} s in the median, "
            f"at most {ready[-1]:.1f} s; {len(self.flaws)} flaws {self.flaws}"
        )


class Life:
    """One process of the service, from its start to its kill."""

    def __init__(self, data: Path, arguments: tuple[str, ...], account: Account) -> None:
        self.data, self.account = data, account
        command = [sys.executable, "-m", "app", "serve", "--port", "0", "--data", str(data), *arguments]
        self.began = time.monotonic()
        self.log = (data / "stderr.log").open("a")
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self.log, text=True)
        self.client: httpx.Client | None = None

    def until_ready(self) -> None:
        """Wait until a request can be taken; raises ``httpx.TransportError`` if it is killed before."""
        page = self.process.stdout.readline().strip()
        if not page:
            raise httpx.ReadError("it ended before it told its address")
        address, _, token = page.partition("/?token=")
        self.client = httpx.Client(
            base_url=address, headers={"Authorization": f"Bearer {token}"}, timeout=END_TIMEOUT_S
        )
        wait_until(lambda: self.client.get("/readyz").status_code == 200, START_TIMEOUT_S, pause_s=0.02)
        self.account.ready_s.append(time.monotonic() - self.began)

    def told(self, path: str, **parameters) -> dict:
        """The answer to a question."""
        response = self.client.get(path, params=parameters or None)  # an empty one would take the query away
        assert response.status_code == 200, f"{path}: {response.text}"
        return response.json()

    def tasks(self) -> dict[str, dict]:
        """All tasks that the service lists."""
        found, path = {}, "/v1/tasks?limit=200"
        while path is not None:
            page = self.told(path)
            found |= {task["id"]: task for task in page["tasks"]}
            path = page["next"]
        return found

    def nodes(self) -> dict[str, dict]:
        """Everything that the robot knows."""
        return {node["id"]: node for node in self.told("/v1/scene")["nodes"]}

    def kill(self) -> None:
        """End it as the operating system does when memory runs out."""
        self.process.send_signal(signal.SIGKILL)

    def bury(self) -> None:
        """Wait for its end, and for that of the simulator, which lives in a process of its own."""
        self.process.wait(END_TIMEOUT_S)
        if self.client is not None:
            self.client.close()
        self.process.stdout.close()
        self.log.close()


def children(pid: int) -> list[int]:
    """Processes that this one has started."""
    listed = Path(f"/proc/{pid}/task/{pid}/children")
    return [int(child) for child in listed.read_text().split()] if listed.exists() else []


def is_gone(pid: int) -> bool:
    """Whether a process has ended, buried or not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def steps_done(task: dict) -> int:
    """How many steps of the newest plan are confirmed."""
    return sum(step["status"] == "succeeded" for step in (task["plan"] or {"steps": ()})["steps"])


def in_hand(task: dict) -> str | None:
    """What the confirmed steps of a task under way leave in the hand."""
    held = None
    for step in (task["plan"] or {"steps": ()})["steps"]:
        if step["skill"] == "PICK" and step["status"] == "succeeded":
            held = step["args"][0]
        elif step["skill"] == "PLACE" and step["status"] != "pending":
            held = None
    return held


class Killing:
    """Ends life after life of one service at random instants, and looks after each."""

    def __init__(self, data: Path, arguments: tuple[str, ...], requests: tuple[str, ...], seed: int) -> None:
        """``requests``: what is asked for, in turn; none may teach, or it contradicts what is taught here."""
        self.data, self.arguments, self.requests = data, arguments, requests
        self.random = random.Random(seed)
        self.account = Account()
        self._asked = 0

    def life(self, after_s: float, *, while_starting: bool = False) -> None:
        """One life, killed so long after it was ready, or so long after its start."""
        account = self.account
        life = Life(self.data, self.arguments, account)
        descendants: list[int] = []
        killed = threading.Event()

        def end() -> None:
            descendants.extend(children(life.process.pid))
            killed.set()
            life.kill()

        timer = threading.Timer(after_s, end)
        try:
            if while_starting:
                timer.start()
            life.until_ready()
            self.look_after(life)
            if not while_starting:
                timer.start()
            while True:
                self.meddle(life)
                time.sleep(PAUSE_S)  # a person's pace
        except httpx.TransportError:
            if not killed.is_set():
                raise
        finally:
            timer.join(60.0) if timer.is_alive() else None
            life.kill()
            life.bury()
        account.kills += 1
        account.before_ready += life.client is None
        self.look_at_what_is_left(descendants)

    def look_again(self) -> None:
        """One more life, in which nothing is asked, to look at what the last kill left."""
        life = Life(self.data, self.arguments, self.account)
        try:
            life.until_ready()
            self.look_after(life)
        finally:
            life.kill()
            life.bury()

    def meddle(self, life: Life) -> None:
        """Ask, cancel, teach; remember only what was acknowledged."""
        account = self.account
        seen = life.tasks()
        account.newest |= seen
        open_tasks = [task for task in seen.values() if task["status"] not in ENDED]
        current = next((task for task in open_tasks if task["status"] in UNDER_WAY), None)
        account.carried = in_hand(current) if current is not None else None
        if len(open_tasks) < MOST_OPEN:
            words = self.requests[self._asked % len(self.requests)]
            self._asked += 1
            response = life.client.post("/v1/tasks", json={"request": words})
            assert response.status_code == 202, response.text
            account.asked[response.json()["id"]] = words
        if open_tasks and self.random.random() < 0.01:
            response = life.client.post(f"/v1/tasks/{self.random.choice(open_tasks)['id']}/cancel")
            if response.status_code == 200:
                account.newest[response.json()["id"]] = response.json()
        if account.rooms and self.random.random() < 0.05:
            room, label = self.random.choice(sorted(account.rooms)), f"den {self.random.randrange(1000)}"
            before = account.taught.pop(room, None)  # killed meanwhile, it may know the old label or the new one
            response = life.client.patch(f"/v1/scene/nodes/{room}", json={"label": label})
            if response.status_code == 200:
                account.taught[room] = label
            elif before is not None:
                account.taught[room] = before

    def look_at_what_is_left(self, descendants: list[int]) -> None:
        """Nothing of it runs on, and every file is whole."""
        account = self.account
        under_way = [task for task in account.newest.values() if task["status"] in UNDER_WAY]
        account.under_way += bool(under_way)
        account.carrying += account.carried is not None
        try:
            wait_until(lambda: all(is_gone(pid) for pid in descendants), END_TIMEOUT_S)
        except AssertionError:
            self.flaw(f"processes {descendants} outlive it")
        for file in self.data.rglob("*.sqlite3"):
            verdict = integrity(file)
            if verdict != "ok":
                self.flaw(f"{file.name}: {verdict}")
        for folder in (self.data / "buildings").iterdir():
            for path, reason in unreadable_rooms(folder):
                self.flaw(f"{path.name}: {reason}")

    def look_after(self, life: Life) -> None:
        """Whether a new life knows what the ones before acknowledged."""
        account = self.account
        tasks, nodes, status = life.tasks(), life.nodes(), life.told("/v1/status")
        for task_id, words in account.asked.items():
            if task_id not in tasks or tasks[task_id]["request"] != words:
                self.flaw(f"{task_id} is lost")
        for task_id, before in account.newest.items():
            if task_id in tasks:
                self.compare(before, tasks[task_id])
        rooms = {node["id"] for node in nodes.values() if node["type"] == "room"}
        if not rooms >= account.rooms:
            self.flaw(f"rooms {sorted(account.rooms - rooms)} are forgotten")
        account.rooms = rooms
        for node, label in account.taught.items():
            if node in nodes and nodes[node]["label"] != label:
                self.flaw(f"{node} was taught to be {label} and is {nodes[node]['label']}")
        if status["robot"]["holding"] is not None:
            self.flaw(f"it believes to hold {status['robot']['holding']}, and the hand is empty")
        carried = nodes.get(account.carried or "")
        if carried is not None and carried["state"] != "missing" and carried["last_seen_s"] <= 0.0:
            self.flaw(f"{carried['id']} was in the hand, and is said to be {carried['state']} without a look")
        aside = [path.name for path in self.data.rglob("*") if ".damaged-" in path.name or path.suffix == ".broken"]
        if aside:
            self.flaw(f"set aside: {aside}")
        account.newest, account.carried = dict(tasks), None

    def compare(self, before: dict, after: dict) -> None:
        """A task as it was last seen with what the next life says of it."""
        told = f"{before['id']} was {before['status']} and is {after['status']}"
        if before["status"] in ENDED and after["status"] != before["status"]:
            self.flaw(told)
        if before["status"] in UNDER_WAY and after["status"] not in ENDED:
            self.flaw(told)
        if any(failure["code"] == "interrupted" for failure in after["failures"]) and before["status"] in UNDER_WAY:
            self.account.interrupted += 1
            same = (before["plan"] or {}).get("revision") == (after["plan"] or {}).get("revision")
            done = steps_done(after)
            said = f"after {done} of" if done else "before any step"
            if said not in after["explanation"] or (same and done < steps_done(before)):
                self.flaw(f"{before['id']} had done {steps_done(before)} steps and says: {after['explanation']}")

    def flaw(self, text: str) -> None:
        """Note what went wrong."""
        self.account.flaws.append(f"after kill {self.account.kills}: {text}")


def integrity(file: Path) -> str:
    """SQLite's own verdict on a copy of a file with its log, as the killed process left them."""
    with tempfile.TemporaryDirectory() as folder:
        for suffix in ("", "-wal"):
            part = file.with_name(file.name + suffix)
            if part.exists():
                shutil.copy(part, folder)
        connection = sqlite3.connect(Path(folder) / file.name)
        try:
            return connection.execute("PRAGMA integrity_check").fetchone()[0]
        except sqlite3.DatabaseError as problem:
            return str(problem)
        finally:
            connection.close()


def explore(data: Path, *arguments: str, timeout_s: float) -> None:
    """Let a service explore its house to the end, and end it as a person does."""
    account = Account()
    life = Life(data, arguments, account)
    try:
        life.until_ready()
        wait_until(lambda: life.told("/v1/status")["explored"], timeout_s, pause_s=1.0)
    finally:
        life.process.terminate()
        try:
            life.process.wait(20)
        finally:
            life.kill()
            life.bury()
