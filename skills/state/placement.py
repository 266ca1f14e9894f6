"""Where things that can be carried are: as the graph has it, but for what a plan has moved since."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from enum import StrEnum


class PlaceRelation(StrEnum):
    """How an object is placed."""

    ON = "on"
    IN = "in"
    GIVEN = "given"


Place = tuple[PlaceRelation, str]


class Placement(Mapping[str, Place]):
    """Object -> (relation, place); immutable. It keeps only the difference to ``base``, which many of them share.

    Args:
        base: where things were; never changes.
        at: the objects of ``base`` that are on or in a place.
        moved: objects that are elsewhere, or nowhere (None), in this placement.
    """

    __slots__ = ("_at", "_base", "_moved")

    def __init__(
        self, base: Mapping[str, Place], at: Callable[[str], tuple[str, ...]], moved: Mapping[str, Place | None]
    ) -> None:
        self._base, self._at = base, at
        self._moved = {thing: place for thing, place in moved.items() if place != base.get(thing)}

    @property
    def key(self) -> frozenset[tuple[str, Place | None]]:
        """Hashable; equal for two placements over one base that hold the same."""
        return frozenset(self._moved.items())

    def is_moved(self, object_id: str) -> bool:
        """Whether an object is elsewhere than in the base."""
        return object_id in self._moved

    def was_at(self, object_id: str, place: str) -> bool:
        """Whether the base has an object on or in a place."""
        at = self._base.get(object_id)
        return at is not None and at[1] == place

    def with_moved(self, object_id: str, place: Place | None) -> Placement:
        """The placement after one object was put somewhere, or taken away (None)."""
        return Placement(self._base, self._at, {**self._moved, object_id: place})

    def at(self, place: str) -> Iterator[str]:
        """The objects on or in a place."""
        yield from (thing for thing in self._at(place) if thing not in self._moved)
        yield from (thing for thing, moved in self._moved.items() if moved is not None and moved[1] == place)

    def like(self, places: Mapping[str, Place]) -> Placement:
        """The placement over the same base that holds what ``places`` does."""
        return Placement(self._base, self._at, {**dict.fromkeys(set(self._base) - set(places)), **places})

    def __getitem__(self, object_id: str) -> Place:
        if object_id not in self._moved:
            return self._base[object_id]
        place = self._moved[object_id]
        if place is None:
            raise KeyError(object_id)
        return place

    def __iter__(self) -> Iterator[str]:
        yield from (thing for thing in self._base if thing not in self._moved)
        yield from (thing for thing, place in self._moved.items() if place is not None)

    def __len__(self) -> int:
        return sum(1 for _ in self)
