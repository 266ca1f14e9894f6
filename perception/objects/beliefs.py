"""What a thing is and what color it has, fused over frames so that single wrong frames wash out."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Mapping
from dataclasses import dataclass

import numpy as np

from perception.vocabulary import is_too_large, oversize
from scene_graph.nodes import UNKNOWN_LABEL, Point3

LabelDistribution = tuple[tuple[str, float], ...]


_BEFORE = "before"


@dataclass(frozen=True, kw_only=True)
class LabelSettings:
    """``noise``: probability that the network is wrong altogether. ``evidence_of_view``: as how many independent frames
    one view counts at most, ``views``: how many of them are kept. ``bound``: by how many nats a label falls behind the
    best at most. ``nameless``: how likely it is in every frame that a thing has none of the known names.
    """

    noise: float = 0.1
    evidence_of_view: float = 2.4
    views: int = 5
    bound: float = 9.0
    nameless: float = 0.2
    frames: float = 12.0
    """So many of the newest frames of a view make its mean."""
    first: float = 0.6
    """As how many independent frames the first of a view counts."""
    frames_before: int = 5
    """What was found out earlier counts as much as so many frames of a view that say the same."""
    observations_of_view: float = 12.0
    """Of so many observations it counts as one view: what was seen time and again, from more sides than one, is not
    overturned by the first look after a restart, or where the thing was put;
    """
    views_before: tuple[float, float] = (0.5, 3.0)
    """as so many views at least and at most."""
    least_left: float = 0.1
    """So much of a frame counts as all of it when the rest is out of the question; less is noise."""
    size_spread: float = 0.25
    """Standard deviation of the logarithm of the size of what comes in one size: a stove two meters long is more likely
    a stove and a counter, which go by the counter's name.
    """


class _Look:
    """What the frames of one view say: sums of log likelihoods, of labels not heard under None."""

    def __init__(self, trust: float, settings: LabelSettings) -> None:
        self.trust, self._settings = trust, settings
        self.weight = self._frames = 0.0
        self.log: dict[str | None, float] = {None: 0.0}

    def add(self, likelihood: Mapping[str, float], weight: float) -> None:
        """One frame more; older ones fade."""
        noise = self._settings.noise
        floor = noise / 10.0
        keep = min(1.0, (self._settings.frames - weight) / self.weight) if self.weight > 0.0 else 1.0
        before = self.log[None]
        for label in dict.fromkeys((*self.log, *likelihood)):
            probability = floor if label is None else (1.0 - noise) * likelihood.get(label, 0.0) + floor
            self.log[label] = keep * self.log.get(label, before) + weight * float(np.log(probability))
        self.weight = keep * self.weight + weight
        self._frames = keep * self._frames + 1.0

    @property
    def quality(self) -> float:
        """How good its frames are, 0 to 1."""
        return self.weight / self._frames

    def evidence(self, best: float) -> float:
        """As how many independent frames they count: less than that where the view is not trusted, or is not as good as
        the ``best`` one.
        """
        first, most = self._settings.first, self._settings.evidence_of_view
        share = self.trust * min(self.quality / best, 1.0)
        return share * most * float(-np.expm1(-first * self.weight / most))


class LabelBelief:
    """Bayesian fusion of the network's label distributions.

    Frames are not independent: from one side the same mistake repeats. What a thing looked like from one ``view`` is
    therefore the mean over its newest frames, and counts as no more than ``evidence_of_view`` independent ones, however
    long the robot looks; a view that shows a part only, as less, and so does one from afar once the thing was seen from
    near: all that is seen from afar makes the same mistakes. At most ``views`` count: one more takes the place of
    the one that says least, such as a glimpse in passing, and among equals of the oldest. So a belief can be turned,
    but not by one view alone when others agree. The network is assumed to be wrong altogether with probability
    ``noise``.

    What the network does not know it gives no name to speak of: no class is much likelier than the others. That a thing
    has none of the known names is therefore as likely as ``nameless`` in every frame, and a class that gets more than
    that time and again wins, be each single frame unsure or not.

    Attributes:
        distribution: (label, probability), most likely first, at most five. Something is left for other labels, except
            after a person's word.
    """

    def __init__(self, settings: LabelSettings = LabelSettings()) -> None:
        self._settings = settings
        self._looks: dict[Hashable, _Look] = {}
        self._taught = False
        self._size_m: Point3 = (0.0, 0.0, 0.0)
        self.distribution: LabelDistribution = ()

    def update(
        self, distribution: LabelDistribution, weight: float = 1.0, view: Hashable = None, *, trust: float = 1.0
    ) -> None:
        """Multiply in one frame; ``weight`` in (0, 1] says how good it was, ``view`` from where it was taken, ``trust``
        in (0, 1] as how much all frames of that view count at most, of what a good view counts.
        """
        if self._taught:
            return
        look = self._looks.pop(view, None) or _Look(trust, self._settings)
        look.add(self._likelihood(distribution), weight)
        self._looks[view] = look
        while len(self._looks) > self._settings.views:
            evidence = self._evidence()
            del self._looks[min((key for key in evidence if key != view), key=lambda key: round(evidence[key], 1))]
        self.distribution = self._ranked(self._fused())

    def start_from(self, distribution: LabelDistribution, observations: int) -> None:
        """Begin anew from what so many observations came to, as after a restart or at another place: it counts as views
        of its own, the more of them the oftener the thing was seen, and no look at the new place takes its place.
        """
        self._looks = {}
        trust = float(np.clip(observations / self._settings.observations_of_view, *self._settings.views_before))
        for _ in range(self._settings.frames_before):
            self.update(distribution, view=_BEFORE, trust=trust)

    def measure(self, size_m: Point3) -> None:
        """Take in the extent of the thing: some names do not go with it."""
        before, self._size_m = self._size_costs(), size_m
        if self._looks and not self._taught and self._size_costs() != before:
            self.distribution = self._ranked(self._fused())

    def _size_costs(self) -> dict[str, float]:
        """How much less likely, in log likelihood to one digit, its size makes the labels that were heard."""
        heard = [label for label in self._heard() if label is not None]
        over = {label: float(np.log(oversize(label, self._size_m))) / self._settings.size_spread for label in heard}
        costs = {label: round(spreads**2 / 2.0, 1) for label, spreads in over.items() if spreads > 0.0}
        return costs | {label: self._settings.bound for label in heard if is_too_large(label, self._size_m)}

    def _likelihood(self, distribution: LabelDistribution) -> dict[str, float]:
        """Of each label, given that it is right; classes of a frame that is unsure share everything among them, and so
        do the other classes of a frame that names what a thing of that size cannot be.
        """
        likelihood = {label: max(probability, 0.0) for label, probability in distribution}
        possible = {label: p for label, p in likelihood.items() if not is_too_large(label, self._size_m)}
        if len(possible) < len(likelihood):
            left = max(1.0 - sum(likelihood.values()) + sum(possible.values()), self._settings.least_left)
            likelihood = {label: probability / left for label, probability in possible.items()}
        known = 1.0 - likelihood.pop(UNKNOWN_LABEL, 0.0)
        if known < 1.0 and likelihood:
            likelihood = {label: probability / max(known, 1e-6) for label, probability in likelihood.items()}
        top = max(likelihood.values(), default=0.0)
        return {
            **likelihood,
            UNKNOWN_LABEL: 1.0 if not likelihood else min(self._settings.nameless, 1.0 - min(top, 1.0)),
        }

    def teach(self, label: str) -> None:
        """Take a person's word; what the network says no longer counts."""
        self._taught = True
        self.distribution = ((label, 1.0),)

    def _evidence(self) -> dict[Hashable, float]:
        """As how many independent frames each view counts, oldest first."""
        best = max(min(look.trust, 1.0) * look.quality for look in self._looks.values())
        return {key: look.evidence(best) for key, look in self._looks.items()}

    def _heard(self) -> dict[str | None, float]:
        """Zero for every label of any look, in the order of hearing: with that of a set, sums would round by chance."""
        return {label: 0.0 for look in self._looks.values() for label in look.log}

    def _fused(self) -> dict[str | None, float]:
        """Log odds of every label that was heard, and of all others under None, against the likeliest."""
        log = self._heard()
        for key, evidence in self._evidence().items():
            look = self._looks[key]
            share = evidence / look.weight
            for label in log:
                log[label] += share * look.log.get(label, look.log[None])
        for label, cost in self._size_costs().items():
            log[label] -= cost
        top = max(log.values())
        return {label: max(value - top, -self._settings.bound) for label, value in log.items()}

    @staticmethod
    def _ranked(log: Mapping[str | None, float]) -> LabelDistribution:
        weights = {label: float(np.exp(value)) for label, value in log.items()}
        total = sum(weights.values())
        named = [(label, weight / total) for label, weight in weights.items() if label is not None]
        return tuple(sorted(named, key=lambda item: (-item[1], item[0]))[:5])

    @property
    def best(self) -> str:
        """The most likely label; that of the nameless before the first look."""
        return self.distribution[0][0] if self.distribution else UNKNOWN_LABEL

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


class AccentBelief:
    """Which colors a thing has besides its main one: those that show in enough of the frames that can tell."""

    def __init__(self, *, memory: float = 0.98, share: float = 0.35, frames: float = 2.0) -> None:
        """``share``: of the frames, weighted by how good they are. ``frames``: so much weight is enough to tell."""
        self._memory, self._share, self._enough = memory, share, frames
        self._votes: dict[str, float] = {}
        self._total = 0.0

    def update(self, colors: Collection[str] | None, weight: float = 1.0) -> None:
        """Add what one frame shows; nothing where it cannot tell."""
        if colors is None:
            return
        self._total = self._memory * self._total + weight
        for name in {*self._votes, *colors}:
            self._votes[name] = self._memory * self._votes.get(name, 0.0) + (weight if name in colors else 0.0)

    @property
    def colors(self) -> tuple[str, ...]:
        """The colors, surest first."""
        if self._total < self._enough:
            return ()
        sure = [name for name, votes in self._votes.items() if votes >= self._share * self._total]
        return tuple(sorted(sure, key=lambda name: (-self._votes[name], name)))


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
