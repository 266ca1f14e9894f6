"""Routes for scoring, present only with ``--simulation-api``."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter

from app.http.description import shows
from app.http.documents.answers import DoneDocument, TruthDocument
from app.http.documents.codes import told
from app.http.documents.problems import Problem
from app.runtime import Runtime
from simulation.errors import DisturbError
from simulation.houses.disturbances import Happening
from simulation.process.client import SimulatedRobot


def simulation_routes(runtime: Runtime) -> APIRouter:
    """The simulator's truth, and a person who interferes."""
    router = APIRouter(tags=["simulation"])

    def robot() -> SimulatedRobot:
        if runtime.robot is None or not runtime.robot.alive:
            raise Problem(503, "simulator_unavailable", "the simulator is not running")
        return runtime.robot

    @router.get(
        "/v1/simulation/truth",
        summary="The simulator's truth, for scoring",
        responses=shows(TruthDocument) | told("simulator_unavailable"),
    )
    async def truth() -> Any:
        """In house coordinates. The robot knows nothing of it."""
        return await robot().truth()

    @router.post(
        "/v1/simulation/disturb",
        summary="Let something happen in the house",
        responses=shows(DoneDocument, {"done": True})
        | told("invalid_disturbance", "invalid_request", "simulator_unavailable"),
    )
    async def disturb(body: Happening) -> Any:
        """Carried out at once; the robot has to notice by itself."""
        try:
            await robot().disturb(body.model_dump(by_alias=True, exclude_none=True))
        except DisturbError as error:
            raise Problem(409, "invalid_disturbance", str(error)) from None
        return {"done": True}

    return router
