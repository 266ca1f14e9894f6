"""Does what the robot sees still fit where it believes to be? Doubt that grows and goes, and what is usual in a room.

As in augmented Monte Carlo localization (Thrun, Burgard, Fox, *Probabilistic Robotics*, table 8.3), the recent
agreement of scans with the map is compared with the long-term one, so that a poor outline of a room raises no alarm.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from perception.localization.doorways import DoorwayFit
from perception.localization.measurement_model import ScanFit


@dataclass(frozen=True, kw_only=True)
class FitnessSettings:
    """When a scan speaks against the pose, and how long it takes to believe it."""

    explained: float = 0.75
    """Least share of returns on the expected walls, well inside a room. Chosen."""
    explained_in_doorway: float = 0.35
    """The same in a doorway, as half the view is another room's."""
    inside_m: float = 0.6
    """Depth where well inside begins. Chosen: more than a doorway."""
    passed: float = 0.03
    """Largest share behind walls: grazing rays at corners. Chosen."""
    patience_s: float = 1.0
    """Of contradiction. Chosen: ten scans."""
    gross: float = 2.5
    """A gross one counts so many times. Chosen."""
    relief: float = 2.0
    """Agreement takes doubt away so many times as fast. Chosen."""
    usual_s: float = 20.0
    """Memory of what is usual in a room. Chosen."""
    poorest: float = 0.6
    """The worst that may become usual. Chosen."""


@dataclass(kw_only=True)
class Usual:
    """Long-term means of a room's fits, and for how long they were gathered."""

    explained: float = 0.97
    passed: float = 0.0
    seconds: float = 0.0

    def add(self, fit: ScanFit, seconds: float, memory_s: float) -> None:
        """Take in a fit that held for ``seconds``; the first ones count most."""
        self.seconds += seconds
        share = min(1.0, seconds / max(min(self.seconds, memory_s), 1e-6))
        self.explained += share * (fit.explained - self.explained)
        self.passed += share * (fit.passed - self.passed)


@dataclass(kw_only=True)
class FitnessMonitor:
    """Running fitness of the pose. ``doubt_s``: seconds of contradiction not yet outweighed by agreement."""

    settings: FitnessSettings = field(default_factory=FitnessSettings)
    doubt_s: float = 0.0
    _usual: dict[str, Usual] = field(default_factory=dict)
    _stamp_s: float = -np.inf

    @property
    def lost(self) -> bool:
        """Whether the pose cannot be believed any more."""
        return self.doubt_s >= self.settings.patience_s - 1e-6

    @property
    def confidence(self) -> float:
        """1 without doubt, 0 when lost."""
        return float(np.clip(1.0 - self.doubt_s / self.settings.patience_s, 0.0, 1.0))

    def usual_shares(self) -> dict[str, float]:
        """Share of a scan that is usually explained, by room."""
        return {room_id: usual.explained for room_id, usual in self._usual.items()}

    def usual(self, room_id: str) -> Usual:
        """What fits were like in a room so far."""
        return self._usual.setdefault(room_id, Usual())

    def forget_doubt(self) -> None:
        """The pose was found anew."""
        self.doubt_s = 0.0

    def startle(self) -> None:
        """What is seen has changed all of a sudden: doubt, but wait for one more look."""
        self.doubt_s = max(self.doubt_s, 0.5 * self.settings.patience_s)

    def rest(self, stamp_s: float) -> None:
        """A scan that cannot be judged, outside of the rooms that stand: doubt goes."""
        self.doubt_s = max(0.0, self.doubt_s - self.settings.relief * self._elapsed(stamp_s))

    def add(self, room_id: str, depth_m: float, fit: ScanFit, doorways: DoorwayFit, stamp_s: float) -> None:
        """Judge the scan of ``stamp_s`` taken ``depth_m`` inside a room's outline."""
        seconds = self._elapsed(stamp_s)
        settings, usual = self.settings, self.usual(room_id)
        if usual.seconds < settings.patience_s and fit.explained >= settings.poorest:
            usual.add(fit, seconds, settings.usual_s)
        inside = float(np.clip(depth_m / settings.inside_m, 0.0, 1.0))
        least = settings.explained_in_doorway + inside * (settings.explained - settings.explained_in_doorway)
        least *= max(settings.poorest, usual.explained)
        most = settings.passed + 2.0 * usual.passed
        swapped = doorways.shut > 0 and doorways.strange > 0
        if fit.explained >= least and fit.passed <= most and not swapped:
            self.doubt_s = max(0.0, self.doubt_s - settings.relief * seconds)
            if inside == 1.0:
                usual.add(fit, seconds, settings.usual_s)
        else:
            gross = fit.explained < 0.6 * least or fit.passed > 3.0 * most
            self.doubt_s += seconds * (settings.gross if gross else 1.0)

    def _elapsed(self, stamp_s: float) -> float:
        """Seconds since the last scan, at most what a scan may stand for."""
        seconds = float(np.clip(stamp_s - self._stamp_s, 0.0, 0.3))
        self._stamp_s = stamp_s
        return seconds
