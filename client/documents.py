"""What the service answers with. Fields that a later service adds are kept and can be read as attributes."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field, JsonValue

ENDED = frozenset({"succeeded", "failed", "cancelled", "refused"})
UNDECIDED = frozenset({"awaiting_answer", "awaiting_approval"})


class Document(BaseModel):
    """Base of all answers."""

    model_config = ConfigDict(frozen=True, extra="allow")


class Goal(Document):
    """A predicate over identifiers of the graph, such as ``on(cup_1, table_2)``."""

    predicate: str
    args: list[str]

    def __str__(self) -> str:
        return f"{self.predicate}({', '.join(self.args)})"


class VerifiedGoal(Goal):
    """A goal, and whether an observation newer than the last action that touched it confirms it."""

    confirmed: bool


class Action(Document):
    """One action of a step."""

    name: str
    status: str


class Step(Document):
    """One step of a plan. ``seconds``: time spent acting and confirming."""

    skill: str
    args: list[str]
    status: str = "pending"
    actions: list[Action] = []
    seconds: float = 0.0

    def __str__(self) -> str:
        return f"{self.skill}({', '.join(self.args)})"


class Plan(Document):
    """A plan: who read the request, the revision of the graph that it was made on, its goals and steps."""

    source: str
    revision: int
    goals: list[Goal]
    steps: list[Step]


class Evidence(Document):
    """What a failure rests on."""

    nodes: list[str] = []
    revision: int = 0
    observation: str = ""


class Failure(Document):
    """One failure on the way, and what the robot tries next."""

    step: str
    code: str
    message: str
    evidence: Evidence = Evidence()
    suggestion: str = ""


class Turn(Document):
    """A question of the robot and its answer, ``""`` while it is open."""

    question: str
    answer: str


class Times(Document):
    """Robot times in seconds, ``None`` until it happens."""

    received_s: float
    planned_s: float | None = None
    started_s: float | None = None
    ended_s: float | None = None


class Task(Document):
    """One request and everything that became of it."""

    id: str
    request: str
    status: str
    times: Times
    approval: str = "auto"
    dry_run: bool = False
    kind: str | None = None
    reply: str = ""
    candidates: list[str] = []
    dialogue: list[Turn] = []
    plan: Plan | None = None
    replans: int = 0
    failures: list[Failure] = []
    verified: list[VerifiedGoal] = []
    explanation: str = ""

    @property
    def ended(self) -> bool:
        """Whether nothing can happen to it any more."""
        return self.status in ENDED

    @property
    def undecided(self) -> bool:
        """Whether it waits for a person."""
        return self.status in UNDECIDED

    @property
    def succeeded(self) -> bool:
        """Whether it ended well."""
        return self.status == "succeeded"


class TaskPage(Document):
    """Some tasks, newest first. ``total``: how many there are."""

    tasks: list[Task]
    total: int


class Node(Document):
    """A node of the scene graph; what its type has beside is among the attributes. Meters, map frame."""

    id: str
    type: str
    label: str | None = None
    room: str | None = None
    position_m: list[float] | None = None
    confidence: float | None = None


class Edge(Document):
    """An edge of the scene graph."""

    source: str
    target: str
    type: str
    label: str | None = None
    probability: float | None = None


class Scene(Document):
    """The scene graph at one revision. ``stamp_s``: the robot's clock."""

    revision: int
    stamp_s: float
    nodes: list[Node]
    edges: list[Edge]


class Selection(Document):
    """Nodes that pass a query. ``total``: how many do, on this page or not."""

    revision: int
    nodes: list[Node]
    total: int


class Path(Document):
    """Rooms and doors from one node to another."""

    origin: str = Field(alias="from")
    target: str = Field(alias="to")
    rooms: list[str]
    doors: list[str]
    length_m: float


class Happening(Document):
    """One thing that became of a node. ``before`` and ``after``: a word, an identifier, or (x, y, z) in the map."""

    stamp_s: float
    kind: str
    before: str | list[float] | None = None
    after: str | list[float] | None = None


class History(Document):
    """What became of a node since ``since_s``, oldest first. ``dropped``: older entries that were let go."""

    node: str
    since_s: float | None
    entries: list[Happening]
    dropped: int = 0


class Seen(Document):
    """One thing in a frame. ``node``: which one it is, if that is known. ``box_px``: left, top, right, bottom."""

    node: str | None
    label: str
    background: bool
    score: float
    box_px: list[int]
    outline_px: list[list[list[int]]]


class View(Document):
    """What was recognized in the newest frame; its pixels go right and down. ``age_s``: how old the frame is."""

    stamp_s: float
    age_s: float
    width: int
    height: int
    instances: list[Seen]


class Pose(Document):
    """A pose in the map frame, meters and radians."""

    x: float
    y: float
    yaw_rad: float


class RobotState(Document):
    """Where the robot is and what it holds."""

    room: str | None = None
    localized: bool = False
    pose_map: Pose | None = None
    holding: str | None = None


class Status(Document):
    """What the service is doing."""

    stamp_s: float
    clock: str
    exploring: bool
    explored: bool
    task: str | None
    stopped: bool
    robot: RobotState
    language_model: str | None = None
    agents: dict[str, dict[str, float]] = {}


class Event(Document):
    """One event of the stream.

    ``type``: ``snapshot``, ``scene``, ``task``, ``robot``, ``perception`` or ``log``; the client adds ``disconnected``
    when the connection is lost and it tries to come back: what was shown so far is old from then on. ``seq`` numbers
    the service's events. ``gap``: events before this one were missed; the snapshot that it is tells how things are.
    """

    seq: int
    type: str
    stamp_s: float = 0.0
    data: Any = None
    gap: bool = False


class TraceEntry(Document):
    """What was decided or seen, and why.

    ``seq`` counts over all tasks. ``stamp_s``: the robot's clock, seconds, which begins anew with every start of the
    service. ``at_s``: wall time, seconds since 1970. ``data``: what is behind it, by ``kind``.
    """

    seq: int
    stamp_s: float
    at_s: float
    kind: str
    what: str
    why: str = ""
    data: dict[str, JsonValue] = {}


class Trace(Document):
    """What was decided about one task, oldest first. ``dropped``: older entries that the full journal let go.

    ``next``: give it as ``after`` to get the entries that follow; ``None`` when these are the last.
    """

    task: str
    entries: list[TraceEntry]
    dropped: int = 0
    next: int | None = None
