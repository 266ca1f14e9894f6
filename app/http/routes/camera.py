"""Routes that show what the robot sees."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Query, Response
from pydantic import FiniteFloat

from app.http.description import shows, shows_media
from app.http.documents import examples
from app.http.documents.answers import CameraDocument
from app.http.documents.codes import told
from app.http.documents.problems import Problem
from app.runtime import Runtime
from app.views.camera import FrameGone

BINARY = {"type": "string", "format": "binary"}


def camera_routes(runtime: Runtime) -> APIRouter:
    """The newest frame as a picture, and what was recognized in it."""
    router = APIRouter(tags=["scene"])

    @router.get(
        "/v1/camera",
        summary="What the robot recognizes",
        responses=shows(CameraDocument, examples.CAMERA) | told("no_camera"),
    )
    async def camera() -> Any:
        """Outlines, labels and nodes of the newest frame that was understood; its picture is at `GET /v1/camera.jpg`
        with the same `stamp_s`.
        """
        document = await runtime.views.camera.document(runtime.now_s)
        if document is None:
            raise _no_camera()
        return document

    @router.get(
        "/v1/camera.jpg",
        summary="What the robot sees",
        response_class=Response,
        responses=shows_media("image/jpeg", "A frame, with masks and labels.", BINARY)
        | told("no_camera", "frame_gone", "invalid_request"),
    )
    async def picture_of_camera(
        stamp_s: Annotated[
            FiniteFloat | None, Query(description="The frame that `GET /v1/camera` told of; without, the newest.")
        ] = None,
        outlines: Annotated[bool, Query(description="Draw outlines and labels into it.")] = True,
    ) -> Response:
        """A camera frame with the outlines of what the network made of it, twice as large; or the frame as it is."""
        try:
            picture = await runtime.views.camera.jpeg(stamp_s=stamp_s, outlines=outlines)
        except FrameGone as error:
            raise Problem(404, "frame_gone", str(error)) from None
        if picture is None:
            raise _no_camera()
        return Response(picture, media_type="image/jpeg", headers={"Cache-Control": "no-store"})

    return router


def _no_camera() -> Problem:
    return Problem(404, "no_camera", "the camera is off, or has not shown anything yet")
