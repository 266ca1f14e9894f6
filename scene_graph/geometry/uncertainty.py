"""Covariance of rigid transforms under right perturbations, ``T = T_mean Exp(xi)``, ``xi ~ N(0, covariance)``.

First order; errors of different transforms are taken as independent. Covariances are (6, 6), ordered as in ``se3.py``,
in meters and radians, expressed in the frame on the right (the child). See Barfoot, Furgale, "Associating uncertainty
with three-dimensional poses for use in estimation problems" (2014), sections II and III.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]


def composed_covariance(covariance_a_b: Array, T_b_c: SE3, covariance_b_c: Array) -> Array:
    """Covariance of ``T_a_b @ T_b_c``: the first error is carried through the second transform by Ad of its inverse."""
    Ad = T_b_c.inverse().adjoint()
    covariance: Array = Ad @ covariance_a_b @ Ad.T + covariance_b_c
    return covariance


def inverse_covariance(T_a_b: SE3, covariance_a_b: Array) -> Array:
    """Covariance of ``T_b_a``: ``(T Exp(xi))^-1 = T^-1 Exp(-Ad_T xi)``."""
    Ad = T_a_b.adjoint()
    covariance: Array = Ad @ covariance_a_b @ Ad.T
    return covariance


def position_covariance(T_a_b: SE3, covariance_a_b: Array) -> Array:
    """(3, 3) covariance of b's origin along the axes of a, in square meters."""
    R = T_a_b.rotation()
    covariance: Array = R @ covariance_a_b[:3, :3] @ R.T
    return covariance
