"""Furniture that carries things lower than its top, with nothing over them: seats and beds."""

from __future__ import annotations

SEAT_SHARES = {"chair": 0.5, "couch": 0.5, "sofa": 0.5, "bed": 0.55, "toilet": 0.5}
"""Height of the surface as a share of the whole, for furniture that rises above what things are put on."""
SEAT_RIMS_M = {"chair": (0.03, 0.03), "couch": (0.2, 0.22), "sofa": (0.2, 0.22), "bed": (0.06, 0.06)}
"""What arms and back take of the surface at the ends and at both of the long sides: which has the back is not known."""


def is_seat(label: str) -> bool:
    """Whether furniture of that name carries things lower than its top, with nothing over them."""
    return _plain(label) in SEAT_SHARES


def seat_share(label: str) -> float:
    """Height of what things are put on, as a share of the whole; 1 for what is no seat."""
    return SEAT_SHARES.get(_plain(label), 1.0)


def rims_m(label: str) -> tuple[float, float]:
    """What arms and back take at the ends and at the long sides."""
    return SEAT_RIMS_M.get(_plain(label), (0.0, 0.0))


def _plain(label: str) -> str:
    return label.replace("_", " ")
