"""Transforms along chains of rt edges (Concepts, section 3.1): up to the lowest common ancestor and down again."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from scene_graph.edges import RtEdge
from scene_graph.errors import FramesNotConnected
from scene_graph.geometry.se3 import SE3
from scene_graph.geometry.uncertainty import composed_covariance, inverse_covariance

Array = NDArray[np.float64]
ParentOf = Callable[[str], RtEdge | None]
_IDENTITY = SE3.identity()


def chain_up(parent_of: ParentOf, frame: str) -> list[RtEdge]:
    """The rt edges from a frame up to the top of its tree, nearest first; stops where a broken graph would loop."""
    edges: list[RtEdge] = []
    seen = {frame}
    edge = parent_of(frame)
    while edge is not None and edge.source not in seen:
        edges.append(edge)
        seen.add(edge.source)
        edge = parent_of(edge.source)
    return edges


def chains_to_common_ancestor(parent_of: ParentOf, target: str, source: str) -> tuple[list[RtEdge], list[RtEdge]]:
    """The edges from target and from source up to their lowest common ancestor.

    Raises:
        FramesNotConnected: they have none.
    """
    target_chain, source_chain = chain_up(parent_of, target), chain_up(parent_of, source)
    depth = {frame: i for i, frame in enumerate((target, *(edge.source for edge in target_chain)))}
    for i, frame in enumerate((source, *(edge.source for edge in source_chain))):
        if frame in depth:
            return target_chain[: depth[frame]], source_chain[:i]
    raise FramesNotConnected(
        target,
        source,
        target_chain=[target, *(edge.source for edge in target_chain)],
        source_chain=[source, *(edge.source for edge in source_chain)],
    )


def transform_down(chain: Sequence[RtEdge]) -> SE3:
    """``T_top_bottom`` of a chain given from bottom to top."""
    if not chain:
        return _IDENTITY
    T_top_bottom = chain[0].T_source_target
    for edge in chain[1:]:
        T_top_bottom = edge.T_source_target @ T_top_bottom
    return T_top_bottom


def transform_between(target_chain: Sequence[RtEdge], source_chain: Sequence[RtEdge]) -> SE3:
    """``T_target_source`` from the two chains to the common ancestor."""
    T_ancestor_source = transform_down(source_chain)
    if not target_chain:
        return T_ancestor_source
    T_target_ancestor = transform_down(target_chain).inverse()
    return T_target_ancestor @ T_ancestor_source if source_chain else T_target_ancestor


def covariance_between(target_chain: Sequence[RtEdge], source_chain: Sequence[RtEdge]) -> Array:
    """Covariance (6, 6) of ``T_target_source``, expressed in the source frame; see ``uncertainty.py``."""
    T_ancestor_target, covariance_target = _uncertain_down(target_chain)
    T_ancestor_source, covariance_source = _uncertain_down(source_chain)
    covariance_inverse = inverse_covariance(T_ancestor_target, covariance_target)
    return composed_covariance(covariance_inverse, T_ancestor_source, covariance_source)


def _uncertain_down(chain: Sequence[RtEdge]) -> tuple[SE3, Array]:
    T_top_bottom, covariance = _IDENTITY, np.zeros((6, 6))
    for edge in reversed(chain):
        covariance = composed_covariance(covariance, edge.T_source_target, edge.covariance)
        T_top_bottom = T_top_bottom @ edge.T_source_target
    return T_top_bottom, covariance
