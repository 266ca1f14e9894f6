"""Asks a language model for goals, checks them, and sends flaws back: at most five rounds within one deadline."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Collection
from typing import Any

from planner.goals import Goal
from planner.models.protocol import (
    CORRECTABLE,
    FailureKind,
    LanguageModel,
    Message,
    ModelFailure,
    ModelReply,
    ModelRequest,
    Role,
)
from planner.plan import Dialogue, Impossible, Interpretation, Kind, Source
from planner.skill_planner.skill_planner import skill_lines
from planner.skill_planner.verifier import Verifier
from planner.task_planner.outline import Outline, outline
from planner.task_planner.proposal import Proposal, goals_of, read_proposal, schema
from planner.task_planner.settings import OutlineSettings, TaskPlannerSettings
from prompts.templates import render
from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot

_PASSING = frozenset({FailureKind.REFUSAL, FailureKind.TIMEOUT})
"""What the same question may not meet again, as long as there is time."""


class ModelRounds:
    """The conversation with a language model about one request at a time."""

    def __init__(
        self,
        model: LanguageModel,
        verifier: Verifier,
        journal: Callable[[dict[str, Any]], None],
        settings: TaskPlannerSettings = TaskPlannerSettings(),
        *,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._model, self._verifier, self._journal = model, verifier, journal
        self._settings, self._clock = settings, clock

    async def run(self, text: str, snapshot: Snapshot, dialogue: Dialogue) -> Interpretation | ModelFailure:
        """A checked interpretation, or why there is none. The ``reply`` of an answer is the question."""
        scene = _scene(text, snapshot, dialogue, self._settings.outline)
        messages = self._opening(text, scene, dialogue)
        end_s, repeated = self._clock() + self._settings.deadline_s, 0
        failure = ModelFailure(kind=FailureKind.TIMEOUT, message="there was no time to ask it")
        for number in range(1, self._settings.rounds + 1):
            left_s = end_s - self._clock()
            if left_s <= 0:
                return ModelFailure(
                    kind=FailureKind.TIMEOUT, message=f"no usable answer within {self._settings.deadline_s:.0f} s"
                )
            request = ModelRequest(
                messages=tuple(messages), schema=schema(scene.identifiers), schema_name="robot_request"
            )
            answer = await self._ask(
                request, left_s, {"task": dialogue.task, "model": self._model.name, "round": number}
            )
            outcome = self._checked(answer, snapshot, scene.identifiers) if isinstance(answer, ModelReply) else answer
            if isinstance(outcome, Interpretation):
                return outcome
            failure = outcome
            if failure.kind in CORRECTABLE:
                messages += _correction(answer.text, failure)
            elif failure.kind in _PASSING and repeated < self._settings.repeats:
                repeated += 1
            else:
                return failure
        return ModelFailure(
            kind=failure.kind, message=f"after {self._settings.rounds} rounds, {failure.message}", text=failure.text
        )

    def _opening(self, text: str, scene: Outline, dialogue: Dialogue) -> list[Message]:
        said = [f"robot: {json.dumps(question)} person: {json.dumps(answer)}" for question, answer in dialogue.answers]
        mentioned = f"spoken of lately: {', '.join(dialogue.mentioned[:8])}" if dialogue.mentioned else ""
        request = render(
            "task_request",
            scene=scene.text,
            dialogue="; ".join(part for part in (*said, mentioned) if part) or "nothing",
            request=json.dumps(text, ensure_ascii=False),
        )
        rules = render("task_planner", skills=skill_lines(self._verifier.skills))
        return [Message(role=Role.SYSTEM, text=rules), Message(role=Role.USER, text=request)]

    async def _ask(self, request: ModelRequest, deadline_s: float, about: dict[str, Any]) -> ModelReply | ModelFailure:
        prompt = [{"role": message.role.value, "text": message.text} for message in request.messages]
        self._journal({"event": "model_prompt", **about, "messages": prompt})
        answer = await self._model.complete(request, deadline_s)
        entry: dict[str, Any] = {"event": "model_answer", **about, "attempts": answer.attempts, "text": answer.text}
        if isinstance(answer, ModelReply):
            entry |= {"prompt_tokens": answer.prompt_tokens, "completion_tokens": answer.completion_tokens}
        else:
            entry |= {"failure": answer.kind.value, "message": answer.message}
        self._journal(entry)
        return answer

    def _checked(self, answer: ModelReply, snapshot: Snapshot, shown: Collection[str]) -> Interpretation | ModelFailure:
        """The answer, if its goals are about nodes that the model was ``shown`` and there is a plan for them."""
        proposal = read_proposal(answer.data)
        if isinstance(proposal, ModelFailure):
            return proposal
        kind = Kind(proposal.kind)
        if kind is not Kind.PLAN:
            reply = proposal.question if kind is Kind.ANSWER else proposal.reply
            return Interpretation(kind=kind, source=Source.MODEL, reply=reply)
        goals = goals_of(proposal, shown)
        return goals if isinstance(goals, ModelFailure) else self._verified(goals, proposal, snapshot)

    def _verified(
        self, goals: tuple[Goal, ...], proposal: Proposal, snapshot: Snapshot
    ) -> Interpretation | ModelFailure:
        """Goals for which there is a plan; those with missing objects are planned for when these have been found."""
        flaws = self._verifier.verify_goals(goals, snapshot)
        if flaws:
            return ModelFailure(kind=FailureKind.WRONG_SHAPE, message=flaws[0].message)
        if not any(_is_missing(arg, snapshot) for goal in goals for arg in goal.args):
            plan = self._verifier.plan_for(goals, snapshot, source=Source.MODEL)
            if isinstance(plan, Impossible):
                return ModelFailure(kind=FailureKind.WRONG_SHAPE, message=plan.reason)
        mentioned = tuple(dict.fromkeys(arg for goal in goals for arg in goal.args))
        return Interpretation(
            kind=Kind.PLAN, source=Source.MODEL, goals=goals, reply=proposal.reply, mentioned=mentioned
        )


def _correction(text: str, failure: ModelFailure) -> list[Message]:
    flaw = failure.message if failure.message.endswith((".", ":")) else f"{failure.message}."
    return [
        Message(role=Role.ASSISTANT, text=text[:4000] or "(nothing)"),
        Message(role=Role.USER, text=render("task_correction", flaw=flaw)),
    ]


def _is_missing(node_id: str, snapshot: Snapshot) -> bool:
    node = snapshot.get(node_id)
    return isinstance(node, ObjectNode) and node.state is ObjectState.MISSING


def _scene(text: str, snapshot: Snapshot, dialogue: Dialogue, settings: OutlineSettings) -> Outline:
    """What the request may be about: *put it back* is about where that was, an answer about what was asked."""
    origins = [dialogue.origins[thing] for thing in dialogue.mentioned if thing in dialogue.origins]
    answered = [part for pair in dialogue.answers for part in pair]
    before = " ".join((*answered, *(exchange.request for exchange in dialogue.earlier[:1])))
    return outline(snapshot, text, mentioned=(*dialogue.mentioned, *origins), before=before, settings=settings)
