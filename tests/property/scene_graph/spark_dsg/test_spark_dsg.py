"""Through Spark-DSG and back, all that has a layer there is what it was, for random houses; its own library agrees."""

import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from property.scene_graph.documents.test_interchange import houses, poses, probabilities
from scene_graph.documents.interchange import to_json
from scene_graph.edges import InEdge, RtEdge
from scene_graph.nodes import PersonNode, RegionNode, RoomNode
from scene_graph.snapshot import Snapshot
from scene_graph.spark_dsg.reader import from_spark_dsg, is_spark_dsg
from scene_graph.spark_dsg.writer import CARRIED, to_spark_dsg

law = settings(max_examples=30)


@st.composite
def inhabited(draw):
    """A random house, perhaps with people, and with rooms that may belong to a wing."""
    house = draw(houses())
    nodes, edges = list(house.nodes.values()), list(house.edges.values())
    rooms = [room.id for room in house.of_type(RoomNode)]
    if (hung := house.parent("robot").source) in rooms:
        edges.append(InEdge(source="robot", target=hung))
    for i in range(draw(st.integers(0, 2))):
        person, room = f"person_{i}", draw(st.sampled_from(rooms))
        nodes.append(PersonNode(id=person, name=draw(st.text(max_size=3)), confidence=draw(probabilities)))
        edges += [RtEdge(source=room, target=person, T_source_target=draw(poses)), InEdge(source=person, target=room)]
    wing = [room for room in rooms if draw(st.booleans())]
    if wing:
        nodes.append(RegionNode(id="region_1", label="wing"))
        edges += [InEdge(source=room, target="region_1") for room in wing]
    return Snapshot.of(nodes, edges, revision=house.revision, stamp_s=house.stamp_s)


def carried(snapshot):
    """Nodes by identifier, and edges but for frames and loops, of what Spark-DSG has a layer for."""
    document = to_json(snapshot, layers=[str(kind) for kind in CARRIED])
    edges = [edge for edge in document["edges"] if edge["type"] != "rt" and edge["source"] != edge["target"]]
    return (
        document["revision"],
        document["stamp_s"],
        {node["id"]: node for node in document["nodes"]},
        sorted(map(str, edges)),
    )


def assert_same(after, before):
    assert after[:2] == before[:2]
    assert after[2].keys() == before[2].keys()
    for node_id, node in before[2].items():
        assert_same_node(after[2][node_id], node)
    assert after[3] == before[3]


def assert_same_node(after, before):
    """Outlines go through the frame of their room and back, and a half turn may come out with either sign."""
    turned = abs(math.remainder(after["yaw_rad"] - before["yaw_rad"], math.tau))
    assert turned == pytest.approx(0.0, abs=1e-5)
    assert after["position_m"] == pytest.approx(before["position_m"], abs=1e-5)
    assert len(after.get("polygon_m", ())) == len(before.get("polygon_m", ()))
    for corner, as_before in zip(after.get("polygon_m", ()), before.get("polygon_m", ()), strict=True):
        assert corner == pytest.approx(as_before, abs=1e-4)
    inexact = {"yaw_rad", "position_m", "polygon_m"}
    assert {key: value for key, value in after.items() if key not in inexact} == {
        key: value for key, value in before.items() if key not in inexact
    }


@law
@given(inhabited())
def test_what_has_a_layer_comes_back_as_it_was(house):
    document = to_spark_dsg(house)
    assert is_spark_dsg(document)
    assert_same(carried(from_spark_dsg(json.loads(json.dumps(document)))), carried(house))


@law
@given(inhabited())
def test_its_own_library_reads_it_and_writes_the_same_building(tmp_path_factory, house):
    spark_dsg = pytest.importorskip("spark_dsg")
    folder = tmp_path_factory.mktemp("dsg")
    document = to_spark_dsg(house)
    (folder / "ours.json").write_text(json.dumps(document))
    graph = spark_dsg.DynamicSceneGraph.load(str(folder / "ours.json"))
    assert {node["id"] for node in document["nodes"]} == {node.id.value for node in graph.nodes}
    assert graph.num_edges() == len(document["edges"])
    graph.save(str(folder / "theirs.json"), False)
    theirs = json.loads((folder / "theirs.json").read_text())
    again, before = carried(from_spark_dsg(theirs)), carried(house)
    assert again[2].keys() == before[2].keys()
    for node_id, node in before[2].items():  # theirs are single precision
        as_theirs = again[2][node_id].pop("size_m", ())
        assert as_theirs == pytest.approx(node.pop("size_m", ()), abs=1e-5)
    assert_same(again, before)
