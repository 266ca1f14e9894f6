"""Why a network's file cannot be used: each error is one sentence that names what is missing or wrong."""

from __future__ import annotations

from collections.abc import Sequence

from perception.errors import PerceptionError


class NetworkRefused(PerceptionError):
    """Base: ``file`` does not keep the contract; ``reason`` says where."""

    def __init__(self, file: str, reason: str) -> None:
        super().__init__(f"network file '{file}': {reason}")
        self.file = file
        self.reason = reason


class NetworkUnreadable(NetworkRefused):
    """The file is not there, cut short, or no ONNX model."""


class MetadataMissing(NetworkRefused):
    """Metadata keys are not in the file."""

    def __init__(self, file: str, missing: Sequence[str], available: Sequence[str]) -> None:
        there = ", ".join(sorted(available)) or "none"
        super().__init__(file, f"metadata {_quoted(missing)} missing; it has: {there}")
        self.missing = tuple(missing)
        self.available = tuple(available)


class MetadataInvalid(NetworkRefused):
    """A metadata value cannot be read."""

    def __init__(self, file: str, key: str, problem: str) -> None:
        super().__init__(file, f"metadata '{key}' {problem}")
        self.key = key


class TensorMissing(NetworkRefused):
    """Inputs or outputs (``kind``) are not in the file."""

    def __init__(self, file: str, kind: str, missing: Sequence[str], available: Sequence[str]) -> None:
        there = ", ".join(available) or "none"
        super().__init__(file, f"{kind} {_quoted(missing)} missing; it has: {there}")
        self.missing = tuple(missing)
        self.available = tuple(available)


class TensorMismatch(NetworkRefused):
    """An input or output has another shape or type than the contract says."""

    def __init__(self, file: str, tensor: str, expected: str, found: str) -> None:
        super().__init__(file, f"'{tensor}' should be {expected} and is {found}")
        self.tensor = tensor
        self.expected = expected
        self.found = found


def _quoted(names: Sequence[str]) -> str:
    listed = ", ".join(f"'{name}'" for name in names)
    return f"{listed} {'is' if len(names) == 1 else 'are'}"
