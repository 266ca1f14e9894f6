"""Reading and teaching the scene graph over HTTP."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

pytestmark = pytest.mark.anyio

SVG = "{http://www.w3.org/2000/svg}"


async def found(service, **query):
    response = await service.client.post("/v1/scene/query", json=query)
    assert response.status_code == 200, response.text
    body = response.json()
    return [node["id"] for node in body["nodes"]], body["total"]


async def problem(response):
    assert response.headers["content-type"] == "application/problem+json", response.text
    return response.status_code, response.json()["code"]


async def test_the_scene_in_the_map_frame_is_the_stored_graph(service, scene):
    body = (await service.client.get("/v1/scene")).json()
    assert {"revision", "stamp_s", "nodes", "edges"} == body.keys()
    shown = {node["id"]: node for node in body["nodes"]}
    assert shown.keys() == scene.keys()
    for node_id, node in scene.items():
        assert shown[node_id]["position_m"] == pytest.approx(node["position_m"], abs=1e-5)
    room, door, bottle = shown["room_2"], shown["door_1_1_0"], shown["bottle_1"]
    assert room["polygon_m"] == [pytest.approx(corner, abs=1e-5) for corner in scene["room_2"]["polygon_m"]]
    assert door.keys() >= {"width_m", "rooms", "state", "yaw_rad"}
    assert bottle.keys() >= {"attributes", "position_std_m", "size_m", "state", "last_seen_s", "graspable", "support"}
    assert shown["person_1"]["name"] == "Ada"
    assert all(edge.keys() >= {"source", "target", "type", "label", "probability"} for edge in body["edges"])


async def test_in_the_room_frame_positions_count_from_the_room(service, scene):
    body = (await service.client.get("/v1/scene", params={"frame": "room"})).json()
    shown = {node["id"]: node for node in body["nodes"]}
    expected = [a - b for a, b in zip(scene["bottle_1"]["position_m"], scene["room_2"]["position_m"], strict=True)]
    assert shown["bottle_1"]["position_m"] == pytest.approx(expected, abs=1e-5)


async def test_layers_choose_node_types_and_only_edges_among_them(service):
    body = (await service.client.get("/v1/scene", params={"layer": ["room", "objects"]})).json()
    assert {node["type"] for node in body["nodes"]} == {"room", "object"}
    ids = {node["id"] for node in body["nodes"]}
    assert all(edge["source"] in ids and edge["target"] in ids for edge in body["edges"])
    assert await problem(await service.client.get("/v1/scene", params={"layer": "dreams"})) == (422, "unknown_layer")
    assert await problem(await service.client.get("/v1/scene", params={"frame": "moon"})) == (422, "invalid_request")


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ({"type": "room"}, ["room_1", "room_2", "room_3"]),
        ({"type": ["person", "robot"]}, ["person_1", "robot"]),
        ({"label": "Cup"}, ["cup_1", "cup_2"]),
        ({"attributes": {"color": "blue"}}, ["bottle_1"]),
        ({"attributes": {"category": "snack"}}, ["apple_1"]),
        ({"type": "object", "label": "cup", "room": "office"}, ["cup_2"]),
        ({"label": "bottle", "room": "room_2"}, ["bottle_1", "bottle_2"]),
        ({"relation": {"predicate": "on", "target": "table_1"}}, ["bottle_1", "bowl_1"]),
        ({"relation": {"predicate": "in"}}, ["apple_1"]),
        ({"state": "missing"}, ["book_2"]),
        ({"state": "closed"}, ["door_2_0_0"]),
        ({"type": "object", "near": {"node": "desk_1", "radius_m": 0.7}, "state": "present"}, ["cup_2", "laptop_1"]),
        ({"type": "object", "near": {"point_m": [3.65, 1.65], "radius_m": 0.1}}, ["bottle_1"]),
        ({"attributes": {"name": "Ada"}}, ["person_1"]),
    ],
)
async def test_queries_filter_by_what_nodes_say(service, query, expected):
    ids, total = await found(service, **query)
    assert total == len(ids)
    assert ids == expected


async def test_queries_order_and_page_and_count_everything(service):
    everything, total = await found(service, type="object")
    assert len(everything) == total
    pages = [await found(service, type="object", limit=5, offset=offset) for offset in range(0, total, 5)]
    assert [node_id for page, _ in pages for node_id in page] == everything
    assert {count for _, count in pages} == {total}
    largest, _ = await found(service, type="object", order_by="size", descending=True, limit=1)
    assert largest == ["counter_1"]
    nearest, _ = await found(
        service, label="cup", near={"node": "desk_1", "radius_m": 20}, order_by="distance", limit=1
    )
    assert nearest == ["cup_2"]


async def test_queries_by_age_know_what_was_seen_lately(service, scene):
    recent, _ = await found(service, type="object", max_age_s=60)
    assert "book_2" not in recent
    assert "bottle_1" in recent


@pytest.mark.parametrize(
    ("query", "expected"),
    [
        ({"type": "unicorn"}, (422, "invalid_query")),
        ({"attributes": {"smell": "sweet"}}, (422, "invalid_query")),
        ({"order_by": "beauty"}, (422, "invalid_query")),
        ({"room": "attic"}, (404, "invalid_query")),
        ({"near": {"radius_m": 1.0}}, (422, "invalid_query")),
        ({"near": {"node": "desk_1", "point_m": [0, 0], "radius_m": 1.0}}, (422, "invalid_query")),
        ({"near": {"node": None, "point_m": None, "radius_m": 1.0}}, (422, "invalid_query")),
        ({"near": {"point_m": [0.0], "radius_m": 1.0}}, (422, "invalid_request")),
        ({"near": {"node": "desk_9", "radius_m": 1.0}}, (404, "node_not_found")),
        ({"relation": {"target": "desk_9"}}, (404, "node_not_found")),
        ({"near": {"node": "desk_1", "radius_m": 0.0}}, (422, "invalid_request")),
        ({"limit": 0}, (422, "invalid_request")),
        ({"limit": 1001}, (422, "invalid_request")),
        ({"offset": -1}, (422, "invalid_request")),
        ({"max_age_s": -1}, (422, "invalid_request")),
        ({"colour": "blue"}, (422, "invalid_request")),
    ],
)
async def test_impossible_queries_say_why(service, query, expected):
    response = await service.client.post("/v1/scene/query", json=query)
    assert await problem(response) == expected
    assert response.json()["detail"]


@pytest.mark.parametrize(
    ("near", "field"),
    [
        ({"radius_m": 1.0}, "near"),
        ({"node": "desk_1", "radius_m": 0.0}, "near.radius_m"),
        ({"point_m": [0.0, "east"], "radius_m": 1.0}, "near.point_m.1"),
    ],
)
async def test_a_flaw_is_named_by_the_field_that_the_client_wrote(service, near, field):
    response = await service.client.post("/v1/scene/query", json={"near": near})
    assert [flaw["field"] for flaw in response.json()["fields"]] == [field]


async def test_blanks_around_what_is_taught_are_taken_off(service):
    taught = await service.client.patch("/v1/scene/nodes/room_1", json={"label": " music room\n", "region": None})
    assert taught.json()["label"] == "music room"


async def test_numbers_that_are_none_are_refused(service):
    for number in ("NaN", "Infinity"):
        content = f'{{"near": {{"node": "desk_1", "radius_m": {number}}}}}'
        headers = {"Content-Type": "application/json"}
        response = await service.client.post("/v1/scene/query", content=content, headers=headers)
        assert await problem(response) == (422, "invalid_request")


async def test_a_path_goes_through_open_doors_only(service):
    path = (await service.client.get("/v1/scene/path", params={"from": "bottle_1", "to": "desk_1"})).json()
    assert path["rooms"] == ["room_2", "room_1", "room_3"]
    assert path["doors"] == ["door_1_1_0", "door_1_1_1"]
    assert path["length_m"] > 0
    from_robot = (await service.client.get("/v1/scene/path", params={"to": "room_2"})).json()
    assert (from_robot["from"], from_robot["rooms"]) == ("robot", ["room_1", "room_2"])


async def test_a_path_to_nowhere_is_not_found(service):
    response = await service.client.get("/v1/scene/path", params={"from": "robot", "to": "attic"})
    assert await problem(response) == (404, "node_not_found")
    assert await problem(await service.client.get("/v1/scene/path")) == (422, "invalid_request")


async def test_a_room_that_was_taught_its_name_is_found_by_it(service):
    response = await service.client.patch("/v1/scene/nodes/room_3", json={"label": " study "})
    assert (response.status_code, response.json()["label"]) == (200, "study")
    assert response.json()["label_taught"] is True
    assert (await found(service, label="cup", room="study"))[0] == ["cup_2"]
    task = await service.ask("what is in the study?")
    assert "laptop" in task["reply"]


async def test_a_person_and_a_thing_take_a_name(service):
    person = await service.client.patch("/v1/scene/nodes/person_1", json={"name": "Grace"})
    assert person.json()["name"] == "Grace"
    mug = await service.client.patch("/v1/scene/nodes/cup_1", json={"name": "my mug"})
    assert mug.json()["attributes"]["name"] == "my mug"


@pytest.mark.parametrize(
    ("node", "body", "expected"),
    [
        ("attic", {"label": "attic"}, (404, "node_not_found")),
        ("robot", {"label": "Marvin"}, (409, "not_teachable")),
        ("door_1_1_0", {"label": "exit"}, (409, "not_teachable")),
        ("room_1", {"name": "hall"}, (409, "not_teachable")),
        ("room_1", {}, (422, "invalid_request")),
        ("room_1", {"label": None, "name": None}, (422, "invalid_request")),
        ("room_1", {"label": ""}, (422, "invalid_request")),
        ("room_1", {"label": " \t"}, (422, "invalid_request")),
        ("room_1", {"label": "x" * 81}, (422, "invalid_request")),
        ("room_1", {"label": "a\nb"}, (422, "invalid_request")),
        ("room_1", {"label": "bell\x07"}, (422, "invalid_request")),
        ("room_1", {"polygon_m": []}, (422, "invalid_request")),
    ],
)
async def test_what_cannot_be_taught_is_refused_and_changes_nothing(service, node, body, expected):
    before = service.runtime.memory.snapshot().revision
    assert await problem(await service.client.patch(f"/v1/scene/nodes/{node}", json=body)) == expected
    assert service.runtime.memory.snapshot().revision == before


async def test_the_map_picture_is_well_formed_and_shows_what_is_known(service):
    response = await service.client.get("/v1/map.svg")
    assert response.headers["content-type"] == "image/svg+xml"
    picture = ET.fromstring(response.text)
    assert picture.tag == f"{SVG}svg"
    names = {text.text for text in picture.iter(f"{SVG}text")}
    assert {"hall", "kitchen", "office", "table", "desk"} <= names
    titles = {title.text for title in picture.iter(f"{SVG}title")}
    assert {"bottle", "Ada", "robot"} <= titles


async def test_names_are_escaped_in_the_map_picture(service):
    hostile = "<script>alert('x')</script> & \"]]>"
    await service.client.patch("/v1/scene/nodes/room_3", json={"label": hostile})
    await service.client.patch("/v1/scene/nodes/desk_1", json={"label": hostile})
    picture = ET.fromstring((await service.client.get("/v1/map.svg")).text)
    assert not list(picture.iter("script"))
    assert not list(picture.iter(f"{SVG}script"))
    assert hostile in {text.text for text in picture.iter(f"{SVG}text")}


async def test_without_a_robot_there_is_no_camera_picture(service):
    assert await problem(await service.client.get("/v1/camera.jpg")) == (404, "no_camera")


async def test_a_node_tells_what_became_of_it(service, viewer_token):
    await service.client.patch("/v1/scene/nodes/cup_1", json={"name": "my mug"})
    await service.runtime.wait_for_change()
    headers = {"Authorization": f"Bearer {viewer_token}"}
    past = (await service.client.get("/v1/scene/nodes/cup_1/history", headers=headers)).json()
    assert past["node"] == "cup_1"
    assert [(entry["kind"], entry["after"]) for entry in past["entries"][1:]] == [("name", "my mug")]
    assert past["entries"][0]["kind"] == "known"
    wall = (await service.client.get("/v1/scene/nodes/wall_1_0/history")).json()
    assert wall["entries"] == []
    assert await problem(await service.client.get("/v1/scene/nodes/attic/history")) == (404, "node_not_found")
