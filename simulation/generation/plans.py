"""A floor plan from a seed: of several that the dice give, the one with the least walking through others' rooms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from simulation.generation.carving import carve_rooms, carve_shapes
from simulation.generation.doorways import Doorway, choose_doorways, inner_outlines, strangeness
from simulation.generation.layouts import (
    Layout,
    Plot,
    Site,
    corridor_layout,
    fits,
    hall_layout,
    ring_layout,
    split_layout,
    wings_layout,
)
from simulation.generation.programs import Use
from simulation.generation.settings import PlanSettings
from simulation.generation.tiles import Outline

_LAYOUTS: Sequence[tuple[Layout, int, int]] = (
    (split_layout, 1, 9),
    (corridor_layout, 3, 14),
    (hall_layout, 3, 13),
    (wings_layout, 10, 30),
    (ring_layout, 10, 30),
)
"""Each with the fewest and the most rooms that it is good for."""


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Walls and doors, before the house is turned. ``outlines``: inner faces, in the order of ``uses``; millimeters."""

    uses: tuple[Use, ...]
    outlines: tuple[Outline, ...]
    doors: tuple[Doorway, ...]
    wall_mm: int


def draw_plan(
    generator: np.random.Generator,
    rooms: int,
    *,
    loops: bool,
    rectilinear: bool,
    settings: PlanSettings = PlanSettings(),
) -> Plan:
    """The best of several plans by the same dice, all of one kind of layout, or two where one does not come out."""
    site = Site(
        generator=generator,
        wall_mm=2 * int(generator.integers(40, 176)),
        office=bool(rooms > 12 or generator.random() < 0.4),
        settings=settings,
    )
    suited = [layout for layout, fewest, most in _LAYOUTS if fewest <= rooms <= most]
    if not loops and ring_layout in suited:
        suited.remove(ring_layout)
    candidates: list[tuple[int, list[Plot], list[Doorway]]] = []
    while not candidates:
        layout = suited[generator.integers(len(suited))]
        for _ in range(settings.layout.most_draws):
            plots = _plots(site, layout, rooms, rectilinear=rectilinear)
            doors = choose_doorways(site, plots, loops=loops) if plots else None
            if plots and doors is not None:
                candidates.append((strangeness(plots, doors), plots, doors))
            if len(candidates) == settings.layout.candidates or (candidates and candidates[-1][0] == 0):
                break
    _, plots, doors = min(candidates, key=lambda candidate: candidate[0])
    return Plan(
        uses=tuple(plot.use for plot in plots),
        outlines=tuple(inner_outlines(plots, site.wall_mm)),
        doors=tuple(doors),
        wall_mm=site.wall_mm,
    )


def _plots(site: Site, layout: Layout, rooms: int, *, rectilinear: bool) -> list[Plot] | None:
    """One try: a layout, and, where asked for, rooms cut out of it and shapes cut into it."""
    cut_out = int(site.generator.integers(0, 1 + rooms // 4)) if rectilinear and layout is not ring_layout else 0
    plots = layout(site, rooms - cut_out)
    if plots is None or not all(fits(plot, site) for plot in plots):
        return None
    if not rectilinear:
        return plots
    plots = carve_rooms(site, plots, cut_out)
    share = site.generator.uniform(0.22, 0.45)
    return plots and carve_shapes(site, plots, max(1, round(share * rooms)))
