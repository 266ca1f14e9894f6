"""Muon (Jordan et al. 2024): steps along orthogonal matrices, for weights that are matrices.

On these pictures the loss falls as far in about two thirds of the steps that AdamW needs.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

import torch
from torch import Tensor

_NEWTON_SCHULZ = (3.4445, -4.7750, 2.0315)
_RMS = 0.2
"""Root mean square of a step's elements at a rate of one; AdamW's is about that, so both take the same rate."""


class Muon(torch.optim.Optimizer):
    """For weights of two dimensions and more; of filters all but the first count as one."""

    def __init__(
        self, weights: Iterable[Tensor], *, rate: float, weight_decay: float, momentum: float = 0.95, rounds: int = 5
    ) -> None:
        super().__init__(list(weights), {"lr": rate, "weight_decay": weight_decay, "momentum": momentum})
        self._rounds = rounds

    @torch.no_grad()  # type: ignore[untyped-decorator]
    def step(self, closure: None = None) -> None:  # noqa: ARG002 - none is called
        """Move all weights that have a gradient. Matrices of one shape are worked on together."""
        for group in self.param_groups:
            of_shape: dict[torch.Size, list[tuple[Tensor, Tensor]]] = defaultdict(list)
            for weight in group["params"]:
                if weight.grad is not None:
                    update = self._with_momentum(weight, weight.grad, group["momentum"]).reshape(len(weight), -1)
                    of_shape[update.shape].append((weight, update))
            for shape, members in of_shape.items():
                steps = orthogonal(torch.stack([update for _, update in members]), self._rounds)
                for (weight, _), step in zip(members, steps, strict=True):
                    weight.mul_(1.0 - group["lr"] * group["weight_decay"])
                    size = _RMS * max(shape) ** 0.5
                    weight.add_(step.reshape(weight.shape).to(weight.dtype), alpha=-group["lr"] * size)

    def _with_momentum(self, weight: Tensor, gradient: Tensor, momentum: float) -> Tensor:
        """Nesterov's."""
        state = self.state[weight]
        if "mean" not in state:
            state["mean"] = torch.zeros_like(weight)
        state["mean"].lerp_(gradient, 1.0 - momentum)
        return gradient.lerp(state["mean"], momentum)


def orthogonal(matrices: Tensor, rounds: int) -> Tensor:
    """(K, M, N) matrices whose singular values are all about one, by Newton and Schulz's iteration, bfloat16."""
    a, b, c = _NEWTON_SCHULZ
    x = matrices.bfloat16()
    tall = x.shape[1] > x.shape[2]
    x = x.mT if tall else x
    x = x / (x.norm(dim=(1, 2), keepdim=True) + 1e-7)
    for _ in range(rounds):
        square = x @ x.mT
        x = a * x + (b * square + c * square @ square) @ x
    return x.mT if tall else x
