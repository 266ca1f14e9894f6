"""What language models are asked: how often, and how much they have to read."""

from __future__ import annotations

import math

from planner.models.budget import BYTES_PER_TOKEN, tokens_needed
from planner.models.protocol import FailureKind, LanguageModel, ModelFailure, ModelReply, ModelRequest
from planner.models.scripted import ScriptedModel
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from planner.task_planner.model_rounds import ModelRounds
from planner.task_planner.settings import TaskPlannerSettings
from planner.task_planner.task_planner import no_journal
from scene_graph.snapshot import Snapshot
from skills.registry import load_registry


class CountedModel:
    """A language model, how often it was asked, and whether what it said last was a question of its own."""

    def __init__(self, model: LanguageModel) -> None:
        self._model = model
        self.calls = 0
        self.questions = False

    @property
    def name(self) -> str:
        """As the model's own."""
        return self._model.name

    async def complete(self, request: ModelRequest, deadline_s: float) -> ModelReply | ModelFailure:
        """The model's answer."""
        self.calls += 1
        answer = await self._model.complete(request, deadline_s)
        self.questions = isinstance(answer, ModelReply) and answer.data.get("kind") == Kind.CLARIFY
        return answer


async def prompt_tokens(text: str, snapshot: Snapshot) -> tuple[int, int]:
    """Estimated tokens of what a model would read of a first turn: the prompt, and the prompt with its schema."""
    down = ModelFailure(kind=FailureKind.ENDPOINT_DOWN, message="nobody is asked")
    recorder = ScriptedModel(lambda _: down)
    await ModelRounds(recorder, Verifier(load_registry()), no_journal, TaskPlannerSettings(deadline_s=60.0)).run(
        text, snapshot, Dialogue()
    )
    request = recorder.requests[0]
    prompt = sum(len(message.text.encode("utf-8", "replace")) for message in request.messages)
    return math.ceil(prompt / BYTES_PER_TOKEN), tokens_needed(request) - request.max_tokens
