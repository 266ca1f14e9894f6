"""How much must be seen of a tentative thing before it is a node, and how long it waits for that."""

from __future__ import annotations

from dataclasses import dataclass

from perception.objects.tracking.track import Track
from scene_graph.nodes import UNKNOWN_LABEL, ObjectState


@dataclass(frozen=True, kw_only=True)
class ProbationSettings:
    """``confirm_hits`` sightings with ``confirm_label`` certainty make a thing a node; so do twice as many of what
    remains doubtful, of a small thing from ``confirm_places`` different places, or from ``nameless_places`` if it has
    no name: from one place, a part of a thing or of the clutter may look like anything for long.

    ``tentative_life_s``: how long what was seen only now and then is remembered; ``doubtful_life_s``: how long what was
    seen often enough waits to be seen from another place; ``homeless_life_s``: how long a thing seen through a door
    waits for its room to become known.
    """

    confirm_hits: int = 3
    confirm_label: float = 0.6
    confirm_places: int = 2
    nameless_places: int = 3
    tentative_life_s: float = 2.0
    doubtful_life_s: float = 300.0
    homeless_life_s: float = 300.0


def is_stable(track: Track, settings: ProbationSettings) -> bool:
    """Whether it was seen often enough, and from places enough, to be a node."""
    sure = track.label.confidence >= settings.confirm_label
    if track.is_furniture or sure:
        return track.hits >= (settings.confirm_hits if sure else 2 * settings.confirm_hits)
    places = settings.nameless_places if track.label.best == UNKNOWN_LABEL else settings.confirm_places
    return _was_seen_often(track, settings) and len(track.seen_from) >= places


def may_come_true(track: Track, stamp_s: float, settings: ProbationSettings) -> bool:
    """Whether to wait for further sights of a tentative thing, or for its room to become known."""
    patience_s = settings.doubtful_life_s if _was_seen_often(track, settings) else settings.tentative_life_s
    if track.homeless and is_stable(track, settings):
        patience_s = settings.homeless_life_s
    return track.state is ObjectState.PRESENT and stamp_s - track.last_seen_s <= patience_s


def _was_seen_often(track: Track, settings: ProbationSettings) -> bool:
    """Whether to wait for sights from other places, however doubtful it is."""
    return track.hits >= 2 * settings.confirm_hits
