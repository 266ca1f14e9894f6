"""The panoptic scene graph network: centers become queries, queries become masks, kinds and relations.

Every thing is found by the peak that its center makes in a heat map of its size (Zhou et al. 2019, CenterNet). The
features there become a query, which draws a mask through filters of its own (Tian et al. 2020, CondInst), pools the
features under it, looks closely at a grid of places around it (He et al. 2017, RoIAlign), and at the other queries,
before it says what it is. Pairs of queries give the relations.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from training.classes import CLASSES, PREDICATES, STUFF

HEIGHT, WIDTH = 192, 256
STRIDES = (4, 16)
"""Of the heat maps of smaller and of larger things."""
PEAKS = (30, 12)
HINTS = (1, 2)
"""Levels of the pyramid, at strides 8 and 16, that training asks for the kind of what every cell shows."""
QUERIES = len(STUFF) + sum(PEAKS)
TRIPLETS = 64
BACKGROUND = len(CLASSES)
_WIDTHS = (24, 48, 96, 160, 224)
_PYRAMID = 64
_DIM = 128
_EMBEDDING, _HIDDEN = 16, 8
_FILTERS = (_EMBEDDING + 2) * _HIDDEN + _HIDDEN + _HIDDEN + 1
_SHIFTS = ((0, 0), (0, 1), (0, -1), (1, 0), (-1, 0))
_GEOMETRY = 2 * 5 + 4 + 1 + 2 * len(_SHIFTS)
_GRID, _CELL = 7, 64
_REACH = 2.0
"""Half the side of the grid, in standard deviations of the first guess at the mask; a filled box has 1.7."""


@dataclass(frozen=True, kw_only=True)
class Features:
    """``pyramid``: (B, D, h, w) at strides 4, 8, 16, 32; ``edges``: (B, A, h, w) at stride 2.

    ``embedding`` (B, E, h, w) at stride 4; ``heats``: logits.
    """

    edges: Tensor
    pyramid: tuple[Tensor, ...]
    embedding: Tensor
    heats: tuple[Tensor, Tensor]


@dataclass(frozen=True, kw_only=True)
class Answers:
    """For N queries: ``classes`` (B, N, C + 1) logits, background last; ``masks`` (B, N, H / 4, W / 4) and the first
    guess ``coarse`` (B, N, H / 8, W / 8), logits; ``boxes`` (B, N, 4) center x, y, width, height as fractions;
    ``log_distance`` (B, N) log of the distance in meters; ``relations`` (B, N, N, P + 1) logits, background first.
    """

    classes: Tensor
    masks: Tensor
    coarse: Tensor
    boxes: Tensor
    log_distance: Tensor
    relations: Tensor


class _Conv(nn.Sequential):
    def __init__(self, inputs: int, outputs: int, size: int = 3, stride: int = 1, *, act: bool = True) -> None:
        layers: list[nn.Module] = [
            nn.Conv2d(inputs, outputs, size, stride, size // 2, bias=False),
            nn.BatchNorm2d(outputs),
        ]
        super().__init__(*layers, *([nn.ReLU(inplace=True)] if act else []))


class _Block(nn.Module):
    def __init__(self, width: int) -> None:
        super().__init__()
        self.first, self.second = _Conv(width, width), _Conv(width, width, act=False)

    def forward(self, x: Tensor) -> Tensor:
        return functional.relu(x + self.second(self.first(x)))


class _Backbone(nn.Module):
    """Features at stride 2, and the pyramid on top of those at strides 4, 8, 16 and 32."""

    def __init__(self) -> None:
        super().__init__()
        a, b, c, d, e = _WIDTHS
        self.stem = nn.Sequential(_Conv(3, a, stride=2), _Conv(a, b, stride=2), _Block(b))
        self.stage_8 = nn.Sequential(_Conv(b, c, stride=2), _Block(c), _Block(c))
        self.stage_16 = nn.Sequential(_Conv(c, d, stride=2), _Block(d), _Block(d))
        self.stage_32 = nn.Sequential(_Conv(d, e, stride=2), _Block(e))
        self.lateral = nn.ModuleList(_Conv(width, _PYRAMID, 1, act=False) for width in (b, c, d, e))
        self.whole = nn.Linear(e, _PYRAMID)
        self.smooth = nn.ModuleList(_Conv(_PYRAMID, _PYRAMID) for _ in range(4))

    def forward(self, image: Tensor) -> tuple[Tensor, tuple[Tensor, ...]]:
        edges = self.stem[0](image)
        levels = [self.stem[1:](edges)]
        for stage in (self.stage_8, self.stage_16, self.stage_32):
            levels.append(stage(levels[-1]))
        above = self.lateral[3](levels[3]) + self.whole(levels[3].mean(dim=(2, 3)))[:, :, None, None]
        pyramid = [self.smooth[3](above)]
        for k in (2, 1, 0):
            above = self.lateral[k](levels[k]) + functional.interpolate(above, scale_factor=2.0, mode="nearest")
            pyramid.insert(0, self.smooth[k](above))
        return edges, tuple(pyramid)


class _Attention(nn.Module):
    """Queries look at each other, then think for themselves."""

    def __init__(self, heads: int = 4) -> None:
        super().__init__()
        self.heads = heads
        self.norm, self.norm_2 = nn.LayerNorm(_DIM), nn.LayerNorm(_DIM)
        self.into, self.out = nn.Linear(_DIM, 3 * _DIM), nn.Linear(_DIM, _DIM)
        self.think = nn.Sequential(nn.Linear(_DIM, 2 * _DIM), nn.ReLU(), nn.Linear(2 * _DIM, _DIM))

    def forward(self, q: Tensor) -> Tensor:
        batch, count, _ = q.shape
        parts = self.into(self.norm(q)).reshape(batch, count, 3, self.heads, _DIM // self.heads)
        query, key, value = parts.permute(2, 0, 3, 1, 4)
        weights = torch.softmax(query @ key.transpose(2, 3) * (_DIM // self.heads) ** -0.5, dim=-1)
        q = q + self.out((weights @ value).transpose(1, 2).reshape(batch, count, _DIM))
        return q + self.think(self.norm_2(q))


class _Filters(nn.Module):
    """Draws a mask for each query: two layers of 1 x 1 filters over the embedding and the place off its center."""

    def __init__(self) -> None:
        super().__init__()
        self.of = nn.Linear(_DIM, _FILTERS)

    def forward(self, q: Tensor, embedding: Tensor, centers: Tensor, scale: Tensor) -> Tensor:
        with torch.autocast("cpu", enabled=False):  # places of single pixels need all digits
            return self._drawn(self.of(q.float()), embedding.float(), centers, scale)

    @staticmethod
    def _drawn(filters: Tensor, embedding: Tensor, centers: Tensor, scale: Tensor) -> Tensor:
        batch, count, _ = filters.shape
        height, width = embedding.shape[2:]
        y = (torch.arange(height, device=filters.device) + 0.5) * (HEIGHT / height / 64.0)
        x = (torch.arange(width, device=filters.device) + 0.5) * (WIDTH / width / 64.0)
        place = torch.stack((x[None, :].expand(height, width), y[:, None].expand(height, width)))
        base = torch.cat((embedding, place[None].expand(batch, 2, height, width).float()), dim=1)
        base = base.reshape(batch, _EMBEDDING + 2, height * width)
        first = filters[..., : (_EMBEDDING + 2) * _HIDDEN].reshape(batch, count, _HIDDEN, _EMBEDDING + 2)
        towards = first[..., _EMBEDDING:] * scale[..., None]
        first = torch.cat((first[..., :_EMBEDDING], towards), dim=-1)
        rest = filters[..., (_EMBEDDING + 2) * _HIDDEN :]
        bias = rest[..., :_HIDDEN] - (towards * (centers / 64.0)[:, :, None, :]).sum(dim=-1)
        hidden = first.reshape(batch, count * _HIDDEN, _EMBEDDING + 2) @ base + bias.reshape(batch, -1, 1)
        hidden = functional.relu(hidden).reshape(batch, count, _HIDDEN, height * width)
        second = rest[..., _HIDDEN : 2 * _HIDDEN]
        logits = (second[:, :, None, :] @ hidden).squeeze(2) + rest[..., 2 * _HIDDEN :]
        return logits.reshape(batch, count, height, width)


class _Look(nn.Module):
    """What a grid of places around each query's first mask shows, as an addition to the query; nothing at first."""

    def __init__(self) -> None:
        super().__init__()
        self.place = nn.Linear(_WIDTHS[0] + _PYRAMID + 1, _CELL)
        self.whole = nn.Sequential(nn.Linear(_GRID**2 * _CELL + 4, 2 * _DIM), nn.ReLU(), nn.Linear(2 * _DIM, _DIM))
        nn.init.zeros_(self.whole[2].weight)
        nn.init.zeros_(self.whole[2].bias)

    def forward(self, features: Features, coarse: Tensor) -> Tensor:
        batch, count, height, width = coarse.shape
        center, half = _extent(coarse.detach().float())
        steps = (torch.arange(_GRID, device=coarse.device) + 0.5) * (2.0 / _GRID) - 1.0
        offsets = torch.stack((steps[None, :].expand(_GRID, _GRID), steps[:, None].expand(_GRID, _GRID)), dim=-1)
        grid = center[:, :, None] + half[:, :, None] * offsets.reshape(1, 1, _GRID**2, 2)
        seen = [_sampled(level, grid).permute(0, 2, 3, 1) for level in (features.edges, features.pyramid[0])]
        own = grid.reshape(batch * count, 1, _GRID**2, 2)
        inside = torch.sigmoid(_sampled(coarse.reshape(batch * count, 1, height, width), own))
        shown = torch.cat((*seen, inside.reshape(batch, count, _GRID**2, 1)), dim=-1)
        cells = functional.relu(self.place(shown)).flatten(2)
        answer: Tensor = self.whole(torch.cat((cells, center.to(cells), torch.log(half).to(cells)), dim=-1))
        return answer


def _extent(coarse: Tensor) -> tuple[Tensor, Tensor]:
    """(B, N, 2) center and half the size of masks (B, N, h, w) of logits, x before y, the image from -1 to 1."""
    height, width = coarse.shape[2:]
    weight = torch.sigmoid(coarse)
    total = weight.sum(dim=(2, 3)) + 1e-3
    places = []
    for sums, count in ((weight.sum(dim=2), width), (weight.sum(dim=3), height)):
        at = (torch.arange(count, device=coarse.device) + 0.5) * (2.0 / count) - 1.0
        mean = (sums * at).sum(dim=-1) / total
        spread = (sums * at**2).sum(dim=-1) / total - mean**2
        places.append((mean, _REACH * torch.sqrt(spread.clamp(min=0.0) + (2.0 / count) ** 2 / 12.0)))
    return torch.stack([mean for mean, _ in places], dim=-1), torch.stack([half for _, half in places], dim=-1)


def _sampled(features: Tensor, grid: Tensor) -> Tensor:
    """(B, D, N, K) features at places (B, N, K, 2) between -1 and 1, x before y."""
    return functional.grid_sample(
        features.float(), grid.float(), mode="bilinear", padding_mode="zeros", align_corners=False
    )


class Network(nn.Module):
    """``features`` first, then ``answers`` for queries at given centers: those of ``peaks``, or what training picks."""

    def __init__(self) -> None:
        super().__init__()
        self.backbone = _Backbone()
        self.detail, self.overview = _Conv(_PYRAMID, _PYRAMID), _Conv(_PYRAMID, _PYRAMID)
        self.embed = nn.Conv2d(_PYRAMID, _EMBEDDING, 1)
        self.heat_small, self.heat_large = nn.Conv2d(_PYRAMID, 1, 1), nn.Conv2d(_PYRAMID, 1, 1)
        for heat in (self.heat_small, self.heat_large):
            nn.init.constant_(heat.bias, -4.0)
        self.begin = nn.ModuleList(
            nn.Sequential(nn.Linear(3 * _PYRAMID + 2, _DIM), nn.ReLU(), nn.Linear(_DIM, _DIM)) for _ in STRIDES
        )
        self.stuff = nn.Parameter(torch.randn(len(STUFF), _DIM))
        self.coarse, self.fine = _Filters(), _Filters()
        self.pooled = nn.Sequential(nn.Linear(2 * _PYRAMID, _DIM), nn.ReLU(), nn.Linear(_DIM, _DIM))
        self.look = _Look()
        self.attend = nn.ModuleList(_Attention() for _ in range(3))
        self.norm = nn.LayerNorm(_DIM)
        self.kind = nn.Sequential(nn.Linear(_DIM, _DIM), nn.ReLU(), nn.Linear(_DIM, BACKGROUND + 1))
        self.box = nn.Sequential(nn.Linear(_DIM, _DIM), nn.ReLU(), nn.Linear(_DIM, 5))
        self.subject, self.object = nn.Linear(_DIM, 96), nn.Linear(_DIM, 96)
        self.between = nn.Linear(_GEOMETRY, 96)
        self.relation = nn.Sequential(nn.Linear(96, 96), nn.ReLU(), nn.Linear(96, len(PREDICATES) + 1))
        self.hints = nn.ModuleList(nn.Conv2d(_PYRAMID, BACKGROUND, 1) for _ in HINTS)
        """Kinds of what single cells show: to learn faster by; exported networks are without."""

    def features(self, image: Tensor) -> Features:
        """Of normalized images (B, 3, H, W)."""
        edges, pyramid = self.backbone(image)
        detail, overview = self.detail(pyramid[0]), self.overview(pyramid[2])
        return Features(
            edges=edges,
            pyramid=pyramid,
            embedding=self.embed(detail),
            heats=(self.heat_small(detail).squeeze(1), self.heat_large(overview).squeeze(1)),
        )

    def peaks(self, features: Features) -> tuple[Tensor, ...]:
        """(B, K) flat cells of the highest peaks of each heat map."""
        found = []
        for answer, count in zip(features.heats, PEAKS, strict=True):
            heat = answer.float()
            highest = functional.max_pool2d(heat[:, None], 3, 1, 1)[:, 0]
            kept = torch.where(heat >= highest, heat, torch.full_like(heat, -30.0))
            found.append(kept.flatten(1).topk(count, dim=1).indices)
        return tuple(found)

    def answers(self, features: Features, cells: tuple[Tensor, ...], chosen: Tensor | None = None) -> Answers:
        """For the stuff queries and queries at ``cells`` of both heat maps, in this order.

        ``chosen``: (B, S) which queries' masks and relations are asked for, all when left out.
        """
        batch = features.embedding.shape[0]
        queries = [self.stuff[None].expand(batch, -1, -1)]
        centers = [torch.tensor((WIDTH / 2.0, HEIGHT / 2.0)).expand(batch, len(STUFF), 2)]
        scales = [torch.full((batch, len(STUFF), 1), 0.5)]
        for level, (begin, stride, cell) in enumerate(zip(self.begin, STRIDES, cells, strict=True)):
            x, y = cell % (WIDTH // stride), cell // (WIDTH // stride)
            center = torch.stack((x, y), dim=-1).float() * stride + stride / 2
            maps = (0, 1, 2) if level == 0 else (1, 2, 3)
            gathered = [_gathered(features.pyramid[k], x, y, stride, 4 << k) for k in maps]
            place = center / torch.tensor((WIDTH, HEIGHT))
            queries.append(begin(torch.cat((*gathered, place.to(gathered[0].dtype)), dim=-1)))
            centers.append(center)
            scales.append(torch.full((batch, cell.shape[1], 1), (4.0, 1.0)[level]))
        q, center, scale = torch.cat(queries, 1), torch.cat(centers, 1), torch.cat(scales, 1)
        embedding_8 = functional.avg_pool2d(features.embedding, 2)
        coarse = self.coarse(q, embedding_8, center, scale)
        under = torch.sigmoid(coarse).flatten(2)
        under = under / (under.sum(dim=-1, keepdim=True) + 0.5)
        seen = features.pyramid[1].flatten(2).transpose(1, 2)
        high = functional.interpolate(features.pyramid[2], scale_factor=2.0, mode="nearest").flatten(2).transpose(1, 2)
        q = q + self.pooled(torch.cat((under @ seen, under @ high), dim=-1)) + self.look(features, coarse)
        for attend in self.attend:
            q = attend(q)
        q = self.norm(q)
        box = self.box(q).float()
        middle = center / torch.tensor((WIDTH, HEIGHT)) + 0.1 * box[..., :2]
        boxes = torch.cat((middle, torch.sigmoid(box[..., 2:4] - 2.0)), dim=-1)
        kinds, distance = self.kind(q), box[..., 4]
        drawn, related = (q, center, scale), (boxes, distance)
        if chosen is not None:
            drawn, related = _rows((q, center, scale), chosen), _rows(related, chosen)
        masks = self.fine(drawn[0], features.embedding, *drawn[1:])
        return Answers(
            classes=kinds.float(),
            masks=masks.float(),
            coarse=coarse.float(),
            boxes=boxes,
            log_distance=distance,
            relations=self._relations(drawn[0], masks, *related).float(),
        )

    def _relations(self, q: Tensor, masks: Tensor, boxes: Tensor, log_distance: Tensor) -> Tensor:
        """(B, N, N, P + 1) of what each pair is like: both queries, boxes, distances, and how masks touch."""
        count = q.shape[1]
        small = functional.avg_pool2d(torch.sigmoid(masks.float()), 2)
        area = small.sum(dim=(2, 3)) + 0.5
        touching = []
        for dy, dx in _SHIFTS:
            padded = functional.pad(small, (1, 1, 1, 1))
            height, width = small.shape[2:]
            moved = padded[:, :, 1 + dy : 1 + dy + height, 1 + dx : 1 + dx + width]
            shared = small.flatten(2) @ moved.flatten(2).transpose(1, 2)
            touching += [shared / area[:, :, None], shared / area[:, None, :]]
        own = torch.cat((boxes, log_distance[..., None]), dim=-1).detach()
        one, two = own[:, :, None].expand(-1, -1, count, -1), own[:, None].expand(-1, count, -1, -1)
        apart = (one - two)[..., :2] / (one[..., 2:4] + two[..., 2:4])
        ratio = torch.log((one[..., 2:4] + 0.01) / (two[..., 2:4] + 0.01))
        nearer = (one - two)[..., 4:]
        geometry = torch.cat((one, two, apart, ratio, nearer, torch.stack(touching, dim=-1).detach()), dim=-1)
        hidden = self.subject(q)[:, :, None] + self.object(q)[:, None] + self.between(geometry)
        answer: Tensor = self.relation(functional.relu(hidden))
        return answer


def _rows(tensors: tuple[Tensor, ...], chosen: Tensor) -> tuple[Tensor, ...]:
    """Of (B, N, ...) tensors the rows (B, S)."""
    return tuple(tensor[torch.arange(len(chosen), device=chosen.device)[:, None], chosen] for tensor in tensors)


def _gathered(features: Tensor, x: Tensor, y: Tensor, stride: int, own: int) -> Tensor:
    """(B, K, D): features of a map of stride ``own`` at cells of a grid of ``stride``."""
    width = features.shape[3]
    if own >= stride:
        cell = (y * stride // own) * width + x * stride // own
        return _at(features, cell)
    step = stride // own
    half = step // 2
    around = [_at(features, (y * step + half - dy) * width + x * step + half - dx) for dy in (0, 1) for dx in (0, 1)]
    return (around[0] + around[1] + around[2] + around[3]) * 0.25


def _at(features: Tensor, cell: Tensor) -> Tensor:
    flat = features.flatten(2)
    return flat.gather(2, cell[:, None, :].expand(-1, flat.shape[1], -1)).transpose(1, 2)
