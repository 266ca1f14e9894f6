"""Poses of nodes in the map, which is the frame of the root: the robot's pose at its very first start."""

from __future__ import annotations

from scene_graph.edges import EdgeType
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ROOT_ID, AffordanceNode, RoomNode
from scene_graph.snapshot import Snapshot


class MapPoses:
    """``T_map_node`` for many nodes of one snapshot; every frame on the way is composed once."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._poses: dict[str, SE3 | None] = {ROOT_ID: SE3.identity()}

    def pose(self, node_id: str) -> SE3 | None:
        """``T_map_node``; an affordance is where its owner is; None when the node does not hang from the root."""
        if node_id in self._poses:
            return self._poses[node_id]
        self._poses[node_id] = None  # also ends the recursion in a broken graph whose frames form a circle
        self._poses[node_id] = pose = self._composed(node_id)
        return pose

    def _composed(self, node_id: str) -> SE3 | None:
        if isinstance(self._snapshot.get(node_id), AffordanceNode):
            owners = self._snapshot.edges_to(node_id, EdgeType.HAS)
            return self.pose(owners[0].source) if owners else None
        edge = self._snapshot.parent(node_id)
        T_map_parent = self.pose(edge.source) if edge else None
        return T_map_parent @ edge.T_source_target if edge and T_map_parent else None


def layout(snapshot: Snapshot) -> dict[str, SE3]:
    """``T_map_room`` of every room that hangs from the root, in natural order."""
    poses = MapPoses(snapshot)
    found = ((room.id, poses.pose(room.id)) for room in snapshot.of_type(RoomNode))
    return {room_id: pose for room_id, pose in found if pose is not None}
