"""The mission agent: takes one task after the other from a request's words to a confirmed outcome."""

from __future__ import annotations

from dataclasses import replace

from planner.explainer.explainer import holding_sentence
from planner.mission.request_handler import Interpreter, RequestHandler
from planner.mission.resources import Resources
from planner.mission.task_execution import TaskExecution, agent_of
from planner.plan import Kind
from planner.tasks.tasks import Task, TaskStatus
from scene_graph.edges import EdgeKey, EdgeType, HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.edits import PutEdge, RemoveEdge
from scene_graph.nodes import ROBOT_ID

LOST = "I wait until I have found out where I am."


class Mission:
    """Plans and runs tasks, one at a time.

    While a task runs it holds a task intention, so that exploration waits; it goes on only while the arbiter grants it.
    After a start in a known building, and wherever it was carried, the robot first finds out where it is: what is to be
    done waits that long, and questions do not. Understanding a request is awaited in ``step`` with a deadline; the
    robot's control loop is another agent.
    """

    name = "mission"

    def __init__(self, resources: Resources, interpreter: Interpreter, *, period_s: float = 0.1) -> None:
        self.period_s = period_s
        self._resources, self._queue = resources, resources.queue
        self._requests = RequestHandler(
            resources.memory,
            resources.queue,
            interpreter,
            resources.verifier,
            on_event=resources.on_event,
            settings=resources.settings,
            recognizable=resources.recognizable,
        )
        self._execution: tuple[str, TaskExecution] | None = None
        self._stamp_s: float | None = None
        self._lost_since_s: float | None = None

    async def step(self, stamp_s: float) -> None:
        """Bring the current task a little farther."""
        dt_s = self.period_s if self._stamp_s is None else stamp_s - self._stamp_s
        self._stamp_s = stamp_s
        self._clear_away(stamp_s)
        task = self._queue.current
        lost = self._finds_its_place(stamp_s)
        if task is None:
            return
        if task.status is TaskStatus.QUEUED and not (lost and _is_read(task)):
            task = self._queue.move(task.id, TaskStatus.PLANNING, stamp_s=stamp_s)
        if task.status is TaskStatus.PLANNING:
            await self._prepare(task, stamp_s, lost=lost)
        elif task.status is TaskStatus.RUNNING:
            self._run(task, stamp_s, dt_s)
        await self._talk(stamp_s, lost=lost)

    def _finds_its_place(self, stamp_s: float) -> bool:
        """Whether the robot is still about to find out where it is."""
        robot = self._resources.memory.snapshot().robot
        if robot is None or robot.localized:
            self._lost_since_s = None
            return False
        if self._lost_since_s is None:
            self._lost_since_s = stamp_s
        return stamp_s - self._lost_since_s < self._resources.settings.lost_patience_s

    async def _talk(self, stamp_s: float, *, lost: bool) -> None:
        """Answer, refuse or ask back at once what is asked while another task has the robot, or waits for it."""
        current, unread = self._queue.current, self._queue.unread
        if unread is None or current is None or current.id == unread.id:
            return
        if current.status in (TaskStatus.RUNNING, TaskStatus.PAUSED) or lost:
            self._queue.move(unread.id, TaskStatus.PLANNING, stamp_s=stamp_s)
            await self._requests.take(self._queue.task(unread.id), stamp_s, busy=True)

    async def _prepare(self, task: Task, stamp_s: float, *, lost: bool) -> None:
        ready = await self._requests.take(task, stamp_s, busy=lost)
        if lost and self._queue.task(task.id).status is TaskStatus.QUEUED:
            self._queue.amend(task.id, explanation=LOST)
        if ready is not None:
            self._queue.move(task.id, TaskStatus.RUNNING, stamp_s=stamp_s, explanation=ready.intent)
            self._execution = (task.id, TaskExecution(ready, self._resources, stamp_s))

    def _run(self, task: Task, stamp_s: float, dt_s: float) -> None:
        """Let the task go on while the arbiter grants its intention and the stop is not latched."""
        if self._execution is None or self._execution[0] != task.id:
            self._requests.end(task, TaskStatus.FAILED, "I was restarted while I worked on this.", stamp_s)
            return
        edge = self._resources.memory.snapshot().edges.get(_intention_key(task.id))
        needs = self._execution[1].needs
        if not isinstance(edge, HasIntentionEdge):
            self._propose(task, needs, stamp_s)
        elif edge.needs != needs:
            self._resources.memory.commit([PutEdge(replace(edge, needs=needs))], agent=self.name, stamp_s=stamp_s)
        elif edge.status is IntentionStatus.GRANTED and not self._resources.executor.stopped:
            ending = self._execution[1].advance(stamp_s, dt_s)
            if ending is not None and ending.status is TaskStatus.PLANNING:
                self._requests.displace(task.id, ending.displaced)
                self._queue.move(task.id, TaskStatus.PLANNING, stamp_s=stamp_s)
                self._clear_away(stamp_s)
            elif ending is not None:
                self._requests.end(task, ending.status, ending.explanation, stamp_s)
                self._clear_away(stamp_s)

    def _propose(self, task: Task, needs: tuple[str, ...], stamp_s: float) -> None:
        edge = HasIntentionEdge(
            source=ROBOT_ID,
            target=ROBOT_ID,
            agent=agent_of(task.id),
            action=IntentionAction.TASK,
            priority=Priority.REQUEST,
            proposed_s=stamp_s,
            needs=needs,
        )
        self._resources.memory.commit([PutEdge(edge)], agent=self.name, stamp_s=stamp_s)

    def _clear_away(self, stamp_s: float) -> None:
        """When the task under way has ended, by itself or by a person, or is to be planned anew: stop its job and
        withdraw its intention.
        """
        if self._execution is None:
            return
        task_id, execution = self._execution
        task = self._queue.task(task_id)
        if not task.status.ended and task.status is not TaskStatus.PLANNING:
            return
        execution.close()
        self._execution = None
        snapshot = self._resources.memory.snapshot()
        if _intention_key(task_id) in snapshot.edges:
            self._resources.memory.commit([RemoveEdge(_intention_key(task_id))], agent=self.name, stamp_s=stamp_s)
        held = holding_sentence(snapshot)
        if task.status is TaskStatus.CANCELLED and held:
            self._queue.amend(task_id, explanation=f"{task.explanation} {held}")


def _is_read(task: Task) -> bool:
    """Whether it is known what is to be done."""
    return task.kind == Kind.PLAN.value or (task.approved and task.plan is not None)


def _intention_key(task_id: str) -> EdgeKey:
    return EdgeKey(EdgeType.HAS_INTENTION, ROBOT_ID, ROBOT_ID, agent_of(task_id))
