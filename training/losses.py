"""How wrong the network is, and which query is to answer for which thing."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor
from torch.nn import functional

from training.classes import STUFF, UNKNOWN
from training.dataset import Batch
from training.network import BACKGROUND, HEIGHT, HINTS, PEAKS, STRIDES, WIDTH, Answers, Network

_STUFF = len(STUFF)


@dataclass(frozen=True, kw_only=True)
class LossWeights:
    """What counts how much in the sum; chosen so that no part is drowned by the others."""

    heat: float = 1.0
    hint: float = 0.5
    kind: float = 2.0
    background: float = 0.6
    """Of queries that stand for nothing, among the kinds; they are many."""
    open_set: float = 0.5
    box: float = 2.0
    distance: float = 0.5
    mask: float = 3.0
    coarse: float = 1.0
    relation: float = 3.0


def assigned(peaks: tuple[Tensor, ...], batch: Batch) -> tuple[tuple[Tensor, ...], Tensor]:
    """Cells to answer for, and (B, N) which row each query stands for, -1 for nothing.

    A thing takes the peak nearest to its center, if one is near; else the least peak moves to its center.
    """
    count = _STUFF + sum(PEAKS)
    row_of = torch.full((len(batch.image), count), -1, dtype=torch.long)
    row_of[:, :_STUFF] = torch.where(batch.there[:, :_STUFF], torch.arange(_STUFF), -1)
    cells = tuple(peak.clone() for peak in peaks)
    start = _STUFF
    for which, (cell, stride) in enumerate(zip(cells, STRIDES, strict=True)):
        width = WIDTH // stride
        for b in range(len(cell)):
            rows = torch.nonzero(batch.there[b] & (batch.level[b] == which)).flatten()
            rows = rows[rows >= _STUFF][: cell.shape[1]]
            if not len(rows):
                continue
            box = batch.boxes[b, rows]
            center = torch.stack((cell[b] % width, cell[b] // width), dim=1) * stride + stride / 2
            apart = (center[None] - box[:, None, :2]).abs() / (0.25 * box[:, None, 2:] + 0.75 * stride)
            far = apart.amax(dim=2)
            taken: set[int] = set()
            homeless = []
            for k in range(len(rows)):
                order = torch.argsort(far[k])
                best = next((int(i) for i in order[:6] if int(i) not in taken and far[k, i] < 1.0), None)
                if best is None:
                    homeless.append(k)
                else:
                    taken.add(best)
                    row_of[b, start + best] = rows[k]
            free = [i for i in range(cell.shape[1] - 1, -1, -1) if i not in taken]
            for k, i in zip(homeless, free, strict=False):
                x = (box[k, 0] // stride).long().clamp(0, width - 1)
                y = (box[k, 1] // stride).long().clamp(0, HEIGHT // stride - 1)
                cell[b, i] = y * width + x
                row_of[b, start + i] = rows[k]
        start += cell.shape[1]
    return cells, row_of


def losses(network: Network, batch: Batch, weights: LossWeights = LossWeights()) -> dict[str, Tensor]:
    """Named parts of what is to be minimized, weighted."""
    features = network.features(batch.image)
    heat = sum(
        _focal(logits.float(), target, weight)
        for logits, target, weight in zip(features.heats, batch.heats, batch.heat_weights, strict=True)
    )
    with torch.no_grad():
        cells, row_of = assigned(network.peaks(features), batch)
        standing = _standing(row_of)
    found = network.answers(features, cells, standing)
    hint = sum(
        _of_cells(tell(features.pyramid[level]), batch, 4 << level)
        for tell, level in zip(network.hints, HINTS, strict=True)
    )
    return {
        "heat": weights.heat * heat,
        "hint": weights.hint * hint,
        **_of_answers(found, row_of, standing, batch, weights),
    }


def _of_cells(logits: Tensor, batch: Batch, stride: int) -> Tensor:
    """Cross entropy of the kinds of what cells show; what is large counts as the root of its cells."""
    ids = batch.ids[:, stride // 2 :: stride, stride // 2 :: stride].long()
    count = batch.classes.shape[1]
    shown = ids < count
    row = ids.clamp(max=count - 1).flatten(1)
    kind = batch.classes.gather(1, row).reshape(ids.shape)
    kind = torch.where(shown & (kind != UNKNOWN), kind, -1)
    cells = torch.zeros(len(ids), count).scatter_add_(1, row, shown.flatten(1).float())
    weight = (kind >= 0) / cells.clamp(min=1).sqrt().gather(1, row).reshape(ids.shape)
    entropy = functional.cross_entropy(logits.float(), kind.clamp(min=0), reduction="none")
    return (entropy * weight).sum() / weight.sum().clamp(min=1)


def _standing(row_of: Tensor) -> Tensor:
    """(B, S) queries that stand for something first, S the most that do in any picture."""
    stands = row_of >= 0
    return torch.argsort(stands.int(), dim=1, descending=True, stable=True)[:, : int(stands.sum(dim=1).max())]


def _focal(logits: Tensor, target: Tensor, weight: Tensor) -> Tensor:
    """Focal loss of heat maps (Law and Deng 2018, equation 1), per thing."""
    p = torch.sigmoid(logits).clamp(1e-4, 1.0 - 1e-4)
    hit = target > 0.999
    found = -((1 - p) ** 2) * torch.log(p)
    spared = -((1 - target) ** 4) * p**2 * torch.log(1 - p)
    return (torch.where(hit, found, spared) * weight).sum() / hit.sum().clamp(min=1)


def _of_answers(
    found: Answers, row_of: Tensor, standing: Tensor, batch: Batch, weights: LossWeights
) -> dict[str, Tensor]:
    b, n = torch.nonzero(row_of >= 0, as_tuple=True)
    row = row_of[b, n]
    kind = torch.full_like(row_of, BACKGROUND)
    kind[b, n] = batch.classes[b, row]
    named = kind != UNKNOWN
    weight = torch.where(kind == BACKGROUND, weights.background, 1.0) * named
    entropy = functional.cross_entropy(
        found.classes.flatten(0, 1), kind.clamp(min=0).flatten(), reduction="none", label_smoothing=0.02
    ).reshape(kind.shape)
    classes = (entropy * weight).sum() / weight.sum()
    open_set = _undecided(found.classes[~named])
    things = row >= _STUFF
    box = batch.boxes[b, row] / torch.tensor((WIDTH, HEIGHT) * 2)
    boxes = ((found.boxes[b, n] - box).abs().sum(-1) * things).sum() / things.sum().clamp(min=1)
    log_distance = batch.log_distance[b, row]
    known = torch.isfinite(log_distance) & things
    away = (found.log_distance[b, n] - torch.nan_to_num(log_distance)).abs()
    distance = (away * known).sum() / known.sum().clamp(min=1)
    rows = row_of.gather(1, standing)
    drawn = torch.nonzero(rows >= 0, as_tuple=True)
    truth = (batch.ids[drawn[0]] == rows[drawn][:, None, None].to(torch.uint8)).float()[:, None]
    masks = _mask_loss(found.masks[drawn][:, None], functional.avg_pool2d(truth, 4))
    coarse = _mask_loss(found.coarse[drawn[0], standing[drawn]][:, None], functional.avg_pool2d(truth, 8))
    return {
        "kind": weights.kind * classes + weights.open_set * open_set,
        "box": weights.box * boxes,
        "distance": weights.distance * distance,
        "mask": weights.mask * masks,
        "coarse": weights.coarse * coarse,
        "relation": weights.relation * _related(found.relations, rows, batch),
    }


def _undecided(logits: Tensor) -> Tensor:
    """For what has no name: surely something, and every kind as likely as any other."""
    if not len(logits):
        return logits.sum()
    log_p = torch.log_softmax(logits, dim=-1)
    return -log_p[:, :-1].mean(dim=-1).mean() + torch.log(torch.tensor(1.0 / BACKGROUND))


def _mask_loss(logits: Tensor, truth: Tensor) -> Tensor:
    """Dice and cross entropy, the latter per pixel of the thing, so that small ones count as much."""
    p = torch.sigmoid(logits)
    area = truth.sum(dim=(1, 2, 3))
    dice = 1.0 - (2.0 * (p * truth).sum(dim=(1, 2, 3)) + 1.0) / ((p * p + truth * truth).sum(dim=(1, 2, 3)) + 1.0)
    entropy = functional.binary_cross_entropy_with_logits(logits, truth, reduction="none").sum(dim=(1, 2, 3))
    return (dice + 0.5 * entropy / (2.0 * area + 8.0)).mean()


def _related(logits: Tensor, row_of: Tensor, batch: Batch) -> Tensor:
    """Cross entropy over pairs of queries that both stand for something, per true relation."""
    stands = row_of >= 0
    pairs = stands[:, :, None] & stands[:, None, :]
    pairs &= ~torch.eye(row_of.shape[1], dtype=torch.bool)
    b, i, j = torch.nonzero(pairs, as_tuple=True)
    truth = batch.relations[b, row_of[b, i], row_of[b, j]]
    entropy = functional.cross_entropy(logits[b, i, j], truth, reduction="none")
    return entropy.sum() / ((truth > 0).sum() + 8.0) * 0.5
