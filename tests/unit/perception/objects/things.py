"""Things as they are known after some frames, and what a sighting is taken for."""

import numpy as np

from perception.objects.beliefs import LabelBelief
from perception.objects.doubles.raycast import render, rgbd_frame
from perception.objects.doubles.scripted import furnished_memory
from perception.objects.furniture.surface import Box, SurfaceBelief
from perception.objects.identity.evidence import likeness
from perception.objects.identity.hypotheses import Asked, Hypothesis
from perception.objects.identity.identity import Identity, IdentitySettings
from perception.objects.identity.pair import Moment, Pair, Subject
from perception.objects.seeing.membership import Surroundings
from perception.objects.seeing.projection import View
from perception.objects.seeing.sight import Sight
from perception.objects.tracking.center import CenterBelief, CenterSettings
from perception.objects.tracking.track import Track, TrackSettings
from scene_graph.edges import ConnectsEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorNode, ObjectState

IDENTITY = Identity(IdentitySettings())


def decision(sighting, known, asked=Asked.TENTATIVE, looked_before=None):
    """What a sighting is taken for, among the things that are known."""
    moment = Moment(known=known, looked_before=looked_before or {})
    return IDENTITY.decide(asked, Subject.of(sighting), moment)


def taken_for(sighting, known, looked_before=None):
    """The known thing that it is, or is a part of, if that is clear by now."""
    decided = decision(sighting, known, looked_before=looked_before)
    return None if decided.waits else decided.best.known


def turned_up(missing, others, looked_before=None):
    """The other thing that a missing one is."""
    moment = Moment(known=others, looked_before=looked_before or {})
    present = [Subject.of(other) for other in others if other.state is ObjectState.PRESENT]
    found = [(IDENTITY.decide(Asked.MISSED, it, moment, [missing]).best, it.track) for it in present]
    best, other = max(found, key=lambda pair: pair[0].score)
    return other if best.known is missing else None


def is_part(sighting, known):
    return decision(sighting, [known]).best.hypothesis is Hypothesis.PART


def are_one(one, other):
    decided = [decision(a, [b], Asked.NODE).best.hypothesis is Hypothesis.PART for a, b in ((one, other), (other, one))]
    return any(decided)


def seen(label, size_m, number):
    track = Track(number, "room_1", settings=TrackSettings(), random=np.random.default_rng(0))
    for view in range(3):
        track.label.update(((label, 0.95),), view=view)
    track.place = SurfaceBelief.of(Box(np.array((0.0, 0.0, size_m[2] / 2)), size_m, 0.0))
    track.seen_whole = True
    return track


def thing(number, label="bottle", color="blue", size_m=(0.07, 0.07, 0.24), seen=(0.0, 10.0), state=ObjectState.PRESENT):
    track = Track(number, "room_1", settings=TrackSettings(), random=np.random.default_rng(number))
    for _ in range(5):
        track.label.update(((label, 0.95),))
    track.color.update({color: 1.0})
    track.place = CenterBelief(
        Box(np.zeros(3), size_m, 0.0), np.eye(3) * 1e-4, settings=CenterSettings(), random=np.random.default_rng(number)
    )
    track.first_seen_s, track.last_seen_s = seen
    track.state = state
    track.log_odds = -2.0 if state is ObjectState.MISSING else 4.6
    return track


def moved(sighting, known, *, place_known=True):
    if not sighting.position.any():
        sighting.put_at("room_1", np.array((3.0, 1.0, 0.0)), 0.01)
    return taken_for(sighting, known, looked_before={"room_1": 0.0} if place_known else {})


def nothing_seen(room, snapshot):
    """One frame that shows nothing, in ``room``."""
    base = SE3.identity()
    frame = rgbd_frame(render([], base), stamp_s=1.0, T_base_camera=base)
    view = View.of(frame, room=room, T_room_base=base, pose_covariance=np.zeros((6, 6)))
    return Sight(view=view, detections=[], surroundings=Surroundings(snapshot, room))


def banana_like(number, **fields):
    """What may be a book, but looks more like a banana."""
    sighting = thing(number, "banana", **fields)
    sighting.label = LabelBelief()
    for _ in range(5):
        sighting.label.update((("banana", 0.8), ("book", 0.1)))
    return sighting


def nameless(number, size_m, color, at, **fields):
    sighting = thing(number, "unknown", color, size_m, **fields)
    sighting.put_at("room_1", np.array(at), 0.01)
    return sighting


def agree(one, other):
    return likeness(Pair(Subject.of(one), other, Moment()))


def door_between(room, other):
    door = DoorNode(id=f"door_{room[5:]}_0_0", rooms=(room, other), width_m=0.9, provisional=False)
    return [
        PutNode(door),
        PutEdge(RtEdge(source=room, target=door.id, T_source_target=SE3.from_xyz_yaw(3.0, 0.0, 0.0, np.pi))),
        PutEdge(ConnectsEdge(source=door.id, target=room)),
        PutEdge(ConnectsEdge(source=door.id, target=other)),
    ]


def two_rooms():
    memory = furnished_memory(rooms=2)
    return memory.commit(door_between("room_1", "room_2"), agent="door_concept", stamp_s=0.0)


def filled(x_m, y_m, z_m=(0.4, 0.9), step_m=0.03):
    ticks = [np.arange(low, high, step_m) for low, high in (x_m, y_m, z_m)]
    return np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1).reshape(-1, 3)
