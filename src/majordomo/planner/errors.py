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
        super().__init__(f"{provider} wants a key, and {problem}: put it into MAJORDOMO_LLM_KEY in the environment")
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
