"""What the simulated house knows of a kind of thing: usual size, mass, graspable or not, what it is made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from simulation.furnishing.shapes import BUILDERS, Part, Size3, plain_box
from simulation.furnishing.small_shapes import SMALL_BUILDERS
from simulation.houses.colors import Rgb, color_of
from simulation.robot.description import RobotDescription


@dataclass(frozen=True, kw_only=True)
class Category:
    """A kind of thing. ``size_m``: usual extent in x, y, z. ``mass_kg``: 0 for what never moves.

    ``color``: the usual one. ``container``: things go into it, onto its first level. ``levels``: heights on which
    things stand, as shares of the full height, the usual one first; the top is 1.
    """

    name: str
    size_m: Size3
    mass_kg: float
    color: str
    support: bool = False
    container: bool = False
    levels: tuple[float, ...] = (1.0,)

    @property
    def static(self) -> bool:
        return self.mass_kg == 0.0

    @property
    def graspable(self) -> bool:
        """Whether the two-finger hand can take it at its usual size."""
        return not self.static and min(self.size_m[:2]) <= RobotDescription().graspable_m

    def parts(self, size_m: Size3, color: Rgb) -> tuple[Part, ...]:
        """The primitives that make up one of ``size_m`` meters, about the center of its bottom."""
        build = BUILDERS.get(self.name) or SMALL_BUILDERS.get(self.name, plain_box)
        return build(size_m, color)


def _furniture(name: str, size_m: Size3, color: str, **what: bool | tuple[float, ...]) -> Category:
    return Category(name=name, size_m=size_m, mass_kg=0.0, color=color, **what)  # type: ignore[arg-type]


def _thing(
    name: str, size_m: Size3, mass_kg: float, color: str, *, support: bool = False, container: bool = False
) -> Category:
    levels = (0.15,) if container else (1.0,)
    return Category(
        name=name, size_m=size_m, mass_kg=mass_kg, color=color, support=support, container=container, levels=levels
    )


_ALL = (
    _furniture("table", (1.2, 0.8, 0.75), "brown", support=True),
    _furniture("desk", (1.4, 0.7, 0.75), "tan", support=True),
    _furniture("counter", (1.8, 0.6, 0.9), "gray", support=True),
    _furniture("chair", (0.45, 0.45, 0.9), "dark brown", support=True, levels=(0.5,)),
    _furniture("stool", (0.4, 0.4, 0.5), "brown", support=True),
    _furniture("bench", (1.2, 0.4, 0.45), "brown", support=True),
    _furniture("sofa", (1.9, 0.9, 0.8), "teal", support=True, levels=(0.5,)),
    _furniture("bed", (1.5, 2.0, 0.9), "light blue", support=True, levels=(0.55,)),
    _furniture("shelf", (0.9, 0.35, 1.6), "tan", support=True, levels=(0.5, 0.75, 0.25, 1.0)),
    _furniture("cabinet", (0.9, 0.45, 0.9), "brown", support=True),
    _furniture("wardrobe", (1.2, 0.6, 1.9), "dark brown"),
    _furniture("nightstand", (0.45, 0.4, 0.55), "brown", support=True),
    _furniture("tv_stand", (1.4, 0.4, 0.5), "dark gray", support=True),
    _furniture("tv", (1.0, 0.15, 0.65), "black"),
    _furniture("fridge", (0.65, 0.65, 1.75), "white"),
    _furniture("stove", (0.6, 0.6, 0.9), "light gray", support=True),
    _furniture("sink", (0.7, 0.55, 0.88), "white", container=True, levels=(0.8,)),
    _furniture("washing_machine", (0.6, 0.6, 0.85), "white", support=True),
    _furniture("toilet", (0.4, 0.65, 0.8), "white"),
    _furniture("bathtub", (1.7, 0.75, 0.55), "white", container=True, levels=(0.3,)),
    _furniture("lamp", (0.35, 0.35, 1.5), "yellow"),
    _furniture("plant", (0.4, 0.4, 0.9), "green"),
    _furniture("bin", (0.3, 0.3, 0.45), "dark gray", container=True, levels=(0.05,)),
    _thing("bottle", (0.07, 0.07, 0.24), 0.3, "blue"),
    _thing("can", (0.066, 0.066, 0.12), 0.3, "red"),
    _thing("cup", (0.08, 0.08, 0.1), 0.15, "white"),
    _thing("mug", (0.08, 0.08, 0.1), 0.25, "orange"),
    _thing("glass", (0.07, 0.07, 0.13), 0.15, "light cyan"),
    _thing("bowl", (0.09, 0.09, 0.055), 0.2, "white", container=True),
    _thing("plate", (0.22, 0.22, 0.025), 0.3, "white", support=True),
    _thing("vase", (0.09, 0.09, 0.22), 0.35, "purple"),
    _thing("apple", (0.075, 0.075, 0.075), 0.15, "red"),
    _thing("orange", (0.08, 0.08, 0.08), 0.18, "orange"),
    _thing("banana", (0.18, 0.04, 0.04), 0.12, "yellow"),
    _thing("ball", (0.085, 0.085, 0.085), 0.1, "green"),
    _thing("book", (0.2, 0.085, 0.035), 0.3, "dark blue", support=True),
    _thing("box", (0.14, 0.085, 0.1), 0.25, "tan", support=True),
    _thing("toy", (0.08, 0.08, 0.08), 0.1, "red"),
    _thing("teddy", (0.12, 0.09, 0.2), 0.15, "brown"),
    _thing("remote", (0.17, 0.05, 0.025), 0.1, "black"),
    _thing("phone", (0.15, 0.07, 0.015), 0.18, "black"),
    _thing("scissors", (0.17, 0.06, 0.015), 0.08, "red"),
    _thing("keys", (0.09, 0.05, 0.015), 0.05, "silver"),
    _thing("clock", (0.12, 0.06, 0.12), 0.25, "red"),
)

CATEGORIES: Mapping[str, Category] = MappingProxyType({category.name: category for category in _ALL})
"""Every category with a shape of its own, by name."""

_OTHER_NAMES: Mapping[str, str] = MappingProxyType(
    {
        "couch": "sofa", "refrigerator": "fridge", "bookshelf": "shelf", "bookcase": "shelf", "cupboard": "cabinet",
        "sideboard": "cabinet", "dresser": "cabinet", "dining_table": "table", "coffee_table": "table", "oven": "stove",
        "trash_can": "bin", "potted_plant": "plant", "cell_phone": "phone", "teddy_bear": "teddy", "television": "tv",
        "remote_control": "remote", "soda_can": "can", "sports_ball": "ball", "vessel": "vase", "armchair": "chair",
        "closet": "wardrobe", "bedside_table": "nightstand", "office_chair": "chair", "wine_glass": "glass",
    }
)  # fmt: skip


def knows(category: str) -> bool:
    """Whether the category, or another name of it, has a shape of its own."""
    return _key(category) in CATEGORIES


def category_names() -> tuple[str, ...]:
    """Every category with a shape of its own, sorted."""
    return tuple(sorted(CATEGORIES))


def category_named(name: str, size_m: Size3 | None = None, *, static: bool = False) -> Category:
    """What is known of ``name``; an unknown one is a plain box of ``size_m``.

    ``static``: it is furniture. A known thing used as furniture becomes static by this.
    """
    known = CATEGORIES.get(_key(name))
    size = size_m or (known.size_m if known is not None else (0.1, 0.08, 0.1))
    if known is not None and known.static == static:
        return known
    volume_m3 = size[0] * size[1] * size[2]
    mass_kg = 0.0 if static else min(0.4, max(0.05, 250.0 * volume_m3))
    color = known.color if known is not None else "light gray"
    return Category(
        name=known.name if known is not None else name, size_m=size, mass_kg=mass_kg, color=color, support=True
    )


def rgb_of(category: Category, color: str | None) -> Rgb:
    """The color asked for, or the category's usual one, as shares of red, green and blue."""
    return color_of(color or category.color)


def _key(name: str) -> str:
    plain = name.strip().lower().replace(" ", "_").replace("-", "_")
    return _OTHER_NAMES.get(plain, plain)
