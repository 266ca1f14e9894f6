"""What can be wrong with a file that an evaluation of planning reads."""

from __future__ import annotations


class LineError(ValueError):
    """A line that cannot be read: ``file``, ``line`` (from 1), the ``field`` at fault and the ``problem`` with it."""

    def __init__(self, file: str, line: int, field: str, problem: str) -> None:
        self.file, self.line, self.field, self.problem = file, line, field, problem
        super().__init__(f"{file}, line {line}, {field}: {problem}")
