"""Routes that read and teach the scene graph."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query, Response

from majordomo.app.http.documents import NodePatch, SceneQuery
from majordomo.app.http.problems import Problem
from majordomo.app.map_picture import map_svg
from majordomo.app.runtime import Runtime
from majordomo.app.scene_documents import InvalidQuery, document_nodes, query_scene, scene_path
from majordomo.planner.lessons import NotTeachable, teach
from majordomo.scene_graph.errors import NodeNotFound, TransactionRejected, UnknownLayer, UnknownRegion, UnknownRoom

Frame = Literal["map", "room"]


def scene_routes(runtime: Runtime) -> APIRouter:
    """Routes over everything the runtime knows."""
    router = APIRouter(tags=["scene"])

    @router.get("/v1/scene", summary="What the robot knows")
    async def scene(frame: Frame = "map", layer: Annotated[list[str] | None, Query()] = None) -> Response:
        try:
            body = runtime.scene_json(frame, tuple(layer or ()))
        except UnknownLayer as error:
            raise Problem(422, "unknown_layer", str(error)) from None
        return Response(body, media_type="application/json")

    @router.post("/v1/scene/query", summary="Find nodes")
    async def query(body: SceneQuery) -> dict[str, Any]:
        try:
            return query_scene(runtime.memory.building(), body)
        except NodeNotFound as error:
            raise Problem(404, "node_not_found", str(error)) from None
        except (InvalidQuery, UnknownRoom, UnknownRegion) as error:
            raise Problem(422, "invalid_query", str(error)) from None

    @router.get("/v1/scene/path", summary="Rooms and doors between two nodes")
    async def path(to: str, origin: Annotated[str, Query(alias="from")] = "robot") -> dict[str, Any]:
        try:
            found = scene_path(runtime.memory.building(), origin, to)
        except NodeNotFound as error:
            raise Problem(404, "node_not_found", str(error)) from None
        if found is None:
            raise Problem(404, "no_path", f"I know of no way from {origin} to {to}")
        return found

    @router.patch("/v1/scene/nodes/{node_id}", summary="Teach a name, a label, or the region of a room")
    async def patch(node_id: str, body: NodePatch) -> dict[str, Any]:
        try:
            taught = {"label": body.label, "name": body.name, "region": body.region}
            teach(runtime.memory, node_id, **taught, stamp_s=runtime.now_s)
        except NodeNotFound as error:
            raise Problem(404, "node_not_found", str(error)) from None
        except (NotTeachable, TransactionRejected) as error:
            raise Problem(409, "not_teachable", str(error)) from None
        return next(node for node in document_nodes(runtime.memory.building()) if node["id"] == node_id)

    @router.get("/v1/map.svg", summary="The known building as a picture")
    async def picture() -> Response:
        return Response(map_svg(runtime.scene_document("map")), media_type="image/svg+xml")

    @router.get("/v1/camera.jpg", summary="What the robot sees")
    async def camera() -> Response:
        picture = await runtime.camera_jpeg()
        if picture is None:
            raise Problem(404, "no_camera", "the camera is off, or has not shown anything yet")
        return Response(picture, media_type="image/jpeg", headers={"Cache-Control": "no-store"})

    return router
