"""What furniture of a name is like, as far as nobody has measured it: all that differs between kinds, in a table."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Kind:
    """What furniture of one kind is like; by default a plain top, or a shelf where boards were measured."""

    surface_share: float = 1.0
    """Height of what things are put on, as a share of the whole; less than 1 for seats and beds, over which there is
    nothing but a back and arms. Usual proportions.
    """
    rims_m: tuple[float, float] = (0.0, 0.0)
    """What arms and back take of the surface at the ends and at both of the long sides: which has the back is not
    known. Usual sizes.
    """
    arms_share: float | None = None
    """Height of the arms as a share of the whole, where the kind has any."""
    holds: bool = False
    """Whether things are put *in* it rather than *on* it."""
    closed: bool = False
    """Whether it has a top and a door: the hand opens no door, what is brought there is put on the top."""
    board_m: float = 0.035
    """How thick a board is, at most: only its upper side is measured."""
    top_m: float = 0.10
    """What is measured so near to the top is the top."""
    panel_m: float = 0.025
    """How thick the side of a shelf is, at its ends."""
    thin_m: float = 0.01
    """How thin a back or an arm is at least."""
    stands_m: float = 0.03
    """Half of what a thing takes at least: no back and no arm is where something stands."""

    @property
    def is_open(self) -> bool:
        """Whether things are dropped into it from above, one onto the other."""
        return self.holds and not self.closed

    @property
    def is_seat(self) -> bool:
        """Whether it carries things lower than its top, with nothing over them."""
        return self.surface_share < 1.0


_OPEN, _CLOSED = Kind(holds=True), Kind(holds=True, closed=True)
_COUCH = Kind(surface_share=0.5, rims_m=(0.2, 0.22), arms_share=0.75)
KINDS = {
    "chair": Kind(surface_share=0.5, rims_m=(0.03, 0.03)),
    "couch": _COUCH,
    "sofa": _COUCH,
    "bed": Kind(surface_share=0.55, rims_m=(0.06, 0.06)),
    "toilet": Kind(surface_share=0.5),
    **dict.fromkeys(("bowl", "box", "basket", "sink", "bin", "trash can", "bag"), _OPEN),
    **dict.fromkeys(("drawer", "cabinet", "refrigerator", "microwave", "oven"), _CLOSED),
}
_PLAIN = Kind()


def kind_of(label: str) -> Kind:
    """The kind of what has that label."""
    return KINDS.get(label.replace("_", " "), _PLAIN)


def is_container(label: str) -> bool:
    """Whether things are put *in* rather than *on* something of this label."""
    return kind_of(label).holds
