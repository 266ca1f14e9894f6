"""The Controller's questions, one by one, on a hand-built flat: what is noticed, and what is no cause for alarm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.controller.controller import QUESTIONS, Controller
from planner.controller.situation import Situation, expect
from planner.doubles.rehearsal import GRIPPER, Stage, rehearsal_graph
from planner.explainer.recovery import RECOVERIES, RecoveryPolicy
from planner.plan import Step
from scene_graph.edges import EdgeKey, EdgeType, RelationEdge
from scene_graph.edits import PutEdge, PutNode, RemoveEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorState, ObjectState
from skills.failures import FailureCode

GOTO_BOTTLE = Step(skill="GOTO", args=("bottle_1",))
PICK = Step(skill="PICK", args=("bottle_1",))
GOTO_DESK = Step(skill="GOTO", args=("desk_1",))
PLACE = Step(skill="PLACE", args=("bottle_1", "desk_1"))
STEPS = (GOTO_BOTTLE, PICK, GOTO_DESK, PLACE)


class Scene:
    """A flat, what the plan counted on at its start, and a step under way."""

    def __init__(self, first: int = 0) -> None:
        self.memory = WorkingMemory(rehearsal_graph())
        self.stage = Stage(memory=self.memory)
        self.first, self.fields = first, {}
        self.expected = self.expect()

    def expect(self):
        self.expected = expect(STEPS[self.first :], self.memory.snapshot())
        return self.expected

    def hold(self):
        self.stage.places["bottle_1"] = GRIPPER
        self.stage.look(1.0)
        self.expect()

    def put(self, **changes):
        node_id = changes.pop("id", "bottle_1")
        node = replace(self.memory.snapshot().node(node_id), **changes)
        self.memory.commit([PutNode(node)], agent="test", stamp_s=1.0)

    def shift(self, dx_m, node_id="bottle_1"):
        edge = self.memory.snapshot().parent(node_id)
        moved = replace(edge, T_source_target=SE3.from_xyz_yaw(dx_m, 0.0, 0.0, 0.0) @ edge.T_source_target, stamp_s=0.1)
        self.memory.commit([PutEdge(moved)], agent="test", stamp_s=1.0)

    def relate(self, support):
        old = EdgeKey(EdgeType.RELATION, "bottle_1", "table_1", "on")
        new = RelationEdge(source="bottle_1", target=support, predicate="on", probability=0.9)
        self.memory.commit([RemoveEdge(old), PutEdge(new)], agent="test", stamp_s=1.0)

    def check(self):
        situation = Situation(
            snapshot=self.memory.snapshot(),
            stamp_s=42.0,
            step=STEPS[self.first],
            expected=self.expected,
            **self.fields,
        )
        answers = [Controller().check(situation) for _ in range(2)]
        assert answers[0] == answers[1]
        return answers[0]

    @property
    def code(self):
        failure = self.check()
        return None if failure is None else failure.code


@pytest.mark.parametrize("first", range(4))
def test_all_is_well_while_nothing_has_changed(first):
    scene = Scene(first)
    if first >= 2:
        scene.hold()
    assert scene.check() is None


def test_a_missing_object_is_gone_and_the_evidence_says_so():
    scene = Scene()
    scene.put(state=ObjectState.MISSING)
    failure = scene.check()
    assert failure.code is FailureCode.OBJECT_GONE
    assert failure.evidence.nodes == ("bottle_1", "table_1")
    assert failure.evidence.revision == scene.memory.snapshot().revision
    assert failure.message == (
        "The blue bottle is no longer on the table in the kitchen; I saw the empty place at 42 s."
    )


@given(st.floats(-1.0, 1.0).filter(lambda dx: abs(abs(dx) - 0.3) > 1e-6))
def test_an_object_has_moved_when_it_is_more_than_thirty_centimeters_off(dx_m):
    scene = Scene()
    scene.shift(dx_m)
    assert scene.code == (FailureCode.OBJECT_MOVED if abs(dx_m) > 0.3 else None)


def test_another_support_counts_only_with_a_shift():
    scene = Scene()
    scene.relate("shelf_1")
    assert scene.code is None
    scene.shift(0.2)
    failure = scene.check()
    assert failure.code is FailureCode.OBJECT_MOVED
    assert "on the shelf in the kitchen" in failure.message


def test_an_object_taken_to_another_room_has_moved():
    scene = Scene()
    scene.stage.places["bottle_1"] = scene.stage.robot_at = "desk_1"
    scene.stage.look(1.0)
    assert scene.code is FailureCode.OBJECT_MOVED


def test_what_the_robot_itself_is_grasping_may_move():
    scene = Scene(1)
    scene.shift(0.5)
    scene.put(id="robot", status="driving to bottle_1")
    assert scene.code is FailureCode.OBJECT_MOVED
    scene.put(id="robot", status="grasping bottle_1")
    assert scene.code is None
    scene.put(id="robot", status="idle")
    scene.fields = {"gripping": "bottle_1"}
    assert scene.code is None


@pytest.mark.parametrize(("seen", "code"), [(True, FailureCode.DROPPED), (False, FailureCode.SLIPPED)])
def test_a_lost_object_was_dropped_if_it_is_seen_and_slipped_if_not(seen, code):
    scene = Scene(2)
    scene.hold()
    scene.stage.places["bottle_1"] = "room_1" if seen else None
    scene.stage.look(2.0)
    assert scene.code is code


def test_letting_go_on_purpose_is_no_loss():
    scene = Scene(3)
    scene.hold()
    scene.stage.robot_at = scene.stage.places["bottle_1"] = "desk_1"
    scene.stage.look(2.0)
    assert scene.code is None
    scene.fields = {"gripping": "bottle_1"}
    assert scene.code is FailureCode.DROPPED


def test_a_support_that_is_gone_is_noticed_long_before_placing():
    scene = Scene()
    scene.put(id="desk_1", state=ObjectState.MISSING)
    failure = scene.check()
    assert failure.code is FailureCode.SUPPORT_GONE
    assert failure.message == "The desk in the office is not where it was."


def test_a_closed_door_matters_while_it_is_ahead_and_not_behind():
    scene = Scene(2)
    scene.hold()
    scene.put(id="door_1_0_0", state=DoorState.CLOSED)
    failure = scene.check()
    assert failure.code is FailureCode.DOOR_CLOSED
    assert failure.evidence.nodes == ("door_1_0_0",)
    scene.stage.stand_at("room_2", 1.0)
    assert scene.code is None


def test_the_sensor_silent_for_longest_is_named():
    scene = Scene()
    scene.fields = {"sensor_ages_s": {"lidar": 2.5, "camera": 7.0, "odometry": 0.0}}
    failure = scene.check()
    assert failure.code is FailureCode.SENSOR_SILENT
    assert "camera" in failure.message
    scene.fields = {"sensor_ages_s": {"lidar": 1.5, "camera": 0.2}}
    assert scene.code is None


def test_a_robot_that_does_not_know_where_it_is_says_so():
    scene = Scene()
    edge = scene.memory.snapshot().parent("robot")
    lost = replace(edge, covariance=np.diag([0.3, 0.01, 0.0, 0.0, 0.0, 0.0]))
    scene.memory.commit([PutEdge(lost)], agent="test", stamp_s=1.0)
    assert scene.code is FailureCode.LOCALIZATION_LOST


@pytest.mark.parametrize(("jump_m", "code"), [(0.05, None), (0.55, None), (0.8, FailureCode.ROBOT_MOVED)])
def test_a_robot_that_was_pushed_notices_the_jump(jump_m, code):
    scene = Scene()
    scene.fields = {"previous": scene.memory.snapshot()}
    scene.shift(jump_m, "robot")
    assert scene.code is code


def test_going_through_a_door_of_ones_way_is_no_jump():
    scene = Scene(first=2)
    scene.fields = {"previous": scene.memory.snapshot()}
    scene.stage.stand_at("desk_1", 1.0)
    assert scene.code is None


@pytest.mark.parametrize(("status", "code"), [("driving to x", FailureCode.ROBOT_MOVED), ("crossing door_1", None)])
def test_a_robot_that_is_in_another_room_without_having_gone_there_was_carried(status, code):
    scene = Scene()
    scene.put(id="robot", status=status)
    scene.fields = {"previous": scene.memory.snapshot()}
    scene.stage.stand_at("desk_1", 1.0)
    assert scene.code is code


def test_a_step_that_takes_too_long_times_out():
    scene = Scene()
    scene.fields = {"active_s": 61.0, "timeout_s": 60.0}
    assert scene.code is FailureCode.TIMEOUT


def test_the_most_basic_trouble_is_reported_first():
    scene = Scene()
    scene.put(state=ObjectState.MISSING)
    scene.fields = {"sensor_ages_s": {"camera": 9.0}}
    assert scene.code is FailureCode.SENSOR_SILENT
    assert len({type(question) for question in QUESTIONS}) == len(QUESTIONS)


def test_every_failure_code_has_a_recovery():
    assert set(RECOVERIES) == set(FailureCode)


@given(st.lists(st.tuples(st.sampled_from(FailureCode), st.sampled_from(["PICK(a)", "GOTO(b)"])), max_size=30))
def test_no_sequence_of_failures_is_recovered_from_for_ever(failures):
    recoveries = RecoveryPolicy(max_failures=5)
    recovered = [recoveries.after(code, step) for code, step in failures]
    assert sum(recovery is not None for recovery in recovered) <= 5
    for code, step in set(failures):
        tried = [r for r, failure in zip(recovered, failures, strict=True) if r and failure == (code, step)]
        assert len(tried) < RECOVERIES[code].times
