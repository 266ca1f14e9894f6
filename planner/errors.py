"""What can go wrong in planning as an exception; expected outcomes are return values instead."""

from __future__ import annotations


class PlannerError(Exception):
    """Base of the planner's exceptions."""


class IllegalTransition(PlannerError):
    """A task cannot make this move; ``allowed`` lists those that it can make."""

    def __init__(self, task_id: str, source: str, target: str, allowed: tuple[str, ...]) -> None:
        super().__init__(
            f"task {task_id} is {source} and cannot become {target}; allowed: {', '.join(allowed) or 'nothing'}"
        )
        self.task_id, self.source, self.target, self.allowed = task_id, source, target, allowed


class WrongArity(PlannerError):
    """A goal has the wrong number of arguments."""

    def __init__(self, predicate: str, given: int, expected: int) -> None:
        super().__init__(f"{predicate} takes {expected} arguments, not {given}")
        self.predicate, self.given, self.expected = predicate, given, expected


class BadModelSpec(PlannerError):
    """A language model specification cannot be read; ``expected`` shows the form."""

    def __init__(self, spec: str, expected: str) -> None:
        super().__init__(f"cannot read the language model {spec!r}; expected {expected}")
        self.spec, self.expected = spec, expected


class BadModelKey(PlannerError):
    """A language model's provider wants a key, and there is none that it could take."""

    def __init__(self, provider: str, problem: str) -> None:
        places = "MAJORDOMO_LLM_KEY in the environment, or into a file that MAJORDOMO_LLM_KEY_FILE names"
        super().__init__(f"{provider} wants a key, and {problem}: put it into {places}")
        self.provider, self.problem = provider, problem


class TaskNotFound(PlannerError):
    """No task has this identifier; ``available`` lists the newest ones."""

    def __init__(self, task_id: str, available: tuple[str, ...]) -> None:
        super().__init__(f"there is no task {task_id!r}; the newest are: {', '.join(available) or 'none'}")
        self.task_id, self.available = task_id, available


class OperationNotAllowed(PlannerError):
    """A person's operation does not fit a task's status; ``allowed`` lists the operations that do."""

    def __init__(self, task_id: str, status: str, operation: str, allowed: tuple[str, ...]) -> None:
        choices = ", ".join(allowed) or "none, it has ended"
        super().__init__(f"{task_id} is {status}: cannot {operation} it; allowed: {choices}")
        self.task_id, self.status, self.operation, self.allowed = task_id, status, operation, allowed


class QueueFull(PlannerError):
    """So many tasks are open that no more are taken."""

    def __init__(self, most: int) -> None:
        super().__init__(f"{most} tasks are open already; wait until some have ended, or cancel some")
        self.most = most


class PlanChanged(PlannerError):
    """A plan was approved that is no longer the task's; ``revision`` is that of the graph its plan is made on."""

    def __init__(self, task_id: str, seen: int, revision: int) -> None:
        super().__init__(
            f"the plan of {task_id} was made anew on revision {revision} of the graph, and you approve the one of "
            f"revision {seen}: look at the new one first"
        )
        self.task_id, self.seen, self.revision = task_id, seen, revision
