"""What is known of a thing by its name alone: can it be grasped, does it carry other things, how large is it usually.

Names come from whatever network is plugged in, so an unknown name is normal: it gets defaults from its measured size.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

from perception.vocabulary_table import LARGEST, ROWS
from scene_graph.nodes import Point3

_OF_ONE_SIZE = frozenset({"appliance", "fixture", "fruit"})


@dataclass(frozen=True, kw_only=True)
class SizeSettings:
    """What a measured size says about a thing, given its name."""

    gripper_opening_m: float = 0.12
    """Of the robot's hand, as its limits have it (``skills.ports.BodyLimits``)."""
    gripper_margin_m: float = 0.01
    """Left free when it closes on something: errors of the grasp on both sides."""
    square_share: float = 0.85
    """A thing whose sides differ less may have been seen from one side only. Chosen."""
    unseen_share: float = 0.65
    """As deep it may be that shows its width alone, as a share of that. Chosen."""
    side_share: float = 0.2
    """By how much, of its usual side, a piece of furniture of one size may seem longer or shorter. Chosen."""
    furniture_from_m: float = 0.5
    """Longest side from which on an unknown thing is furniture. Chosen."""
    reachable_top_m: float = 1.25
    """Things are not put on what is higher: its top is out of the camera's and of the hand's reach."""


@dataclass(frozen=True, kw_only=True)
class Category:
    """Prior knowledge of one kind of thing.

    ``size_m``: usual extent, long side, short side, height. ``round``: rotationally symmetric about the vertical;
    ``ball``: about any axis. ``levels``: carries things below its top (shelf boards, a seat). ``floor``: stands on
    the floor. ``background``: part of the building.
    """

    label: str
    graspable: bool = False
    support: bool = False
    container: bool = False
    furniture: bool = False
    round: bool = False
    ball: bool = False
    levels: bool = False
    floor: bool = False
    background: bool = False
    known: bool = True
    size_m: Point3 = (0.0, 0.0, 0.0)
    tags: tuple[str, ...] = ()


def category_of(label: str, size_m: Point3 | None = None, settings: SizeSettings = SizeSettings()) -> Category:
    """What is known of ``label``; an unknown one is judged by its measured ``size_m``.

    A large unknown thing is taken for furniture that stands where it is, a small one for something to carry.
    """
    category = CATEGORIES.get(plain_label(label))
    return category if category is not None else _unknown(label, size_m, settings)


def fits_gripper(size_m: Point3, settings: SizeSettings = SizeSettings()) -> bool:
    """Whether the hand can close on the thing from above or from the side: one horizontal side or, lying flat, its
    height.
    """
    return 0.0 < min(size_m[:2]) <= settings.gripper_opening_m - settings.gripper_margin_m


def is_graspable(label: str, size_m: Point3, settings: SizeSettings = SizeSettings()) -> bool:
    """By name and by geometry; a thing that need not be as deep as it is wide, but looks so, may have been seen from
    one side only, and is given the benefit of the doubt.
    """
    category, (narrow_m, wide_m) = category_of(label, size_m, settings), sorted(size_m[:2])
    in_doubt = not (category.round or category.ball) and narrow_m > settings.square_share * wide_m
    sides = (narrow_m * (settings.unseen_share if in_doubt else 1.0), wide_m, size_m[2])
    return category.graspable and fits_gripper(sides, settings)


def carries_things(label: str, size_m: Point3, settings: SizeSettings = SizeSettings()) -> bool:
    """Whether things are put on or in it: a support, or a container that is open; not one whose top is out of sight."""
    category = category_of(label, size_m, settings)
    open_container = category.container and "appliance" not in category.tags
    return (category.support and (category.levels or size_m[2] <= settings.reachable_top_m)) or open_container


def is_of_one_size(label: str) -> bool:
    """Whether things of that name come in much the same size everywhere: appliances, fixtures and fruits."""
    return not _OF_ONE_SIZE.isdisjoint(category_of(label).tags)


def oversize(label: str, size_m: Point3) -> float:
    """How many times longer than usual for its name a thing is, or broader if it can be grasped; 1 if it is not, or
    where things of that name come in all sizes.
    """
    if not is_of_one_size(label):
        return 1.0
    category = category_of(label)
    longer = max(size_m[:2]) / max(category.size_m[:2])
    broader = min(size_m[:2]) / min(category.size_m[:2]) if category.graspable else 1.0
    return max(longer, broader, 1.0)


def is_too_large(label: str, size_m: Point3) -> bool:
    """Whether a thing of that size cannot have that name: no bench is as deep as a table, be it as low as one."""
    largest_m = _LARGEST_M.get(plain_label(label))
    if largest_m is None:
        return False
    sides = (*sorted(size_m[:2], reverse=True), size_m[2])
    return any(side > largest for side, largest in zip(sides, largest_m, strict=True))


def spans_its_kind(label: str, size_m: Point3, settings: SizeSettings = SizeSettings()) -> bool:
    """Whether furniture that comes in one size is as long and as deep as that: of what is seen no side is missing."""
    category = category_of(label)
    usual_m, seen_m = sorted(category.size_m[:2]), sorted(size_m[:2])
    share = settings.side_share
    fits = all(abs(seen - usual) < share * usual for seen, usual in zip(seen_m, usual_m, strict=True))
    return fits and category.furniture and is_of_one_size(label)


def may_grow_m(label: str, size_m: Point3, settings: SizeSettings = SizeSettings()) -> float:
    """How much longer than it seems a thing may still be whose kind comes in one size; infinite for other kinds."""
    if not is_of_one_size(label):
        return math.inf
    return max((1.0 + settings.side_share) * max(category_of(label).size_m[:2]) - max(size_m[:2]), 0.0)


def has_back(label: str) -> bool:
    """Whether something rises on one side of what things are put on: the back of a seat, the head of a bed."""
    category = category_of(label)
    return category.furniture and category.levels and ("seat" in category.tags or category.label == "bed")


def is_person(label: str) -> bool:
    """Whether ``label`` names a human being."""
    return "person" in category_of(label).tags


@lru_cache(maxsize=4096)
def plain_label(label: str) -> str:
    """The name as the vocabulary writes it: *Washing_Machine* is a *washing machine*."""
    return re.sub(r"[\s_]+", " ", label.strip().lower())


def _unknown(label: str, size_m: Point3 | None, settings: SizeSettings) -> Category:
    if size_m is None or max(size_m) <= 0.0:
        return Category(label=label, graspable=True, known=False)
    furniture = max(size_m) > settings.furniture_from_m
    return Category(
        label=label,
        graspable=not furniture,
        support=furniture and min(size_m[:2]) > settings.gripper_opening_m,
        furniture=furniture,
        known=False,
        size_m=size_m,
    )


def _parse(rows: str) -> Mapping[str, Category]:
    categories: dict[str, Category] = {}
    for row in filter(None, rows.splitlines()):
        names, flags, size, tags = (cell.strip() for cell in row.split("|"))
        x_m, y_m, z_m = (float(number) for number in size.split())
        for name in names.split(", "):
            categories[name] = Category(
                label=name,
                graspable="g" in flags,
                support="s" in flags,
                container="c" in flags,
                furniture="f" in flags,
                round="r" in flags or "b" in flags,
                ball="b" in flags,
                levels="l" in flags,
                floor="f" in flags and "w" not in flags,
                background="x" in flags,
                size_m=(x_m, y_m, z_m),
                tags=tuple(tags.split()),
            )
    return MappingProxyType(categories)


CATEGORIES: Mapping[str, Category] = _parse(ROWS)
"""Every known name, other names of the same thing included."""

_LARGEST_M: Mapping[str, tuple[float, ...]] = {
    plain_label(name): tuple(map(float, sides.split()))
    for names, sides in (line.split("|") for line in LARGEST.strip().splitlines())
    for name in names.split(",")
}
