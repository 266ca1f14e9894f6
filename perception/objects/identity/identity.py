"""Is this that thing, and is it a thing at all? One table of hypotheses answers, whoever asks."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.objects.identity.hypotheses import Asked, Claim, Decision, Hypothesis, Row
from perception.objects.identity.pair import Moment, Pair, Subject
from perception.objects.identity.scales import Scales
from perception.objects.identity.table import TABLE
from perception.objects.tracking.track import Track

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class IdentitySettings:
    """What is known, and how it is weighed."""

    rows: tuple[Row, ...] = TABLE
    scales: Scales = field(default_factory=Scales)
    floor: float = 0.08
    """No agreement counts for less: a label, a color or a size is wrong altogether so often. It also is the ratio of
    the chances that a look-alike turns up where one has looked before, 0.02, and where one has not, 0.25.
    """
    margin: float = 0.15
    """By so many nats the best hypothesis must lead, or one waits for more frames."""
    patience_hits: int = 15
    """How many sightings to wait for that: three seconds of frames."""


class Identity:
    """Asks the table."""

    def __init__(self, settings: IdentitySettings) -> None:
        self._settings = settings
        self._rows = {asked: tuple(row for row in settings.rows if asked in row.asked) for asked in Asked}

    def claims(self, asked: Asked, it: Subject, moment: Moment, known: Sequence[Track]) -> list[Claim]:
        """What speaks for it being any of the ``known`` things, or a part of one, or nothing."""
        alone, pairs = [Pair(it, None, moment)], [Pair(it, track, moment) for track in known if track is not it.track]
        admitted = [
            (row, pair) for row in self._rows[asked] for pair in (alone if row.alone else pairs) if row.admits(pair)
        ]
        return [row.claim(pair, self._settings.floor) for row, pair in admitted]

    def decide(self, asked: Asked, it: Subject, moment: Moment, known: Sequence[Track] | None = None) -> Decision:
        """What it is; of the ``known`` things, those of the moment if nothing else is said. Of two that are as likely,
        it is the one known for longer.
        """
        found = self.claims(asked, it, moment, moment.known if known is None else known)
        new = Claim(hypothesis=Hypothesis.NEW, way="nothing speaks for another", score=0.0)
        ranked = sorted((*found, new), key=lambda c: (-c.score, c.known.number if c.known is not None else 0, c.way))
        lead = min((ranked[0].score - c.score for c in ranked if c.outcome != ranked[0].outcome), default=np.inf)
        decision = Decision(claims=tuple(ranked), waits=lead < self._settings.margin)
        if found:
            logger.debug("objects: %s is %s", it, decision, extra={"asked": asked.value})
        return decision

    def scores(self, asked: Asked, its: Sequence[Subject], moment: Moment) -> NDArray[np.float64]:
        """(T, M) best score of each known thing of the moment and each subject; minus infinity where there is none."""
        row_of = {id(track): i for i, track in enumerate(moment.known)}
        scores = np.full((len(moment.known), len(its)), -np.inf)
        for j, it in enumerate(its):
            for claim in self.claims(asked, it, moment, moment.known):
                i = row_of[id(claim.known)]
                scores[i, j] = max(scores[i, j], claim.score)
        return scores
