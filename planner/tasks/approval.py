"""Whether a person is asked before a plan is carried out."""

from __future__ import annotations

from enum import StrEnum


class Approval(StrEnum):
    """Whether a person sees the plan before anything moves."""

    AUTO = "auto"
    ASK = "ask"
