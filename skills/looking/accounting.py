"""At the end of a look: is everything still there that should be? What hides is looked for from another side."""

from __future__ import annotations

from math import atan2, pi

from py_trees.common import Status

from scene_graph.edges import EdgeType
from scene_graph.nodes import ObjectNode, ObjectState
from skills.action import Action, RobotContext
from skills.anchor import Anchor
from skills.looking.looking import Gaze, aim
from skills.navigation.driving import DriveTo
from skills.navigation.goals import overlooking
from skills.navigation.pose import in_base


class Account:
    """What should be on or in a node, and was not seen since ``since_s`` before the account was opened."""

    def __init__(self, context: RobotContext, node_id: str, *, since_s: float = 10.0) -> None:
        self.context, self.node_id = context, node_id
        self._since_s = since_s
        self._from_s: float | None = None

    def open(self) -> None:
        """Begin, if it has not begun."""
        self._from_s = self.context.stamp_s - self._since_s if self._from_s is None else self._from_s

    def is_settled(self, object_id: str) -> bool:
        """Whether it was seen, or is known not to be there."""
        node = self.context.snapshot.get(object_id)
        if not isinstance(node, ObjectNode) or node.state is not ObjectState.PRESENT:
            return True
        return self._from_s is not None and node.last_seen_s > self._from_s

    def unseen(self) -> list[str]:
        """What is still to be accounted for, in the order of names."""
        snapshot = self.context.snapshot
        if self.node_id not in snapshot:
            return []
        there = sorted({edge.source for edge in snapshot.edges_to(self.node_id, EdgeType.RELATION)})
        return [thing for thing in there if snapshot.support_of(thing) == self.node_id and not self.is_settled(thing)]


class AccountFor(Action):
    """Looks at each thing of an account until it is seen, is known to be missing, or no doubt grew for ``patience_s``:
    a glance at a place is too short to be sure that a thing has gone.
    """

    timeout_s = 120.0

    def __init__(self, account: Account, *, patience_s: float = 3.0) -> None:
        super().__init__(f"account for what is at {account.node_id}", account.context)
        self._account, self._patience_s = account, patience_s
        self._gaze = Gaze(account.context)
        self._tried: set[str] = set()
        self._object_id: str | None = None
        self._waits_from_s: float | None = None
        self._existence = 1.0

    def begin(self) -> None:
        """Nothing was looked for yet."""
        self._account.open()
        self._tried, self._object_id = set(), None

    def step(self) -> Status:
        """One thing after the other."""
        object_id = self._object_id
        if object_id is None or self._account.is_settled(object_id) or self._is_out_of_patience():
            object_id = next((thing for thing in self._account.unseen() if thing not in self._tried), None)
            if object_id is None:
                return Status.SUCCESS
            self._tried.add(object_id)
            self._object_id, self._waits_from_s, self._existence = object_id, None, 1.0
        aimed, existence = self._gaze.at(*aim(self.context, Anchor(object_id))), self._existence_of(object_id)
        if aimed and (
            self._waits_from_s is None or existence < self._existence - self.context.settings.looking.noticeable
        ):
            self._waits_from_s, self._existence = self.context.stamp_s, existence
        return Status.RUNNING

    def _existence_of(self, object_id: str) -> float:
        node = self.context.snapshot.get(object_id)
        return node.existence if isinstance(node, ObjectNode) else 0.0

    def _is_out_of_patience(self) -> bool:
        return self._waits_from_s is not None and self.context.stamp_s - self._waits_from_s > self._patience_s


class SeeFromElsewhere(DriveTo):
    """Drives to where a node is overlooked from another side, if something of an account hides; else it stays, and so
    it does where no way leads around.
    """

    def __init__(self, account: Account, standoff_m: float) -> None:
        super().__init__(account.context, account.node_id, overlooking(account.context, account.node_id, standoff_m))
        self.name = f"see {account.node_id} from elsewhere"
        self._account, self._standoff_m = account, standoff_m
        self._needed = False

    def begin(self) -> None:
        """Decide which side it is: the one across from here."""
        hiding = self._account.unseen()
        self._needed = bool(hiding)
        if hiding:
            context, node_id = self.context, self._account.node_id
            robot = in_base(context, node_id).inverse()
            side_rad = pi + atan2(robot.y_m, robot.x_m)
            self._goals = overlooking(context, node_id, self._standoff_m, side_rad=side_rad, things=hiding)
            super().begin()

    def step(self) -> Status:
        """Drive on, as long as there is a reason to."""
        if not self._needed or super().step() is not Status.RUNNING:
            self.failure = None
            return Status.SUCCESS
        return Status.RUNNING
