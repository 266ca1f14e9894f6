"""What can go wrong between a client and its service."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import httpx


class ClientError(Exception):
    """Base of the client's exceptions; its text is a sentence for a person."""


class NoService(ClientError):
    """No service was found, or it does not answer."""


class StillWaiting(ClientError):
    """A task had not ended when the time was over; ``task_id`` says which, ``status`` where it stood."""

    def __init__(self, task_id: str, status: str, timeout_s: float) -> None:
        super().__init__(f"{task_id} is {status.replace('_', ' ')} after {timeout_s:g} s; it goes on")
        self.task_id, self.status, self.timeout_s = task_id, status, timeout_s


class Refused(ClientError):
    """The service refused.

    Attributes:
        status: of HTTP, or the code with which a stream was closed.
        code: stable, for programs, such as ``task_not_found``.
        detail: for people.
        document: everything that the service said, such as ``fields`` of an invalid request.
    """

    def __init__(self, status: int, code: str, detail: str, document: Mapping[str, Any] | None = None) -> None:
        super().__init__(detail)
        self.status, self.code, self.detail = status, code, detail
        self.document = dict(document or {})


class Unauthorized(Refused):
    """The token is missing or wrong."""


class Forbidden(Refused):
    """This token may not do that, or the request came under a foreign host or origin."""


class NotFound(Refused):
    """There is no such task, node, room, region, way or picture."""


class NotAllowedNow(Refused):
    """What was asked does not fit the state of things: a task has ended, a key came with another request before."""


class Invalid(Refused):
    """The request cannot be understood, or is too large."""


class TooManyRequests(Refused):
    """Slow down; ``retry_after_s`` says how long to wait, zero when the service did not say."""

    retry_after_s: float = 0.0


class Unavailable(Refused):
    """The service or its robot is not ready."""


_BY_STATUS: Mapping[int, type[Refused]] = {
    401: Unauthorized,
    403: Forbidden,
    404: NotFound,
    409: NotAllowedNow,
    400: Invalid,
    413: Invalid,
    422: Invalid,
    429: TooManyRequests,
    503: Unavailable,
}
_BY_CLOSE_CODE: Mapping[int, type[Refused]] = {
    4401: Unauthorized,
    4403: Forbidden,
    4429: TooManyRequests,
    1008: Forbidden,
    1009: Invalid,
}


def silent(address: str, error: BaseException) -> NoService:
    """The exception for a service that does not answer, with what a person may do."""
    return NoService(
        f"the service at {address} does not answer: {error}; if it has ended, 'majordomo serve' starts one"
    )


def refusal(response: httpx.Response) -> Refused:
    """The exception that an answer with an error status stands for."""
    kind = _BY_STATUS.get(response.status_code, Refused)
    document = _problem(response)
    detail = str(document.get("detail") or f"the service answered {response.status_code}")
    error = kind(response.status_code, str(document.get("code", "http_error")), detail, document)
    if isinstance(error, TooManyRequests):
        wait = response.headers.get("Retry-After", "")
        error.retry_after_s = float(wait) if wait.isdecimal() else 0.0
    return error


def closing(code: int, reason: str) -> Refused | None:
    """The exception that the closing of a stream stands for; ``None`` where coming back is worth a try."""
    kind = _BY_CLOSE_CODE.get(code)
    return None if kind is None else kind(code, "stream_closed", reason or f"the stream was closed ({code})")


def _problem(response: httpx.Response) -> Mapping[str, Any]:
    if "json" not in response.headers.get("content-type", ""):
        return {}
    try:
        document = response.json()
    except ValueError:
        return {}
    return document if isinstance(document, dict) else {}
