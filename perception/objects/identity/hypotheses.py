"""What a thing that is seen may be, as hypotheses that are scored alike: the best one is believed.

The score of a hypothesis is a log likelihood ratio against "something new that nobody knows", in nats:

    score = prior + sum over its evidence of  weight x ln(max(e, floor))

where e is an agreement or a share from 0 to 1. No evidence can be certain to be wrong (``floor``), and nothing counts
outside the gates of a hypothesis. Where the best one leads by too little, one waits for more frames.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field
from enum import StrEnum
from functools import cached_property

from perception.objects.identity.pair import Evidence, Pair
from perception.objects.tracking.track import Track


class Hypothesis(StrEnum):
    """It is the known thing; a part of it; that, moved here; one like it; something new; no thing at all."""

    SAME = "same"
    PART = "part"
    MOVED = "moved"
    LOOK_ALIKE = "look-alike"
    NEW = "new"
    NOTHING = "nothing"


class Asked(StrEnum):
    """About what it is asked, in the order of a frame."""

    MASK = "mask"
    """A detection, before it is compared with what is known: is it a thing of its own?"""
    FRAME = "frame"
    """A detection: is it a thing that is known?"""
    LEFT = "left"
    """A detection that is none of these."""
    UNSEEN = "unseen"
    """A known thing that no detection is: does that tell anything?"""
    HOME = "home"
    """A thing whose room has just become known."""
    TENTATIVE = "tentative"
    """A thing that was seen often enough to be given a name."""
    NODE = "node"
    """Two things that have names: are they one?"""
    MISSED = "missed"
    """A thing with a name: is it one that is missed?"""
    PERSON = "person"
    """Who is taken for somebody."""


_IS_THAT = {Hypothesis.SAME, Hypothesis.MOVED}


@dataclass(frozen=True)
class Row:
    """One way in which a hypothesis may be true.

    ``prior``: log odds against something new when all evidence agrees, in nats. ``weights``: how much each evidence
    counts. Gates: what must be so (``yes``) and must not (``no``), at least (``least``) and at most (``most``).
    ``alone``: whether it is about no known thing in particular.
    """

    asked: tuple[Asked, ...]
    hypothesis: Hypothesis
    way: str
    prior: float
    _: KW_ONLY
    yes: tuple[Evidence, ...] = ()
    no: tuple[Evidence, ...] = ()
    least: Mapping[Evidence, float] = field(default_factory=dict)
    most: Mapping[Evidence, float] = field(default_factory=dict)
    weights: Mapping[Evidence, float] = field(default_factory=dict)
    alone: bool = False

    @cached_property
    def gates(self) -> tuple[tuple[Evidence, float, float], ...]:
        """Each evidence with the least and the most that it may be."""
        most = [(each, -math.inf, most) for each, most in self.most.items()]
        yes = [(each, 1.0, math.inf) for each in self.yes]
        no = [(each, -math.inf, 0.0) for each in self.no]
        return (*most, *yes, *no, *((each, least, math.inf) for each, least in self.least.items()))

    def admits(self, pair: Pair) -> bool:
        """Whether the pair is within all gates."""
        return all(low <= pair.measure(each) <= high for each, low, high in self.gates)

    def claim(self, pair: Pair, floor: float) -> Claim:
        """The hypothesis about a pair that is within all gates."""
        terms = (weight * math.log(max(pair.measure(each), floor)) for each, weight in self.weights.items())
        return Claim(
            hypothesis=self.hypothesis,
            way=self.way,
            score=self.prior + sum(terms),
            known=None if self.alone else pair.known,
            evidence={each.__name__: value for each, value in pair.measured.items()},
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Claim:
    """A hypothesis about a subject and what is known, with its score and all evidence that was measured by then."""

    hypothesis: Hypothesis
    way: str
    score: float
    known: Track | None = None
    evidence: Mapping[str, float] = field(default_factory=dict)

    @property
    def outcome(self) -> tuple[Hypothesis, Track | None]:
        """What further frames may decide: which thing it is, but not of which of two it is a part, nor beside which it
        stands as something new.
        """
        return self.hypothesis, self.known if self.hypothesis in _IS_THAT else None

    def __str__(self) -> str:
        about = f" {self.known.node_id or self.known.number}" if self.known is not None else ""
        evidence = ", ".join(f"{name} {value:.3g}" for name, value in self.evidence.items())
        return f"{self.hypothesis}{about} ({self.way}) {self.score:.2f} [{evidence}]"


@dataclass(frozen=True, kw_only=True, eq=False)
class Decision:
    """All hypotheses that are within their gates, the best one first; ``waits``: whether it leads by too little."""

    claims: tuple[Claim, ...]
    waits: bool

    @property
    def best(self) -> Claim:
        return self.claims[0]

    def __str__(self) -> str:
        return ("wait: " if self.waits else "") + "; ".join(str(claim) for claim in self.claims)
