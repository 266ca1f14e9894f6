"""Where sensors are on the base: ROS's tree of frames, as ``/tf`` and ``/tf_static`` tell it."""

from __future__ import annotations

from bisect import bisect_left
from collections import deque
from dataclasses import dataclass

from drivers.rosbridge.errors import FrameStale, FrameUnknown
from scene_graph.geometry.se3 import SE3

FIXED_S = -1.0
"""Stamp of what never changes."""
_DEPTH_LIMIT = 32
"""Frames on a way through the tree; more are a circle."""


@dataclass(frozen=True, kw_only=True)
class FrameSettings:
    """How long frames are remembered and believed."""

    history: int = 200
    """Transforms of each frame: two to four seconds at the rates at which they come."""
    stale_s: float = 0.5
    """How far beside what was told a frame may still be taken to be where it was: chosen."""


class FrameTree:
    """Newest transforms of each frame to its parent, with a short history of those that move.

    Stamps are the robot's own, seconds.
    """

    def __init__(self, settings: FrameSettings = FrameSettings()) -> None:
        self._settings = settings
        self._parents: dict[str, str] = {}
        self._history: dict[str, deque[tuple[float, SE3]]] = {}

    def fix(self, parent: str, child: str, T_parent_child: SE3) -> None:
        """Take in a transform that never changes."""
        self._parents[_plain(child)] = _plain(parent)
        self._history[_plain(child)] = deque([(FIXED_S, T_parent_child)], maxlen=self._settings.history)

    def put(self, parent: str, child: str, T_parent_child: SE3, stamp_s: float) -> None:
        """Take in a transform of something that moves."""
        parent, child = _plain(parent), _plain(child)
        if self._parents.get(child) != parent or self._history[child][-1][0] == FIXED_S:
            self._history[child] = deque(maxlen=self._settings.history)
        self._parents[child] = parent
        history = self._history[child]
        if history and stamp_s <= history[-1][0]:
            history.clear()
        history.append((stamp_s, T_parent_child))

    def lookup(self, base: str, frame: str, stamp_s: float) -> SE3:
        """``T_base_frame`` at ``stamp_s``, interpolated; a little beside what was told, as told nearest.

        Raises:
            FrameUnknown: no chain of transforms leads there.
            FrameStale: something on the way has not been told of for a while.
        """
        base, name = _plain(base), _plain(frame)
        T_name_frame = SE3.identity()
        for _ in range(_DEPTH_LIMIT):
            if name == base:
                return T_name_frame
            if name not in self._parents:
                break
            history, stale_s = self._history[name], self._settings.stale_s
            if history[-1][0] != FIXED_S and not history[0][0] - stale_s <= stamp_s <= history[-1][0] + stale_s:
                raise FrameStale(name)
            T_name_frame = _at(history, stamp_s) @ T_name_frame
            name = self._parents[name]
        raise FrameUnknown(base, _plain(frame), frozenset(self._parents))


def _plain(frame: str) -> str:
    """ROS 1 lets names begin with a slash."""
    return frame.lstrip("/")


def _at(history: deque[tuple[float, SE3]], stamp_s: float) -> SE3:
    index = bisect_left(history, stamp_s, key=lambda entry: entry[0])
    if index in {0, len(history)}:
        return history[min(index, len(history) - 1)][1]
    (before_s, before), (after_s, after) = history[index - 1], history[index]
    share = (stamp_s - before_s) / (after_s - before_s)
    return before @ SE3.exp(share * (before.inverse() @ after).log())
