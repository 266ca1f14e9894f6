"""The agent that hands what is new in each of its turns to the writer."""

from __future__ import annotations

import asyncio

from app.recording.mcap_writer import McapWriter
from app.recording.moment import Moment
from app.robot_port import Robot
from perception.sensing import SensorBuffer
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, ROOT_ID


class Recorder:
    """Agent that records what perception was given, how the body was, and what the graph holds.

    It takes the last turn, so that a moment holds what the others have worked with in theirs.
    """

    name = "recorder"

    def __init__(
        self,
        writer: McapWriter,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        robot: Robot,
        *,
        patient: bool,
        period_s: float,
        graph_period_s: float = 1.0,
    ) -> None:
        """``patient``: let the robot's time wait for the disk, as in lockstep; otherwise moments may be left out.

        ``graph_period_s``: between two moments that hold the graph.
        """
        self._graph_period_s = graph_period_s
        self.period_s = period_s
        self._writer, self._memory, self._buffer, self._robot = writer, memory, buffer, robot
        self._patient = patient
        self._told_s: dict[str, float] = {}
        self._graph_due_s = float("-inf")

    async def step(self, stamp_s: float) -> None:
        """Record one moment."""
        if not self._writer.running:
            return
        moment = await self._moment(stamp_s)
        if self._patient:
            taken = await asyncio.to_thread(self._writer.put_patiently, moment)
        else:
            taken = self._writer.put(moment)
        if taken:
            self._remember(moment)

    def close(self) -> None:
        """End the file."""
        self._writer.close()

    async def _moment(self, stamp_s: float) -> Moment:
        buffer, snapshot = self._buffer, self._memory.snapshot()
        odometry = buffer.odometry[-1] if buffer.odometry else None
        return Moment(
            now_s=stamp_s,
            body=await self._robot.state(),
            odometry=odometry if self._is_new("odometry", odometry) else None,
            scan=buffer.scan if self._is_new("scan", buffer.scan) else None,
            joints=buffer.joints if self._is_new("joints", buffer.joints) else None,
            frame=buffer.frame if self._is_new("frame", buffer.frame) else None,
            T_map_base=snapshot.transform(ROOT_ID, ROBOT_ID),
            building=self._memory.building() if stamp_s >= self._graph_due_s else None,
        )

    def _is_new(self, sensor: str, measurement: object) -> bool:
        stamp_s: float | None = getattr(measurement, "stamp_s", None)
        return stamp_s is not None and stamp_s != self._told_s.get(sensor)

    def _remember(self, moment: Moment) -> None:
        """What a moment that was left out held is told with the next."""
        for sensor in ("odometry", "scan", "joints", "frame"):
            measurement = getattr(moment, sensor)
            if measurement is not None:
                self._told_s[sensor] = measurement.stamp_s
        if moment.building is not None:
            self._graph_due_s = moment.now_s + self._graph_period_s
