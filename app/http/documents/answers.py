"""What the service answers, described for the documentation; the answers themselves are made elsewhere.

Answers may hold more than is described here.
"""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from planner.goals import Predicate
from planner.tasks.approval import Approval
from planner.tasks.tasks import StepStatus, TaskStatus
from scene_graph.nodes import NodeType


class Shown(BaseModel):
    """Base of all answers."""

    model_config = ConfigDict(extra="allow")


class FactDocument(Shown):
    """A predicate over identifiers of the graph, such as ``on(bottle_1, desk_1)``."""

    predicate: Predicate
    args: list[str]


class GoalDocument(FactDocument):
    """A goal, and whether the robot has seen that it holds."""

    confirmed: bool


class ActionDocument(Shown):
    """One action of a step."""

    name: str
    status: StepStatus


class StepDocument(Shown):
    """One step of a plan. ``seconds``: spent on it so far."""

    skill: str
    args: list[str]
    status: StepStatus
    actions: list[ActionDocument]
    seconds: float


class ChangesDocument(Shown):
    """How the graph will have changed when the plan is done."""

    added: list[FactDocument]
    removed: list[FactDocument]


class PlanDocument(Shown):
    """A plan, proven on a revision of the graph, with what it is expected to take and to change."""

    source: str
    revision: int
    goals: list[FactDocument]
    steps: list[StepDocument]
    expected_s: float
    expected_m: float
    changes: ChangesDocument


class EvidenceDocument(Shown):
    """What a failure rests on."""

    nodes: list[str]
    revision: int
    observation: str


class FailureDocument(Shown):
    """What went wrong on the way, and what was tried next."""

    step: str
    code: str
    message: str
    evidence: EvidenceDocument
    suggestion: str


class TimesDocument(Shown):
    """Seconds of the robot's clock."""

    received_s: float
    planned_s: float | None
    started_s: float | None
    ended_s: float | None


class ExchangeDocument(Shown):
    """A question of the robot's and its answer, empty while it is open."""

    question: str
    answer: str


class TaskDocument(Shown):
    """A request and everything that became of it."""

    id: str = Field(examples=["task_1"])
    request: str
    status: TaskStatus
    kind: Literal["plan", "answer", "clarify", "refuse"] | None
    reply: str
    candidates: list[str]
    dialogue: list[ExchangeDocument]
    approval: Approval
    approved: bool
    dry_run: bool
    plan: PlanDocument | None
    replans: int
    failures: list[FailureDocument]
    verified: list[GoalDocument]
    explanation: str
    times: TimesDocument


class TasksDocument(Shown):
    """A page of tasks. ``queue``: who has the robot, and who waits for it, in order. ``next``: the next page."""

    tasks: list[TaskDocument]
    total: int
    queue: list[str]
    next: str | None


class StopDocument(Shown):
    """Whether the software stop is latched."""

    stopped: bool


class NodeDocument(Shown):
    """A node; which other fields it has goes by its type."""

    id: str = Field(examples=["bottle_1"])
    type: NodeType
    label: str
    room: str | None
    position_m: list[float] = Field(min_length=3, max_length=3)
    confidence: float


class EdgeDocument(Shown):
    """An edge; ``label`` is the predicate of a relation."""

    source: str
    target: str
    type: str
    label: str
    probability: float


class SceneDocument(Shown):
    """The graph at a revision."""

    revision: int
    stamp_s: float
    nodes: list[NodeDocument]
    edges: list[EdgeDocument]


class NodesDocument(Shown):
    """A page of nodes, and how many there are in all."""

    revision: int
    nodes: list[NodeDocument]
    total: int


class HistoryEntry(Shown):
    """One thing that became of a node.

    ``stamp_s``: robot time, negative before the last start. ``kind``: ``known`` when the record began, ``found``,
    ``gone``; ``moved``, with positions in the map; another ``room``, ``place`` (``on table_1``), ``state``, ``label``
    or ``name``; ``seen_again`` after more than a minute.
    """

    stamp_s: float
    kind: Literal["known", "found", "gone", "moved", "room", "place", "state", "label", "name", "seen_again"]
    before: str | list[float] | None
    after: str | list[float] | None


class HistoryDocument(Shown):
    """The newest entries about a node, oldest first. ``since_s``: when the record began. ``dropped``: older ones."""

    node: str = Field(examples=["bottle_1"])
    since_s: float | None
    entries: list[HistoryEntry]
    dropped: int


class SeenDocument(Shown):
    """One thing in a frame, in its pixels: x right, y down.

    ``node``: which node of the graph it is, ``null`` while that is not known. ``background``:
    a part of the building, such as a wall. ``box_px``: left, top, right, bottom.
    ``outline_px``: a polygon for each part of its mask.
    """

    node: str | None
    label: str
    background: bool
    score: float
    box_px: list[int] = Field(min_length=4, max_length=4)
    outline_px: list[list[list[int]]]


class CameraDocument(Shown):
    """What was recognized in the newest frame, the largest first. ``age_s``: how old the frame is."""

    stamp_s: float
    age_s: float
    width: int
    height: int
    instances: list[SeenDocument]


class PathDocument(Shown):
    """A way through the building. ``doors``: between each room and the next."""

    origin: str = Field(alias="from")
    to: str
    rooms: list[str]
    doors: list[str]
    length_m: float


class PoseDocument(Shown):
    """In the map frame: origin at the robot's first pose, x forward."""

    x: float
    y: float
    yaw_rad: float


class RobotDocument(Shown):
    """Where the robot is and what it holds."""

    room: str | None
    localized: bool
    pose_map: PoseDocument
    holding: str | None


class AgentDocument(Shown):
    """How one agent keeps its rate. ``busy_ms``: wall time of a turn. ``restarts``: unexpected errors."""

    rate_hz: float
    busy_ms_p50: float
    busy_ms_p99: float
    restarts: int


class StatusDocument(Shown):
    """What the robot is doing."""

    stamp_s: float
    clock: Literal["real", "lockstep"]
    exploring: bool
    explored: bool
    task: str | None
    stopped: bool
    robot: RobotDocument
    language_model: str | None
    agents: dict[str, AgentDocument]


class TruthDocument(Shown):
    """The simulator's truth, in house coordinates."""

    stamp_s: float
    house: str
    robot: dict[str, Any]
    objects: list[dict[str, Any]]
    doors: list[dict[str, Any]]
    people: list[dict[str, Any]]
    collisions: int
    touched: list[str]


class RestartDocument(Shown):
    """The simulator was brought back."""

    restarted: Literal[True]


class DoneDocument(Shown):
    """It has happened."""

    done: Literal[True]


class HealthDocument(Shown):
    """Yes."""

    status: Literal["alive", "ready"]
