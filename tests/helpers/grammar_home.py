"""A home of six rooms for what people say to a robot; one of its doors is closed."""

from __future__ import annotations

from planner.doubles.sketch import flat
from scene_graph.nodes import DoorState


def home():
    """The flat, with a bedroom, and a bathroom behind a closed door."""
    sketch = flat().room("room_5", "bedroom", at=(8.4, 4.2)).door("room_3", "room_5", at=(8.4, 2.1))
    sketch.room("room_6", "bathroom", at=(0.0, 4.2)).door("room_1", "room_6", at=(0.0, 2.1), state=DoorState.CLOSED)
    sketch.furniture("bed_1", "bed", "room_5", at=(8.4, 5.0), size_m=(2.0, 1.6, 0.5))
    sketch.furniture("nightstand_1", "nightstand", "room_5", at=(9.9, 5.0), size_m=(0.4, 0.4, 0.5))
    sketch.furniture("fridge_1", "refrigerator", "room_1", at=(1.6, -1.5), size_m=(0.6, 0.6, 1.8))
    sketch.furniture("sink_1", "sink", "room_6", at=(0.5, 5.5), size_m=(0.6, 0.5, 0.9))
    sketch.thing("phone_1", "cell phone", on="nightstand_1", color="black")
    sketch.thing("book_2", "book", on="bed_1", color="blue", size_m=(0.05, 0.15, 0.2))
    sketch.thing("book_3", "book", on="bed_1", at=(8.8, 5.0), color="yellow", size_m=(0.05, 0.15, 0.2))
    sketch.thing("bowl_1", "bowl", on="table_2", at=(8.6, 1.0), color="white", size_m=(0.1, 0.1, 0.06))
    sketch.thing("sock_1", "sock", on="room_3", at=(9.6, -1.2), color="gray")
    sketch.thing("towel_1", "towel", on="sink_1", color="white")
    sketch.thing("pen_1", "pen", on="desk_1", at=(4.2, 5.4), color="black", size_m=(0.02, 0.1, 0.02))
    return sketch.thing("key_1", "key", on="table_1", at=(0.0, 0.9), color="silver", size_m=(0.02, 0.05, 0.01))
