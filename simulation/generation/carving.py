"""Rooms that are no rectangles: a piece of one becomes a small room, goes to its neighbor, or to the open air."""

from __future__ import annotations

from dataclasses import replace

from simulation.generation.layouts import Plot, Site, fits
from simulation.generation.programs import CORRIDOR, SERVICE, USES, Wish
from simulation.generation.tiles import Shape, Tile, area, inset, narrowest, outline_of, shape_of, sides, without


def carve_rooms(site: Site, plots: list[Plot], rooms: int) -> list[Plot] | None:
    """That many bathrooms and the like, each cut out of a corner or a side of a larger room; None when none fits."""
    labels = sorted(SERVICE)
    for _ in range(rooms):
        use = USES[labels[site.generator.integers(len(labels))]]
        wish = Wish(use=use, area_m2=float(site.generator.uniform(*use.area_m2)))
        carved = next(
            (new for _ in range(site.settings.carving.tries) if (new := _with_room(site, plots, wish)) is not None),
            None,
        )
        if carved is None:
            return None
        plots = carved
    return plots


def carve_shapes(site: Site, plots: list[Plot], wanted: int) -> list[Plot] | None:
    """Pieces change hands until ``wanted`` rooms are no rectangles, or dice are tired; None while there are none."""
    for _ in range(site.settings.carving.tries * len(plots)):
        if bent(plots) >= wanted:
            break
        plots = _moved(site, plots) or plots
    return plots if bent(plots) else None


def bent(plots: list[Plot]) -> int:
    """How many rooms are no rectangles."""
    return sum(_shape(plot) is not Shape.RECTANGLE for plot in plots)


def _shape(plot: Plot) -> Shape | None:
    outline = outline_of(plot.tiles)
    return None if outline is None else shape_of(outline)


def _with_room(site: Site, plots: list[Plot], wish: Wish) -> list[Plot] | None:
    """One try to cut a room out of another one."""
    giver = int(site.generator.integers(len(plots)))
    wide_m = site.generator.uniform(wish.use.width_m, 3.0)
    deep_m = max(wish.area_m2 / wide_m, wish.use.width_m)
    wide, deep = (round(1000 * extent) + site.wall_mm for extent in (wide_m, deep_m))
    tile = _piece(site, plots[giver], wide, deep)
    rest = _less(site, plots[giver], tile)
    room = Plot(use=wish.use, tiles=(tile,))
    if rest is None or not fits(room, site):
        return None
    return [*_replaced(plots, giver, rest), room]


def _moved(site: Site, plots: list[Plot]) -> list[Plot] | None:
    """One try to give a piece of a room to a neighbor or to the open air."""
    giver = int(site.generator.integers(len(plots)))
    if plots[giver].use is CORRIDOR:
        return None
    tile = _piece(site, plots[giver], site.between(0.7, 3.5), site.between(0.6, 2.5))
    rest = _less(site, plots[giver], tile)
    if rest is None:
        return None
    if site.chance(0.4):
        return _replaced(plots, giver, rest) if _open_to_the_air(plots, tile, site.settings.carving.open_m) else None
    touching = [
        index for index, plot in enumerate(plots) if index != giver and any(t.touches(tile) for t in plot.tiles)
    ]
    if not touching:
        return None
    taker = touching[site.generator.integers(len(touching))]
    grown = replace(plots[taker], tiles=(*plots[taker].tiles, tile))
    return _replaced(_replaced(plots, giver, rest), taker, grown) if _sound(site, grown) else None


def _piece(site: Site, plot: Plot, wide: int, deep: int) -> Tile:
    """A rectangle in a corner or at a side of the room's bounding box."""
    if site.chance(0.5):
        wide, deep = deep, wide
    left, low = min(t.left for t in plot.tiles), min(t.low for t in plot.tiles)
    right, high = max(t.right for t in plot.tiles), max(t.high for t in plot.tiles)
    x = right - wide if site.chance(0.5) else left
    y = high - deep if site.chance(0.5) else low
    if site.chance(0.3):
        x = left + round(site.generator.uniform(0.2, 0.8) * (right - left - wide))
    return Tile(x, y, x + wide, y + deep)


def _less(site: Site, plot: Plot, tile: Tile) -> Plot | None:
    """The room without the piece; None when that is not sound, or the piece is not all of this room."""
    rest = replace(plot, tiles=without(plot.tiles, tile))
    whole = area(rest.tiles) + tile.width * tile.height == area(plot.tiles)
    return rest if whole and rest.tiles and _sound(site, rest) else None


def _sound(site: Site, plot: Plot) -> bool:
    """A rectangle, L, T or U with arms that a robot likes to drive in, of a size that suits its use."""
    wall_mm, settings = site.wall_mm, site.settings.carving
    outline = outline_of(plot.tiles)
    if outline is None or shape_of(outline) is None or not fits(plot, site):
        return False
    shortest = min(abs(b[0] - a[0]) + abs(b[1] - a[1]) for a, b in sides(inset(outline, wall_mm // 2)))
    arm_m = plot.use.width_m if plot.use is CORRIDOR or shape_of(outline) is Shape.RECTANGLE else settings.arm_m
    roomy = area(plot.tiles) / 1e6 >= 0.7 * plot.use.area_m2[0]
    return roomy and shortest >= 1000 * settings.side_m and narrowest(plot.tiles) - wall_mm >= 1000 * arm_m


def _open_to_the_air(plots: list[Plot], tile: Tile, open_m: float) -> bool:
    """Whether nothing stands before at least one side of the piece."""
    far = round(1000 * open_m)
    strips = (
        Tile(tile.left, tile.high, tile.right, tile.high + far),
        Tile(tile.left, tile.low - far, tile.right, tile.low),
        Tile(tile.right, tile.low, tile.right + far, tile.high),
        Tile(tile.left - far, tile.low, tile.left, tile.high),
    )
    built = [t for plot in plots for t in plot.tiles]
    return any(not any(strip.overlaps(t) for t in built) for strip in strips)


def _replaced(plots: list[Plot], index: int, plot: Plot) -> list[Plot]:
    return [*plots[:index], plot, *plots[index + 1 :]]
