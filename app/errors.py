"""What ends a command with a sentence instead of a stack trace; light to import, so that the doctor can ask why."""


class RobotUnavailable(RuntimeError):
    """There is no robot: it died, or a stored graph is served."""


class RefusedToBind(RuntimeError):
    """The address would be reachable from outside without protection, or cannot be had."""


class LineError(ValueError):
    """A line that cannot be read: ``file``, ``line`` (from 1), the ``field`` at fault and the ``problem`` with it."""

    def __init__(self, file: str, line: int, field: str, problem: str) -> None:
        self.file, self.line, self.field, self.problem = file, line, field, problem
        super().__init__(f"{file}, line {line}, {field}: {problem}")
