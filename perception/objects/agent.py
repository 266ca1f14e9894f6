"""The object memory agent: frame, network, tracks, graph; five times a second."""

from __future__ import annotations

import asyncio
import logging
from dataclasses import dataclass, field

import numpy as np
from numpy.random import Generator

from perception.errors import PerceptionError
from perception.objects.holding.grip import GripSettings
from perception.objects.holding.hand import Hand
from perception.objects.inspection import AGENT, Inspection, InspectionSettings
from perception.objects.publishing.people import People, PeopleSettings
from perception.objects.publishing.publication import (
    PublicationSettings,
    held_edits,
    object_edits,
    person_edits,
    relation_edits,
    robot_edits,
    united_edits,
)
from perception.objects.publishing.recollection import Recollection
from perception.objects.seeing.body import BodyGeometry, OwnBody
from perception.objects.seeing.detection import Detection, DetectionSettings, detections_of
from perception.objects.seeing.look import Look
from perception.objects.seeing.membership import MembershipSettings, Surroundings
from perception.objects.seeing.projection import View
from perception.objects.seeing.sight import Sight
from perception.objects.seeing.viewpoint import turning_radps, view_of
from perception.objects.tracker import Tracker, TrackerSettings
from perception.objects.tracking.relations import RelationMemory, RelationSettings
from perception.panoptic import PanopticModel, PanopticScene
from perception.ports import JointState, RgbdFrame
from perception.sensing import SensorBuffer
from scene_graph.edges import EdgeKey
from scene_graph.edits import Edit
from scene_graph.errors import TransactionRejected
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ObjectState
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class ObjectMemorySettings:
    """Settings of every stage.

    ``silent_s``: age of the newest frame from which on the camera counts as silent. ``late_s``: so much older than the
    newest a frame may be that waits for its turn. ``sure_rad``: standard deviation of the robot's heading from which
    on nothing is placed by it.
    """

    period_s: float = 0.2
    silent_s: float = 2.0
    late_s: float = 0.3
    inference_timeout_s: float = 10.0
    depth_share_min: float = 0.05
    in_hand_m: float = 0.12
    reaching_m: float = 0.1
    """An arm that is stretched out by more is not in a pose to travel in."""
    sure_rad: float = 0.008
    body: BodyGeometry = field(default_factory=BodyGeometry)
    membership: MembershipSettings = field(default_factory=MembershipSettings)
    detection: DetectionSettings = field(default_factory=DetectionSettings)
    tracker: TrackerSettings = field(default_factory=TrackerSettings)
    people: PeopleSettings = field(default_factory=PeopleSettings)
    relations: RelationSettings = field(default_factory=RelationSettings)
    inspection: InspectionSettings = field(default_factory=InspectionSettings)
    grip: GripSettings = field(default_factory=GripSettings)
    publication: PublicationSettings = field(default_factory=PublicationSettings)


class ObjectMemory:
    """Agent "objects": sees things, remembers them, doubts them, and asks to look.

    Attributes:
        degraded: why no frame is being used at the moment, ``None`` while all is well.
        look: the last frame that was understood, with what was recognized in it; ``None`` before the first.
    """

    name = AGENT

    def __init__(
        self,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        model: PanopticModel,
        *,
        random: Generator,
        settings: ObjectMemorySettings | None = None,
        held_before: str | None = None,
    ) -> None:
        """``held_before``: what was in the hand when the robot was switched off."""
        self._settings = settings or ObjectMemorySettings()
        self.period_s = self._settings.period_s
        self.degraded: str | None = None
        self.look: Look | None = None
        self._memory, self._buffer, self._model = memory, buffer, model
        self._tracker = Tracker(settings=self._settings.tracker, random=random)
        self._people = People(self._settings.people, self._settings.tracker.existence)
        self._relations = RelationMemory(self._settings.relations)
        self._recollection = Recollection(self._tracker, self._relations)
        self._inspection = Inspection(self._settings.inspection)
        self._hand = Hand(self._tracker, self._settings.grip, held_before)
        self._published: set[EdgeKey] = set()
        self._frame_s = -np.inf
        self._held_in: frozenset[int] = frozenset()

    async def step(self, stamp_s: float) -> None:
        """One frame, if there is a new one; the hand and the intentions in any case."""
        snapshot = self._memory.snapshot()
        self._published |= self._recollection.sync(snapshot)
        self._people.sync(snapshot)
        placed = self._hand.update(snapshot, self._buffer.joints)
        frame = self._new_frame(stamp_s)
        scene = await self._infer(frame) if frame is not None else None
        snapshot = self._memory.snapshot()
        sight: View | None = None
        if frame is not None and scene is not None:
            sight = view_of(frame, snapshot, self._buffer, sure_rad=self._settings.sure_rad)
        if frame is not None and scene is not None and sight is not None:
            await asyncio.to_thread(self._see, frame, scene, sight, snapshot, placed, stamp_s)
        elif placed and snapshot.current_room is not None:
            self._relate(Surroundings(snapshot, snapshot.current_room, self._settings.membership), placed, None)
        self._publish(stamp_s)
        if frame is not None and scene is not None:
            self.look = Look(frame=frame, scene=scene, nodes=self._recognized() if sight is not None else {})

    def _new_frame(self, stamp_s: float) -> RgbdFrame | None:
        """The next frame that has not been used yet and shows depth; one that is too old for that is left out."""
        newest = self._buffer.frame
        if newest is None or stamp_s - newest.stamp_s > self._settings.silent_s:
            self._mark("the camera is silent")
            return None
        frame = self._buffer.frame_after(max(self._frame_s, min(newest.stamp_s, stamp_s) - self._settings.late_s))
        if frame is None:
            return None
        self._frame_s = frame.stamp_s
        with np.errstate(invalid="ignore"):
            share = float(np.mean(frame.depth_m > 0.0))
        if share < self._settings.depth_share_min:
            self._mark("the depth image is empty")
            return None
        return frame

    async def _infer(self, frame: RgbdFrame) -> PanopticScene | None:
        try:
            async with asyncio.timeout(self._settings.inference_timeout_s):
                scene = await self._model.infer(frame)
        except (PerceptionError, TimeoutError, ConnectionError) as problem:
            self._mark(f"the panoptic model failed: {problem or type(problem).__name__}")
            return None
        self._mark(None)
        return scene

    def _mark(self, problem: str | None) -> None:
        if problem != self.degraded:
            log = logger.info if problem is None else logger.warning
            log("objects: %s", problem or "seeing again", extra={"agent": self.name, "degraded": problem})
        self.degraded = problem

    def _see(
        self,
        frame: RgbdFrame,
        scene: PanopticScene,
        view: View,
        snapshot: Snapshot,
        placed: frozenset[int],
        stamp_s: float,
    ) -> None:
        """Everything that takes time; runs in a worker thread while nobody else touches the tracks."""
        surroundings = Surroundings(snapshot, view.room, self._settings.membership)
        joints = self._buffer.joints_at(frame.stamp_s)
        held_m = self._hand.held.track.box.size_m if self._hand.held is not None else None
        body = OwnBody(joints, self._settings.body, held_m=held_m) if joints is not None else None
        things, persons = detections_of(
            scene, frame.rgb, view, self._settings.detection, body, surroundings.of_building
        )
        self._held_in = frozenset(thing.index for thing in things if self._in_hand(thing, view, joints))
        turning = turning_radps(self._buffer)
        T_here_room = surroundings.T_here_room
        persons = [each for each in persons if self._tracker.is_somebody(each, view.room, T_here_room)]
        self._people.update(persons, view, surroundings)
        self._tracker.update(
            Sight(
                view=view,
                detections=[thing for thing in things if thing.index not in self._held_in],
                surroundings=surroundings,
                turning_radps=turning,
                looked_before=self._inspection.looked(snapshot, stamp_s),
                hand=view.T_room_base.apply(body.grip) if body is not None else None,
                reaching=joints is not None and joints.extension_m > self._settings.reaching_m,
                persons=self._people.spots(surroundings),
            )
        )
        self._relate(surroundings, placed, scene)
        self._inspection.watch(self._tracker.tracks, view, surroundings, turning, snapshot)

    def _recognized(self) -> dict[int, str]:
        """Which node each instance of the frame is that was just seen, as far as it is one."""
        seen = {index: track.node_id for index, track in self._tracker.matches.items()}
        seen |= {index: person.node_id for index, person in self._people.matches.items()}
        if self._hand.held is not None:
            seen |= dict.fromkeys(self._held_in, self._hand.held.track.node_id)
        return {index: node_id for index, node_id in seen.items() if node_id is not None}

    def _in_hand(self, thing: Detection, view: View, joints: JointState | None) -> bool:
        """Whether a detection is what the gripper holds; ``joints``: as they were then."""
        if self._hand.held is None or joints is None:
            return False
        in_room = (view.T_room_base @ joints.T_base_gripper @ self._hand.held.T_gripper_object).translation_m
        near = np.linalg.norm(thing.cloud.points - in_room, axis=1) < self._settings.in_hand_m
        return float(near.mean()) > 0.5

    def _relate(self, surroundings: Surroundings, placed: frozenset[int], scene: PanopticScene | None) -> None:
        seen = frozenset(track.number for track in self._tracker.matches.values()) if scene is not None else frozenset()
        self._relations.unite(self._tracker.united)
        self._relations.update(
            self._tracker.tracks,
            surroundings.T_here_room,
            seen | placed,
            scene.relations if scene is not None else (),
            self._tracker.matches if scene is not None else {},
        )

    def _publish(self, stamp_s: float) -> None:
        """Write everything that changed in one transaction, on the newest snapshot."""
        snapshot = self._bring_what_turned_up(stamp_s)
        self._recollection.sync(snapshot)
        tracks, settings = self._tracker.tracks, self._settings.publication
        edits = self._inspection.edits(snapshot, stamp_s)
        edits += united_edits(snapshot, self._tracker.removed)
        edits += object_edits(snapshot, tracks, self._inspection.inspected, stamp_s, settings)
        held, room = self._hand.held, snapshot.current_room
        node_id = held.track.node_id if held is not None and held.track.state is ObjectState.HELD else None
        if held is not None and node_id is not None and room is not None:
            held.track.room = room
            edits.extend(held_edits(snapshot, node_id, self._hand.T_robot_object(held), room, stamp_s, settings))
            edits.extend(robot_edits(snapshot, node_id))
        elif room is not None or node_id is None:
            edits.extend(robot_edits(snapshot, None))
        edits.extend(person_edits(snapshot, self._people.tracks, stamp_s, settings))
        edits.extend(relation_edits(snapshot, self._relations.stated(), tracks, self._published, stamp_s, settings))
        self._commit(edits, stamp_s)

    def _bring_what_turned_up(self, stamp_s: float) -> Snapshot:
        """Load the room in which a thing was kept that is now seen in another, and the one in which a thing was seen
        that is now missed here; the newest snapshot.
        """
        snapshot = self._memory.snapshot()
        named = [(track.node_id, track.room) for track in self._tracker.tracks if track.node_id is not None]
        turned_up = [node_id for node_id, room in named if node_id in snapshot.elsewhere and room in snapshot]
        turned_up += [room for node_id, room in named if node_id in snapshot and room in snapshot.elsewhere]
        turned_up += [node_id for node_id in self._tracker.removed if node_id in snapshot.elsewhere]
        return self._memory.load(*turned_up, agent=self.name, stamp_s=stamp_s) if turned_up else snapshot

    def _commit(self, edits: list[Edit], stamp_s: float) -> None:
        try:
            self._memory.commit(edits, agent=self.name, stamp_s=stamp_s)
        except TransactionRejected as problem:
            logger.warning("objects: not written: %s", problem, extra={"agent": self.name})
