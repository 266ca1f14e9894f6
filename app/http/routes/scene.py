"""Routes that read and teach the scene graph."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from fastapi import APIRouter, Path, Query, Response

from app.http.description import shows, shows_media
from app.http.documents import examples
from app.http.documents.answers import (
    HistoryDocument,
    NodeDocument,
    NodesDocument,
    PathDocument,
    SceneDocument,
)
from app.http.documents.choices import Among, RefusedAs
from app.http.documents.codes import told
from app.http.documents.problems import Problem
from app.http.documents.requests import NodePatch, SceneQuery
from app.runtime import Runtime
from app.views.map_picture import map_svg
from app.views.scene_documents import document_nodes, query_scene, scene_path
from planner.mission.teaching import NotTeachable, teach
from scene_graph.documents.scene_writer import LAYERS
from scene_graph.errors import NodeNotFound, TransactionRejected, UnknownRegion, UnknownRoom
from scene_graph.nodes import NodeType

Frame = Annotated[
    Literal["map", "room"],
    Query(description="`map`: the metric layout, a physical door one node. `room`: each node in its room's frame."),
]
Layer = Annotated[
    str,
    Among(names=tuple(LAYERS)),
    RefusedAs(code="unknown_layer", sentence=f"unknown; there are {', '.join(NodeType)}"),
]
NodeId = Annotated[str, Path(description="Such as `room_1`.")]
From = Annotated[str, Query(alias="from", description="A node.")]


def scene_routes(runtime: Runtime) -> APIRouter:
    """Routes over everything the runtime knows."""
    router = APIRouter(tags=["scene"])

    @router.get(
        "/v1/scene",
        summary="What the robot knows",
        response_class=Response,
        responses=shows(SceneDocument, examples.SCENE) | told("unknown_layer", "invalid_request"),
    )
    async def scene(
        frame: Frame = "map",
        layer: Annotated[
            list[Layer] | None, Query(description="Node types to show, with the edges among them.")
        ] = None,
    ) -> Response:
        """The scene graph at its newest revision, long-term memory included."""
        return Response(runtime.views.scene.json(frame, tuple(layer or ())), media_type="application/json")

    @router.post(
        "/v1/scene/query",
        summary="Find nodes",
        responses=shows(NodesDocument, examples.NODES) | told("node_not_found", "invalid_query", "invalid_request"),
    )
    async def query(body: SceneQuery) -> Any:
        """Filter by type, label, attributes, room, relation, nearness, state and age; a viewer may ask too."""
        try:
            return query_scene(runtime.memory.building(), body)
        except NodeNotFound as error:
            raise Problem(404, "node_not_found", str(error)) from None
        except (UnknownRoom, UnknownRegion) as error:
            raise Problem(404, "invalid_query", str(error)) from None

    @router.get(
        "/v1/scene/path",
        summary="Rooms and doors between two nodes",
        responses=shows(PathDocument, examples.PATH) | told("node_not_found", "no_path", "invalid_request"),
    )
    async def path(to: Annotated[str, Query(description="A node.")], origin: From = "robot") -> Any:
        """The shortest way through doors that are open."""
        try:
            found = scene_path(runtime.memory.building(), origin, to)
        except NodeNotFound as error:
            raise Problem(404, "node_not_found", str(error)) from None
        if found is None:
            raise Problem(404, "no_path", f"I know of no way from {origin} to {to}")
        return found

    @router.patch(
        "/v1/scene/nodes/{node_id}",
        summary="Teach a name, a label, or the region of a room",
        responses=shows(NodeDocument, examples.NODE)
        | told("node_not_found", "not_teachable", "invalid_request", "journal_unavailable"),
    )
    async def patch(node_id: NodeId, body: NodePatch) -> Any:
        """Rooms, regions and objects take a label, objects and persons a name, rooms a region. Perception never
        overrides what a person has taught, and it is written down before the answer.
        """
        try:
            taught = {"label": body.label, "name": body.name, "region": body.region}
            teach(runtime.memory, node_id, **taught, stamp_s=runtime.now_s)
        except NodeNotFound as error:
            raise Problem(404, "node_not_found", str(error)) from None
        except (NotTeachable, TransactionRejected) as error:
            raise Problem(409, "not_teachable", str(error)) from None
        runtime.orders.keep_taught()
        return next(node for node in document_nodes(runtime.memory.building()) if node["id"] == node_id)

    @router.get(
        "/v1/scene/nodes/{node_id}/history",
        summary="What became of a node",
        responses=shows(HistoryDocument, examples.HISTORY) | told("node_not_found"),
    )
    async def history(node_id: NodeId) -> Any:
        """When rooms, doors, objects, persons and regions were found, moved, renamed, missed or seen again, also before
        the last start of the service. What is gone is remembered for a while.
        """
        found = runtime.views.scene.history(node_id)
        if found is None:
            raise Problem(404, "node_not_found", f"there is no node {node_id!r}, and none is remembered")
        return found

    @router.get(
        "/v1/map.svg",
        summary="The known building as a picture",
        response_class=Response,
        responses=shows_media("image/svg+xml", "Rooms, doors, furniture, things, people and the robot."),
    )
    async def picture() -> Response:
        """The map from above, for people; programs take `GET /v1/scene`."""
        return Response(map_svg(runtime.views.scene.document()), media_type="image/svg+xml")

    return router
