"""How right the graph is about the things of a house: counts of one house, and figures over several."""

from __future__ import annotations

import statistics
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from evaluations.perception.inventory import GraphContents, GraphThing, TrueThing, true_relations_of
from evaluations.perception.matching import Matching, match_things, off_m
from evaluations.perception.recognition import EITHER_WAY, share
from perception.labels import room_label
from scene_graph.nodes import UNKNOWN_LABEL
from simulation.houses.house import House

BANDS_M = (0.0, 1.0, 2.0, 3.0)
"""Where the bands of the distance begin from which a thing was seen at the nearest."""
NEAR_M = BANDS_M[-1]
"""What was seen from farther than the last band begins is not asked how right its place is."""
SUPPORTING = ("on", "in")
LABELS_ALIKE = {"corridor": "hall", "lounge": "living room"}
"""Uses of rooms that the graph has one word for."""


@dataclass(frozen=True, kw_only=True)
class Sightings:
    """From how near (meters) the camera was turned to each true thing, and from how near each node was last renewed.

    ``seconds``: time under way. ``switches``: how often a thing got another node meanwhile.
    """

    in_view_m: Mapping[str, float]
    renewed_m: Mapping[str, float]
    seconds: float
    switches: int


def score_house(house: House, true: Sequence[TrueThing], graph: GraphContents, sightings: Sightings) -> dict[str, Any]:
    """One house as the JSON file holds it. Of things in rooms that the robot never found nothing is asked."""
    matching = match_things(true, graph.things)
    asked = [thing for thing in true if thing.room in graph.rooms]
    return {
        "things": [_thing_row(thing, graph, matching, sightings) for thing in asked],
        "nodes": [
            {
                "id": node.id,
                "label": node.label,
                "is": verdict,
                "of": of,
                "position_m": node.position_m.round(3).tolist(),
            }
            for node in graph.things
            for verdict, of in [_verdict(node, matching)]
        ],
        "relations": _relation_counts(asked, graph, matching),
        "rooms": _room_rows(house, asked, graph),
        "seconds": round(sightings.seconds, 2),
        "switches": sightings.switches,
    }


def summarize(runs: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Figures over all houses, shares None where nothing was counted."""
    things = [row for run in runs for row in run["things"]]
    nodes = [row for run in runs for row in run["nodes"]]
    found = [row for row in things if row["found"] == "named"]
    placed = [row for row in things if row["node"] is not None]
    rooms = [row for run in runs for row in run["rooms"] if row["told"]]
    minutes = sum(run["seconds"] for run in runs) / 60.0
    related = {name: _summed(runs, name) for name in sorted({name for run in runs for name in run["relations"]})}
    near = [row["error_m"] for row in found if row["renewed_m"] is not None and row["renewed_m"] <= NEAR_M]
    return {
        "things": len(things),
        "nodes": len(nodes),
        "recall": share(len(found), len(things)),
        "recall_in_view": _share(row["found"] == "named" for row in things if _was_near(row)),
        "found_under_any_name": share(len(placed), len(things)),
        "precision": _share(row["is"] == "named" for row in nodes if row["is"] != "unnamed"),
        "unnamed": _share(row["is"] == "unnamed" for row in nodes),
        "duplicates": _share(row["is"] == "duplicate" for row in nodes),
        "invented": _share(row["is"] == "invented" for row in nodes),
        "position_error_m": statistics.fmean(near) if near else None,
        "position_error_small_m": _error(row for row in found if not row["furniture"]),
        "position_error_furniture_m": _error(row for row in found if row["furniture"]),
        "size_error_furniture_m": _error((row for row in found if row["furniture"]), "size_error_m"),
        "position_error_by_distance": {f"{low:g}": _error(rows) for low, rows in _banded(found).items()},
        "recall_by_distance": {
            f"{low:g}": _share(row["found"] == "named" for row in rows)
            for low, rows in _banded(things, by="in_view_m").items()
        },
        "switches_per_10_min": 10.0 * sum(run["switches"] for run in runs) / minutes if minutes else None,
        "room_right": _share(row["room_right"] for row in placed),
        "support_right": _share(row["support"] == "right" for row in placed if row["support"] != "none"),
        "support": dict(sorted(Counter(row["support"] for row in placed if row["support"] != "none").items())),
        "relation_recall": share(sum(hit for hit, _ in related.values()), sum(there for _, there in related.values())),
        "relation_recall_by_predicate": {name: share(*counts) for name, counts in related.items()},
        "room_labels_right": _share(row["right"] for row in rooms),
        "classes": _classes(things, nodes),
        "misnamed": [
            [*pair, count]
            for pair, count in Counter(
                (row["category"], row["called"]) for row in things if row["found"] == "misnamed"
            ).most_common(20)
        ],
    }


def _thing_row(thing: TrueThing, graph: GraphContents, matching: Matching, sightings: Sightings) -> dict[str, Any]:
    node = next((node for node in graph.things if node.id == matching.node_of.get(thing.id)), None)
    found = _verdict(node, matching)[0] if node is not None else "missed"
    return {
        "id": thing.id,
        "category": thing.category,
        "furniture": thing.furniture,
        "room": thing.room,
        "found": found,
        "node": node.id if node is not None else None,
        "called": node.label if node is not None else None,
        "position_m": thing.position_m.round(3).tolist(),
        "error_m": round(off_m(thing, node), 4) if node is not None else None,
        "size_error_m": round(_size_error_m(thing, node), 4) if node is not None else None,
        "in_view_m": sightings.in_view_m.get(thing.id),
        "renewed_m": sightings.renewed_m.get(node.id) if node is not None else None,
        "room_right": node is not None and node.room == graph.rooms.get(thing.room or ""),
        "support": _support(thing, graph, matching),
    }


def _size_error_m(thing: TrueThing, node: GraphThing) -> float:
    """How much the longer or the shorter side, seen from above, is off, whichever is more."""
    sides = zip(sorted(thing.size_m[:2]), sorted(node.size_m[:2]), strict=True)
    return max(abs(true_m - said_m) for true_m, said_m in sides)


def _support(thing: TrueThing, graph: GraphContents, matching: Matching) -> str:
    """What the graph says of what carries a thing: right, other (another carrier), lacking, or made up."""
    node = matching.node_of.get(thing.id)
    said = {
        (predicate, matching.thing_of.get(target, matching.duplicates.get(target, "")))
        for source, predicate, target in graph.relations
        if source == node and predicate in SUPPORTING
    }
    if thing.furniture or node is None:
        return "none"
    if thing.support is None:
        return "made up" if said else "right"
    if said == {thing.support}:
        return "right"
    return "other" if said else "lacking"


def _verdict(node: GraphThing, matching: Matching) -> tuple[str, str | None]:
    """What a node is, and of which thing; one that stands for a thing and claims no name is merely unnamed."""
    if node.id in matching.duplicates:
        return "duplicate", matching.duplicates[node.id]
    thing = matching.thing_of.get(node.id)
    if thing is None:
        return "invented", None
    if thing in matching.named:
        return "named", thing
    return ("unnamed" if node.label == UNKNOWN_LABEL else "misnamed"), thing


def _relation_counts(
    things: Sequence[TrueThing], graph: GraphContents, matching: Matching
) -> dict[str, tuple[int, int]]:
    """(stated by the graph, true) by predicate."""
    thing_of = matching.thing_of
    said = {(thing_of.get(a), predicate, thing_of.get(b)) for a, predicate, b in graph.relations}
    counts: dict[str, tuple[int, int]] = {}
    for subject, predicate, other in true_relations_of(things):
        hit = (subject, predicate, other) in said
        hit |= predicate == EITHER_WAY and (other, predicate, subject) in said
        before = counts.get(predicate, (0, 0))
        counts[predicate] = (before[0] + hit, before[1] + 1)
    return counts


def _room_rows(house: House, things: Sequence[TrueThing], graph: GraphContents) -> list[dict[str, Any]]:
    """``told``: whether the contents of the room, truly known, would tell its use."""
    rows = []
    for room in house.rooms:
        if room.id not in graph.rooms:
            continue
        label = LABELS_ALIKE.get(room.label, room.label)
        inside = [(thing.category.replace("_", " "), 1.0) for thing in things if thing.room == room.id]
        said = graph.labels.get(graph.rooms[room.id], "")
        rows.append(
            {
                "room": room.id,
                "label": label,
                "said": said,
                "right": said == label,
                "told": room_label(inside)[0] == label,
            }
        )
    return rows


def _classes(things: Sequence[Mapping[str, Any]], nodes: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    names = sorted({row["category"] for row in things} | {row["label"] for row in nodes})
    result = {}
    for name in names:
        mine = [row for row in things if row["category"] == name]
        called = [row for row in nodes if row["label"] == name]
        result[name] = {
            "there": len(mine),
            "claimed": len(called),
            "recall": _share(row["found"] == "named" for row in mine),
            "found_under_any_name": _share(row["node"] is not None for row in mine),
            "precision": _share(row["is"] == "named" for row in called),
            "error_m": _error(row for row in mine if row["found"] == "named"),
        }
    return result


def _banded(rows: Iterable[Mapping[str, Any]], by: str = "renewed_m") -> dict[float, list[Mapping[str, Any]]]:
    """Rows by the band of distances in which they are; those without a distance are left out."""
    bands: dict[float, list[Mapping[str, Any]]] = {low: [] for low in BANDS_M}
    for row in rows:
        if row[by] is not None:
            bands[max(low for low in BANDS_M if row[by] >= low)].append(row)
    return bands


def _was_near(row: Mapping[str, Any]) -> bool:
    return row["in_view_m"] is not None and row["in_view_m"] <= NEAR_M


def _error(rows: Iterable[Mapping[str, Any]], by: str = "error_m") -> float | None:
    errors = [row[by] for row in rows]
    return statistics.fmean(errors) if errors else None


def _share(marks: Iterable[bool]) -> float | None:
    counted = list(marks)
    return share(sum(counted), len(counted))


def _summed(runs: Sequence[Mapping[str, Any]], predicate: str) -> tuple[int, int]:
    """(stated, true) over all houses."""
    counts = [run["relations"].get(predicate, (0, 0)) for run in runs]
    return sum(hit for hit, _ in counts), sum(there for _, there in counts)
