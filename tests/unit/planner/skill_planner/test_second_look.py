"""A support that was full when it was last seen is looked at once more before a request is turned down."""

from __future__ import annotations

import pytest

from planner.doubles.sketch import Sketch
from planner.goals import goal
from planner.mission.settings import MissionSettings
from planner.plan import Impossible
from planner.skill_planner.second_look import perhaps_cleared
from planner.skill_planner.verifier import Verifier
from planner.tasks.approval import Approval
from planner.tasks.tasks import TaskStatus
from rehearsed_mission import Show
from scene_graph.edges import InEdge, RelationEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode, ObjectState
from skills.failures import FailureCode
from skills.registry import load_registry

VERIFIER = Verifier(load_registry([]))
CUP_ON_STOOL = goal("on", "cup_1", "stool_1")
LATER_S = MissionSettings.fresh_s + 100.0


def room(cup_m=(0.08, 0.08, 0.1)):
    """A stool of 0.3 m with a vase on it that leaves no room, and a cup on a table."""
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0))
    sketch.furniture("table_1", "table", "room_1", at=(0.0, 1.2))
    sketch.furniture("stool_1", "stool", "room_1", at=(1.2, -1.2), size_m=(0.3, 0.3, 0.5))
    sketch.thing("cup_1", "cup", on="table_1", at=(0.0, 1.2), size_m=cup_m)
    sketch.thing("vase_1", "vase", on="stool_1", at=(1.2, -1.2), size_m=(0.25, 0.25, 0.3), graspable=False)
    return sketch.snapshot(robot_in="room_1", at=(0.0, -0.5))


def support_to_look_at(snapshot, stamp_s, *goals):
    why = VERIFIER.plan_for(goals, snapshot)
    assert isinstance(why, Impossible)
    return perhaps_cleared(why, goals, VERIFIER, snapshot, stamp_s, fresh_s=MissionSettings.fresh_s)


def test_what_was_full_long_ago_may_have_been_cleared():
    assert support_to_look_at(room(), LATER_S, CUP_ON_STOOL) == "stool_1"


def test_what_is_seen_to_be_full_is_full():
    assert support_to_look_at(room(), 0.0, CUP_ON_STOOL) is None


def test_what_would_be_too_small_even_if_it_was_empty_is_not_looked_at():
    assert support_to_look_at(room(cup_m=(0.5, 0.5, 0.1)), LATER_S, CUP_ON_STOOL) is None


def test_only_that_it_is_full_can_have_changed_on_a_support():
    why = Impossible(reason="closed", nodes=("stool_1",), code=FailureCode.DOOR_CLOSED)
    assert perhaps_cleared(why, (CUP_ON_STOOL,), VERIFIER, room(), LATER_S, fresh_s=MissionSettings.fresh_s) is None


def show_of(crate_at):
    """A rehearsal in which a crate covers the desk, as far as is known; in truth it is at ``crate_at``."""
    show = Show()
    crate = ObjectNode(id="crate_1", label="box", size_m=(0.98, 0.58, 0.3), state=ObjectState.PRESENT)
    x_m, y_m, z_m = show.memory.snapshot().position("desk_1", "room_2")
    above = SE3.from_xyz_yaw(x_m, y_m, z_m + 0.5, 0.0)
    frame = RtEdge(source="room_2", target="crate_1", T_source_target=above)
    relation = RelationEdge(source="crate_1", target="desk_1", predicate="on", probability=0.95)
    edits = [PutNode(crate), PutEdge(frame), PutEdge(InEdge(source="crate_1", target="room_2")), PutEdge(relation)]
    show.memory.commit(edits, agent="objects", stamp_s=0.0)
    show.stage.places["crate_1"] = crate_at
    show.run(ticks=int((MissionSettings.fresh_s + 5.0) / 0.05))
    return show


def test_a_desk_that_was_cleared_meanwhile_takes_what_is_brought():
    show = show_of(None)
    show.ask()
    show.run_until(lambda: show.task.status is TaskStatus.RUNNING)
    assert show.task.explanation.endswith("was full when I last saw it; I will look whether it still is.")
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED
    assert show.stage.places["bottle_1"] == "desk_1"
    assert show.task.failures == ()


def test_a_desk_that_is_full_still_is_a_reason_to_turn_the_request_down():
    task = show_of("desk_1").finish()
    assert task.status is TaskStatus.REFUSED
    assert "is full" in task.explanation


@pytest.mark.parametrize("options", [{"dry_run": True}, {"approval": Approval.ASK}])
def test_nobody_drives_off_to_look_where_a_plan_is_only_to_be_shown(options):
    show = show_of(None)
    assert show.finish(**options).status is TaskStatus.REFUSED
    assert show.stage.robot_at == "room_1"
