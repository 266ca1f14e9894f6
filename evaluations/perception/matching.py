"""Which node of the graph is which thing of the house: by name and place, one to one; and what is left over."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import linear_sum_assignment

from evaluations.perception.inventory import GraphThing, TrueThing


@dataclass(frozen=True, kw_only=True)
class MatchingSettings:
    """How near a node must be to a thing to stand for it; chosen, wide enough that what is merely off is not missed."""

    small_gate_m: float = 0.5
    """So far from the center of a small thing its node may be."""
    furniture_gate_m: float = 0.3
    """So far from the box of a piece of furniture its node may be."""
    close_m: float = 0.15
    """Nodes under another name than a thing's count as that thing within so much of its box."""
    size_ratio: float = 2.5
    """And if neither is so many times as long as the other."""


@dataclass(frozen=True, kw_only=True)
class Matching:
    """True identifiers by node and the other way round.

    ``named``: true thing -> node of its name. ``misnamed``: true thing -> node of another name. ``duplicates``: node ->
    the true thing that another node stands for already. ``invented``: nodes that stand for nothing.
    """

    named: Mapping[str, str]
    misnamed: Mapping[str, str]
    duplicates: Mapping[str, str]
    invented: tuple[str, ...]

    @property
    def node_of(self) -> dict[str, str]:
        """True thing -> node, under whatever name."""
        return {**self.named, **self.misnamed}

    @property
    def thing_of(self) -> dict[str, str]:
        """Node -> true thing, second nodes left out."""
        return {node: thing for thing, node in self.node_of.items()}


def match_things(
    true: Sequence[TrueThing], graph: Sequence[GraphThing], settings: MatchingSettings = MatchingSettings()
) -> Matching:
    """Assign nodes to things of their own name first, then to the rest by place and size; then sort what is left."""
    gates = _Gates(settings)
    named = _assign(true, graph, gates.may_be)
    left_true = [thing for thing in true if thing.id not in named]
    left = [node for node in graph if node.id not in named.values()]
    misnamed = _assign(left_true, left, gates.looks_like)
    left = [node for node in left if node.id not in misnamed.values()]
    duplicates = {node.id: again for node in left if (again := gates.already(true, node)) is not None}
    return Matching(
        named=named,
        misnamed=misnamed,
        duplicates=duplicates,
        invented=tuple(node.id for node in left if node.id not in duplicates),
    )


def off_m(thing: TrueThing, node: GraphThing) -> float:
    """Distance of a node from the center of the thing that it stands for."""
    return float(np.linalg.norm(node.position_m - thing.position_m))


@dataclass(kw_only=True)
class Identities:
    """Follows over time which node stands for each true thing, and counts when that becomes another node.

    A node that stood for a thing goes on to do so for as long as it is near: two nodes of one thing are not a switch.

    Attributes:
        switches: how often a thing got another node.
        last: true thing -> the node that stands for it, or stood for it last.
    """

    switches: int = 0
    last: dict[str, str] = field(default_factory=dict)
    settings: MatchingSettings = field(default_factory=MatchingSettings)

    def update(self, true: Sequence[TrueThing], graph: Sequence[GraphThing]) -> None:
        """The graph as it is now."""
        nodes, gates = {node.id: node for node in graph}, _Gates(self.settings)
        kept = {
            thing.id: self.last[thing.id]
            for thing in true
            if thing.id in self.last and self.last[thing.id] in nodes and gates.near(thing, nodes[self.last[thing.id]])
        }
        rest = [node for node in graph if node.id not in kept.values()]
        fresh = match_things([thing for thing in true if thing.id not in kept], rest, self.settings).node_of
        self.switches += sum(thing in self.last and self.last[thing] != node for thing, node in fresh.items())
        self.last |= kept | fresh


class _Gates:
    """What may stand for what."""

    def __init__(self, settings: MatchingSettings) -> None:
        self._settings = settings

    def near(self, thing: TrueThing, node: GraphThing) -> bool:
        if thing.furniture:
            return thing.gap_m(node.position_m) <= self._settings.furniture_gate_m
        return off_m(thing, node) <= self._settings.small_gate_m

    def may_be(self, thing: TrueThing, node: GraphThing) -> bool:
        return thing.category == node.label and self.near(thing, node)

    def looks_like(self, thing: TrueThing, node: GraphThing) -> bool:
        """Whether place and size are right, whatever it is called."""
        longest, other = max(thing.size_m), max(*node.size_m, 1e-3)
        similar = max(longest / other, other / longest) <= self._settings.size_ratio
        return similar and thing.gap_m(node.position_m) <= self._settings.close_m

    def already(self, true: Sequence[TrueThing], node: GraphThing) -> str | None:
        """The nearest thing that a node left over may be."""
        near = [thing for thing in true if self.may_be(thing, node) or self.looks_like(thing, node)]
        return min(near, key=lambda thing: (thing.gap_m(node.position_m), off_m(thing, node))).id if near else None


def _assign(
    true: Sequence[TrueThing], graph: Sequence[GraphThing], allowed: Callable[[TrueThing, GraphThing], bool]
) -> dict[str, str]:
    """True thing -> node, one to one: as many pairs as are allowed, then the nearest."""
    far_m = 1e3
    cost = np.array([[off_m(thing, node) if allowed(thing, node) else far_m for node in graph] for thing in true])
    if cost.size == 0:
        return {}
    rows, columns = linear_sum_assignment(cost)
    return {
        true[row].id: graph[column].id for row, column in zip(rows, columns, strict=True) if cost[row, column] < far_m
    }
