"""Training: pictures in, a checkpoint every minute, to go on from."""

from __future__ import annotations

import copy
import math
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor
from torch.utils.data import DataLoader

from training.dataset import Batch, Lessons, batch_of
from training.export import weights_of
from training.losses import losses
from training.muon import Muon
from training.network import Network
from training.shards import Examples

_ENDS = ("stuff", "stem.0", "embed", "heat_", "coarse", "fine", "kind.2", "box.2", "relation.2", "hints")
"""Parts of names of weights at the input and at the outputs, which AdamW trains like all that is no matrix."""


@dataclass(frozen=True, kw_only=True)
class Course:
    """How long and how fast; chosen."""

    steps: int
    """The learning rate falls to nothing within them."""
    batch: int = 16
    rate: float = 2e-3
    """Learning rate where it begins."""
    weight_decay: float = 0.02
    warm_up_steps: int = 300
    mosaics: float = 0.6
    """Share of examples of the first part that are put together from several pictures."""
    mosaics_until: float = 0.7
    """Share of the course after which there are whole pictures only, as the network will see them."""
    keep: float = 0.999
    """Share of the mean of the weights that each step leaves: the mean is over about a thousand steps."""
    clip: float = 5.0
    """Greatest norm of a gradient."""
    workers: int = 1
    seed: int = 0


def fit(
    shards: Callable[[], Iterable[Path]],
    *,
    checkpoint: Path,
    course: Course,
    tell: Callable[[str], None],
    begin: Path | None = None,
) -> Network:
    """The mean of the network over the last steps. ``shards`` is asked again before every pass.

    Goes on from ``checkpoint`` where there is one, with the steps that are left of the course; else a new course begins
    with the weights of the exported network ``begin``, or with random ones.
    """
    torch.manual_seed(course.seed)
    network = Network().to(memory_format=torch.channels_last)
    if begin is not None:
        network.load_state_dict({**network.state_dict(), **weights_of(begin)})
    mean = copy.deepcopy(network)
    optimizers = _optimizers(network, course)
    step, passes = 0, 0
    if checkpoint.exists():
        kept = torch.load(checkpoint, weights_only=True)
        network.load_state_dict(kept["network"])
        mean.load_state_dict(kept["mean"])
        for optimizer, state in zip(optimizers, kept["optimizers"], strict=True):
            optimizer.load_state_dict(state)
        step, passes = kept["step"], kept["passes"]
    known: list[Path] = []
    lessons: Lessons | None = None
    sums: dict[str, float] = {}
    said, told_s = step, time.monotonic()
    while step < course.steps:
        passes += 1
        files = list(shards())
        if lessons is None or files != known:
            known, lessons = files, Lessons(Examples(files), vary=True)
        mixing = step < course.mosaics_until * course.steps
        lessons.mosaics = course.mosaics if mixing else 0.0
        torch.manual_seed(course.seed * 1000 + passes)
        loader = DataLoader(
            lessons, course.batch, shuffle=True, drop_last=True, num_workers=course.workers, collate_fn=batch_of,
            prefetch_factor=4 if course.workers else None,
        )  # fmt: skip
        for batch in loader:
            warm = min(1.0, (step + 1) / course.warm_up_steps)
            for group in (group for optimizer in optimizers for group in optimizer.param_groups):
                group["lr"] = course.rate * warm * 0.5 * (1.0 + math.cos(math.pi * step / course.steps))
            parts = _step(network, batch, optimizers, clip=course.clip)
            step += 1
            _follow(mean, network, min(course.keep, (1.0 + step) / (10.0 + step)))
            for name, value in parts.items():
                sums[name] = sums.get(name, 0.0) + value
            if time.monotonic() - told_s > 60.0:
                rate = (step - said) * course.batch / (time.monotonic() - told_s)
                means = "  ".join(f"{name} {value / (step - said):.3f}" for name, value in sums.items())
                tell(f"step {step} of {course.steps}, {len(lessons)} pictures, {rate:.0f}/s: {means}")
                sums, said, told_s = {}, step, time.monotonic()
                _save(checkpoint, network, mean, optimizers, step, passes)
            if step >= course.steps or (mixing and step >= course.mosaics_until * course.steps):
                break
    _save(checkpoint, network, mean, optimizers, step, passes)
    return mean


def trained(checkpoint: Path) -> Network:
    """The network of a checkpoint, the mean over its last steps."""
    network = Network()
    network.load_state_dict(torch.load(checkpoint, weights_only=True)["mean"])
    return network


def _optimizers(network: Network, course: Course) -> tuple[torch.optim.Optimizer, ...]:
    """Muon for the matrices inside, AdamW for the rest."""
    inside: list[Tensor] = []
    rest: list[Tensor] = []
    for name, weight in network.named_parameters():
        (inside if weight.ndim > 1 and not any(end in name for end in _ENDS) else rest).append(weight)
    return (
        Muon(inside, rate=course.rate, weight_decay=course.weight_decay),
        torch.optim.AdamW(rest, lr=course.rate, weight_decay=course.weight_decay, fused=True),
    )


def _step(
    network: Network, batch: Batch, optimizers: Sequence[torch.optim.Optimizer], *, clip: float
) -> dict[str, float]:
    network.train()
    batch.image = batch.image.contiguous(memory_format=torch.channels_last)
    with torch.autocast("cpu", torch.bfloat16):
        parts = losses(network, batch)
    total: Tensor = torch.stack([part.float() for part in parts.values()]).sum()
    network.zero_grad(set_to_none=True)
    if torch.isfinite(total):
        total.backward()
        torch.nn.utils.clip_grad_norm_(network.parameters(), clip)
        for optimizer in optimizers:
            optimizer.step()
    return {name: float(part.detach()) for name, part in parts.items()}


def _follow(mean: Network, network: Network, keep: float) -> None:
    """Move the mean a little towards the network."""
    with torch.no_grad():
        for kept, new in zip(mean.state_dict().values(), network.state_dict().values(), strict=True):
            if kept.is_floating_point():
                kept.lerp_(new, 1.0 - keep)
            else:
                kept.copy_(new)


def _save(
    file: Path,
    network: Network,
    mean: Network,
    optimizers: Sequence[torch.optim.Optimizer],
    step: int,
    passes: int,
) -> None:
    part = file.with_suffix(".part")
    state = {
        "network": network.state_dict(),
        "mean": mean.state_dict(),
        "optimizers": [optimizer.state_dict() for optimizer in optimizers],
        "step": step,
        "passes": passes,
    }
    torch.save(state, part)
    part.replace(file)
