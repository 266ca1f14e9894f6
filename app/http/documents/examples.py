"""Examples for the documentation, all of one story: the blue bottle goes to the desk."""

from __future__ import annotations

from typing import Any

REQUEST = "bring the blue bottle from the kitchen to the desk in the office"
_STEPS = [
    ("GOTO", ["bottle_1"]),
    ("PICK", ["bottle_1"]),
    ("GOTO", ["desk_1"]),
    ("PLACE", ["bottle_1", "desk_1"]),
]
PLAN: dict[str, Any] = {
    "source": "grammar",
    "revision": 412,
    "goals": [{"predicate": "on", "args": ["bottle_1", "desk_1"]}],
    "steps": [
        {"skill": skill, "args": args, "status": "pending", "actions": [], "seconds": 0.0} for skill, args in _STEPS
    ],
    "expected_s": 64.5,
    "expected_m": 11.2,
    "changes": {
        "added": [{"predicate": "on", "args": ["bottle_1", "desk_1"]}, {"predicate": "robot_at", "args": ["room_3"]}],
        "removed": [
            {"predicate": "on", "args": ["bottle_1", "table_1"]},
            {"predicate": "robot_at", "args": ["room_1"]},
        ],
    },
}
TASK: dict[str, Any] = {
    "id": "task_1",
    "request": REQUEST,
    "times": {"received_s": 81.2, "planned_s": 81.3, "started_s": None, "ended_s": None},
    "status": "awaiting_approval",
    "approval": "ask",
    "dry_run": False,
    "approved": False,
    "kind": "plan",
    "reply": "",
    "candidates": [],
    "dialogue": [],
    "plan": PLAN,
    "replans": 0,
    "failures": [],
    "verified": [],
    "explanation": "I fetch the blue bottle and put it on the desk. Shall I?",
}
SUBMITTED = TASK | {
    "status": "queued",
    "kind": None,
    "plan": None,
    "explanation": "",
    "times": TASK["times"] | {"planned_s": None},
}
TASKS = {"tasks": [TASK], "total": 1, "queue": [], "next": None}
TRACE = {
    "task": "task_1",
    "entries": [
        {
            "seq": 7,
            "stamp_s": 12.4,
            "at_s": 1790000000.0,
            "kind": "planned",
            "what": "GOTO(table_1), PICK(bottle_1), GOTO(desk_1), PLACE(bottle_1, desk_1)",
            "why": "the cheapest way to on(bottle_1, desk_1)",
            "data": {"revision": 412},
        }
    ],
    "dropped": 0,
    "next": None,
}
NODE: dict[str, Any] = {
    "id": "bottle_1",
    "type": "object",
    "label": "bottle",
    "room": "room_2",
    "position_m": [3.65, 1.65, 0.86],
    "yaw_rad": 0.0,
    "confidence": 0.98,
    "attributes": {"color": "blue", "accents": ["white"], "categories": ["drink"], "name": None},
    "position_std_m": [0.01, 0.01, 0.01],
    "size_m": [0.07, 0.07, 0.22],
    "state": "present",
    "last_seen_s": 79.8,
    "graspable": True,
    "support": False,
}
HISTORY = {
    "node": "bottle_1",
    "since_s": 0.2,
    "entries": [
        {"stamp_s": 31.4, "kind": "found", "before": None, "after": [3.65, 1.65, 0.86]},
        {"stamp_s": 79.8, "kind": "name", "before": None, "after": "Ada's bottle"},
        {"stamp_s": 96.2, "kind": "state", "before": "present", "after": "held"},
    ],
    "dropped": 0,
}
CAMERA = {
    "stamp_s": 81.0,
    "age_s": 0.2,
    "width": 320,
    "height": 240,
    "instances": [
        {
            "node": "bottle_1",
            "label": "bottle",
            "background": False,
            "score": 0.97,
            "box_px": [150, 90, 164, 131],
            "outline_px": [[[150, 96], [157, 90], [163, 96], [163, 130], [150, 130]]],
        }
    ],
}
EDGE = {"source": "bottle_1", "target": "table_1", "type": "relation", "label": "on", "probability": 0.97}
SCENE = {"revision": 412, "stamp_s": 81.2, "nodes": [NODE], "edges": [EDGE]}
NODES = {"revision": 412, "nodes": [NODE], "total": 1}
PATH = {
    "from": "bottle_1",
    "to": "desk_1",
    "rooms": ["room_2", "room_1", "room_3"],
    "doors": ["door_1_1_0", "door_1_1_1"],
    "length_m": 8.4,
}
STATUS: dict[str, Any] = {
    "stamp_s": 81.2,
    "clock": "real",
    "exploring": False,
    "explored": True,
    "task": "task_1",
    "stopped": False,
    "robot": {
        "room": "room_1",
        "localized": True,
        "pose_map": {"x": 0.0, "y": 0.2, "yaw_rad": 0.6},
        "holding": None,
    },
    "language_model": None,
    "agents": {"mission": {"rate_hz": 10.0, "busy_ms_p50": 0.1, "busy_ms_p99": 4.2, "restarts": 0}},
}
