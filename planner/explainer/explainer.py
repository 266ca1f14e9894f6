"""The Explainer: failures and outcomes in sentences that a person understands (design, section 8). Needs no model.

Names that a camera saw or a person typed go into sentences as they are; nothing here reads them as instructions.
"""

from __future__ import annotations

from collections.abc import Sequence

from planner.explainer.recovery import RECOVERIES
from planner.goals import Goal, goal
from planner.language.lexicon.vocabulary import PERSON
from planner.naming import aim_phrase, goal_phrase, humanize, listed, name_of, places_phrase, step_phrase
from planner.plan import Plan, Step
from planner.tasks.tasks import FailureReport, StepStatus, Task
from scene_graph.nodes import ObjectNode, PersonNode
from scene_graph.snapshot import Snapshot
from skills.failures import Failure

HOPELESS = "I stop here; ask me again when this has changed."


def explain(failure: Failure, step: Step, snapshot: Snapshot, *, hopeless: bool = False) -> FailureReport:
    """What failed at which step, on what evidence, and what will be tried next, if anything."""
    tried = RECOVERIES[failure.code].suggestion.format(thing=_thing(failure, step, snapshot))
    suggestion = HOPELESS if hopeless else tried
    return FailureReport(
        step=str(step),
        code=failure.code.value,
        message=humanize(failure.message, snapshot, meant={*failure.evidence.nodes, *step.args}),
        evidence=failure.evidence,
        suggestion=suggestion,
    )


def plan_sentence(plan: Plan, snapshot: Snapshot) -> str:
    """What the robot is going to do: "I will go to the table, pick up the blue bottle and go to the desk"."""
    if plan.seeking is not None:
        places = places_phrase([step.args[0] for step in plan.steps], snapshot)
        if plan.seeking == PERSON:
            return f"I do not know where you are; I will look for you in {places}."
        if plan.seeking not in snapshot:
            return f"I have not seen “{plan.seeking}” yet; I will look for it at {places}."
        return f"I do not know where {name_of(plan.seeking, snapshot)} is now; I will look at {places}."
    if not plan.steps:
        return "Nothing needs to be done; I will only check."
    return f"I will {listed([step_phrase(step, snapshot) for step in plan.steps])}."


def success_sentence(task: Task, goals: Sequence[Goal], snapshot: Snapshot, stamp_s: float) -> str:
    """What is so now, on what evidence, what was put elsewhere for it, and what it took."""
    said = [_confirmed_phrase(each, snapshot) for each in goals]
    sentence = f"Done: {listed(said)}."
    if put := _put_aside(task, goals, snapshot):
        sentence += f" On the way I {listed(put)}."
    if task.times.started_s is not None:
        sentence += f" It took {stamp_s - task.times.started_s:.0f} s"
        sentence += f" and {_count(task.replans, 'change')} of plan." if task.replans else "."
    return sentence


def failure_sentence(goals: Sequence[Goal], reason: str, snapshot: Snapshot) -> str:
    """That the task failed, why, and what the robot holds: one honest sentence, and one more if its hand is full."""
    aims = listed([aim_phrase(goal, snapshot) for goal in goals])
    sentence = f"I could not {aims}: {_lower_first(humanize(reason, snapshot).rstrip('.'))}."
    return " ".join(part for part in (sentence, holding_sentence(snapshot)) if part)


def unseen_sentence(goal: Goal, snapshot: Snapshot) -> str:
    """That a goal could not be confirmed by looking."""
    return f"I looked, and could not see that {goal_phrase(goal, snapshot)}."


def holding_sentence(snapshot: Snapshot) -> str:
    """What is in the gripper, ``""`` when nothing is."""
    held = snapshot.robot.holding if snapshot.robot is not None else None
    return f"I am still holding {name_of(held, snapshot)}." if held is not None else ""


def exhausted_reason(object_id: str, looked: Sequence[str], skipped: Sequence[str], snapshot: Snapshot) -> str:
    """Why a search gave up: where it looked, and where it could not look."""
    places = places_phrase(looked, snapshot)
    reason = f"{name_of(object_id, snapshot)} is not where I had seen it"
    reason += f", and I did not find it at {places}" if places else ", and there is nowhere else that I can look"
    if skipped:
        reason += f"; I could not get to {places_phrase(skipped, snapshot)}"
    return reason


def scouted_sentence(looked: Sequence[str], skipped: Sequence[str], snapshot: Snapshot, *, what: str = "it") -> str:
    """Where a thing, or anybody, was looked for that had never been seen, in vain; ``""`` if nowhere."""
    places = places_phrase([place for place in looked if place in snapshot], snapshot)
    missed = places_phrase([place for place in skipped if place in snapshot], snapshot)
    sentence = f"I looked at {places}, and did not find {what}." if places else ""
    return f"{sentence} I could not get to {missed}.".strip() if missed else sentence


def give_up_reason(failure: Failure, times: int) -> str:
    """Why the robot stops trying after the same failure again and again."""
    return failure.message if times < 2 else f"I tried {times} times, and at last: {_lower_first(failure.message)}"


def _thing(failure: Failure, step: Step, snapshot: Snapshot) -> str:
    """What the failure is about: the first object of its evidence, else of the step."""
    for node_id in (*failure.evidence.nodes, *step.args):
        if isinstance(snapshot.get(node_id), ObjectNode | PersonNode):
            return name_of(node_id, snapshot)
    return "it"


def _put_aside(task: Task, goals: Sequence[Goal], snapshot: Snapshot) -> list[str]:
    """What stood in the way or was in the hand, and where the last plan has put it."""
    asked = {arg for each in goals for arg in each.args}
    steps = task.plan.steps if task.plan is not None else ()
    done = [step.args[0] for step in steps if step.skill == "PLACE" and step.status is StepStatus.SUCCEEDED]
    places = {thing: snapshot.support_of(thing) or snapshot.room_of(thing) for thing in done if thing not in asked}
    return [aim_phrase(goal("on", thing, place), snapshot) for thing, place in places.items() if place is not None]


def _confirmed_phrase(goal: Goal, snapshot: Snapshot) -> str:
    node = snapshot.get(goal.args[0])
    phrase = goal_phrase(goal, snapshot)
    held = snapshot.robot is not None and snapshot.robot.holding == goal.args[0]
    return f"{phrase} (seen at {node.last_seen_s:.0f} s)" if isinstance(node, ObjectNode) and not held else phrase


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _lower_first(text: str) -> str:
    """Lower case at the start, except for ``I``."""
    first, _, _ = text.partition(" ")
    return text if first in ("I", "I'm") else text[:1].lower() + text[1:]
