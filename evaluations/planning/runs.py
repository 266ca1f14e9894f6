"""Requests put to the planner, one conversation each, and a record of every one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.progress import track

from app.garbage_collection import exempt_what_is_loaded
from evaluations.planning.buildings import building
from evaluations.planning.conversation import Conversation
from evaluations.planning.corruption import Deaf, Oracle, can_be_put
from evaluations.planning.judging.expectations import Request
from evaluations.planning.judging.judge import Judgement, Verdict, judge
from evaluations.planning.model_usage import CountedModel, prompt_tokens
from planner.language.grammar.parser import CommandGrammar
from planner.models.protocol import LanguageModel
from planner.models.scripted import ScriptedModel


@dataclass(frozen=True, kw_only=True)
class Record:
    """What came of one request. ``ms``, ``wall_ms``: of each turn. ``prompt_tokens``: of the first, without and
    with the schema.

    ``executable``: whether all plans could be carried out. ``asked``: calls of the model.
    """

    request: Request
    verdict: Verdict
    reason: str
    ms: tuple[float, ...]
    wall_ms: tuple[float, ...]
    executable: bool
    acted: bool
    nodes: int
    asked: int = 0
    slips: tuple[str, ...] = ()
    prompt_tokens: tuple[int, int] = (0, 0)


async def run_all(
    requests: Sequence[Request], console: Console, model: LanguageModel | None = None, folder: Path | None = None
) -> list[Record]:
    """Every request with the grammar, and with ``model`` for what it cannot parse."""
    grammar = CommandGrammar()
    for name in dict.fromkeys(request.building for request in requests):
        building(name, folder)
    exempt_what_is_loaded()
    return [
        await run_one(request, grammar, model, folder=folder)
        for request in track(requests, description="requests", console=console)
    ]


async def run_corrupted(
    requests: Sequence[Request], rate: float, seed: int, console: Console, folder: Path | None = None
) -> list[Record]:
    """Every request that a model can answer, with a model that slips at ``rate`` and no grammar before it."""
    deaf = Deaf()
    fit = [request for request in requests if all(can_be_put(turn.expected) for turn in request.turns)]
    records = []
    for request in track(fit, description=f"slips at {rate:g}", console=console):
        oracle = Oracle(rate, f"{seed} {request.name}")
        records.append(await run_one(request, deaf, ScriptedModel(oracle.speak), oracle=oracle, folder=folder))
    return records


async def run_one(
    request: Request,
    grammar: CommandGrammar,
    model: LanguageModel | None = None,
    *,
    oracle: Oracle | None = None,
    folder: Path | None = None,
) -> Record:
    """All turns of a request, until one goes wrong."""
    snapshot = building(request.building, folder)
    counted = CountedModel(model) if model is not None else None
    talk = Conversation(snapshot, grammar, counted)
    judgement = Judgement(verdict=Verdict.RIGHT)
    ms: list[float] = []
    wall_ms: list[float] = []
    executable, acted = True, False
    for number, turn in enumerate(request.turns, 1):
        if oracle is not None:
            oracle.hear(turn, talk.snapshot)
        if counted is not None:
            counted.questions = False
        outcome = await talk.say(turn.text)
        ms.append(outcome.ms)
        wall_ms.append(outcome.wall_ms)
        executable, acted = executable and not outcome.obstacle, acted or outcome.acts
        judgement = judge(outcome, turn.expected, own_words=counted is not None and counted.questions)
        if judgement.verdict is not Verdict.RIGHT:
            if len(request.turns) > 1:
                judgement = Judgement(verdict=judgement.verdict, reason=f"turn {number}, {judgement.reason}")
            break
    return Record(
        request=request,
        verdict=judgement.verdict,
        reason=judgement.reason,
        ms=tuple(ms),
        wall_ms=tuple(wall_ms),
        executable=executable,
        acted=acted,
        nodes=len(snapshot.nodes),
        asked=counted.calls if counted is not None else 0,
        slips=tuple(oracle.slips) if oracle is not None else (),
        prompt_tokens=await prompt_tokens(request.turns[0].text, snapshot) if oracle is None else (0, 0),
    )
