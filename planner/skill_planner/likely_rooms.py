"""In which room a thing most probably is that nobody has seen lately: by its kind, its like, and where it was last."""

from __future__ import annotations

from collections.abc import Iterable

from planner.language.lexicon.vocabulary import kind_labels, normal, words_for
from planner.skill_planner.settings import ObjectSearchSettings
from scene_graph.nodes import ObjectNode, ObjectState, RoomNode
from scene_graph.snapshot import Snapshot

_KITCHEN = frozenset({"kitchen", "dining room", "pantry", "canteen", "break room"})
_DESK = frozenset({"office", "library", "meeting room"})
_STORE = frozenset({"storage", "workshop", "garage", "basement"})
_WASH = frozenset({"bathroom", "laundry"})
_USUAL_ROOMS: tuple[tuple[frozenset[str], frozenset[str]], ...] = (
    (frozenset({"drink", "tableware", "drinkware", "cutlery", "dishes"}), _KITCHEN),
    (frozenset({"food", "fruit", "vegetable", "snack"}), _KITCHEN),
    (frozenset({"kitchenware", "pan", "kettle", "jug", "glass", "mug", "sponge"}), _KITCHEN),
    (frozenset({"reading", "reading matter", "book", "magazine"}), _DESK | {"living room", "bedroom"}),
    (frozenset({"stationery", "writing tool", "scissors", "paper"}), _DESK),
    (frozenset({"tool"}), _STORE),
    (frozenset({"keyboard", "mouse", "laptop", "charger"}), _DESK),
    (frozenset({"remote", "tablet", "vase", "candle"}), frozenset({"living room"})),
    (frozenset({"toy", "game"}), frozenset({"living room", "bedroom", "nursery"})),
    (frozenset({"hygiene", "toothbrush", "toothpaste", "shampoo", "comb", "towel", "soap"}), _WASH),
    (frozenset({"cleaning", "detergent"}), _WASH | {"kitchen"}),
    (frozenset({"medicine"}), frozenset({"bathroom", "bedroom"})),
    (frozenset({"clothing", "umbrella", "shoe", "bag"}), frozenset({"hall", "bedroom"})),
    (frozenset({"personal", "keys", "wallet"}), frozenset({"hall", "bedroom", "office"})),
)
"""Kinds of things, or names of them, and rooms where people usually keep them."""


def room_weights(
    called: Iterable[str],
    last_room: str | None,
    snapshot: Snapshot,
    settings: ObjectSearchSettings = ObjectSearchSettings(),
) -> dict[str, float]:
    """How likely each room is to hold the thing, up to a common factor.

    Args:
        called: what the thing is called: labels, and words for its kind.
        last_room: where it was last known to be, if anywhere.
        snapshot: the building.
        settings: how much each hint counts.
    """
    names = {normal(word) for word in called}
    words = names.union(*(words_for(name) for name in names))
    usual = frozenset[str]().union(*(rooms for kinds, rooms in _USUAL_ROOMS if _is_of(words, kinds)))
    like = {
        snapshot.room_of(node.id)
        for node in snapshot.of_type(ObjectNode)
        if node.state is ObjectState.PRESENT and normal(node.label) in words
    }
    return {
        room.id: _area_share(room, settings.large_m2)
        * (settings.usual if usual & (words_for(normal(room.label)) | {normal(room.label)}) else 1.0)
        * (settings.like if room.id in like else 1.0)
        * (settings.last if room.id == last_room else 1.0)
        for room in snapshot.of_type(RoomNode)
    }


def _is_of(words: frozenset[str] | set[str], kinds: frozenset[str]) -> bool:
    return any(kind in words or not words.isdisjoint(kind_labels(kind)) for kind in kinds)


def _area_share(room: RoomNode, large_m2: float) -> float:
    """Area over that of a middling room, within bounds; 1 where the shape is not known."""
    corners = room.polygon_m
    if len(corners) < 3:
        return 1.0
    twice_m2 = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, (*corners[1:], corners[0]), strict=True))
    return min(max(abs(twice_m2) / 2.0 / large_m2, 0.5), 2.0)
