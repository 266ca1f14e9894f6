"""What a thing is and what color it has, fused over frames so that single wrong frames wash out."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from majordomo.perception.panoptic import UNKNOWN_LABEL

LabelDistribution = tuple[tuple[str, float], ...]


class LabelBelief:
    """Bayesian fusion of the network's label distributions.

    Frames are not independent (the same mistake repeats from the same side), so each counts as ``evidence`` < 1 of
    one, and the network is assumed to be wrong altogether with probability ``noise``. Odds are bounded: a belief can
    be turned.

    What the network does not know it gives no name to speak of: no class is much likelier than the others. That a thing
    has none of the known names is therefore as likely as ``nameless`` in every frame, and a class that gets more than
    that time and again wins, be each single frame unsure or not.

    Attributes:
        distribution: (label, probability), most likely first, at most five. Something is left for other labels, except
            after a person's word.
    """

    def __init__(self, *, noise: float = 0.1, evidence: float = 0.6, bound: float = 9.0, nameless: float = 0.2) -> None:
        self._noise = noise
        self._nameless = nameless
        self._evidence = evidence
        self._bound = bound
        self._log: dict[str, float] = {}
        self._rest = 0.0
        self._taught = False
        self.distribution: LabelDistribution = ()

    def update(self, distribution: LabelDistribution, weight: float = 1.0) -> None:
        """Multiply in one frame; ``weight`` in (0, 1] says how good the view was."""
        if self._taught:
            return
        likelihood = self._likelihood(distribution)
        floor = self._noise / 10.0
        labels = sorted({*self._log, *likelihood})
        scale = weight * self._evidence
        for label in labels:
            probability = (1.0 - self._noise) * likelihood.get(label, 0.0) + floor
            self._log[label] = self._log.get(label, self._rest) + scale * float(np.log(probability))
        self._rest += scale * float(np.log(floor))
        self._bound_odds()
        self.distribution = self._ranked()

    def _likelihood(self, distribution: LabelDistribution) -> dict[str, float]:
        """Of each label, given that it is right; classes of a frame that is unsure share everything among them."""
        likelihood = {label: max(probability, 0.0) for label, probability in distribution}
        known = 1.0 - likelihood.pop(UNKNOWN_LABEL, 0.0)
        if known < 1.0 and likelihood:
            likelihood = {label: probability / max(known, 1e-6) for label, probability in likelihood.items()}
        top = max(likelihood.values(), default=0.0)
        return {**likelihood, UNKNOWN_LABEL: 1.0 if not likelihood else min(self._nameless, 1.0 - min(top, 1.0))}

    def teach(self, label: str) -> None:
        """Take a person's word; what the network says no longer counts."""
        self._log = {label: 0.0}
        self._rest = -np.inf
        self._taught = True
        self.distribution = self._ranked()

    def _bound_odds(self) -> None:
        top = max(self._log.values())
        self._log = {label: max(value - top, -self._bound) for label, value in self._log.items()}
        self._rest = max(self._rest - top, -self._bound)

    def _ranked(self) -> LabelDistribution:
        if not self._log:
            return ()
        weights = {label: float(np.exp(value)) for label, value in self._log.items()}
        total = sum(weights.values()) + float(np.exp(self._rest))
        ranked = sorted(weights.items(), key=lambda item: (-item[1], item[0]))
        return tuple((label, weight / total) for label, weight in ranked[:5])

    @property
    def best(self) -> str:
        """The most likely label."""
        return self.distribution[0][0]

    @property
    def confidence(self) -> float:
        """The probability of the most likely label."""
        return self.distribution[0][1] if self.distribution else 0.0


class ColorBelief:
    """Votes of pixels for palette colors, older ones slowly forgotten."""

    def __init__(self, *, memory: float = 0.98) -> None:
        self._memory = memory
        self._votes: dict[str, float] = {}

    def update(self, votes: Mapping[str, float], weight: float = 1.0) -> None:
        """Add the shares of one frame."""
        for name in self._votes:
            self._votes[name] *= self._memory
        for name, share in votes.items():
            self._votes[name] = self._votes.get(name, 0.0) + weight * share

    @property
    def best(self) -> str:
        """The color most pixels voted for, ``""`` before the first vote."""
        if not self._votes:
            return ""
        return min(self._votes, key=lambda name: (-self._votes[name], name))

    @property
    def shares(self) -> dict[str, float]:
        """Share of each color in all votes."""
        total = sum(self._votes.values())
        return {name: votes / total for name, votes in sorted(self._votes.items())} if total > 0.0 else {}


def agreement(a: LabelDistribution, b: LabelDistribution) -> float:
    """How far two distributions are about the same thing: Bhattacharyya's coefficient, 0 to 1."""
    of_b = dict(b)
    return float(sum(np.sqrt(p * of_b.get(label, 0.0)) for label, p in a))


def share_agreement(a: Mapping[str, float], b: Mapping[str, float]) -> float:
    """The same for color shares; 1 where one of them has not voted yet."""
    if not a or not b:
        return 1.0
    return float(sum(np.sqrt(share * b.get(name, 0.0)) for name, share in a.items()))


def is_taught(label: str, distribution: LabelDistribution) -> bool:
    """Whether a stored distribution is a person's word: only that leaves nothing for other labels."""
    return distribution == ((label, 1.0),)
