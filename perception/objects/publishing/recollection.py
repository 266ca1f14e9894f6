"""Keeps tracks and nodes in step: what the graph brings back is adopted, furniture that it unloads is let go, what
people teach is believed.
"""

from __future__ import annotations

from collections.abc import Mapping

from perception.objects.beliefs import is_taught
from perception.objects.tracker import Tracker
from perception.objects.tracking.relations import RelationMemory
from perception.objects.tracking.track import Track
from scene_graph.edges import EdgeKey
from scene_graph.errors import FramesNotConnected
from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot


class Recollection:
    """Synchronizes the tracker with the graph at the start of every step."""

    def __init__(self, tracker: Tracker, relations: RelationMemory) -> None:
        self._tracker = tracker
        self._relations = relations
        self._written: set[str] = set()

    def sync(self, snapshot: Snapshot) -> set[EdgeKey]:
        """Bring the tracks in line with ``snapshot``; the relation edges of things that were adopted."""
        nodes = {node.id: node for node in snapshot.of_type(ObjectNode)}
        self._tracker.taken.update(nodes)
        self._tracker.taken.elsewhere = snapshot.elsewhere
        tracks = {track.node_id: track for track in self._tracker.tracks if track.node_id is not None}
        for node_id, track in tracks.items():
            if node_id in self._written and node_id not in nodes and not self._may_turn_up(track, snapshot):
                self._tracker.drop(track)
        self._written = set(nodes)
        new = [self._adopt(node, snapshot) for node in nodes.values() if self._is_new(node, tracks)]
        adopted = [track for track in new if track is not None]
        for node in nodes.values():
            self._listen(node, tracks.get(node.id))
        return self._adopt_relations(adopted, snapshot) if adopted else set()

    @staticmethod
    def _may_turn_up(track: Track, snapshot: Snapshot) -> bool:
        """Whether a thing in an unloaded room is one that people carry about: it is recognized wherever it is seen."""
        return track.node_id in snapshot.elsewhere and not track.is_furniture

    def _is_new(self, node: ObjectNode, tracks: Mapping[str, Track]) -> bool:
        return node.id not in tracks and node.id not in self._tracker.removed

    def _adopt(self, node: ObjectNode, snapshot: Snapshot) -> Track | None:
        room, parent = snapshot.room_of(node.id), snapshot.parent(node.id)
        if room is None or parent is None:
            return None
        try:
            T_room_object = snapshot.transform(room, node.id)
        except FramesNotConnected:
            return None
        R = T_room_object.rotation()
        track = self._tracker.new_track(room)
        track.adopt(node, T_room_object, R @ parent.covariance[:3, :3] @ R.T)
        return track

    @staticmethod
    def _listen(node: ObjectNode, track: Track | None) -> None:
        """A person's word for a thing, the newest one."""
        if track is not None and is_taught(node.label, node.label_distribution):
            track.label.teach(node.label)

    def _adopt_relations(self, adopted: list[Track], snapshot: Snapshot) -> set[EdgeKey]:
        """What was said of the things that were adopted; of what turned out to be another, it is said of that."""
        number_of = {t.node_id: t.number for t in self._tracker.tracks if t.node_id is not None}
        number_of |= {node_id: heir.number for node_id, heir in self._tracker.removed.items() if heir is not None}
        keys: set[EdgeKey] = set()
        for track in adopted:
            for edge in (*snapshot.relations(source=track.node_id), *snapshot.relations(target=track.node_id)):
                if edge.source in number_of and edge.target in number_of:
                    key = (number_of[edge.source], number_of[edge.target], edge.predicate)
                    self._relations.remember(key, edge.probability)
                    if not {edge.source, edge.target} & self._tracker.removed.keys():
                        keys.add(edge.key)
        return keys
