"""Errors as ``application/problem+json`` with a stable ``code``; a stack trace never leaves the service."""

from __future__ import annotations

import http
import logging
from collections.abc import Mapping, Sequence
from typing import Any

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from starlette.exceptions import HTTPException

from app.http.documents.codes import CODES
from app.http.methods import allowed

logger = logging.getLogger(__name__)

MEDIA_TYPE = "application/problem+json"
WHOLE_SENTENCE = "whole_sentence"
"""Type of flaws that are told in a sentence which says what it is about."""


class Problem(Exception):
    """A refusal with a status, a stable code and one sentence; ``extra`` members go into the document."""

    def __init__(
        self, status: int, code: str, detail: str, *, headers: Mapping[str, str] | None = None, **extra: Any
    ) -> None:
        super().__init__(detail)
        self.status = status
        self.code = code
        self.detail = detail
        self.headers = dict(headers or {})
        self.extra = extra


def problem_response(problem: Problem) -> JSONResponse:
    """The response that tells ``problem``."""
    document = {
        "type": f"urn:majordomo:problem:{problem.code}",
        "title": http.HTTPStatus(problem.status).phrase,
        "status": problem.status,
        "code": problem.code,
        "detail": problem.detail,
        **problem.extra,
    }
    return JSONResponse(document, status_code=problem.status, media_type=MEDIA_TYPE, headers=problem.headers)


def install_problem_handlers(app: FastAPI) -> None:
    """Make every error of ``app`` a problem document."""

    @app.exception_handler(Problem)
    async def _problem(_: Request, error: Problem) -> JSONResponse:
        return problem_response(error)

    @app.exception_handler(RequestValidationError)
    async def _invalid(_: Request, error: RequestValidationError) -> JSONResponse:
        kinds = [item["type"] for item in error.errors()]
        fields = [_flaw(item, error.body) for item in error.errors()]
        detail = "; ".join(_told(kind, flaw) for kind, flaw in zip(kinds, fields, strict=True))
        return problem_response(Problem(422, _code(kinds), detail, fields=fields))

    @app.exception_handler(HTTPException)
    async def _http(request: Request, error: HTTPException) -> JSONResponse:
        status = 422 if error.status_code == 400 else error.status_code  # a body that is not even text
        codes = {404: "not_found", 405: "method_not_allowed", 422: "invalid_request"}
        code = codes.get(status, "http_error")
        headers = dict(error.headers or {})
        if status == 405:
            headers["Allow"] = allowed(app.routes, request.scope, headers.get("Allow", ""))
        return problem_response(Problem(status, code, str(error.detail), headers=headers))

    @app.exception_handler(Exception)
    async def _unexpected(request: Request, error: Exception) -> JSONResponse:
        logger.error("request %s failed", request.url.path, exc_info=error)
        return problem_response(Problem(500, "internal_error", "something went wrong here; the log says what"))


def _code(kinds: Sequence[str]) -> str:
    """The code that all flaws have for a type; what has none of its own makes the whole request invalid."""
    return kinds[0] if kinds[0] in CODES and len(set(kinds)) == 1 else "invalid_request"


def _flaw(item: Mapping[str, Any], body: Any) -> dict[str, str]:
    """One flaw of a request: which field, and what is wrong with it."""
    if item["type"] == "json_invalid":
        return {"field": "body", "message": f"not JSON at character {item['loc'][-1]}: {item['ctx']['error']}"}
    return {"field": _field(item["loc"], body), "message": item["msg"]}


def _told(kind: str, flaw: Mapping[str, str]) -> str:
    return flaw["message"] if kind == WHOLE_SENTENCE else f"{flaw['field']}: {flaw['message']}"


def _field(location: Sequence[int | str], body: Any) -> str:
    """Where a flaw is, as the client wrote it: without the tag of the variant that the document was taken for."""
    place, *parts = location
    if place != "body":
        return ".".join(map(str, location))
    path, at = [], body
    for number, part in enumerate(parts, start=1):
        written = part in at if isinstance(at, Mapping) else isinstance(at, list) and part in range(len(at))
        if written or number == len(parts):
            path.append(str(part))
        if written:
            at = at[part]
    return ".".join(path) or "body"
