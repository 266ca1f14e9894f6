import json
import math

import pytest

from app.commands.export import export
from app.commands.options import GraphFormat
from app.exchange.stored_graph import load_graph
from scene_graph.documents.interchange import to_json
from scene_graph.errors import SceneFormatError
from scene_graph.queries.topology import Topology
from scene_graph.spark_dsg.layers import symbol
from scene_graph.spark_dsg.reader import from_spark_dsg
from scene_graph.spark_dsg.writer import to_spark_dsg


def node(category, index, layer, position, partition=0, **attributes):
    kind = {"a": "AgentNodeAttributes", "p": "PlaceNodeAttributes", "R": "RoomNodeAttributes"}.get(category, "")
    attributes = {"type": kind, "position": position, "metadata": None, **attributes}
    return {"id": symbol(category, index), "layer": layer, "partition": partition, "attributes": attributes}


def joined(*ends):
    first, second = (symbol(*end) for end in ends)
    return {"source": first, "target": second, "info": {"type": "EdgeAttributes"}}


@pytest.fixture
def foreign():
    """As Hydra writes it: two rooms that places join, a chair under a place, and where the robot was, twice."""
    box = {
        "type": "RAABB",
        "dimensions": [0.5, 0.4, 1.0],
        "world_P_center": [1.0, 1.0, 0.5],
        "world_R_center": {"w": math.cos(0.2), "x": 0.0, "y": 0.0, "z": math.sin(0.2)},
    }
    rooms = {"type": "AABB", "dimensions": [4.0, 4.0, 2.5], "world_R_center": {"w": 1.0, "x": 0.0, "y": 0.0, "z": 0.0}}
    return {
        "SPARK_DSG_header": {"project_name": "main", "version": {"major": 1, "minor": 1, "patch": 0}},
        "directed": False,
        "metadata": {"labelspaces": {"_l2p0": [[7, "chair"]], "_l4p0": [[1, "kitchen"]]}},
        "nodes": [
            node("O", 3, 2, [1.0, 1.1, 0.4], semantic_label=7, bounding_box=box, last_update_time_ns=2_500_000_000),
            node("O", 4, 2, [6.0, 1.0, 0.4], semantic_label=99, name=""),
            node("p", 0, 3, [1.0, 1.0, 1.0], distance=0.9),
            node("p", 1, 3, [3.8, 1.0, 1.0], distance=0.5),
            node("p", 2, 3, [4.2, 1.2, 1.0], distance=0.45),
            node("R", 0, 4, [2, 2, 0], semantic_label=1, bounding_box=rooms | {"world_P_center": [2.0, 2.0, 1.0]}),
            node("R", 1, 4, [6.0, 2.0, 0.0], bounding_box=rooms | {"world_P_center": [6.0, 2.0, 1.0]}),
            node("a", 0, 2, [0.5, 0.5, 0.0], partition=97),
            node("a", 1, 2, [6.0, 2.0, 0.0], partition=97),
        ],
        "edges": [
            joined(("R", 0), ("p", 0)),
            joined(("R", 0), ("p", 1)),
            joined(("R", 1), ("p", 2)),
            joined(("p", 0), ("p", 1)),
            joined(("p", 1), ("p", 2)),
            joined(("p", 0), ("O", 3)),
            joined(("R", 1), ("O", 4)),
            joined(("R", 0), ("R", 1)),
            joined(("a", 0), ("a", 1)),
        ],
    }  # fmt: skip


def test_somebody_elses_graph_has_rooms_things_a_way_between_and_a_robot(foreign):
    graph = from_spark_dsg(foreign)
    assert {room.id: room.label for room in (graph.room("room_0"), graph.room("room_1"))} == {
        "room_0": "kitchen",
        "room_1": "",
    }
    chair = {record["id"]: record for record in to_json(graph)["nodes"]}["chair_3"]
    assert (chair["label"], chair["room"], chair["size_m"]) == ("chair", "room_0", [0.5, 0.4, 1.0])
    assert chair["position_m"] == [1.0, 1.0, 0.5]
    assert chair["yaw_rad"] == pytest.approx(0.4)
    assert chair["last_seen_s"] == 2.5
    assert graph.object("unknown_4").label == "unknown"
    assert graph.room_of("unknown_4") == graph.current_room == "room_1"
    door = graph.door("door_0_1")
    assert door.width_m == pytest.approx(0.9)
    assert graph.position("door_0_1", "root")[:2] == pytest.approx([4.0, 1.1])
    assert Topology.from_snapshot(graph).path("room_0", "room_1").doors == ("door_0_1",)


def test_rooms_that_are_joined_without_places_have_a_door_between_them(foreign):
    foreign["edges"] = [joined(("R", 0), ("R", 1))]
    graph = from_spark_dsg(foreign)
    assert graph.position("door_0_1", "root")[:2] == pytest.approx([4.0, 2.0])


def changed(document, path, value):
    *parents, last = path
    spot = document
    for key in parents:
        spot = spot[key]
    spot[last] = value
    return document


@pytest.mark.parametrize(
    ("path", "value", "named", "why"),
    [
        (("nodes",), None, "nodes", "valid tuple"),
        (("nodes", 0, "id"), -1, "nodes[0].id", "greater than or equal to 0"),
        (("nodes", 1, "id"), symbol("O", 3), "nodes[0].id", "also the id of another node"),
        (("nodes", 0, "attributes", "position"), [1.0, 2.0], "nodes[0].attributes.position[2]", "required"),
        (("nodes", 0, "attributes", "position"), [1.0, 2.0, math.nan], "nodes[0].attributes.position[2]", "finite"),
        (("edges", 0, "target"), 5, "edges[0].target", "there is no node 5"),
        (
            ("nodes", 5, "attributes", "metadata"),
            {"majordomo": {"id": "room_1", "type": "room", "height_m": -1.0}},
            "nodes[5].attributes.metadata.majordomo.height_m",
            "greater than or equal to 0",
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named_with_its_path(foreign, path, value, named, why):
    with pytest.raises(SceneFormatError) as caught:
        from_spark_dsg(changed(foreign, path, value))
    assert caught.value.path == named
    assert why in caught.value.problem


def test_the_layers_are_those_of_the_format(house):
    document = to_spark_dsg(house)
    at = {
        n["attributes"].get("name") or n["id"]: (n["layer"], n["partition"], n["id"] >> 56) for n in document["nodes"]
    }
    assert at["building"] == (5, 0, ord("B"))
    assert at["kitchen"] == (4, 0, ord("R"))
    assert at["door_1_1_0"] == (3, 0, ord("D"))
    assert at["bottle_2"] == (2, 0, ord("O"))
    assert at[symbol("a", 0)] == (2, 97, ord("a"))
    assert at[symbol("h", 0)] == (2, 104, ord("h"))
    assert "wall_1_1" not in json.dumps(document["nodes"])


def test_a_file_in_either_format_is_read_and_written(house, tmp_path):
    dsg, ours = tmp_path / "house.dsg.json", tmp_path / "house.json"
    export(house, dsg, GraphFormat.SPARK_DSG)
    export(load_graph(dsg), ours, GraphFormat.MAJORDOMO)
    again = load_graph(ours)
    assert again.object("bottle_2") == house.object("bottle_2")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["house.dsg.json", "house.json"]
