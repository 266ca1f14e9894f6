"""Teaching floors and wings over HTTP."""

from __future__ import annotations

import pytest

pytestmark = pytest.mark.anyio


async def teach(service, room, region):
    response = await service.client.patch(f"/v1/scene/nodes/{room}", json={"region": region})
    assert response.status_code == 200, response.text
    return response.json()["region"]


async def regions(service):
    nodes = (await service.client.get("/v1/scene", params={"layer": "regions"})).json()["nodes"]
    return {node["id"]: (node["label"], node["rooms"]) for node in nodes}


async def test_rooms_taught_the_same_region_are_in_one(service):
    assert await teach(service, "room_1", "Ground floor") == "region_1"
    assert await teach(service, "room_2", "ground floor") == "region_1"
    assert await teach(service, "room_3", "upstairs") == "region_2"
    assert await regions(service) == {
        "region_1": ("Ground floor", ["room_1", "room_2"]),
        "region_2": ("upstairs", ["room_3"]),
    }


async def test_a_room_moves_to_another_region_and_an_empty_region_goes(service):
    for room in ("room_1", "room_2"):
        await teach(service, room, "ground floor")
    await teach(service, "room_3", "upstairs")
    assert await teach(service, "room_3", "region_1") == "region_1"
    assert await regions(service) == {"region_1": ("ground floor", ["room_1", "room_2", "room_3"])}
    assert await teach(service, "room_3", "ground floor") == "region_1"


async def test_a_region_is_renamed_queried_and_gone_to(service):
    await teach(service, "room_2", "upstairs")
    renamed = await service.client.patch("/v1/scene/nodes/region_1", json={"label": "first floor"})
    assert renamed.json()["label"] == "first floor"
    found = await service.client.post("/v1/scene/query", json={"region": "First floor", "type": "room"})
    assert [node["id"] for node in found.json()["nodes"]] == ["room_2"]
    path = await service.client.get("/v1/scene/path", params={"to": "region_1"})
    assert path.json()["rooms"][-1] == "room_2"


@pytest.mark.parametrize(
    ("node", "body", "expected"),
    [
        ("bottle_1", {"region": "upstairs"}, (409, "not_teachable")),
        ("room_99", {"region": "upstairs"}, (404, "node_not_found")),
        ("room_1", {"region": " "}, (422, "invalid_request")),
    ],
)
async def test_only_rooms_are_in_regions(service, node, body, expected):
    response = await service.client.patch(f"/v1/scene/nodes/{node}", json=body)
    assert (response.status_code, response.json()["code"]) == expected


async def test_an_unknown_region_in_a_query_is_told(service):
    response = await service.client.post("/v1/scene/query", json={"region": "attic"})
    assert (response.status_code, response.json()["code"]) == (404, "invalid_query")
